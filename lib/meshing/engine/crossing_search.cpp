#include "meshing/engine/crossing_search.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/threads.h"
#include "geometry/model/bodies.h"
#include "geometry/shape/wall_gap.h"
#include "mesh/corner_uv.h"
#include "mesh/patch_crossing.h"
#include "mesh/touching_triangles.h"

namespace st {
namespace {

constexpr std::size_t kMaxCrossingPlaces = 2000;  // proposed at once
constexpr std::size_t kMaxWallPlaces = 8000;      // likewise, where walls are measured
constexpr double kAround = 4;                     // triangles that a place makes shorter, about
constexpr double kCovering = 1.5;                 // of half a triangle's longest side: a circle that covers it
constexpr double kWider = 0.75;                   // more than that in each later search: new places crossed beside
constexpr double kLeastFactor = 1.0 / 32;         // of a triangle's length: walls that would need less cannot be parted

FaceId face_of(const WeldedPatches& m, TriangleId t) {
  return static_cast<FaceId>(std::upper_bound(m.patch_begin.begin(), m.patch_begin.end(), t) - m.patch_begin.begin()) -
         1;
}

/// The longest side times `factor` where there is one, `covering` halves of it around. Else half of it; half the
/// shortest side, or a quarter of the longest, where the triangle spans its face from boundary to boundary.
RefinementPoint refinement_of(const WeldedPatches& m, TriangleId t, double factor, double covering) {
  const NodeId* n = m.triangles[t].n;
  const Vec3 a = m.points[n[0]], b = m.points[n[1]], c = m.points[n[2]];
  RefinementPoint place = halve_triangle(a, b, c);
  if (factor > 0) return {place.x, 2 * factor * place.length, covering * place.length, factor};
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

/// Segments of the CAD edges, as pairs of nodes.
class BoundarySegments {
 public:
  BoundarySegments(const BoundaryNumbering& numbering, const WeldedPatches& mesh) : joins_next_(mesh.n_boundary, 0) {
    const auto node = [&](EdgeId e, std::int32_t index) { return mesh.boundary[numbering.edge_node(e, index)]; };
    for (EdgeId e = 0; e < numbering.tables.n_edges(); ++e)
      for (std::int32_t i = 1; i < numbering.edges.n_nodes(e); ++i) {
        const auto [a, b] = std::minmax({node(e, i - 1), node(e, i)});
        if (a != kNone && b == a + 1)
          joins_next_[a] = 1;
        else
          others_.push_back({a, b});
      }
    std::sort(others_.begin(), others_.end());
  }
  /// `a` < `b`
  bool contain(NodeId a, NodeId b) const {
    return (b == a + 1 && joins_next_[a]) || std::binary_search(others_.begin(), others_.end(), std::pair{a, b});
  }

 private:
  std::vector<char> joins_next_;  // by node: a segment joins it and the next one
  std::vector<std::pair<NodeId, NodeId>> others_;
};

/// Uses of edges between two nodes on boundaries that are no segments of these, sorted.
std::vector<EdgeUse> uses_of_chords(const BoundarySegments& segments, const WeldedPatches& mesh) {
  constexpr std::size_t kPerPiece = 65'536;
  std::vector<std::vector<EdgeUse>> found(mesh.triangles.size() / kPerPiece + 1);
  parallel_for(mesh.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(mesh.triangles[i].n[k], mesh.triangles[i].n[(k + 1) % 3]);
        if (b < mesh.n_boundary && !segments.contain(a, b))
          found[begin / kPerPiece].push_back({a, b, static_cast<TriangleId>(i)});
      }
  });
  std::vector<EdgeUse> uses;
  for (const auto& some : found) uses.insert(uses.end(), some.begin(), some.end());
  std::sort(uses.begin(), uses.end());
  return uses;
}

WeldedPatches weld(const BoundaryNumbering& numbering, const std::vector<FacePatch>& patches) {
  std::vector<const FacePatch*> by_face;
  for (const FacePatch& p : patches) by_face.push_back(&p);
  return weld_patches(numbering.edges, numbering.tables.vertex_xyz, by_face);
}

/// Such faces meet, and where they cross beside what they share no length parts them.
bool share_a_vertex(const ModelTables& t, FaceId a, FaceId b) {
  const std::set<VertexId> of_a = vertices_of(t, a), of_b = vertices_of(t, b);
  return std::any_of(of_a.begin(), of_a.end(), [&](VertexId v) { return of_b.contains(v); });
}

}  // namespace

