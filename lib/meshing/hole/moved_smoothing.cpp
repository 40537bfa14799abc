#include "meshing/hole/moved_smoothing.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/boxes.h"
#include "base/lists_by_key.h"
#include "base/sort_once.h"
#include "base/sparse.h"
#include "mesh/quality.h"

namespace st {
namespace {

constexpr double kGood = 0.6;  // quality above which a triangle asks for nothing: twice the bound below which it is
                               // made again, so that further moves find some room
constexpr int kRings = 3;      // of nodes around bad triangles that give way
constexpr int kSweeps = 40;    // over these nodes, at most
constexpr double kFirstStep = 0.25;  // of the extent of a node's triangles in u and in v
constexpr double kLastStep = 0.01;   // likewise: a node that finds nothing better there rests
constexpr double kBetter = 1e-4;     // gain of quality that counts

double uv_area(const SurfaceMesh& m, TriangleId t) {
  const Vec2* uv = &m.corner_uv[3 * static_cast<std::size_t>(t)];
  return cross(uv[1] - uv[0], uv[2] - uv[0]);
}

double area_of(const SurfaceMesh& m, TriangleId t) {
  const NodeId* n = m.triangles[t].n;
  return 0.5 * norm(cross(m.node_xyz[n[1]] - m.node_xyz[n[0]], m.node_xyz[n[2]] - m.node_xyz[n[0]]));
}

double quality_of(const SurfaceMesh& m, TriangleId t, std::span<const Vec3> squeeze) {
  const auto [a, b, c] = TriangleCorners(m, squeeze)(t);
  return triangle_quality(a, b, c);
}

class FaceSmoother {
 public:
  FaceSmoother(const Surface& surface, const SurfaceMesh& old, TriangleId begin, TriangleId end, double side,
               std::span<const Vec3> squeeze, SurfaceMesh& moved)
      : surface_(surface), old_(old), m_(moved), begin_(begin), end_(end), side_(side), squeeze_(squeeze) {}

  void run() {
    find_nodes();
    if (nodes_.empty()) return;
    find_stars();
    step_.assign(nodes_.size(), kFirstStep);
    for (int sweep = 0, n_bad = 1; sweep < kSweeps && n_bad > 0; ++sweep) {
      n_bad = 0;
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (step_[i] >= kLastStep) n_bad += improve(i);
    }
  }

 private:
  using Corner = std::size_t;  // 3 * triangle + k

  /// Quality; of turned triangles minus their area, which a node that leaves only makes worse, by that before the move.
  double rated(TriangleId t) const {
    const double q = moved_quality(old_, m_, t, side_, squeeze_);
    return q > 0 ? q : -area_of(m_, t) / std::max(area_of(old_, t), 1e-300);
  }

  /// Nodes inside the face at bad triangles, and rings of nodes around them, ascending.
  void find_nodes() {
    std::vector<NodeId> touched;
    const auto touch = [&](TriangleId t) { touched.insert(touched.end(), m_.triangles[t].n, m_.triangles[t].n + 3); };
    for (TriangleId t = begin_; t < end_; ++t)
      if (const double q = rated(t); q < kGood && q < quality_of(old_, t, squeeze_) - kBetter) touch(t);
    if (touched.empty()) return;
    for (int ring = 0; ring < kRings; ++ring) {
      sort_once(touched);
      const std::vector<NodeId> before = touched;
      for (TriangleId t = begin_; t < end_; ++t)
        if (std::any_of(m_.triangles[t].n, m_.triangles[t].n + 3,
                        [&](NodeId n) { return std::binary_search(before.begin(), before.end(), n); }))
          touch(t);
    }
    sort_once(touched);
    for (const NodeId n : touched)
      if (m_.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace)) nodes_.push_back(n);
  }

