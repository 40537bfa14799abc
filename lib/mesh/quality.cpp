#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "mesh/adjacency.h"

namespace st {

namespace {

double area_of(const SurfaceMesh& mesh, TriangleId t) {
  const auto& n = mesh.triangles[t].n;
  return 0.5 * norm(cross(mesh.node_xyz[n[1]] - mesh.node_xyz[n[0]], mesh.node_xyz[n[2]] - mesh.node_xyz[n[0]]));
}

/// Smallest and largest angle of a triangle, degrees.
void angles(Vec3 a, Vec3 b, Vec3 c, double& smallest, double& largest) {
  const double alpha = angle_between(b - a, c - a), beta = angle_between(c - b, a - b), gamma = angle_between(a - c, b - c);
  smallest = degrees(std::min({alpha, beta, gamma}));
  largest = degrees(std::max({alpha, beta, gamma}));
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

QualityStats stats_of(const SurfaceMesh& mesh, std::span<const TriangleId> triangles, std::span<const double> quality) {
  QualityStats s;
  if (triangles.empty()) return s;
  s.n_triangles = static_cast<std::int64_t>(triangles.size());
  s.min = 2;
  s.min_angle_deg = 180;
  std::vector<double> sorted;
  sorted.reserve(triangles.size());
  for (const TriangleId t : triangles) {
    const double q = quality[t];
    sorted.push_back(q);
    s.mean += q;
    s.n_below_03 += q < 0.3;
    ++s.histogram[std::clamp(static_cast<int>(10 * q), 0, 9)];
    if (q < s.min) s.min = q, s.worst = t;
    const auto& n = mesh.triangles[t].n;
    double smallest, largest;
    angles(mesh.node_xyz[n[0]], mesh.node_xyz[n[1]], mesh.node_xyz[n[2]], smallest, largest);
    s.min_angle_deg = std::min(s.min_angle_deg, smallest);
    s.max_angle_deg = std::max(s.max_angle_deg, largest);
    s.n_below_20_deg += smallest < 20;
    s.n_below_5_deg += smallest < 5;
  }
  s.mean /= static_cast<double>(triangles.size());
  s.p1 = nth_smallest(sorted, sorted.size() / 100);
  return s;
}

/// Triangles by key (face or group), ascending within each: one QualityStats per key.
std::vector<QualityStats> stats_by_key(const SurfaceMesh& mesh, std::span<const std::int32_t> key, std::size_t n_keys,
                                       std::span<const double> quality) {
  for (const std::int32_t k : key) n_keys = std::max(n_keys, static_cast<std::size_t>(k) + 1);
  std::vector<std::int64_t> offsets(n_keys + 1, 0);
  for (const std::int32_t k : key) ++offsets[k + 1];
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<TriangleId> sorted(key.size());
  std::vector<std::int64_t> fill(offsets.begin(), offsets.end() - 1);
  for (std::size_t t = 0; t < key.size(); ++t) sorted[fill[key[t]]++] = static_cast<TriangleId>(t);
  std::vector<QualityStats> stats;
  for (std::size_t k = 0; k < n_keys; ++k)
    stats.push_back(stats_of(mesh, std::span<const TriangleId>(sorted).subspan(offsets[k], offsets[k + 1] - offsets[k]), quality));
  return stats;
}

void measure_jumps(const SurfaceMesh& mesh, QualityReport& report) {
  std::vector<double> jumps;
  EdgeTable(mesh.triangles, mesh.n_nodes()).for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const auto [low, high] = std::minmax({area_of(mesh, sides[0] / 3), area_of(mesh, sides[i] / 3)});
      if (low > 0) jumps.push_back(std::sqrt(high / low));
    }
  });
  if (jumps.empty()) return;
  report.jump_p999 = percentile(jumps, 0.999);
  report.jump_max = *std::max_element(jumps.begin(), jumps.end());
}

}  // namespace

double triangle_quality(Vec3 a, Vec3 b, Vec3 c) {
  const double sum = norm2(b - a) + norm2(c - b) + norm2(a - c);
  return sum > 0 ? 2 * std::sqrt(3.0) * norm(cross(b - a, c - a)) / sum : 0;
}

QualityReport measure_quality(const SurfaceMesh& mesh) {
  std::vector<double> quality;
  quality.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    quality.push_back(triangle_quality(mesh.node_xyz[t.n[0]], mesh.node_xyz[t.n[1]], mesh.node_xyz[t.n[2]]));
  std::vector<TriangleId> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  QualityReport report;
  report.model = stats_of(mesh, all, quality);
  report.groups = stats_by_key(mesh, mesh.triangle_group, mesh.group_name.size(), quality);
  report.faces = stats_by_key(mesh, mesh.triangle_face, mesh.face_name.size(), quality);
  measure_jumps(mesh, report);
  return report;
}

void ConformityStats::add(double ratio) {
  min = n_edges ? std::min(min, ratio) : ratio;
  max = n_edges ? std::max(max, ratio) : ratio;
  ++n_edges;
  n_within += ratio >= kConformityMin && ratio <= kConformityMax;
  sum += ratio;
}

ConformityReport measure_conformity(const SurfaceMesh& mesh, const std::function<double(Vec3)>& requested_length) {
  ConformityReport report;
  report.groups.resize(mesh.group_name.size());
  report.faces.resize(mesh.face_name.size());
  std::vector<double> inverse(mesh.n_nodes()), ratios;
  for (std::int64_t n = 0; n < mesh.n_nodes(); ++n) inverse[n] = 1 / requested_length(mesh.node_xyz[n]);
  const auto at = [](std::vector<ConformityStats>& stats, std::int32_t i) -> ConformityStats& {
    if (static_cast<std::size_t>(i) >= stats.size()) stats.resize(i + 1);
    return stats[i];
  };
  EdgeTable(mesh.triangles, mesh.n_nodes()).for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> sides) {
    const Vec3 p = mesh.node_xyz[a], q = mesh.node_xyz[b];
    const double ratio = distance(p, q) * (inverse[a] + 4 / requested_length(0.5 * (p + q)) + inverse[b]) / 6;
    ratios.push_back(ratio);
    report.model.add(ratio);
    const auto face_dim = static_cast<std::uint8_t>(EntityDim::kFace);
    if (mesh.node_entity_dim[a] == face_dim || mesh.node_entity_dim[b] == face_dim) report.inner.add(ratio);
    at(report.groups, mesh.triangle_group[sides[0] / 3]).add(ratio);
    at(report.faces, mesh.triangle_face[sides[0] / 3]).add(ratio);
  });
  if (ratios.empty()) return report;
  report.p1 = percentile(ratios, 0.01);
  report.p99 = percentile(ratios, 0.99);
  return report;
}

}  // namespace st