std::vector<TrianglePair> find_repeated_chords(const BoundaryNumbering& numbering, const WeldedPatches& mesh,
                                               std::span<const char> face_is_fresh) {
  const std::vector<EdgeUse> uses = uses_of_chords(BoundarySegments(numbering, mesh), mesh);
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    while (j < uses.size() && uses[j].a == uses[i].a && uses[j].b == uses[i].b) ++j;
    const TriangleId first = uses[i].triangle, last = uses[j - 1].triangle;
    const FaceId f = face_of(mesh, first), g = face_of(mesh, last);
    if (j - i >= 3 && f != g && (face_is_fresh[f] || face_is_fresh[g])) pairs.push_back({first, last, 2});
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
      find_crossing_patches({m.points, m.triangles, m.patch_begin, face_body_, face_is_fresh_,
                             [&](FaceId a, FaceId b) { return may_be_apart(a, b); }});
  // with two common nodes: folded flat onto each other
  std::erase_if(found, [](const TrianglePair& p) { return p.n_shared == 1; });
  const std::vector<TrianglePair> repeated = find_repeated_chords(numbering, m, face_is_fresh_);
  found.insert(found.end(), repeated.begin(), repeated.end());
  FacetPairs fresh;
  for (const TrianglePair& p : found) {
    const FaceId a = face_of(m, p.a), b = face_of(m, p.b);
    fresh.push_back({a, b, p.a - m.patch_begin[a], p.b - m.patch_begin[b], p.n_shared > 0 ? kHalve : kUnknown});
  }
  std::sort(fresh.begin(), fresh.end());
  fresh = measured(fresh, m, patches);
  pairs_.insert(pairs_.end(), fresh.begin(), fresh.end());
  std::sort(pairs_.begin(), pairs_.end());
  std::fill(face_is_fresh_.begin(), face_is_fresh_.end(), 0);
  std::vector<RefinementPoint> places = places_to_refine(m);
  ++n_runs_;
  return places;
}

/// The first pairs whose walls are not measured, and pairs from all over the others.
std::vector<RefinementPoint> CrossingSearch::places_to_refine(const WeldedPatches& m) const {
  std::vector<RefinementPoint> places;
  const auto add = [&](const FacetPair& p, double n_triangles) {
    for (const TriangleId t : {m.patch_begin[p.face_a] + p.index_a, m.patch_begin[p.face_b] + p.index_b}) {
      places.push_back(refinement_of(m, t, p.factor, kCovering + kWider * n_runs_));
      places.back().n_triangles = n_triangles;
    }
  };
  FacetPairs apart;
  for (const FacetPair& p : pairs_) {
    if (p.factor > 0) apart.push_back(p);
    if (p.factor == kHalve && places.size() < kMaxCrossingPlaces) add(p, 1);
  }
  const std::size_t step = 2 * apart.size() / kMaxWallPlaces + 1;
  for (std::size_t i = 0; i < apart.size(); i += step) add(apart[i], kAround * static_cast<double>(step));
  return places;
}

/// Plane walls have chords of their own shape: triangles of two bodies cross there where the CAD does.
bool CrossingSearch::may_be_apart(FaceId a, FaceId b) const {
  const ModelTables& t = model_.tables();
  return is_across_ && !(t.face_type[a] == SurfaceType::kPlane && t.face_type[b] == SurfaceType::kPlane) &&
         !touching_.contains(std::minmax(a, b));
}

/// With their factors, without pairs where two bodies meet. `pairs` sorted.
CrossingSearch::FacetPairs CrossingSearch::measured(const FacetPairs& pairs, const WeldedPatches& mesh,
                                                    const std::vector<FacePatch>& patches) {
  std::vector<std::span<const FacetPair>> by_faces;
  for (std::size_t i = 0, j = 0; i < pairs.size(); i = j) {
    while (j < pairs.size() && pairs[j].face_a == pairs[i].face_a && pairs[j].face_b == pairs[i].face_b) ++j;
    by_faces.push_back(std::span(pairs).subspan(i, j - i));
  }
  std::vector<FacetPairs> kept(by_faces.size());
  parallel_for(by_faces.size(), 1,
               [&](std::size_t i, std::size_t) { kept[i] = measured_pair_of_faces(by_faces[i], mesh, patches); });
  FacetPairs all;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i].empty()) touching_.insert({by_faces[i][0].face_a, by_faces[i][0].face_b});
    all.insert(all.end(), kept[i].begin(), kept[i].end());
  }
  return all;
}

