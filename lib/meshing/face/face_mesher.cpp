#include "meshing/face/face_mesher.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/limits.h"
#include "base/predicates.h"
#include "meshing/face/front.h"
#include "meshing/face/stretch.h"

namespace st {
namespace {

constexpr double kSnap = 1e-3;       // of the length: nearer nodes of one id are one (docs/design/kernel.md)
constexpr double kSnapPlane = 0.05;  // likewise in the scaled plane, where the surface is singular and all steps are
                                     // short
constexpr double kSmallStep = 2e-3;  // of the range of (u,v): far less than the steps between the nodes of a pole
constexpr double kSingular = 0.02;   // of its mean: a derivative shorter than this makes no reliable normal
constexpr int kProbe = 6;            // grid of the scale of the plane
constexpr int kAreaProbe = 10;       // grid of the expected number of nodes
constexpr double kMaxNodesOfFace = kMaxTriangles / 2.0;  // two triangles to a node
constexpr double kRunaway = 30;                          // times the expected number of nodes

/// Work on one face: the named steps of meshing.
class FaceMesher {
 public:
  FaceMesher(const Surface& surface, const FaceBoundary& boundary) : surface_(surface), boundary_(boundary) {
    work_.surface = &surface;
  }

  std::vector<RefinementPoint> prepare() {
    scale_plane();
    add_nodes();
    add_segments();
    std::vector<RefinementPoint> places;
    for (const LoopConflict& c : work_.mesh.build(work_.segments)) places.push_back(place_of(c));
    return places;
  }

  FaceMesh mesh(const SizeField& field, const FaceMeshOptions& options) {
    FaceMesh result;
    if (boundary_.nodes.size() < 3) {
      result.cause = FailureCause::kShortLoops;
      return result;
    }
    result.refinement = prepare();
    if (!result.refinement.empty()) {
      result.cause = FailureCause::kCrossingLoops;
      return result;
    }
    work_.field = &field;
    if (field.is_stretched())
      for (std::int32_t i = 0; i < work_.mesh.n_boundary; ++i) {
        MeshNode& n = work_.mesh.nodes[i];
        n.squeeze = squeeze_of(field.local(n.x, work_.hint), n.normal);
      }
    work_.max_turning = radians(options.max_turning_deg);
    work_.max_nodes = expected_nodes();
    advance_front(work_);
    if (work_.mesh.nodes.size() >= work_.max_nodes) {
      result.cause = FailureCause::kTooManyNodes;
      collect(result);
      return result;
    }
    enhance(work_, options.enhance_rounds);
    collect(result);
    validate(result);
    return result;
  }

 private:
  void scale_plane() {
    double su = 0, sv = 0;
    const double du = (surface_.u_max() - surface_.u_min()) / kProbe,
                 dv = (surface_.v_max() - surface_.v_min()) / kProbe;
    for (int i = 0; i < kProbe; ++i)
      for (int j = 0; j < kProbe; ++j) {
        const SurfacePoint s =
            surface_.evaluate({surface_.u_min() + (i + 0.5) * du, surface_.v_min() + (j + 0.5) * dv});
        su += norm(s.du);
        sv += norm(s.dv);
      }
    const double n = kProbe * kProbe;
    work_.scale = {su > 0 && std::isfinite(su) ? su / n : 1.0, sv > 0 && std::isfinite(sv) ? sv / n : 1.0};
  }

  /// Plane nodes; nodes of the same id that nearly coincide become one.
  void add_nodes() {
    std::map<std::int32_t, std::vector<std::int32_t>> same;
    node_of_.resize(boundary_.nodes.size());
    for (std::size_t i = 0; i < boundary_.nodes.size(); ++i) {
      const FaceNode& b = boundary_.nodes[i];
      MeshNode n{b};
      n.p = {b.uv.x * work_.scale.x, b.uv.y * work_.scale.y};
      work_.evaluate(n);
      n.normal = reliable_normal(n);
      n.x = b.x;
      n.request = b.h;
      std::vector<std::int32_t>& twins = same[b.id];
      std::int32_t found = kNone;
      for (std::int32_t t : twins) {
        const MeshNode& o = work_.mesh.nodes[t];
        const Vec2 d = o.p - n.p;
        if (norm(d.x * n.du + d.y * n.dv) < kSnap * b.h && (norm(d) < kSnapPlane * b.h || is_small_step(d))) found = t;
        if (d.x == 0 && d.y == 0) found = t;
      }
      if (found == kNone) {
        found = static_cast<std::int32_t>(work_.mesh.nodes.size());
        work_.mesh.nodes.push_back(n);
        local_to_boundary_.push_back(static_cast<std::int32_t>(i));
        twins.push_back(found);
      }
      node_of_[i] = found;
    }
    for (const auto& [id, twins] : same)  // a degenerate edge of no extent is no pole
      if (twins.size() == 1) work_.mesh.nodes[twins[0]].is_pole = false;
  }

