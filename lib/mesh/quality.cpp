#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "base/threads.h"
#include "mesh/node_sizes.h"

namespace st {

namespace {

constexpr std::size_t kPerPiece = 16'384;  // triangles or nodes

/// `squares`: sum of the squared lengths of the sides.
double quality_of(double area, double squares) { return squares > 0 ? 4 * std::sqrt(3.0) * area / squares : 0; }

/// The bin of a value among bins of one width from `first`, the last without end.
template <std::size_t n>
std::int64_t& bin_of(std::array<std::int64_t, n>& histogram, double value, double first, double width) {
  const double bin = (value - first) / width;
  if (!(bin > 0)) return histogram[0];  // NaN, too: of coordinates that overflow
  return histogram[static_cast<std::size_t>(std::min(bin, static_cast<double>(n - 1)))];
}

/// Statistics of some triangles of a face. Angles are counted by their cosines, and worked out where one is smaller or
/// larger than those before.
struct ShapeSum {
  QualityStats stats;
  double most_acute = -1, most_obtuse = 1;  ///< cosines
};

double cosine_deg(double angle) { return std::cos(angle * kPi / 180); }

struct TriangleShape {
  double area, quality;
  std::array<double, 3> cosine;  ///< of its angles
};

TriangleShape shape_of(const std::array<Vec3, 3>& x) {
  const Vec3 ab = x[1] - x[0], ac = x[2] - x[0], bc = x[2] - x[1];
  const double ab2 = norm2(ab), ac2 = norm2(ac), bc2 = norm2(bc), area = 0.5 * norm(cross(ab, ac));
  return {
      area,
      quality_of(area, ab2 + ac2 + bc2),
      {dot(ab, ac) / std::sqrt(ab2 * ac2), -dot(ab, bc) / std::sqrt(ab2 * bc2), dot(ac, bc) / std::sqrt(ac2 * bc2)}};
}

/// The bin of 10 degrees that an angle lies in: the first for NaN, of sides without length.
std::size_t angle_bin(double cosine) {
  static const auto ends = [] {
    std::array<double, std::tuple_size_v<decltype(QualityStats::angle_histogram)> - 1> cosines;
    for (std::size_t k = 0; k < cosines.size(); ++k) cosines[k] = cosine_deg(10.0 * static_cast<double>(k + 1));
    return cosines;
  }();
  constexpr std::size_t kHalf = std::tuple_size_v<decltype(ends)> / 2;  // 90 degrees
  const bool is_obtuse = cosine <= ends[kHalf];
  std::size_t bin = is_obtuse ? kHalf + 1 : 0;
  for (std::size_t k = 0; k < kHalf; ++k) bin += cosine <= ends[k + (is_obtuse ? kHalf + 1 : 0)];
  return bin;
}

/// Counts the angles of a triangle with corners `x`, and the smallest.
void add_angles(const std::array<Vec3, 3>& x, const std::array<double, 3>& cosine, ShapeSum& sum) {
  static const double cos5 = cosine_deg(5);
  QualityStats& s = sum.stats;
  std::size_t smallest = s.angle_histogram.size();
  for (const double c : cosine) {
    const std::size_t bin = angle_bin(c);
    smallest = std::min(smallest, bin);
    ++s.angle_histogram[bin];
  }
  s.n_below_20_deg += smallest < 2;
  s.n_below_10_deg += smallest < 1;
  const double acute = std::ranges::max(cosine);
  s.n_below_5_deg += acute > cos5;
  if (acute <= sum.most_acute) return;
  sum.most_acute = acute;
  s.min_angle_deg = std::min(s.min_angle_deg, std::ranges::min(triangle_angles_deg(x[0], x[1], x[2])));
}

void add_largest_angle(const std::array<Vec3, 3>& x, const std::array<double, 3>& cosine, ShapeSum& sum) {
  static const double cos_large = cosine_deg(kLargeAngleDeg);
  const double obtuse = std::ranges::min(cosine);
  sum.stats.n_above_150_deg += obtuse < cos_large;
  if (obtuse >= sum.most_obtuse) return;
  sum.most_obtuse = obtuse;
  double& largest = sum.stats.max_angle_deg;
  largest = std::max(largest, std::ranges::max(triangle_angles_deg(x[0], x[1], x[2])));
}

/// The k-th smallest value. Reorders `values`.
double nth_smallest(std::vector<double>& values, std::size_t k) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
  return values[k];
}

/// The value with `share` of the others below it. Reorders `values`.
double percentile(std::vector<double>& values, double share) {
  return nth_smallest(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// Statistics of parts: `mean` is the sum until finish(), `p1` is set by set_percentiles().
TriangleShape add_triangle(const SurfaceMesh& mesh, const TriangleCorners& corners, TriangleId t, ShapeSum& sum) {
  const std::array<Vec3, 3> x = corners(t);
  const TriangleShape shape = shape_of(x);
  const double quality = shape.quality;
  QualityStats& s = sum.stats;
  if (s.n_triangles++ == 0) s.min = 2, s.min_angle_deg = 180;
  s.mean += quality;
  s.n_below_03 += quality < 0.3;
  ++s.histogram[std::clamp(static_cast<int>(10 * quality), 0, 9)];
  if (quality < s.min) s.min = quality, s.worst = t;
  add_angles(x, shape.cosine, sum);
  if (corners.is_stretched()) {
    const std::array<Vec3, 3> in_space = TriangleCorners(mesh)(t);
    add_largest_angle(in_space, shape_of(in_space).cosine, sum);
  } else {
    add_largest_angle(x, shape.cosine, sum);
  }
  return shape;
}

void add_part(const QualityStats& part, QualityStats& s) {
  if (s.n_triangles == 0) s.min = 2, s.min_angle_deg = 180;
  s.n_triangles += part.n_triangles;
  s.mean += part.mean;
  s.n_below_03 += part.n_below_03;
  for (std::size_t k = 0; k < s.histogram.size(); ++k) s.histogram[k] += part.histogram[k];
  if (part.min < s.min) s.min = part.min, s.worst = part.worst;
  s.min_angle_deg = std::min(s.min_angle_deg, part.min_angle_deg);
  s.max_angle_deg = std::max(s.max_angle_deg, part.max_angle_deg);
  s.n_below_20_deg += part.n_below_20_deg;
  s.n_below_10_deg += part.n_below_10_deg;
  s.n_below_5_deg += part.n_below_5_deg;
  s.n_above_150_deg += part.n_above_150_deg;
  for (std::size_t k = 0; k < s.angle_histogram.size(); ++k) s.angle_histogram[k] += part.angle_histogram[k];
}

void finish(QualityStats& s) {
  if (s.n_triangles > 0) s.mean /= static_cast<double>(s.n_triangles);
}

/// The element of a list that grows as needed.
template <class Stats>
Stats& at(std::vector<Stats>& list, std::int32_t i) {
  if (static_cast<std::size_t>(i) >= list.size()) list.resize(static_cast<std::size_t>(i) + 1);
  return list[i];
}

/// Model, groups and faces but for the percentiles: each piece of the mesh has its own sums, added up in order.
void add_shapes(const SurfaceMesh& mesh, const TriangleCorners& corners, std::span<double> quality,
                std::span<double> area, QualityReport& report) {
  using Parts = std::map<std::pair<FaceId, std::int32_t>, ShapeSum>;
  std::vector<Parts> pieces((quality.size() + kPerPiece - 1) / kPerPiece);
  parallel_for(quality.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    Parts& parts = pieces[begin / kPerPiece];
    std::pair<FaceId, std::int32_t> last{kNone, kNone};
    ShapeSum* part = nullptr;  // triangles come face by face
    for (std::size_t t = begin; t < end; ++t) {
      const std::pair key(mesh.triangle_face[t], mesh.triangle_group[t]);
      if (!part || key != last) part = &parts[last = key];
      const TriangleShape shape = add_triangle(mesh, corners, static_cast<TriangleId>(t), *part);
      quality[t] = shape.quality;
      area[t] = shape.area;
    }
  });
  for (const Parts& parts : pieces)
    for (const auto& [key, part] : parts) {
      add_part(part.stats, report.model);
      add_part(part.stats, at(report.faces, key.first));
      add_part(part.stats, at(report.groups, key.second));
    }
  finish(report.model);
  for (auto* list : {&report.faces, &report.groups})
    for (QualityStats& s : *list) finish(s);
}

/// First percentiles by key (face or group).
void set_percentiles(std::span<const std::int32_t> key, std::span<const double> quality,
                     std::vector<QualityStats>& stats) {
  std::vector<std::vector<double>> of_key(stats.size());
  for (std::size_t k = 0; k < stats.size(); ++k) of_key[k].reserve(static_cast<std::size_t>(stats[k].n_triangles));
  for (std::size_t t = 0; t < key.size(); ++t) of_key[key[t]].push_back(quality[t]);
  parallel_for(of_key.size(), 1, [&](std::size_t k, std::size_t) {
    if (!of_key[k].empty()) stats[k].p1 = nth_smallest(of_key[k], of_key[k].size() / 100);
  });
}

/// `area`: of the triangles.
void measure_jumps(const SurfaceMesh& mesh, const EdgeTable& edges, std::span<const double> area,
                   QualityReport& report) {
  std::vector<double> jumps;
  jumps.reserve(area.size() / 2 * 3);  // of a closed mesh
  report.group_jumps.resize(report.groups.size());
  report.face_jumps.resize(report.faces.size());
  edges.for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const TriangleId t = sides[0] / 3;
      const auto [low, high] = std::minmax({area[t], area[sides[i] / 3]});
      if (!(low > 0)) continue;
      jumps.push_back(std::sqrt(high / low));
      if (jumps.back() > kLargeGrowth) report.large_jumps.push_back({t, sides[i] / 3, jumps.back()});
      for (JumpStats* stats :
           {&report.jumps, &report.group_jumps[mesh.triangle_group[t]], &report.face_jumps[mesh.triangle_face[t]]})
        stats->add(jumps.back());
    }
  });
  if (jumps.empty()) return;
  report.jump_p999 = percentile(jumps, 0.999);
  report.jump_max = report.jumps.max;
}

}  // namespace

