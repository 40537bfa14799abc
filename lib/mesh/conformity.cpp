#include "mesh/conformity.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "base/threads.h"
#include "mesh/node_sizes.h"

namespace st {

namespace {

constexpr std::size_t kPerPiece = 2'048;  // nodes

/// The element of a list that grows as needed.
template <class Stats>
Stats& at(std::vector<Stats>& list, std::int32_t i) {
  if (static_cast<std::size_t>(i) >= list.size()) list.resize(static_cast<std::size_t>(i) + 1);
  return list[i];
}

}  // namespace

void ConformityStats::add(double ratio) {
  min = n_edges ? std::min(min, ratio) : ratio;
  max = n_edges ? std::max(max, ratio) : ratio;
  ++n_edges;
  n_within += ratio >= kConformityMin && ratio <= kConformityMax;
  sum += ratio;
  ++bin_of(histogram, ratio, 0, kBinWidth);
}

void ConformityStats::add(const ConformityStats& other) {
  if (other.n_edges == 0) return;
  min = n_edges ? std::min(min, other.min) : other.min;
  max = n_edges ? std::max(max, other.max) : other.max;
  n_edges += other.n_edges;
  n_within += other.n_within;
  sum += other.sum;
  for (std::size_t k = 0; k < histogram.size(); ++k) histogram[k] += other.histogram[k];
}

namespace {

/// Tells which short edges the CAD forces, and gathers them by place.
class ForcedEdges {
 public:
  explicit ForcedEdges(const SurfaceMesh& mesh) : mesh_(mesh) {
    for (std::int64_t n = 0; n < mesh.n_nodes(); ++n)
      if (dim(n) == EntityDim::kEdge) ++n_inside_[mesh.node_entity[n]];
  }

  /// Takes the edge (a, b) when it is forced. `sides`: its triangles.
  bool take(NodeId a, NodeId b, std::span<const SideId> sides, double ratio, const OwnTriangles& own) {
    if (ratio >= kConformityMin || dim(a) == EntityDim::kFace || dim(b) == EntityDim::kFace) return false;
    ForcedPlace place{ForcedPlace::Kind::kShortEdge, kNone, 0, ratio, 0.5 * (mesh_.node_xyz[a] + mesh_.node_xyz[b])};
    Key key{place.kind, kNone, own.node(a), own.node(b)};
    if (is_across(a, b, sides)) {
      place.kind = ForcedPlace::Kind::kStrip;
      place.entity = mesh_.triangle_face[sides[0] / 3];
      key = {place.kind, place.entity, kNone, kNone};
    } else if (dim(a) == EntityDim::kEdge || dim(b) == EntityDim::kEdge) {
      place.entity = mesh_.node_entity[dim(a) == EntityDim::kEdge ? a : b];
      if (n_inside_.at(place.entity) >= kMostSegments) return false;
      key = {place.kind, place.entity, kNone, kNone};
    }
    auto& [known, order] = places_.try_emplace(key, place, own.order(a, b)).first->second;
    if (ratio < known.min_ratio) known.min_ratio = ratio, known.xyz = place.xyz, order = own.order(a, b);
    ++known.n_edges;
    return true;
  }

  std::vector<ConformityParts::Forced> places() const {
    std::vector<ConformityParts::Forced> list;
    for (const auto& [key, found] : places_) {
      const auto& [kind, entity, a, b] = key;
      list.push_back({kind, entity, a, b, found.second, found.first});
    }
    return list;
  }

 private:
  using Key = ConformityParts::ForcedKey;
  static constexpr int kMostSegments = 3;  ///< what a loop of one edge needs

  EntityDim dim(NodeId n) const { return static_cast<EntityDim>(mesh_.node_entity_dim[n]); }
  Vec2 uv_at(SideId side, NodeId n) const {
    const SideId next = side / 3 * 3 + (side % 3 + 1) % 3;
    return mesh_.corner_uv[mesh_.triangles[side / 3].n[side % 3] == n ? side : next];
  }
  /// Inside one face, not along its boundary: a seam's two sides have different (u,v).
  bool is_across(NodeId a, NodeId b, std::span<const SideId> sides) const {
    if (sides.size() != 2 || mesh_.triangle_face[sides[0] / 3] != mesh_.triangle_face[sides[1] / 3]) return false;
    return uv_at(sides[0], a) == uv_at(sides[1], a) && uv_at(sides[0], b) == uv_at(sides[1], b);
  }

