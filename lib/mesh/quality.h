// How good is a mesh: shapes of triangles, growth between neighbours, lengths against the requested sizes
// (docs/checks.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/local_size.h"
#include "mesh/adjacency.h"
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
  TriangleId worst = kNone;                        ///< the (first) triangle of least quality
};

/// Growth between neighbours: square root of the ratio of their areas, at least 1.
struct JumpStats {
  static constexpr double kBinWidth = 0.1;
  std::int64_t n_pairs = 0;  ///< pairs of triangles with a common edge, both with an area
  double max = 1;
  std::array<std::int64_t, 20> histogram{};  ///< pairs by ratio in [1 + 0.1 k, 1.1 + 0.1 k), the last without end
  void add(double ratio);
};

/// Neighbours that grow more than this are listed.
inline constexpr double kLargeGrowth = 1.6;

struct QualityReport {
  struct LargeJump {
    TriangleId a, b;
    double ratio;  ///< above kLargeGrowth
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

/// Lengths of mesh edges over the requested lengths.
struct ConformityStats {
  static constexpr double kBinWidth = 0.1;
  std::int64_t n_edges = 0, n_within = 0;    ///< within [kConformityMin, kConformityMax]
  double min = 0, max = 0, sum = 0;          ///< of the ratio
  std::array<std::int64_t, 21> histogram{};  ///< edges by ratio in [0.1 k, 0.1 k + 0.1), the last without end
  double share() const { return n_edges ? static_cast<double>(n_within) / static_cast<double>(n_edges) : 1.0; }
  double mean() const { return n_edges ? sum / static_cast<double>(n_edges) : 1.0; }
  void add(double ratio);
  void add(const ConformityStats& other);
};

inline constexpr double kConformityMin = 0.7, kConformityMax = 1.4;

/// Mesh edges shorter than kConformityMin because the CAD leaves no choice.
struct ForcedPlace {
  enum class Kind : std::uint8_t {
    kShortEdge,  ///< along a CAD edge of at most three segments: it is shorter than its sizes, or a loop that needs its
                 ///< three sides
    kStrip       ///< across a face, from boundary to boundary: a strip or corner thinner than its sizes
  };
  Kind kind = Kind::kShortEdge;
  std::int32_t entity = kNone;  ///< CAD edge (kNone: between two vertices) or, for a strip, CAD face
  std::int64_t n_edges = 0;     ///< mesh edges there
  double min_ratio = 0;         ///< the shortest of them over its requested length
  Vec3 xyz;                     ///< the middle of that one, model unit
};

struct ConformityReport {
  struct OutsideEdge {
    NodeId a, b;
    TriangleId triangle, other;  ///< the first two at the edge; `other` kNone at a rim
    double ratio;
  };
  ConformityStats model;
  ConformityStats free;             ///< all edges but those of `forced`
  std::vector<ForcedPlace> forced;  ///< by kind and entity; between two vertices: one each
  ConformityStats inner;            ///< edges with a node inside a face: nothing of the CAD forces their length
  std::vector<ConformityStats> groups, faces;  ///< an edge counts for the face of its first triangle
  std::vector<OutsideEdge> outside;  ///< edges of `free` outside [kConformityMin, kConformityMax], by their nodes
  double p1 = 1, p99 = 1;            ///< percentiles of the ratio
};

/// As SizeField::local; may be called on several threads.
using RequestedSize = std::function<LocalSize(Vec3, int& hint)>;
/// As SizeField::length_along; likewise.
using RequestedLength = std::function<double(Vec3, Vec3 way, int& hint)>;

/// Ratio of an edge: its length times the mean of 1/requested over it (Simpson's rule on its ends and middle).
/// `requested_length(xyz) > 0` in model units. Forced is an edge below kConformityMin with both ends on the boundary of
/// faces that lies on a CAD edge of at most three segments, between two CAD vertices, or across a face. `along`: asked
/// for each edge instead, where planes matter. Local, linear.
ConformityReport measure_conformity(const SurfaceMesh& mesh, const EdgeTable& edges, const RequestedSize& requested,
                                    const RequestedLength& along = {});

}  // namespace st