std::array<double, 3> triangle_angles_deg(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const double twice_area = norm(cross(ab, ac));
  const double at_a = std::atan2(twice_area, dot(ab, ac)), at_b = std::atan2(twice_area, -dot(ab, bc));
  const double at_c = twice_area > 0 ? kPi - at_a - at_b : angle_between(ac, bc);
  return {degrees(at_a), degrees(at_b), degrees(at_c)};
}

void JumpStats::add(double ratio) {
  ++n_pairs;
  max = std::max(max, ratio);
  ++bin_of(histogram, ratio, 1, kBinWidth);
}

double triangle_quality(Vec3 a, Vec3 b, Vec3 c) {
  return quality_of(0.5 * norm(cross(b - a, c - a)), norm2(b - a) + norm2(c - b) + norm2(a - c));
}

/// Of the three nodes, the mean of their vectors up to the sign, which has no meaning.
std::array<Vec3, 3> TriangleCorners::operator()(TriangleId t) const {
  const auto& n = mesh_.triangles[t].n;
  const std::array<Vec3, 3> x{mesh_.node_xyz[n[0]], mesh_.node_xyz[n[1]], mesh_.node_xyz[n[2]]};
  if (squeeze_.empty()) return x;
  const Vec3 first = squeeze_[n[0]];
  Vec3 squeeze = first;
  for (const int k : {1, 2}) squeeze += (dot(squeeze, squeeze_[n[k]]) < 0 ? -1.0 : 1.0) * squeeze_[n[k]];
  squeeze = squeeze / 3;
  return {Vec3{}, squeezed(x[1] - x[0], squeeze), squeezed(x[2] - x[0], squeeze)};
}

