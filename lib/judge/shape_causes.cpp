#include "judge/shape_causes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/sort_once.h"
#include "geometry/model/edge_angles.h"
#include "judge/cad_corners.h"

namespace st {

namespace {

constexpr int kMostSegments = 3;         // of a CAD edge that counts as short: what a loop of one edge needs
constexpr double kCornerMargin = 1.25;   // chords make a corner a little sharper than the CAD's edges do
constexpr double kCornerReach = 3;       // requests: so far from a corner its edges may still be as near
constexpr double kGrowthCornerDeg = 25;  // in such a corner the first triangle is smaller than its neighbours by
                                         // kLargeGrowth
constexpr double kNarrow = 0.35;         // of the request: a face of this width has no place for a good triangle
constexpr double kRequestJump = 2;       // between the nodes of one triangle
constexpr double kStraightDeg = 150;     // at a vertex with a larger angle the boundary goes on

/// What a triangle's or an edge's neighbourhood blames.
struct Blame {
  ShapeCause cause = ShapeCause::kFree;
  EdgeId edge = kNone;
  VertexId vertex = kNone;
};

class Causes {
 public:
  Causes(const Model& model, const SurfaceMesh& mesh, const TriangleCorners& corners, double angle_deg)
      : mesh_(mesh),
        shapes_(corners),
        tables_(model.tables()),
        corners_(model, mesh.merged),
        edge_angles_(model),
        angle_deg_(angle_deg),
        sine_limit_(1.001 * std::sin(radians(angle_deg))) {
    number_edge_nodes();
  }

  /// Of the triangle's smallest angle; nullopt when it is not below the limit.
  std::optional<CausePlace> of_angle(TriangleId t) {
    if (sine_of_smallest(t) > sine_limit_) return std::nullopt;
    const auto [a, b, c] = shapes_(t);
    const auto angle = triangle_angles_deg(a, b, c);
    const int k = static_cast<int>(std::min_element(angle.begin(), angle.end()) - angle.begin());
    if (!(angle[k] < angle_deg_)) return std::nullopt;
    CausePlace found = place(blame_angle(t, angle, k), mesh_.triangle_face[t], angle[k], centre(t));
    for (const EdgeId e : edges_beside(t)) {
      const double turning = edge_angles_.largest_deg(e);
      if (found.beside == kNone || turning < found.beside_deg) found.beside = e, found.beside_deg = turning;
    }
    return found;
  }

  CausePlace of_growth(const QualityReport::LargeJump& jump) {
    Blame b = blame_size(jump.a, jump.ratio);
    if (b.cause == ShapeCause::kFree) b = blame_size(jump.b, jump.ratio);
    if (b.cause == ShapeCause::kFree && request_ratio(jump.a, jump.b) > kLargeGrowth) b.cause = ShapeCause::kSizeJump;
    return place(b, mesh_.triangle_face[jump.a], jump.ratio, 0.5 * (centre(jump.a) + centre(jump.b)));
  }

  CausePlace of_length(const ConformityReport::OutsideEdge& e) {
    Blame b;
    if (const EdgeId along = along_edge(e.a, e.b); along != kNone && e.ratio < kConformityMin)
      b = {ShapeCause::kSizeJump, along};  // a short edge would be in ConformityReport::forced
    else
      b = blame_size(e.triangle, kLargeGrowth);
    if (b.cause == ShapeCause::kFree && e.other != kNone) b = blame_size(e.other, kLargeGrowth);
    return place(b, mesh_.triangle_face[e.triangle], e.ratio, 0.5 * (xyz(e.a) + xyz(e.b)));
  }

 private:
  Vec3 xyz(NodeId n) const { return mesh_.node_xyz[n]; }
  Vec3 centre(TriangleId t) const {
    const auto& n = mesh_.triangles[t].n;
    return (xyz(n[0]) + xyz(n[1]) + xyz(n[2])) / 3;
  }
  /// Cheaper than the angle itself.
  double sine_of_smallest(TriangleId t) const {
    const auto [a, b, c] = shapes_(t);
    const Vec3 p = b - a, q = c - a, r = q - p;
    const double shortest2 = std::min({norm2(p), norm2(q), norm2(r)}), product2 = norm2(p) * norm2(q) * norm2(r);
    return product2 > 0 ? std::sqrt(norm2(cross(p, q)) * shortest2 / product2) : 0;
  }
  EntityDim dim(NodeId n) const { return static_cast<EntityDim>(mesh_.node_entity_dim[n]); }
  bool is_boundary(NodeId n) const { return dim(n) != EntityDim::kFace; }
  VertexId vertex_of(NodeId n) const { return corners_.representative(mesh_.node_entity[n]); }
  double ratio(NodeId a, NodeId b) const {
    return distance(xyz(a), xyz(b)) * 0.5 * (1 / mesh_.node_size[a] + 1 / mesh_.node_size[b]);
  }