  bool is_small_step(Vec2 d) const {
    return std::abs(d.x) < kSmallStep * work_.scale.x * (surface_.u_max() - surface_.u_min()) &&
           std::abs(d.y) < kSmallStep * work_.scale.y * (surface_.v_max() - surface_.v_min());
  }

  /// The normal a little inside where the parametrisation is singular at the boundary.
  Vec3 reliable_normal(const MeshNode& n) const {
    if (norm(n.du) > kSingular && norm(n.dv) > kSingular) return n.normal;
    const Vec2 middle{0.5 * (surface_.u_min() + surface_.u_max()), 0.5 * (surface_.v_min() + surface_.v_max())};
    MeshNode inside = n;
    inside.p = n.p + 0.01 * Vec2{(middle.x - n.uv.x) * work_.scale.x, (middle.y - n.uv.y) * work_.scale.y};
    work_.evaluate(inside);
    return inside.normal;
  }

  void add_segments() {
    for (const auto& [a, b] : boundary_.segments)
      if (node_of_[a] != node_of_[b]) work_.segments.push_back({node_of_[a], node_of_[b]});
  }

  RefinementPoint place_of(const LoopConflict& c) const {
    const auto& n = work_.mesh.nodes;
    Vec3 x = 0.25 * (n[c.node_a].x + n[c.node_b].x + n[c.other_a].x + n[c.other_b].x);
    const double h = std::max(
        {distance(n[c.node_a].x, n[c.node_b].x), distance(n[c.other_a].x, n[c.other_b].x), 1e-3 * n[c.node_a].h});
    return {x, 0.5 * h};
  }

  /// What area over squared length explains, with a wide margin.
  std::size_t expected_nodes() {
    const double du = (surface_.u_max() - surface_.u_min()) / kAreaProbe,
                 dv = (surface_.v_max() - surface_.v_min()) / kAreaProbe;
    double n = 0;
    for (int i = 0; i < kAreaProbe; ++i)
      for (int j = 0; j < kAreaProbe; ++j) {
        const SurfacePoint s =
            surface_.evaluate({surface_.u_min() + (i + 0.5) * du, surface_.v_min() + (j + 0.5) * dv});
        const double h = work_.field->size(s.x, work_.hint);
        n += norm(cross(s.du, s.dv)) * du * dv / (h * h);
      }
    const double boundary = static_cast<double>(boundary_.nodes.size());
    return static_cast<std::size_t>(std::min(kMaxNodesOfFace, kRunaway * (n + boundary * boundary) + 10000));
  }

  void collect(FaceMesh& result) const {
    const Triangulation& m = work_.mesh;
    const std::int32_t n_local = m.n_boundary, first_inner = n_local + 4;
    const std::int32_t n_boundary = static_cast<std::int32_t>(boundary_.nodes.size());
    std::vector<std::int32_t> number(m.nodes.size(), kNone);
    for (std::int32_t i = 0; i < n_local; ++i) number[i] = local_to_boundary_[i];
    for (const PlaneTriangle& t : m.triangles) {
      if (t.state == kOutside || t.state == kDead) continue;
      int n_pole = 0;
      for (std::int32_t v : t.v) n_pole += m.nodes[v].is_pole;
      if (n_pole >= 2 && same_pole(t)) continue;
      for (std::int32_t v : t.v) {
        if (number[v] == kNone && v >= first_inner) {
          number[v] = n_boundary + static_cast<std::int32_t>(result.inner.size());
          result.inner.push_back(m.nodes[v]);
        }
        result.corners.push_back(number[v]);
      }
    }
  }

  bool same_pole(const PlaneTriangle& t) const {
    const auto& n = work_.mesh.nodes;
    return are_one_pole(n[t.v[0]], n[t.v[1]]) || are_one_pole(n[t.v[1]], n[t.v[2]]) ||
           are_one_pole(n[t.v[2]], n[t.v[0]]);
  }

  using NodePair = std::pair<std::int64_t, std::int64_t>;  // node_key(), the smaller first

  std::int64_t node_key(std::int32_t corner) const {
    const std::int32_t n_boundary = static_cast<std::int32_t>(boundary_.nodes.size());
    return corner < n_boundary ? boundary_.nodes[corner].id : (std::int64_t{1} << 31) + corner;
  }
  Vec3 position(const FaceMesh& r, std::int32_t corner) const {
    const std::int32_t n_boundary = static_cast<std::int32_t>(boundary_.nodes.size());
    return corner < n_boundary ? boundary_.nodes[corner].x : r.inner[corner - n_boundary].x;
  }

