// How good is a mesh: shapes of triangles, growth between neighbours, lengths against the requested sizes (docs/checks.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Quality 4 sqrt(3) A / (l1^2 + l2^2 + l3^2) of a triangle: 1 equilateral, 0 without area.
double triangle_quality(Vec3 a, Vec3 b, Vec3 c);

/// Shapes of a set of triangles. All zero for an empty set.
struct QualityStats {
  std::int64_t n_triangles = 0;
  double mean = 0, p1 = 0, min = 0;          ///< quality: average, first percentile, worst
  std::int64_t n_below_03 = 0;               ///< triangles with quality below 0.3
  std::array<std::int64_t, 10> histogram{};  ///< triangles by quality in [k/10, (k+1)/10)
  double min_angle_deg = 0, max_angle_deg = 0;
  std::int64_t n_below_20_deg = 0, n_below_5_deg = 0;  ///< triangles by their smallest angle
  TriangleId worst = kNone;                            ///< the (first) triangle of least quality
};

struct QualityReport {
  QualityStats model;
  std::vector<QualityStats> groups;    ///< [n_groups]
  std::vector<QualityStats> faces;     ///< [n_faces]
  double jump_p999 = 1, jump_max = 1;  ///< sqrt of the area ratio of neighbours, 99.9th percentile and largest
};

/// Local, linear. Needs 24 bytes per triangle.
QualityReport measure_quality(const SurfaceMesh& mesh);

/// Lengths of mesh edges over the requested lengths.
struct ConformityStats {
  std::int64_t n_edges = 0, n_within = 0;  ///< within [kConformityMin, kConformityMax]
  double min = 0, max = 0, sum = 0;        ///< of the ratio
  double share() const { return n_edges ? static_cast<double>(n_within) / static_cast<double>(n_edges) : 1.0; }
  double mean() const { return n_edges ? sum / static_cast<double>(n_edges) : 1.0; }
  void add(double ratio);
};

inline constexpr double kConformityMin = 0.7, kConformityMax = 1.4;

struct ConformityReport {
  ConformityStats model;
  ConformityStats inner;                       ///< edges with a node inside a face: nothing of the CAD forces their length
  std::vector<ConformityStats> groups, faces;  ///< an edge counts for the face of its first triangle
  double p1 = 1, p99 = 1;                      ///< percentiles of the ratio
};

/// Ratio of an edge: its length times the mean of 1/requested over it (Simpson's rule on its ends and middle).
/// `requested_length(xyz) > 0` in model units. Local, linear.
ConformityReport measure_conformity(const SurfaceMesh& mesh, const std::function<double(Vec3)>& requested_length);

}  // namespace st