  const SurfaceMesh& mesh_;
  std::map<EdgeId, std::int64_t> n_inside_;                     ///< nodes inside each CAD edge
  std::map<Key, std::pair<ForcedPlace, std::int64_t>> places_;  ///< with the order of its shortest edge
};

/// Sums of pieces by face and group; edges come in any order of pieces, mostly in that of faces.
class ConformitySums {
 public:
  ConformitySums(const SurfaceMesh& mesh, const OwnTriangles& own) : mesh_(mesh), own_(own), pieces_(own.n_pieces()) {}

  /// Of the edges whose first triangle is `t`.
  ConformityParts::Part& at(TriangleId t) {
    const std::size_t piece = own_.piece(t);
    const std::pair key(mesh_.triangle_face[t], mesh_.triangle_group[t]);
    if (last_ && piece == last_piece_ && key == last_key_) return *last_;
    ConformityParts::Part& part = pieces_[last_piece_ = piece].try_emplace(key).first->second;
    part.face = key.first;
    part.group = key.second;
    last_key_ = key;
    return *(last_ = &part);
  }
  std::vector<ConformityParts::Part> parts() const {
    std::vector<ConformityParts::Part> all;
    for (const auto& parts : pieces_)
      for (const auto& entry : parts) all.push_back(entry.second);
    return all;
  }

 private:
  const SurfaceMesh& mesh_;
  const OwnTriangles& own_;
  std::vector<std::map<std::pair<FaceId, std::int32_t>, ConformityParts::Part>> pieces_;
  ConformityParts::Part* last_ = nullptr;
  std::size_t last_piece_ = 0;
  std::pair<FaceId, std::int32_t> last_key_{kNone, kNone};
};

/// Length over requested length of every own edge, in the order of the table.
std::vector<double> length_ratios(const SurfaceMesh& mesh, const EdgeTable& edges, const RequestedSize& requested,
                                  const RequestedLength& along, const OwnTriangles& own) {
  const auto n_nodes = static_cast<std::size_t>(mesh.n_nodes());
  const NodeSizes asked(mesh.node_xyz, requested, along);
  std::vector<std::size_t> first((n_nodes + kPerPiece - 1) / kPerPiece, 0);  // edge of each piece
  parallel_for(n_nodes, kPerPiece, [&](std::size_t begin, std::size_t end) {
    edges.for_each_edge(
        static_cast<NodeId>(begin), static_cast<NodeId>(end),
        [&](NodeId, NodeId, std::span<const SideId> sides) { first[begin / kPerPiece] += own.has_side(sides[0]); });
  });
  std::size_t n_edges = 0;
  for (std::size_t& f : first) n_edges += std::exchange(f, n_edges);
  std::vector<double> ratios(n_edges);
  parallel_for(n_nodes, kPerPiece, [&](std::size_t begin, std::size_t end) {
    int hint = 0;
    double* ratio = ratios.data() + first[begin / kPerPiece];
    edges.for_each_edge(static_cast<NodeId>(begin), static_cast<NodeId>(end),
                        [&](NodeId a, NodeId b, std::span<const SideId> sides) {
                          if (!own.has_side(sides[0])) return;
                          const Vec3 p = mesh.node_xyz[a], q = mesh.node_xyz[b];
                          const auto inverse = [&](NodeId n) { return 1 / asked.length(n, q - p, hint); };
                          const double middle = asked.length(0.5 * (p + q), q - p, hint);
                          *ratio++ = distance(p, q) * (inverse(a) + 4 / middle + inverse(b)) / 6;
                        });
  });
  return ratios;
}

}  // namespace

ConformityReport measure_conformity(const SurfaceMesh& mesh, const EdgeTable& edges, const RequestedSize& requested,
                                    const RequestedLength& along) {
  return report_conformity(
      measure_conformity(mesh, edges, requested, along, OwnTriangles::all(mesh), mesh.n_triangles()),
      mesh.labels.group_name.size(), mesh.labels.face_name.size());
}

ConformityParts measure_conformity(const SurfaceMesh& mesh, const EdgeTable& edges, const RequestedSize& requested,
                                   const RequestedLength& along, const OwnTriangles& own, std::int64_t n_triangles) {
  ConformityParts result;
  std::vector<double> ratios = length_ratios(mesh, edges, requested, along, own);
  ForcedEdges forced(mesh);
  ConformitySums sums(mesh, own);
  std::size_t n_seen = 0;
  edges.for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> sides) {
    if (!own.has_side(sides[0])) return;
    const double ratio = ratios[n_seen++];
    ConformityParts::Part& part = sums.at(sides[0] / 3);
    if (forced.take(a, b, sides, ratio, own)) {
      part.forced.add(ratio);
      return;
    }
    const auto face_dim = static_cast<std::uint8_t>(EntityDim::kFace);
    const bool is_inner = mesh.node_entity_dim[a] == face_dim || mesh.node_entity_dim[b] == face_dim;
    (is_inner ? part.inner : part.rim).add(ratio);
    if (ratio < kConformityMin || ratio > kConformityMax)
      result.outside.push_back({a, b, sides[0] / 3, sides.size() > 1 ? sides[1] / 3 : kNone, ratio});
  });
  result.parts = sums.parts();
  result.forced = forced.places();
  const std::size_t most = n_kept(most_sides(n_triangles), 0.01);
  result.highest.values = ratios;
  keep_highest(result.highest.values, most);
  result.highest.values.shrink_to_fit();
  result.lowest.values = std::move(ratios);
  keep_lowest(result.lowest.values, most);
  result.lowest.values.shrink_to_fit();
  return result;
}

