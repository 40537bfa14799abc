#include "meshing/engine/crossing_search.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/threads.h"
#include "mesh/patch_crossing.h"

namespace st {
namespace {

constexpr std::size_t kMaxCrossingPlaces = 2000;  // proposed at once

FaceId face_of(const WeldedPatches& m, TriangleId t) {
  return static_cast<FaceId>(std::upper_bound(m.patch_begin.begin(), m.patch_begin.end(), t) - m.patch_begin.begin()) -
         1;
}

/// Half the shortest side, or a quarter of the longest, where the triangle spans its face from boundary to boundary.
RefinementPoint refinement_of(const WeldedPatches& m, TriangleId t) {
  const NodeId* n = m.triangles[t].n;
  const Vec3 a = m.points[n[0]], b = m.points[n[1]], c = m.points[n[2]];
  RefinementPoint place = halve_triangle(a, b, c);
  if (std::max({n[0], n[1], n[2]}) >= m.n_boundary) return place;
  const auto [shortest, longest] = std::minmax({distance(a, b), distance(b, c), distance(c, a)});
  place.length = 0.5 * std::max(shortest, 0.5 * longest);
  return place;
}

struct EdgeUse {
  NodeId a, b;  // a < b
  TriangleId triangle;
  auto operator<=>(const EdgeUse&) const = default;
};

/// Uses of edges between two nodes on boundaries, sorted.
std::vector<EdgeUse> uses_between_boundaries(const WeldedPatches& mesh) {
  constexpr std::size_t kPerPiece = 65'536;
  std::vector<std::vector<EdgeUse>> found(mesh.triangles.size() / kPerPiece + 1);
  parallel_for(mesh.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(mesh.triangles[i].n[k], mesh.triangles[i].n[(k + 1) % 3]);
        if (b < mesh.n_boundary) found[begin / kPerPiece].push_back({a, b, static_cast<TriangleId>(i)});
      }
  });
  std::vector<EdgeUse> uses;
  for (const auto& some : found) uses.insert(uses.end(), some.begin(), some.end());
  std::sort(uses.begin(), uses.end());
  return uses;
}

/// Segments of the CAD edges, sorted.
std::vector<std::pair<NodeId, NodeId>> boundary_segments(const BoundaryNumbering& numbering,
                                                         const WeldedPatches& mesh) {
  const auto node = [&](EdgeId e, std::int32_t index) { return mesh.boundary[numbering.edge_node(e, index)]; };
  std::vector<std::pair<NodeId, NodeId>> segments;
  for (EdgeId e = 0; e < numbering.tables.n_edges(); ++e)
    for (std::int32_t i = 1; i < numbering.edges.n_nodes(e); ++i)
      segments.push_back(std::minmax({node(e, i - 1), node(e, i)}));
  std::sort(segments.begin(), segments.end());
  return segments;
}

WeldedPatches weld(const BoundaryNumbering& numbering, const std::vector<FacePatch>& patches) {
  std::vector<const FacePatch*> by_face;
  for (const FacePatch& p : patches) by_face.push_back(&p);
  return weld_patches(numbering.edges, numbering.tables.vertex_xyz, by_face);
}

}  // namespace

std::vector<TrianglePair> find_repeated_chords(const BoundaryNumbering& numbering, const WeldedPatches& mesh,
                                               std::span<const char> face_is_fresh) {
  const std::vector<EdgeUse> uses = uses_between_boundaries(mesh);
  const auto segments = boundary_segments(numbering, mesh);
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    while (j < uses.size() && uses[j].a == uses[i].a && uses[j].b == uses[i].b) ++j;
    const TriangleId first = uses[i].triangle, last = uses[j - 1].triangle;
    const FaceId f = face_of(mesh, first), g = face_of(mesh, last);
    if (j - i < 3 || f == g || !(face_is_fresh[f] || face_is_fresh[g])) continue;
    if (!std::binary_search(segments.begin(), segments.end(), std::pair{uses[i].a, uses[i].b}))
      pairs.push_back({first, last, 2});
  }
  return pairs;
}

RefinementPoint halve_triangle(Vec3 a, Vec3 b, Vec3 c) {
  return {(a + b + c) / 3, 0.5 * std::max({distance(a, b), distance(b, c), distance(c, a)})};
}

std::vector<RefinementPoint> CrossingSearch::run(const BoundaryNumbering& numbering,
                                                 const std::vector<FacePatch>& patches) {
  const WeldedPatches m = weld(numbering, patches);
  std::erase_if(pairs_, [&](const FacetPair& p) { return face_is_fresh_[p.face_a] || face_is_fresh_[p.face_b]; });
  std::vector<TrianglePair> found =
      find_crossing_patches({m.points, m.triangles, m.patch_begin, face_shell_, face_is_fresh_});
  // with two common nodes: folded flat onto each other
  std::erase_if(found, [](const TrianglePair& p) { return p.n_shared == 1; });
  const std::vector<TrianglePair> repeated = find_repeated_chords(numbering, m, face_is_fresh_);
  found.insert(found.end(), repeated.begin(), repeated.end());
  for (const TrianglePair& p : found) {
    const FaceId a = face_of(m, p.a), b = face_of(m, p.b);
    pairs_.push_back({a, b, p.a - m.patch_begin[a], p.b - m.patch_begin[b]});
  }
  std::sort(pairs_.begin(), pairs_.end());
  std::fill(face_is_fresh_.begin(), face_is_fresh_.end(), 0);
  std::vector<RefinementPoint> places;
  for (const FacetPair& p : pairs_) {
    if (places.size() >= kMaxCrossingPlaces) break;
    places.push_back(refinement_of(m, m.patch_begin[p.face_a] + p.index_a));
    places.push_back(refinement_of(m, m.patch_begin[p.face_b] + p.index_b));
  }
  return places;
}

std::vector<std::size_t> CrossingSearch::crossing_in(FaceId f, bool others_too) const {
  std::set<std::size_t> triangles;
  for (const FacetPair& p : pairs_) {
    if (p.face_a != p.face_b && !others_too) continue;
    if (p.face_a == f) triangles.insert(static_cast<std::size_t>(p.index_a));
    if (p.face_b == f) triangles.insert(static_cast<std::size_t>(p.index_b));
  }
  return {triangles.begin(), triangles.end()};
}

}  // namespace st
