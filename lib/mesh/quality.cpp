#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "base/local_size.h"
#include "base/threads.h"

namespace st {

namespace {

/// `squares`: sum of the squared lengths of the sides.
double quality_of(double area, double squares) { return squares > 0 ? 4 * std::sqrt(3.0) * area / squares : 0; }

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

/// Of `n` values those up to the first percentile.
std::size_t n_to_first_percentile(std::int64_t n) { return static_cast<std::size_t>(n) / 100 + 1; }

/// Statistics of parts: `mean` is the sum until finish(), `p1` is set by report_quality().
TriangleShape add_triangle(const SurfaceMesh& mesh, const TriangleCorners& corners, TriangleId t, ShapeSum& sum) {
  const std::array<Vec3, 3> x = corners(t);
  const TriangleShape shape = shape_of(x);
  const double quality = shape.quality;
  QualityStats& s = sum.stats;
  if (s.n_triangles++ == 0) s.min = 2, s.min_angle_deg = 180;
  s.mean += quality;
  s.n_below_03 += quality < 0.3;
  ++s.histogram[std::clamp(static_cast<int>(10 * quality), 0, 9)];
  if (quality < s.min) s.min = quality, s.worst.triangle = t;
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

/// Sums of each piece by face and group. `quality`: of own triangles, `area`: of all.
std::vector<QualityParts::Part> measure_shapes(const SurfaceMesh& mesh, const TriangleCorners& corners,
                                               const OwnTriangles& own, std::span<double> quality,
                                               std::span<double> area) {
  using Parts = std::map<std::pair<FaceId, std::int32_t>, ShapeSum>;
  std::vector<Parts> pieces(own.n_pieces());
  parallel_for(own.size(), kTrianglesPerPiece, [&](std::size_t begin, std::size_t end) {
    Parts& parts = pieces[begin / kTrianglesPerPiece];
    std::pair<FaceId, std::int32_t> last{kNone, kNone};
    ShapeSum* part = nullptr;  // triangles come face by face
    for (std::size_t i = begin; i < end; ++i) {
      const auto t = static_cast<TriangleId>(own.begin + static_cast<TriangleId>(i));
      const std::pair key(mesh.triangle_face[t], mesh.triangle_group[t]);
      if (!part || key != last) part = &parts[last = key];
      const TriangleShape shape = add_triangle(mesh, corners, t, *part);
      quality[i] = shape.quality;
      area[t] = shape.area;
    }
  });
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t)
    if (t == own.begin && own.size() > 0)
      t = own.end - 1;
    else
      area[t] = shape_of(corners(t)).area;
  std::vector<QualityParts::Part> all;
  for (const Parts& parts : pieces)
    for (const auto& [key, part] : parts) {
      all.push_back({key.first, key.second, part.stats});
      QualityStats& s = all.back().stats;
      const TriangleId worst = s.worst.triangle;
      if (worst == kNone) continue;
      const auto& n = mesh.triangles[worst].n;
      s.worst = {own.number(worst), mesh.triangle_face[worst],
                 (mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3};
    }
  return all;
}

/// The lowest values by key (face or group). `counts`: of the whole mesh.
std::vector<KeptValues> lowest_by(std::span<const std::int32_t> key, std::span<const double> quality,
                                  const std::vector<std::int64_t>& counts) {
  std::vector<std::size_t> n_own(counts.size(), 0);
  for (const std::int32_t k : key) ++n_own[k];
  std::vector<KeptValues> of_key(counts.size());
  for (std::size_t k = 0; k < counts.size(); ++k) of_key[k].values.reserve(n_own[k]);
  for (std::size_t t = 0; t < key.size(); ++t) of_key[key[t]].values.push_back(quality[t]);
  parallel_for(of_key.size(), 1, [&](std::size_t k, std::size_t) {
    keep_lowest(of_key[k].values, n_to_first_percentile(counts[k]));
    of_key[k].values.shrink_to_fit();
  });
  return of_key;
}

/// `area`: of the triangles.
void measure_jumps(const SurfaceMesh& mesh, const EdgeTable& edges, std::span<const double> area,
                   const OwnTriangles& own, const TriangleCounts& counts, QualityParts& parts) {
  std::vector<double>& jumps = parts.highest_jumps.values;
  jumps.reserve(own.size() / 2 * 3);  // of a closed mesh
  parts.group_jumps.resize(counts.groups.size());
  parts.face_jumps.resize(counts.faces.size());
  edges.for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> sides) {
    if (!own.has_side(sides[0])) return;
    const TriangleId t = sides[0] / 3;
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const auto [low, high] = std::minmax({area[t], area[sides[i] / 3]});
      if (!(low > 0)) continue;
      jumps.push_back(std::sqrt(high / low));
      if (jumps.back() > kLargeGrowth) parts.large_jumps.push_back({t, sides[i] / 3, a, b, jumps.back()});
      for (JumpStats* stats :
           {&parts.jumps, &parts.group_jumps[mesh.triangle_group[t]], &parts.face_jumps[mesh.triangle_face[t]]})
        stats->add(jumps.back());
    }
  });
  keep_highest(jumps, n_kept(most_sides(counts.model), 0.001));
  jumps.shrink_to_fit();
}