  CausePlace place(const Blame& b, FaceId face, double value, Vec3 x) const {
    return {.cause = b.cause, .face = face, .edge = b.edge, .vertex = b.vertex, .value = value, .xyz = x};
  }

  /// Nodes inside an edge follow one another in a canonical mesh.
  void number_edge_nodes() {
    first_inside_.assign(tables_.n_edges(), kNone);
    n_inside_.assign(tables_.n_edges(), 0);
    for (NodeId n = 0; n < mesh_.n_nodes(); ++n) {
      if (dim(n) != EntityDim::kEdge) continue;
      const EdgeId e = mesh_.node_entity[n];
      if (n_inside_[e]++ == 0) first_inside_[e] = n;
    }
    for (EdgeId e = 0; e < tables_.n_edges(); ++e)
      if (n_inside_[e] == 0 && !tables_.edge_is_degenerate[e]) bare_edges_.try_emplace(ends_of(e), e);
  }
  std::pair<VertexId, VertexId> ends_of(EdgeId e) const {
    return std::minmax(corners_.representative(tables_.edge_vertices[2 * e]),
                       corners_.representative(tables_.edge_vertices[2 * e + 1]));
  }

  /// The CAD edge of which (a, b) is a segment, or kNone.
  EdgeId along_edge(NodeId a, NodeId b) const {
    if (!is_boundary(a) || !is_boundary(b)) return kNone;
    if (dim(a) == EntityDim::kVertex && dim(b) == EntityDim::kVertex) {
      const auto found = bare_edges_.find(std::minmax(vertex_of(a), vertex_of(b)));
      return found == bare_edges_.end() ? kNone : found->second;
    }
    if (dim(a) != EntityDim::kEdge) std::swap(a, b);
    const EdgeId e = mesh_.node_entity[a];
    if (dim(b) == EntityDim::kEdge) return mesh_.node_entity[b] == e && std::abs(a - b) == 1 ? e : kNone;
    const bool at_first =
        a == first_inside_[e] && vertex_of(b) == corners_.representative(tables_.edge_vertices[2 * e]);
    const bool at_last = a == first_inside_[e] + n_inside_[e] - 1 &&
                         vertex_of(b) == corners_.representative(tables_.edge_vertices[2 * e + 1]);
    return at_first || at_last ? e : kNone;
  }
  bool is_short(EdgeId e) const { return n_inside_[e] < kMostSegments; }

  /// That have a node of the triangle inside, or a side of it; ascending.
  std::vector<EdgeId> edges_beside(TriangleId t) const {
    std::vector<EdgeId> edges;
    const auto& n = mesh_.triangles[t].n;
    for (int k = 0; k < 3; ++k) {
      if (dim(n[k]) == EntityDim::kEdge) edges.push_back(mesh_.node_entity[n[k]]);
      if (const EdgeId e = along_edge(n[k], n[(k + 1) % 3]); e != kNone) edges.push_back(e);
    }
    sort_once(edges);
    return edges;
  }

  Blame blame_angle(TriangleId t, const std::array<double, 3>& angle, int smallest) {
    const auto& n = mesh_.triangles[t].n;
    const FaceId face = mesh_.triangle_face[t];
    for (int k = 0; k < 3; ++k)
      if (angle[k] < angle_deg_ && dim(n[k]) == EntityDim::kVertex &&
          corners_.smallest_deg(face, vertex_of(n[k])) < kCornerMargin * angle_deg_)
        return {ShapeCause::kCorner, kNone, mesh_.node_entity[n[k]]};
    const NodeId a = n[(smallest + 1) % 3], b = n[(smallest + 2) % 3];  // the shortest side
    if (ratio(a, b) < kConformityMin)
      if (const EdgeId e = along_edge(a, b); e != kNone)
        return {is_short(e) ? ShapeCause::kShortEdge : ShapeCause::kSizeJump, e};
    if (is_in_strip(t, angle, a, b)) {
      const VertexId corner = corner_about(t);
      return corner == kNone ? Blame{ShapeCause::kStrip} : Blame{ShapeCause::kCorner, kNone, corner};
    }
    if (request_ratio(t, t) > kRequestJump) return {ShapeCause::kSizeJump};
    return {};
  }

