#include "judge/surface_deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/threads.h"
#include "geometry/shape/projection.h"
#include "judge/face_surface.h"
#include "judge/squared_angle.h"

namespace st {

void DeviationStats::add(Vec3 midpoint, double distance, double angle_deg) {
  if (distance > max_distance) max_distance = distance, distance_place = midpoint;
  if (angle_deg > max_angle_deg) max_angle_deg = angle_deg, angle_place = midpoint;
  ++n_triangles;
  sum_distance += distance;
  sum_angle_deg += angle_deg;
  ++angle_histogram[static_cast<std::size_t>(
      std::clamp(angle_deg / kBinDeg, 0.0, static_cast<double>(angle_histogram.size() - 1)))];
}

void DeviationStats::add(const DeviationStats& other) {
  if (other.max_distance > max_distance) max_distance = other.max_distance, distance_place = other.distance_place;
  if (other.max_angle_deg > max_angle_deg) max_angle_deg = other.max_angle_deg, angle_place = other.angle_place;
  n_triangles += other.n_triangles;
  sum_distance += other.sum_distance;
  sum_angle_deg += other.sum_angle_deg;
  for (std::size_t k = 0; k < angle_histogram.size(); ++k) angle_histogram[k] += other.angle_histogram[k];
}

namespace {

/// Where a triangle's midpoint lies against the surface.
struct Beside {
  double distance;  // model unit
  Vec3 normal;      // of the surface at the nearest point
};

/// Feet of the midpoints of some triangles. Few of them need a start, hardly any more than one.
class FootFinder {
 public:
  /// From the nearest point found of the surface to the triangle's midpoint. A few steps in tangent planes from the
  /// mean (u,v) are enough nearly everywhere: where the midpoint lies along the normal.
  Beside beside(const Surface& surface, const std::array<Vec3, 3>& x, const Vec2* uv) {
    const Vec3 middle = (x[0] + x[1] + x[2]) / 3;
    const std::array<double, 3> side2{norm2(x[1] - x[0]), norm2(x[2] - x[1]), norm2(x[0] - x[2])};
    const auto [shortest2, longest2] = std::minmax({side2[0], side2[1], side2[2]});
    const double side = std::sqrt(longest2);
    const Vec2 mean = (1.0 / 3) * (uv[0] + uv[1] + uv[2]);
    if (const auto above = point_above(surface, middle, mean, kAside * std::sqrt(shortest2));
        above && above->distance <= kDoubtful * side)
      return {above->distance, above->normal};
    const Vec2 foot = search(surface, middle, side, mean, uv);
    return {distance(surface.point(foot), middle), surface_normal(surface, foot)};
  }

 private:
  /// (u,v) of the nearest point found from the mean and the corners, and in the end on the whole surface.
  Vec2 search(const Surface& surface, Vec3 middle, double side, Vec2 mean, const Vec2* uv) {
    Foot best{mean, distance(surface.point(mean), middle), false};
    try_from(surface, middle, best.uv, best);
    if (best.is_doubtful(side) && !best.is_foot) descend(surface, middle, best);
    const bool is_own = best.is_foot && is_beside(best.uv, uv);  // the surface bulges there, however far
    for (int k = 0; k < 3 && !is_own && best.is_doubtful(side); ++k) try_from(surface, middle, uv[k], best);
    if (!is_own && best.is_doubtful(side) && n_searches_ < kMostSearches) {
      ++n_searches_;
      const SurfaceFoot nearest = closest_point(surface, middle);
      if (nearest.distance < best.distance) best.uv = nearest.uv;
    }
    return best.uv;
  }

  struct Foot {
    Vec2 uv;
    double distance = 0;   // model unit
    bool is_foot = false;  // Newton's method ended there, or at a side of the surface
    bool is_doubtful(double side) const { return distance > (is_foot ? kDoubtful : kNegligible) * side; }
  };

  /// Whether (u,v) lies in the box of a triangle's corners, or beside it by no more than its sides.
  static bool is_beside(Vec2 p, const Vec2* uv) {
    const auto [u0, u1] = std::minmax({uv[0].x, uv[1].x, uv[2].x});
    const auto [v0, v1] = std::minmax({uv[0].y, uv[1].y, uv[2].y});
    return p.x >= u0 - (u1 - u0) && p.x <= u1 + (u1 - u0) && p.y >= v0 - (v1 - v0) && p.y <= v1 + (v1 - v0);
  }

  /// Newton's method from a guess.
  static void try_from(const Surface& surface, Vec3 p, Vec2 guess, Foot& best) {
    const auto projected = project_near(surface, p, guess);
    if (!projected) return;
    const double d = distance(surface.point(*projected), p);
    if (d < best.distance) best = {*projected, d, true};
  }

