// How far the triangles of a mesh lie from the CAD surfaces they stand for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Distances of triangle midpoints to the surface and angles between the normals of triangle and surface there. All
/// zero for no triangles.
struct DeviationStats {
  static constexpr double kBinDeg = 2;
  std::int64_t n_triangles = 0;
  double max_distance = 0, sum_distance = 0;    ///< model unit
  double max_angle_deg = 0, sum_angle_deg = 0;  ///< triangles without area and singular points of the surface count as
                                                ///< 0
  Vec3 distance_place, angle_place;             ///< midpoints of the worst triangles
  std::array<std::int64_t, 16> angle_histogram{};  ///< triangles by angle in [2 k, 2 k + 2) degrees, the last without
                                                   ///< end

  double mean_distance() const { return n_triangles ? sum_distance / static_cast<double>(n_triangles) : 0; }
  double mean_angle_deg() const { return n_triangles ? sum_angle_deg / static_cast<double>(n_triangles) : 0; }
  void add(Vec3 midpoint, double distance, double angle_deg);
  /// Adds another set of triangles.
  void add(const DeviationStats& other);
};

struct SurfaceDeviation {
  DeviationStats model;
  FaceId worst_distance = kNone, worst_angle = kNone;  ///< the (first) faces of the largest values
  std::vector<DeviationStats> faces;                   ///< [n_faces]
};

/// Each midpoint is projected from the mean (u,v) of its triangle's corners. Where that does not converge, or ends at
/// more than a tenth of the longest side, it is projected from the corners, then by a search of the whole surface.
/// Where nothing nearer is found, the surface's point at the mean counts: never less than the true distance.
/// Precondition: `mesh` was made on `model`. Local; some 2 microseconds per triangle, and at most a thousand searches
/// for each 16,384 triangles.
SurfaceDeviation measure_deviation(const Model& model, const SurfaceMesh& mesh);

/// The distance of each triangle's midpoint, found likewise. [n_triangles] model unit.
std::vector<float> triangle_deviations(const Model& model, const SurfaceMesh& mesh);

}  // namespace st