  void find_stars() {
    star_ = {nodes_.size(), [&](const auto& visit) {
               for (Corner c = 3 * static_cast<Corner>(begin_); c < 3 * static_cast<Corner>(end_); ++c) {
                 const NodeId n = m_.triangles[c / 3].n[c % 3];
                 const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), n);
                 if (found != nodes_.end() && *found == n) visit(found - nodes_.begin(), c);
               }
             }};
  }

  double worst(std::size_t i) const {
    double least = 1;
    for (const Corner c : star_[i]) least = std::min(least, rated(static_cast<TriangleId>(c / 3)));
    return least;
  }

  /// All corners at the node move alike: across a period they differ by it.
  void shift(std::size_t i, Vec2 by) {
    for (const Corner c : star_[i]) m_.corner_uv[c] = m_.corner_uv[c] + by;
    m_.node_xyz[nodes_[i]] = surface_.point(m_.corner_uv[star_[i][0]]);
  }

  /// Takes the best of some places if it is better than its own. Returns false for a node that needs none.
  bool improve(std::size_t i) {
    const double before = worst(i);
    if (before >= kGood) return false;
    Vec2 to_middle;
    Box2 extent;
    for (const Corner c : star_[i]) {
      const Corner first = c - c % 3;
      for (const Corner other : {first + (c + 1) % 3, first + (c + 2) % 3}) {
        const Vec2 d = m_.corner_uv[other] - m_.corner_uv[c];
        extent.add(d);
        to_middle = to_middle + (0.5 / static_cast<double>(star_[i].size())) * d;
      }
    }
    const double du = step_[i] * (extent.hi.x - extent.lo.x), dv = step_[i] * (extent.hi.y - extent.lo.y);
    const std::array<Vec2, 10> moves = {to_middle, 0.5 * to_middle, {du, 0},   {-du, 0},  {0, dv},
                                        {0, -dv},  {du, dv},        {du, -dv}, {-du, dv}, {-du, -dv}};
    double best = before + kBetter;
    std::optional<Vec2> chosen;
    const Vec3 x = m_.node_xyz[nodes_[i]];
    std::vector<Vec2> own;
    for (const Corner c : star_[i]) own.push_back(m_.corner_uv[c]);
    const auto back = [&] {
      for (std::size_t k = 0; k < own.size(); ++k) m_.corner_uv[star_[i][k]] = own[k];
      m_.node_xyz[nodes_[i]] = x;
    };
    for (const Vec2 move : moves) {
      shift(i, move);
      if (const double q = worst(i); q > best) best = q, chosen = move;
      back();
    }
    if (chosen)
      shift(i, *chosen);
    else
      step_[i] *= 0.5;
    return true;
  }

  const Surface& surface_;
  const SurfaceMesh& old_;
  SurfaceMesh& m_;
  const TriangleId begin_, end_;
  const double side_;
  const std::span<const Vec3> squeeze_;
  std::vector<NodeId> nodes_;  // ascending
  std::vector<double> step_;   // [nodes_]
  ListsByKey<Corner> star_;    // corners at each of these nodes
};

}  // namespace

double moved_quality(const SurfaceMesh& old, const SurfaceMesh& moved, TriangleId t, double side,
                     std::span<const Vec3> squeeze) {
  const double q = quality_of(moved, t, squeeze);
  return side * uv_area(moved, t) * uv_area(old, t) > 0 ? q : -q;
}

void spread_boundary_shift(const SurfaceMesh& old, TriangleId begin, TriangleId end, std::span<const Vec2> by,
                           SurfaceMesh& moved) {
  const auto is_inner = [&](NodeId n) { return old.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace); };
  std::vector<NodeId> inner;
  for (TriangleId t = begin; t < end; ++t)
    std::copy_if(old.triangles[t].n, old.triangles[t].n + 3, std::back_inserter(inner), is_inner);
  sort_once(inner);
  const auto number = [&](NodeId n) {
    return static_cast<std::int32_t>(std::lower_bound(inner.begin(), inner.end(), n) - inner.begin());
  };
  std::vector<SparseEntry> matrix;
  std::vector<double> u(inner.size(), 0), v(inner.size(), 0);
  for (std::size_t c = 3 * static_cast<std::size_t>(begin); c < 3 * static_cast<std::size_t>(end); ++c)
    for (const std::size_t other : {c - c % 3 + (c + 1) % 3, c - c % 3 + (c + 2) % 3}) {
      const NodeId a = old.triangles[c / 3].n[c % 3], b = old.triangles[other / 3].n[other % 3];
      if (!is_inner(a)) continue;
      const double weight = 1 / std::max(norm2(old.node_xyz[a] - old.node_xyz[b]), 1e-300);
      const std::int32_t row = number(a);
      matrix.push_back({row, row, weight});
      if (is_inner(b)) {
        matrix.push_back({row, number(b), -weight});
      } else {
        const Vec2 shift = by[other - 3 * static_cast<std::size_t>(begin)];
        u[row] += weight * shift.x, v[row] += weight * shift.y;
      }
    }
  if (inner.empty()) return;
  SymmetricSolver solver;
  const auto du = solver.solve(matrix, u), dv = solver.solve(matrix, v);
  if (!du || !dv) return;  // what the map gave is good, too
  for (std::size_t c = 3 * static_cast<std::size_t>(begin); c < 3 * static_cast<std::size_t>(end); ++c)
    if (const NodeId n = old.triangles[c / 3].n[c % 3]; is_inner(n))
      moved.corner_uv[c] = moved.corner_uv[c] + Vec2{(*du)[number(n)], (*dv)[number(n)]};
}

void smooth_moved_face(const Surface& surface, const SurfaceMesh& old, TriangleId begin, TriangleId end, double side,
                       std::span<const Vec3> squeeze, SurfaceMesh& moved) {
  FaceSmoother(surface, old, begin, end, side, squeeze, moved).run();
}

}  // namespace st