  /// The sharp corner in which its nodes lie, on the two edges that meet there; kNone: there is none.
  VertexId corner_about(TriangleId t) {
    std::vector<EdgeId> edges;
    for (const NodeId n : mesh_.triangles[t].n)
      if (dim(n) == EntityDim::kEdge) edges.push_back(mesh_.node_entity[n]);
    sort_once(edges);
    if (edges.size() != 2) return kNone;
    for (int k = 0; k < 4; ++k) {
      const VertexId v = tables_.edge_vertices[2 * static_cast<std::size_t>(edges[0]) + k / 2],
                     w = tables_.edge_vertices[2 * static_cast<std::size_t>(edges[1]) + k % 2];
      if (corners_.representative(v) == corners_.representative(w) && is_near(t, tables_.vertex_xyz[v]) &&
          corners_.smallest_deg(mesh_.triangle_face[t], corners_.representative(v)) < kCornerMargin * angle_deg_)
        return v;
    }
    return kNone;
  }
  bool is_near(TriangleId t, Vec3 corner) const {
    return std::ranges::all_of(mesh_.triangles[t].n,
                               [&](NodeId n) { return distance(xyz(n), corner) < kCornerReach * mesh_.node_size[n]; });
  }

  /// Its shortest side, or its height on the longest one, reaches across a face that is narrower than the sizes.
  bool is_in_strip(TriangleId t, const std::array<double, 3>& angle, NodeId short_a, NodeId short_b) {
    if (is_boundary(short_a) && is_boundary(short_b) && along_edge(short_a, short_b) == kNone &&
        ratio(short_a, short_b) < kNarrow)
      return true;
    const auto& n = mesh_.triangles[t].n;
    if (!std::all_of(n, n + 3, [&](NodeId i) { return is_boundary(i); })) return false;
    const int apex = static_cast<int>(std::max_element(angle.begin(), angle.end()) - angle.begin());
    const NodeId p = n[apex], a = n[(apex + 1) % 3], b = n[(apex + 2) % 3];
    const double longest = distance(xyz(a), xyz(b)), height = norm(cross(xyz(a) - xyz(p), xyz(b) - xyz(p))) / longest;
    const double request = (mesh_.node_size[p] + mesh_.node_size[a] + mesh_.node_size[b]) / 3;
    return height < kNarrow * request && !is_ear(mesh_.triangle_face[t], a, p, b);
  }
  /// The boundary runs a, p, b without a corner.
  bool is_ear(FaceId face, NodeId a, NodeId p, NodeId b) {
    if (along_edge(a, p) == kNone || along_edge(p, b) == kNone) return false;
    return dim(p) != EntityDim::kVertex || corners_.smallest_deg(face, vertex_of(p)) > kStraightDeg;
  }

  /// What makes a triangle smaller than its sizes.
  Blame blame_size(TriangleId t, double growth) {
    const auto& n = mesh_.triangles[t].n;
    const FaceId face = mesh_.triangle_face[t];
    for (const NodeId i : n)
      if (dim(i) == EntityDim::kVertex && corners_.smallest_deg(face, vertex_of(i)) < kGrowthCornerDeg)
        return {ShapeCause::kCorner, kNone, mesh_.node_entity[i]};
    for (int k = 0; k < 3; ++k) {
      const NodeId a = n[k], b = n[(k + 1) % 3];
      if (!is_boundary(a) || !is_boundary(b) || ratio(a, b) >= kConformityMin) continue;
      const EdgeId e = along_edge(a, b);
      if (e == kNone) return {ShapeCause::kStrip};
      return {is_short(e) ? ShapeCause::kShortEdge : ShapeCause::kSizeJump, e};
    }
    if (std::all_of(n, n + 3, [&](NodeId i) { return is_boundary(i); })) {
      const double longest = std::sqrt(
          std::max({norm2(xyz(n[0]) - xyz(n[1])), norm2(xyz(n[1]) - xyz(n[2])), norm2(xyz(n[2]) - xyz(n[0]))}));
      const double height = norm(cross(xyz(n[1]) - xyz(n[0]), xyz(n[2]) - xyz(n[0]))) / longest;
      if (height < kNarrow * mesh_.node_size[n[0]]) return {ShapeCause::kStrip};
    }
    if (request_ratio(t, t) > growth) return {ShapeCause::kSizeJump};
    return {};
  }

  /// Largest over smallest length asked for at the nodes of two triangles.
  double request_ratio(TriangleId s, TriangleId t) const {
    double low = mesh_.node_size[mesh_.triangles[s].n[0]], high = low;
    for (const TriangleId i : {s, t})
      for (const NodeId n : mesh_.triangles[i].n)
        low = std::min(low, mesh_.node_size[n]), high = std::max(high, mesh_.node_size[n]);
    return high / low;
  }