QualityReport measure_quality(const SurfaceMesh& mesh, const EdgeTable& edges) {
  return measure_quality(mesh, edges, TriangleCorners(mesh));
}

QualityReport measure_quality(const SurfaceMesh& mesh, const EdgeTable& edges, const TriangleCorners& corners) {
  std::vector<double> quality(mesh.triangles.size()), area(mesh.triangles.size());
  QualityReport report;
  report.groups.resize(mesh.labels.group_name.size());
  report.faces.resize(mesh.labels.face_name.size());
  add_shapes(mesh, corners, quality, area, report);
  set_percentiles(mesh.triangle_group, quality, report.groups);
  set_percentiles(mesh.triangle_face, quality, report.faces);
  if (corners.is_stretched()) report.rows = measure_rows(mesh, edges, quality);
  if (!quality.empty()) report.model.p1 = nth_smallest(quality, quality.size() / 100);
  std::vector<double>().swap(quality);
  measure_jumps(mesh, edges, area, report);
  return report;
}

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
  bool take(NodeId a, NodeId b, std::span<const SideId> sides, double ratio) {
    if (ratio >= kConformityMin || dim(a) == EntityDim::kFace || dim(b) == EntityDim::kFace) return false;
    ForcedPlace place{ForcedPlace::Kind::kShortEdge, kNone, 0, ratio, 0.5 * (mesh_.node_xyz[a] + mesh_.node_xyz[b])};
    Key key{place.kind, kNone, a, b};
    if (is_across(a, b, sides)) {
      place.kind = ForcedPlace::Kind::kStrip;
      place.entity = mesh_.triangle_face[sides[0] / 3];
      key = {place.kind, place.entity, kNone, kNone};
    } else if (dim(a) == EntityDim::kEdge || dim(b) == EntityDim::kEdge) {
      place.entity = mesh_.node_entity[dim(a) == EntityDim::kEdge ? a : b];
      if (n_inside_.at(place.entity) >= kMostSegments) return false;
      key = {place.kind, place.entity, kNone, kNone};
    }
    ForcedPlace& known = places_.try_emplace(key, place).first->second;
    if (ratio < known.min_ratio) known.min_ratio = ratio, known.xyz = place.xyz;
    ++known.n_edges;
    return true;
  }

  std::vector<ForcedPlace> places() const {
    std::vector<ForcedPlace> list;
    for (const auto& entry : places_) list.push_back(entry.second);
    return list;
  }

 private:
  using Key = std::tuple<ForcedPlace::Kind, std::int32_t, NodeId, NodeId>;
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
  std::map<EdgeId, std::int64_t> n_inside_;  ///< nodes inside each CAD edge
  std::map<Key, ForcedPlace> places_;
};

