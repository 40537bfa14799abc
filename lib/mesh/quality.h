// How good is a mesh: shapes of triangles, growth between neighbours (docs/checks.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/kept_values.h"
#include "mesh/own_triangles.h"
#include "mesh/row_quality.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Quality 4 sqrt(3) A / (l1^2 + l2^2 + l3^2) of a triangle: 1 equilateral, 0 without area.
double triangle_quality(Vec3 a, Vec3 b, Vec3 c);

/// Angles at the three corners, degrees.
std::array<double, 3> triangle_angles_deg(Vec3 a, Vec3 b, Vec3 c);

/// Corners of triangles: in space, or squeezed as stretched sizes see them, where a triangle of the requested shape is
/// equilateral.
class TriangleCorners {
 public:
  /// `squeeze`: [n_nodes] see base/local_size.h, or empty. All outlive the object.
  explicit TriangleCorners(const SurfaceMesh& mesh, std::span<const Vec3> squeeze = {})
      : mesh_(mesh), squeeze_(squeeze) {}
  std::array<Vec3, 3> operator()(TriangleId t) const;
  bool is_stretched() const { return !squeeze_.empty(); }

 private:
  const SurfaceMesh& mesh_;
  std::span<const Vec3> squeeze_;
};

/// Angles of stretched triangles in space above this are listed.
inline constexpr double kLargeAngleDeg = 150;

/// Shapes of a set of triangles. All zero for an empty set.
struct QualityStats {
  std::int64_t n_triangles = 0;
  double mean = 0, p1 = 0, min = 0;          ///< quality: average, first percentile, worst
  std::int64_t n_below_03 = 0;               ///< triangles with quality below 0.3
  std::array<std::int64_t, 10> histogram{};  ///< triangles by quality in [k/10, (k+1)/10)
  double min_angle_deg = 0, max_angle_deg = 0;
  std::int64_t n_below_20_deg = 0, n_below_10_deg = 0, n_below_5_deg = 0;  ///< triangles by their smallest angle
  std::int64_t n_above_150_deg = 0;                ///< triangles by their largest angle in space
  std::array<std::int64_t, 18> angle_histogram{};  ///< angles (three per triangle) in [10 k, 10 k + 10) degrees
  /// The (first) triangle of least quality.
  struct Worst {
    TriangleId triangle = kNone;  ///< number in the whole mesh
    FaceId face = kNone;
    Vec3 place = {};  ///< its middle
  };
  Worst worst = {};
};

/// Growth between neighbours: square root of the ratio of their areas, at least 1.
struct JumpStats {
  static constexpr double kBinWidth = 0.1;
  std::int64_t n_pairs = 0;  ///< pairs of triangles with a common edge, both with an area
  double max = 1;
  std::array<std::int64_t, 20> histogram{};  ///< pairs by ratio in [1 + 0.1 k, 1.1 + 0.1 k), the last without end
  void add(double ratio);
  void add(const JumpStats& other);
};

/// Neighbours that grow more than this are listed.
inline constexpr double kLargeGrowth = 1.6;

struct QualityReport {
  struct LargeJump {
    TriangleId a, b;
    NodeId low, high;  ///< of their common edge
    double ratio;      ///< above kLargeGrowth
  };
  QualityStats model;
  std::vector<QualityStats> groups;    ///< [n_groups]
  std::vector<QualityStats> faces;     ///< [n_faces]
  double jump_p999 = 1, jump_max = 1;  ///< sqrt of the area ratio of neighbours, 99.9th percentile and largest
  JumpStats jumps;
  std::vector<JumpStats> group_jumps, face_jumps;  ///< [n_groups], [n_faces]; a pair counts for the face of its first
                                                   ///< triangle
  std::vector<LargeJump> large_jumps;              ///< by the nodes of their common edge
  RowStats rows;                                   ///< of stretched sizes
};

/// Local, linear, by threads. `edges`: edges_of(mesh). Shapes, growth and the smallest angles are those of `corners`,
/// the largest angles those in space.
QualityReport measure_quality(const SurfaceMesh& mesh, const EdgeTable& edges, const TriangleCorners& corners);
QualityReport measure_quality(const SurfaceMesh& mesh, const EdgeTable& edges);

/// Triangles of a whole mesh, and of its groups and faces: which values of a share percentiles may need.
struct TriangleCounts {
  std::int64_t model = 0;
  std::vector<std::int64_t> groups, faces;

  static TriangleCounts of(const SurfaceMesh& mesh);
  static auto fields(auto& c) { return std::tie(c.model, c.groups, c.faces); }
};

/// What shares of a mesh add to a QualityReport.
struct QualityParts {
  struct Part {
    FaceId face;
    std::int32_t group;
    QualityStats stats;  ///< `mean`: the sum
  };
  std::vector<Part> shapes;  ///< by piece, face and group
  KeptValues lowest;         ///< of the quality: as many as the first percentile needs
  std::vector<KeptValues> group_lowest, face_lowest;
  JumpStats jumps;
  std::vector<JumpStats> group_jumps, face_jumps;
  KeptValues highest_jumps;                           ///< likewise
  std::vector<QualityReport::LargeJump> large_jumps;  ///< of this share, which has its triangles
  RowStats rows;                                      ///< of a whole mesh

  /// Those of the next share, but for its large jumps.
  void add(const QualityParts& next, const TriangleCounts& counts);
  static auto fields(auto& p) {
    return std::tie(p.shapes, p.lowest, p.group_lowest, p.face_lowest, p.jumps, p.group_jumps, p.face_jumps,
                    p.highest_jumps);
  }
};
/// `counts`: of the whole mesh. Rows are measured where `own` is all of it.
QualityParts measure_quality(const SurfaceMesh& mesh, const EdgeTable& edges, const TriangleCorners& corners,
                             const OwnTriangles& own, const TriangleCounts& counts);
/// Of all parts.
QualityReport report_quality(QualityParts&& parts, const TriangleCounts& counts);

}  // namespace st