/// Adds lists element by element.
void add_lowest(std::vector<KeptValues>& all, const std::vector<KeptValues>& next,
                const std::vector<std::int64_t>& counts) {
  all.resize(std::max(all.size(), next.size()));
  for (std::size_t k = 0; k < next.size(); ++k) {
    std::vector<double>& values = all[k].values;
    values.insert(values.end(), next[k].values.begin(), next[k].values.end());
    keep_lowest(values, n_to_first_percentile(counts[k]));
  }
}
void add_jumps(std::vector<JumpStats>& all, const std::vector<JumpStats>& next) {
  all.resize(std::max(all.size(), next.size()));
  for (std::size_t k = 0; k < next.size(); ++k) all[k].add(next[k]);
}

void set_percentiles(const std::vector<KeptValues>& lowest, std::vector<QualityStats>& stats) {
  for (std::size_t k = 0; k < lowest.size(); ++k)
    if (!lowest[k].values.empty()) stats[k].p1 = std::ranges::max(lowest[k].values);
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

void JumpStats::add(const JumpStats& other) {
  n_pairs += other.n_pairs;
  max = std::max(max, other.max);
  for (std::size_t k = 0; k < histogram.size(); ++k) histogram[k] += other.histogram[k];
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
  const TriangleCounts counts = TriangleCounts::of(mesh);
  return report_quality(measure_quality(mesh, edges, corners, OwnTriangles::all(mesh), counts), counts);
}

TriangleCounts TriangleCounts::of(const SurfaceMesh& mesh) {
  TriangleCounts counts;
  counts.model = mesh.n_triangles();
  counts.groups.resize(mesh.labels.group_name.size());
  counts.faces.resize(mesh.labels.face_name.size());
  for (const std::int32_t g : mesh.triangle_group) ++at(counts.groups, g);
  for (const FaceId f : mesh.triangle_face) ++at(counts.faces, f);
  return counts;
}

QualityParts measure_quality(const SurfaceMesh& mesh, const EdgeTable& edges, const TriangleCorners& corners,
                             const OwnTriangles& own, const TriangleCounts& counts) {
  std::vector<double> quality(own.size()), area(mesh.triangles.size());
  QualityParts parts;
  parts.shapes = measure_shapes(mesh, corners, own, quality, area);
  parts.group_lowest = lowest_by(std::span(mesh.triangle_group).subspan(own.begin, own.size()), quality, counts.groups);
  parts.face_lowest = lowest_by(std::span(mesh.triangle_face).subspan(own.begin, own.size()), quality, counts.faces);
  if (corners.is_stretched()) parts.rows = measure_rows(mesh, edges, quality);
  keep_lowest(quality, n_to_first_percentile(counts.model));
  parts.lowest.values.assign(quality.begin(), quality.end());
  std::vector<double>().swap(quality);
  measure_jumps(mesh, edges, area, own, counts, parts);
  return parts;
}

void QualityParts::add(const QualityParts& next, const TriangleCounts& counts) {
  shapes.insert(shapes.end(), next.shapes.begin(), next.shapes.end());
  lowest.values.insert(lowest.values.end(), next.lowest.values.begin(), next.lowest.values.end());
  keep_lowest(lowest.values, n_to_first_percentile(counts.model));
  add_lowest(group_lowest, next.group_lowest, counts.groups);
  add_lowest(face_lowest, next.face_lowest, counts.faces);
  jumps.add(next.jumps);
  add_jumps(group_jumps, next.group_jumps);
  add_jumps(face_jumps, next.face_jumps);
  std::vector<double>& highest = highest_jumps.values;
  highest.insert(highest.end(), next.highest_jumps.values.begin(), next.highest_jumps.values.end());
  keep_highest(highest, n_kept(most_sides(counts.model), 0.001));
}

QualityReport report_quality(QualityParts&& parts, const TriangleCounts& counts) {
  QualityReport report;
  report.groups.resize(counts.groups.size());
  report.faces.resize(counts.faces.size());
  for (const QualityParts::Part& part : parts.shapes) {
    add_part(part.stats, report.model);
    add_part(part.stats, report.faces[part.face]);
    add_part(part.stats, report.groups[part.group]);
  }
  finish(report.model);
  for (auto* list : {&report.faces, &report.groups})
    for (QualityStats& s : *list) finish(s);
  set_percentiles(parts.group_lowest, report.groups);
  set_percentiles(parts.face_lowest, report.faces);
  if (!parts.lowest.values.empty()) report.model.p1 = std::ranges::max(parts.lowest.values);
  report.jumps = parts.jumps;
  report.group_jumps = std::move(parts.group_jumps);
  report.face_jumps = std::move(parts.face_jumps);
  report.group_jumps.resize(report.groups.size());
  report.face_jumps.resize(report.faces.size());
  report.large_jumps = std::move(parts.large_jumps);
  report.rows = parts.rows;
  if (parts.highest_jumps.values.empty()) return report;
  report.jump_p999 =
      percentile_of_highest(parts.highest_jumps.values, static_cast<std::size_t>(report.jumps.n_pairs), 0.999);
  report.jump_max = report.jumps.max;
  return report;
}

}  // namespace st
