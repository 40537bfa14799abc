// How far the triangles of a mesh lie from the CAD surfaces they stand for.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/own_triangles.h"
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

/// What each triangle adds to a SurfaceDeviation, for passes that have its surface at hand (estimate_chord_error()).
/// A midpoint's foot is found by steps in tangent planes from the mean (u,v) of the corners, exact to 1e-5 of the
/// shortest side. Where that does not end, or at more than a tenth of the longest, it is projected from the mean, the
/// corners, then by a search of the whole surface: at most 250 of these per piece (kTrianglesPerPiece). Where
/// nothing nearer is found, the surface's point at the mean counts: never less than the true distance. Triangles of one
/// piece are added in order, by one thread. Precondition: the mesh was made on the model.
class DeviationSum {
 public:
  /// What the triangles of one face in one piece add.
  struct Part {
    FaceId face;
    DeviationStats stats;
  };

  /// Model and mesh outlive the object.
  DeviationSum(const Model& model, const SurfaceMesh& mesh);
  /// Of a share. `side`: side_of_face() of the sums of side_parts() of all shares.
  DeviationSum(const SurfaceMesh& mesh, const OwnTriangles& own, std::vector<double> side);
  ~DeviationSum();
  void add(TriangleId triangle, const Surface& surface);
  std::vector<Part> parts() const;

 private:
  struct Piece;
  const SurfaceMesh& mesh_;
  const OwnTriangles own_;
  std::vector<double> side_;  // [n_faces]
  std::vector<Piece> pieces_;
};

/// Of all parts, in order.
SurfaceDeviation report_deviation(std::span<const DeviationSum::Part> parts, std::int32_t n_faces);

/// Area in (u,v) of the triangles of one face in one piece.
struct SidePart {
  FaceId face;
  double area;
};
/// `corner_uv`, `face`: of consecutive triangles, from where a piece begins.
std::vector<SidePart> side_parts(std::span<const Vec2> corner_uv, std::span<const FaceId> face);
/// [n_faces] +1 for faces whose triangles run counter-clockwise in (u,v), -1 for those turned at output: of all parts.
std::vector<double> sides_of_faces(std::span<const SidePart> parts, std::int32_t n_faces);

/// The distance of each triangle's midpoint, found as in DeviationSum. [n_triangles] model unit.
std::vector<float> triangle_deviations(const Model& model, const SurfaceMesh& mesh);

}  // namespace st