  /// Every edge used twice (boundary segments as often as the loops use them), no triangle with a repeated node, no
  /// repeated triangle.
  void validate(FaceMesh& r) const {
    std::vector<NodePair> uses, loop_uses;  // of edges with a boundary node
    const auto ordered = [](std::int64_t a, std::int64_t b) { return a < b ? std::pair{a, b} : std::pair{b, a}; };
    const auto refine = [&](Vec3 x, double length) {
      if (r.refinement.size() < kMostRefined) r.refinement.push_back({x, length});
    };
    const std::int32_t n_boundary = static_cast<std::int32_t>(boundary_.nodes.size());
    for (std::size_t i = 0; i < r.corners.size(); i += 3) {
      const std::int32_t* c = &r.corners[i];
      if (c[0] == kNone || c[1] == kNone || c[2] == kNone) {
        r.cause = FailureCause::kOutsideLoops;
        return;
      }
      const std::int64_t key[3] = {node_key(c[0]), node_key(c[1]), node_key(c[2])};
      for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        if (key[k] == key[l]) {
          r.cause = FailureCause::kNarrowPart;
          refine(position(r, c[k]), 0.5 * distance(position(r, c[0]), position(r, c[1])) +
                                        0.25 * distance(position(r, c[1]), position(r, c[2])));
          break;
        }
        if (c[k] < n_boundary || c[l] < n_boundary) uses.push_back(ordered(key[k], key[l]));
      }
    }
    for (const auto& [a, b] : boundary_.segments)
      if (boundary_.nodes[a].id != boundary_.nodes[b].id)
        loop_uses.push_back(ordered(boundary_.nodes[a].id, boundary_.nodes[b].id));
    std::sort(uses.begin(), uses.end());
    std::sort(loop_uses.begin(), loop_uses.end());
    compare_uses(r, uses, loop_uses, refine);
    check_folds(r);
  }

  /// Walks both sorted lists: an edge of the loops is used as often as they use it, any other twice.
  template <class Refine>
  void compare_uses(FaceMesh& r, const std::vector<NodePair>& uses, const std::vector<NodePair>& loop_uses,
                    const Refine& refine) const {
    std::size_t i = 0, j = 0;
    while (i < uses.size() || j < loop_uses.size()) {
      const NodePair edge =
          j == loop_uses.size() || (i < uses.size() && uses[i] < loop_uses[j]) ? uses[i] : loop_uses[j];
      std::size_t n_used = 0, n_wanted = 0;
      for (; i < uses.size() && uses[i] == edge; ++i) ++n_used;
      for (; j < loop_uses.size() && loop_uses[j] == edge; ++j) ++n_wanted;
      if (n_used == (n_wanted ? n_wanted : 2)) continue;
      r.cause = n_wanted ? FailureCause::kUnusedBoundary : FailureCause::kNarrowPart;
      report_edge(r, edge, refine);
    }
  }

  template <class Refine>
  void report_edge(const FaceMesh& r, const NodePair& edge, const Refine& refine) const {
    for (std::size_t i = 0; i < r.corners.size(); ++i) {
      const std::size_t j = i % 3 == 2 ? i - 2 : i + 1;
      const std::int64_t a = node_key(r.corners[i]), b = node_key(r.corners[j]);
      if ((a == edge.first && b == edge.second) || (a == edge.second && b == edge.first)) {
        const Vec3 x = position(r, r.corners[i]), y = position(r, r.corners[j]);
        refine(0.5 * (x + y), 0.5 * distance(x, y));
        return;
      }
    }
  }

  /// Triangles turned against the surface, and neighbours folded onto each other.
  void check_folds(FaceMesh& r) const {
    const auto& triangles = work_.mesh.triangles;
    std::vector<Vec3> normal(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const PlaneTriangle& t = triangles[i];
      if (t.state == kOutside || t.state == kDead || same_pole(t)) continue;
      const MeshNode &a = work_.mesh.nodes[t.v[0]], &b = work_.mesh.nodes[t.v[1]], &c = work_.mesh.nodes[t.v[2]];
      normal[i] = normalized(cross(b.x - a.x, c.x - a.x));
      if (dot(normal[i], a.normal + b.normal + c.normal) < 0) report_fold(r, t);
    }
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t o = triangles[i].n[k];
        if (o <= static_cast<std::int32_t>(i) || (triangles[i].constrained >> k & 1) ||
            dot(normal[i], normal[o]) > kFoldedCosine)
          continue;
        report_fold(r, triangles[i]);
      }
  }

  void report_fold(FaceMesh& r, const PlaneTriangle& t) const {
    const MeshNode &a = work_.mesh.nodes[t.v[0]], &b = work_.mesh.nodes[t.v[1]], &c = work_.mesh.nodes[t.v[2]];
    ++r.n_folds;
    const double size = std::sqrt(std::max({norm2(b.x - a.x), norm2(c.x - a.x), norm2(c.x - b.x)}));
    if (r.refinement.size() < kMostRefined) r.refinement.push_back({(a.x + b.x + c.x) / 3, 0.5 * size});
  }

  const Surface& surface_;
  const FaceBoundary& boundary_;
  FaceWork work_;
  std::vector<std::int32_t> node_of_, local_to_boundary_;
};

}  // namespace

FaceMesh mesh_face(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                   const FaceMeshOptions& options) {
  return FaceMesher(surface, boundary).mesh(field, options);
}

std::vector<RefinementPoint> check_boundary(const Surface& surface, const FaceBoundary& boundary) {
  return FaceMesher(surface, boundary).prepare();
}

}  // namespace st