/// Pairs of two faces. Where these are of two bodies, some places tell whether the bodies meet everywhere.
CrossingSearch::FacetPairs CrossingSearch::measured_pair_of_faces(std::span<const FacetPair> pairs,
                                                                  const WeldedPatches& mesh,
                                                                  const std::vector<FacePatch>& patches) const {
  constexpr std::size_t kTried = 16;  // of two bodies: none apart, and they meet
  constexpr std::size_t kMostMeasured = 1000;
  FacetPairs kept(pairs.begin(), pairs.end());
  const FaceId a = pairs[0].face_a, b = pairs[0].face_b;
  const bool is_one_body = face_body_[a] == face_body_[b];
  const auto set_unknown = [&](double factor) {
    for (FacetPair& p : kept)
      if (p.factor == kUnknown) p.factor = factor;
  };
  if (a == b || share_a_vertex(model_.tables(), a, b)) {
    set_unknown(kHalve);
    return kept;
  }
  const auto surface_a = model_.surface(a), surface_b = model_.surface(b);
  const double tolerance = meeting_distance(model_.tables(), a, b);
  const auto measure = [&](FacetPair& p) {
    const auto wall = [&](FaceId f, std::int32_t index) {
      WallTriangle t;
      for (int k = 0; k < 3; ++k) {
        t.x[k] = mesh.points[mesh.triangles[mesh.patch_begin[f] + index].n[k]];
        t.uv[k] = corner_uv(patches[f], 3 * static_cast<std::size_t>(index) + k);
      }
      return t;
    };
    const auto gap = measure_gap(*surface_a, wall(a, p.index_a), *surface_b, wall(b, p.index_b), tolerance);
    if (gap && gap->is_apart)
      p.factor = gap->factor < kLeastFactor ? kHopeless : gap->factor;
    else
      p.factor = is_one_body ? kHalve : kMeets;
  };
  const auto measure_every = [&](std::size_t step) {
    for (std::size_t i = 0; i < kept.size(); i += step)
      if (kept[i].factor == kUnknown) measure(kept[i]);
  };
  if (!is_one_body) {
    measure_every(std::max<std::size_t>(1, kept.size() / kTried));
    if (std::all_of(kept.begin(), kept.end(),
                    [](const FacetPair& p) { return p.factor == kMeets || p.factor == kUnknown; }))
      return {};
  }
  measure_every(kept.size() / kMostMeasured + 1);
  set_unknown(is_one_body ? kHalve : kMeets);
  std::erase_if(kept, [](const FacetPair& p) { return p.factor == kMeets; });
  return kept;
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

std::map<FaceId, std::vector<Vec3>> CrossingSearch::move_touching_apart(const BoundaryNumbering& numbering,
                                                                        std::vector<FacePatch>& patches) {
  WeldedPatches m = weld(numbering, patches);
  std::vector<TouchingPair> touching;
  for (const FacetPair& p : pairs_) {
    const Triangle &a = m.triangles[m.patch_begin[p.face_a] + p.index_a],
                   &b = m.triangles[m.patch_begin[p.face_b] + p.index_b];
    if (std::none_of(std::begin(a.n), std::end(a.n), [&](NodeId n) { return std::ranges::count(b.n, n) > 0; }))
      touching.push_back({a, b, meeting_distance(model_.tables(), p.face_a, p.face_b)});
  }
  std::map<FaceId, std::vector<Vec3>> before;
  if (!st::move_touching_apart(touching, m.n_boundary, m.points)) return before;
  std::set<FaceId> faces;
  for (const FacetPair& p : pairs_) faces.insert({p.face_a, p.face_b});
  for (const FaceId f : faces) {
    std::vector<Vec3> xyz = patches[f].inner_xyz;
    for (std::int32_t i = m.inner_begin[f]; i < m.inner_begin[f + 1]; ++i) xyz[m.inner[i]] = m.points[m.n_boundary + i];
    if (xyz == patches[f].inner_xyz) continue;
    before[f] = std::exchange(patches[f].inner_xyz, std::move(xyz));
    renew(f);
  }
  return before;
}

}  // namespace st