  /// To a side of the surface, beyond which Newton's method left it.
  static void descend(const Surface& surface, Vec3 p, Foot& best) {
    const SurfaceFoot foot = descend_from(surface, p, best.uv);
    best = {foot.uv, foot.distance, true};
  }

  static constexpr double kAside = 1e-5;       // of the shortest side: so much of the turning along it
  static constexpr double kNegligible = 1e-3;  // of the longest side
  static constexpr double kDoubtful = 0.1;     // of the longest side: an arc of 45 degrees
  static constexpr int kMostSearches = 250;    // of the whole surface, up to a millisecond each

  int n_searches_ = 0;
};

void add_triangle(const Surface& surface, const SurfaceMesh& mesh, TriangleId t, double side, FootFinder& finder,
                  DeviationStats& stats) {
  const auto& n = mesh.triangles[t].n;
  const std::array<Vec3, 3> x{mesh.node_xyz[n[0]], mesh.node_xyz[n[1]], mesh.node_xyz[n[2]]};
  const Vec3 middle = (x[0] + x[1] + x[2]) / 3;
  const Beside b = finder.beside(surface, x, &mesh.corner_uv[3 * static_cast<std::size_t>(t)]);
  const double squared = squared_angle(cross(x[1] - x[0], x[2] - x[0]), side * b.normal);
  stats.add(middle, b.distance, degrees(std::sqrt(squared)));
}

}  // namespace

std::vector<SidePart> side_parts(std::span<const Vec2> corner_uv, std::span<const FaceId> face) {
  std::vector<SidePart> parts;
  for (std::size_t t = 0; t < face.size(); ++t) {
    if (t % kTrianglesPerPiece == 0 || parts.back().face != face[t]) parts.push_back({face[t], 0});
    const Vec2* uv = &corner_uv[3 * t];
    parts.back().area += cross(uv[1] - uv[0], uv[2] - uv[0]);
  }
  return parts;
}

std::vector<double> sides_of_faces(std::span<const SidePart> parts, std::int32_t n_faces) {
  std::vector<double> side(n_faces, 0);
  for (const SidePart& part : parts) side[part.face] += part.area;
  for (double& s : side) s = s < 0 ? -1 : 1;
  return side;
}

struct DeviationSum::Piece {
  std::map<FaceId, DeviationStats> faces;
  FootFinder finder;
  FaceId last = kNone;  // triangles come face by face
  DeviationStats* of_last = nullptr;

  DeviationStats& of(FaceId f) {
    if (f != last) of_last = &faces[last = f];
    return *of_last;
  }
};

DeviationSum::DeviationSum(const Model& model, const SurfaceMesh& mesh)
    : DeviationSum(mesh, OwnTriangles::all(mesh),
                   sides_of_faces(side_parts(mesh.corner_uv, mesh.triangle_face), model.tables().n_faces())) {}

DeviationSum::DeviationSum(const SurfaceMesh& mesh, const OwnTriangles& own, std::vector<double> side)
    : mesh_(mesh), own_(own), side_(std::move(side)), pieces_(own.n_pieces()) {}

DeviationSum::~DeviationSum() = default;

void DeviationSum::add(TriangleId triangle, const Surface& surface) {
  const FaceId f = mesh_.triangle_face[triangle];
  Piece& piece = pieces_[own_.piece(triangle)];
  add_triangle(surface, mesh_, triangle, side_[f], piece.finder, piece.of(f));
}

std::vector<DeviationSum::Part> DeviationSum::parts() const {
  std::vector<Part> all;
  for (const Piece& piece : pieces_)
    for (const auto& [f, part] : piece.faces) all.push_back({f, part});
  return all;
}

SurfaceDeviation report_deviation(std::span<const DeviationSum::Part> parts, std::int32_t n_faces) {
  SurfaceDeviation deviation;
  deviation.faces.resize(n_faces);
  for (const DeviationSum::Part& part : parts) deviation.faces[part.face].add(part.stats);
  for (FaceId f = 0; f < n_faces; ++f) {
    if (deviation.faces[f].max_distance > deviation.model.max_distance) deviation.worst_distance = f;
    if (deviation.faces[f].max_angle_deg > deviation.model.max_angle_deg) deviation.worst_angle = f;
    deviation.model.add(deviation.faces[f]);
  }
  return deviation;
}

std::vector<float> triangle_deviations(const Model& model, const SurfaceMesh& mesh) {
  std::vector<float> deviations(mesh.triangles.size());
  parallel_for(deviations.size(), kTrianglesPerPiece, [&](std::size_t begin, std::size_t end) {
    FaceSurface surface(model);
    FootFinder finder;
    for (std::size_t t = begin; t < end; ++t) {
      DeviationStats one;
      add_triangle(surface.of(mesh.triangle_face[t]), mesh, static_cast<TriangleId>(t), 1, finder, one);
      deviations[t] = static_cast<float>(one.max_distance);
    }
  });
  return deviations;
}

}  // namespace st