/// Length over requested length of every edge, in the order of the table.
std::vector<double> length_ratios(const SurfaceMesh& mesh, const EdgeTable& edges, const RequestedSize& requested,
                                  const RequestedLength& along) {
  const auto n_nodes = static_cast<std::size_t>(mesh.n_nodes());
  const NodeSizes asked(mesh.node_xyz, requested, along);
  std::vector<std::size_t> first((n_nodes + kPerPiece - 1) / kPerPiece, 0);  // edge of each piece
  parallel_for(n_nodes, kPerPiece, [&](std::size_t begin, std::size_t end) {
    edges.for_each_edge(static_cast<NodeId>(begin), static_cast<NodeId>(end),
                        [&](NodeId, NodeId, std::span<const SideId>) { ++first[begin / kPerPiece]; });
  });
  std::size_t n_edges = 0;
  for (std::size_t& f : first) n_edges += std::exchange(f, n_edges);
  std::vector<double> ratios(n_edges);
  parallel_for(n_nodes, kPerPiece, [&](std::size_t begin, std::size_t end) {
    int hint = 0;
    double* ratio = ratios.data() + first[begin / kPerPiece];
    edges.for_each_edge(static_cast<NodeId>(begin), static_cast<NodeId>(end),
                        [&](NodeId a, NodeId b, std::span<const SideId>) {
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
  ConformityReport report;
  report.groups.resize(mesh.labels.group_name.size());
  report.faces.resize(mesh.labels.face_name.size());
  std::vector<double> ratios = length_ratios(mesh, edges, requested, along);
  ForcedEdges forced(mesh);
  std::size_t n_seen = 0;
  edges.for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> sides) {
    const double ratio = ratios[n_seen++];
    if (!forced.take(a, b, sides, ratio)) {
      report.free.add(ratio);
      if (ratio < kConformityMin || ratio > kConformityMax)
        report.outside.push_back({a, b, sides[0] / 3, sides.size() > 1 ? sides[1] / 3 : kNone, ratio});
    }
    const auto face_dim = static_cast<std::uint8_t>(EntityDim::kFace);
    if (mesh.node_entity_dim[a] == face_dim || mesh.node_entity_dim[b] == face_dim) report.inner.add(ratio);
    at(report.groups, mesh.triangle_group[sides[0] / 3]).add(ratio);
    at(report.faces, mesh.triangle_face[sides[0] / 3]).add(ratio);
  });
  for (const ConformityStats& face : report.faces) report.model.add(face);
  report.forced = forced.places();
  if (ratios.empty()) return report;
  report.p1 = percentile(ratios, 0.01), report.p99 = percentile(ratios, 0.99);
  return report;
}

}  // namespace st
