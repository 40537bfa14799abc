#include "meshing/face/face_check.h"

#include <algorithm>
#include <cmath>

#include "base/threads.h"

namespace st {
namespace {

using NodePair = std::pair<std::int64_t, std::int64_t>;  // node_key(), the smaller first

void refine(FaceMesh& mesh, Vec3 x, double length) {
  if (mesh.refinement.size() < kMostRefined) mesh.refinement.push_back({x, length});
}

/// Edges of a mesh against those of its loops.
class EdgeCheck {
 public:
  EdgeCheck(const FaceBoundary& boundary, FaceMesh& mesh)
      : boundary_(boundary), r_(mesh), n_boundary_(static_cast<std::int32_t>(boundary.nodes.size())) {}

  void run(std::span<const std::array<std::int32_t, 2>> elsewhere) {
    constexpr std::size_t kPerPiece = 65'536;
    const std::size_t n = r_.corners.size() / 3;
    std::vector<Scan> scans((n + kPerPiece - 1) / kPerPiece);
    parallel_for(n, kPerPiece, [&](std::size_t begin, std::size_t end) { scan(begin, end, scans[begin / kPerPiece]); });
    std::vector<NodePair> uses, loop_uses;  // of edges with a boundary node
    for (const auto& [a, b] : elsewhere) uses.push_back({a, b});
    for (const Scan& s : scans) {
      for (const RefinementPoint& p : s.narrow) {
        r_.cause = FailureCause::kNarrowPart;
        refine(r_, p.x, p.length);
      }
      uses.insert(uses.end(), s.uses.begin(), s.uses.end());
      if (!s.is_outside) continue;
      r_.cause = FailureCause::kOutsideLoops;
      return;
    }
    for (const auto& [a, b] : boundary_.segments)
      if (boundary_.nodes[a].id != boundary_.nodes[b].id) loop_uses.push_back(std::minmax({node_key(a), node_key(b)}));
    std::sort(uses.begin(), uses.end());
    std::sort(loop_uses.begin(), loop_uses.end());
    compare_uses(uses, loop_uses);
  }

 private:
  struct Scan {  // of some triangles
    std::vector<NodePair> uses;
    std::vector<RefinementPoint> narrow;  // triangles with two corners at one node
    bool is_outside = false;              // one has a corner outside the loops
  };

  /// Up to the first triangle outside.
  void scan(std::size_t begin, std::size_t end, Scan& found) const {
    for (std::size_t t = begin; t < end && !found.is_outside; ++t) {
      const std::int32_t* c = &r_.corners[3 * t];
      found.is_outside = c[0] == kNone || c[1] == kNone || c[2] == kNone;
      if (!found.is_outside) scan_triangle(c, found);
    }
  }

  void scan_triangle(const std::int32_t* c, Scan& found) const {
    const std::int64_t key[3] = {node_key(c[0]), node_key(c[1]), node_key(c[2])};
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      if (key[k] == key[l]) {
        const Vec3 a = position(c[0]), b = position(c[1]), d = position(c[2]);
        found.narrow.push_back({position(c[k]), 0.5 * distance(a, b) + 0.25 * distance(b, d)});
        return;
      }
      if (c[k] < n_boundary_ || c[l] < n_boundary_) found.uses.push_back(std::minmax({key[k], key[l]}));
    }
  }

  std::int64_t node_key(std::int32_t corner) const {
    return corner < n_boundary_ ? boundary_.nodes[corner].id : (std::int64_t{1} << 31) + corner;
  }
  Vec3 position(std::int32_t corner) const {
    return corner < n_boundary_ ? boundary_.nodes[corner].x : r_.inner[corner - n_boundary_].x;
  }

  /// Walks both sorted lists: an edge of the loops is used as often as they use it, any other twice. One that they use
  /// twice may be used by none: to and fro, or where two loops touch along it with nothing of the face between them.
  void compare_uses(const std::vector<NodePair>& uses, const std::vector<NodePair>& loop_uses) {
    std::size_t i = 0, j = 0;
    while (i < uses.size() || j < loop_uses.size()) {
      const NodePair edge =
          j == loop_uses.size() || (i < uses.size() && uses[i] < loop_uses[j]) ? uses[i] : loop_uses[j];
      std::size_t n_used = 0, n_wanted = 0;
      for (; i < uses.size() && uses[i] == edge; ++i) ++n_used;
      for (; j < loop_uses.size() && loop_uses[j] == edge; ++j) ++n_wanted;
      if (n_used == (n_wanted ? n_wanted : 2) || (n_used == 0 && n_wanted == 2)) continue;
      r_.cause = n_wanted ? FailureCause::kUnusedBoundary : FailureCause::kNarrowPart;
      report_edge(edge);
    }
  }

  void report_edge(const NodePair& edge) {
    if (r_.refinement.size() >= kMostRefined) return;
    for (std::size_t i = 0; i < r_.corners.size(); ++i) {
      const std::size_t j = i % 3 == 2 ? i - 2 : i + 1;
      if (NodePair(std::minmax({node_key(r_.corners[i]), node_key(r_.corners[j])})) != edge) continue;
      const Vec3 x = position(r_.corners[i]), y = position(r_.corners[j]);
      refine(r_, 0.5 * (x + y), 0.5 * distance(x, y));
      return;
    }
  }

  const FaceBoundary& boundary_;
  FaceMesh& r_;
  const std::int32_t n_boundary_;
};

}  // namespace

bool has_pole_side(const Triangulation& mesh, const PlaneTriangle& t) {
  const auto& n = mesh.nodes;
  return are_one_pole(n[t.v[0]], n[t.v[1]]) || are_one_pole(n[t.v[1]], n[t.v[2]]) || are_one_pole(n[t.v[2]], n[t.v[0]]);
}

void check_edges(const FaceBoundary& boundary, FaceMesh& mesh, std::span<const std::array<std::int32_t, 2>> elsewhere) {
  EdgeCheck(boundary, mesh).run(elsewhere);
}

void check_folds(const Triangulation& m, FaceMesh& mesh) {
  const auto report = [&](const PlaneTriangle& t) {
    const Vec3 a = m.nodes[t.v[0]].x, b = m.nodes[t.v[1]].x, c = m.nodes[t.v[2]].x;
    ++mesh.n_folds;
    refine(mesh, (a + b + c) / 3, 0.5 * std::sqrt(std::max({norm2(b - a), norm2(c - a), norm2(c - b)})));
  };
  std::vector<Vec3> normal(m.triangles.size());
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const PlaneTriangle& t = m.triangles[i];
    if (t.state == kOutside || t.state == kDead || has_pole_side(m, t)) continue;
    const MeshNode &a = m.nodes[t.v[0]], &b = m.nodes[t.v[1]], &c = m.nodes[t.v[2]];
    normal[i] = normalized(cross(b.x - a.x, c.x - a.x));
    if (dot(normal[i], a.normal + b.normal + c.normal) < 0) report(t);
  }
  for (std::size_t i = 0; i < m.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t o = m.triangles[i].n[k];
      if (o <= static_cast<std::int32_t>(i) || (m.triangles[i].constrained >> k & 1) ||
          dot(normal[i], normal[o]) > kFoldedCosine)
        continue;
      report(m.triangles[i]);
    }
}

}  // namespace st