void ConformityParts::add(const ConformityParts& next, std::int64_t n_triangles) {
  parts.insert(parts.end(), next.parts.begin(), next.parts.end());
  std::map<ForcedKey, Forced> by_key;
  for (const Forced& f : forced) by_key.emplace(f.key(), f);
  for (const Forced& f : next.forced) {
    const auto [known, is_new] = by_key.try_emplace(f.key(), f);
    if (is_new) continue;
    Forced& all = known->second;
    const std::int64_t n_edges = all.place.n_edges + f.place.n_edges;
    if (std::pair(f.place.min_ratio, f.order) < std::pair(all.place.min_ratio, all.order)) all = f;
    all.place.n_edges = n_edges;
  }
  forced.clear();
  for (const auto& entry : by_key) forced.push_back(entry.second);
  const std::size_t most = n_kept(most_sides(n_triangles), 0.01);
  lowest.values.insert(lowest.values.end(), next.lowest.values.begin(), next.lowest.values.end());
  keep_lowest(lowest.values, most);
  highest.values.insert(highest.values.end(), next.highest.values.begin(), next.highest.values.end());
  keep_highest(highest.values, most);
}

ConformityReport report_conformity(ConformityParts&& parts, std::size_t n_groups, std::size_t n_faces) {
  ConformityReport report;
  report.groups.resize(n_groups);
  report.faces.resize(n_faces);
  for (const ConformityParts::Part& part : parts.parts) {
    for (const ConformityStats* stats : {&part.inner, &part.rim, &part.forced}) {
      at(report.faces, part.face).add(*stats);
      at(report.groups, part.group).add(*stats);
      if (stats != &part.forced) report.free.add(*stats);
    }
    report.inner.add(part.inner);
  }
  for (const ConformityStats& face : report.faces) report.model.add(face);
  for (const ConformityParts::Forced& f : parts.forced) report.forced.push_back(f.place);
  report.outside = std::move(parts.outside);
  const auto n = static_cast<std::size_t>(report.model.n_edges);
  if (n == 0) return report;
  report.p1 = percentile_of_lowest(parts.lowest.values, n, 0.01);
  report.p99 = percentile_of_highest(parts.highest.values, n, 0.99);
  return report;
}

}  // namespace st