  const SurfaceMesh& mesh_;
  const TriangleCorners& shapes_;
  const ModelTables& tables_;
  CadCorners corners_;
  EdgeAngles edge_angles_;
  double angle_deg_, sine_limit_;
  std::vector<NodeId> first_inside_;                            // by CAD edge: its first node that is no vertex
  std::vector<std::int32_t> n_inside_;                          // by CAD edge: nodes that are no vertices
  std::map<std::pair<VertexId, VertexId>, EdgeId> bare_edges_;  // edges without such nodes, by their ends
};

/// Keeps the worst places of each cause, ties by their order in the mesh.
template <class IsWorse>
CauseList gather(std::vector<CausePlace> places, const IsWorse& is_worse) {
  CauseList list;
  std::stable_sort(places.begin(), places.end(), is_worse);
  for (const CausePlace& p : places) {
    const std::size_t k = static_cast<std::size_t>(p.cause);
    list.n_smooth += p.beside != kNone && p.beside_deg <= kSmoothEdgeDeg;
    if (list.count[k]++ < static_cast<std::int64_t>(CauseList::kMaxPlaces)) list.worst[k].push_back(p);
  }
  return list;
}

/// Those of both, likewise.
template <class IsWorse>
void add(const CauseList& other, const IsWorse& is_worse, CauseList& all) {
  all.n_smooth += other.n_smooth;
  for (std::size_t k = 0; k < kNShapeCauses; ++k) {
    all.count[k] += other.count[k];
    std::vector<CausePlace>& worst = all.worst[k];
    worst.insert(worst.end(), other.worst[k].begin(), other.worst[k].end());
    std::sort(worst.begin(), worst.end(), [](const CausePlace& a, const CausePlace& b) { return a.order < b.order; });
    std::stable_sort(worst.begin(), worst.end(), is_worse);
    if (worst.size() > CauseList::kMaxPlaces) worst.resize(CauseList::kMaxPlaces);
  }
}

bool is_lower(const CausePlace& a, const CausePlace& b) { return a.value < b.value; }
bool is_higher(const CausePlace& a, const CausePlace& b) { return a.value > b.value; }
bool is_more_off(const CausePlace& a, const CausePlace& b) {
  const auto off = [](double ratio) { return std::max(ratio, 1 / std::max(ratio, 1e-300)); };
  return off(a.value) > off(b.value);
}

}  // namespace

const char* cause_name(ShapeCause cause) {
  switch (cause) {
    case ShapeCause::kCorner:
      return "corner";
    case ShapeCause::kShortEdge:
      return "short edge";
    case ShapeCause::kStrip:
      return "strip";
    case ShapeCause::kSizeJump:
      return "size jump";
    case ShapeCause::kFree:
      return "free";
  }
  return "";
}

std::int64_t CauseList::total() const {
  std::int64_t n = 0;
  for (const std::int64_t c : count) n += c;
  return n;
}

void ShapeCauses::add(const ShapeCauses& other) {
  st::add(other.sharp, is_lower, sharp);
  st::add(other.growth, is_higher, growth);
  st::add(other.lengths, is_more_off, lengths);
}

ShapeCauses find_shape_causes(const Model& model, const SurfaceMesh& mesh, const TriangleCorners& corners,
                              const ShapesToExplain& shapes, const OwnTriangles& own) {
  Causes causes(model, mesh, corners, shapes.angle_deg);
  std::vector<CausePlace> sharp, growth, lengths;
  const auto take = [](CausePlace place, std::int64_t order, std::vector<CausePlace>& list) {
    place.order = order;
    list.push_back(place);
  };
  for (TriangleId t = own.begin; t < own.end; ++t)
    if (const auto place = causes.of_angle(t)) take(*place, own.number(t), sharp);
  for (const QualityReport::LargeJump& jump : shapes.jumps)
    take(causes.of_growth(jump), own.order(jump.low, jump.high), growth);
  for (const ConformityReport::OutsideEdge& e : shapes.edges) take(causes.of_length(e), own.order(e.a, e.b), lengths);
  ShapeCauses result;
  result.angle_deg = shapes.angle_deg;
  result.sharp = gather(std::move(sharp), is_lower);
  result.growth = gather(std::move(growth), is_higher);
  result.lengths = gather(std::move(lengths), is_more_off);
  return result;
}

ShapeCauses find_shape_causes(const Model& model, const SurfaceMesh& mesh, const TriangleCorners& corners,
                              const QualityReport& quality, const ConformityReport* conformity, double angle_deg) {
  ShapesToExplain shapes{quality.large_jumps, {}, angle_deg};
  if (conformity) shapes.edges = conformity->outside;
  return find_shape_causes(model, mesh, corners, shapes, OwnTriangles::all(mesh));
}

}  // namespace st
