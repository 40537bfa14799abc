#include "judge/surface_deviation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/threads.h"
#include "judge/face_surface.h"

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

constexpr std::size_t kPerPiece = 16'384;  // triangles

/// The nearest point found of the surface, as (u,v).
Vec2 foot(const Surface& surface, Vec3 p, Vec2 guess) {
  const auto projected = project_near(surface, p, guess);
  return projected && distance(surface.point(*projected), p) < distance(surface.point(guess), p) ? *projected : guess;
}

void add_triangle(const Surface& surface, const SurfaceMesh& mesh, TriangleId t, double side, DeviationStats& stats) {
  const auto& n = mesh.triangles[t].n;
  const Vec3 a = mesh.node_xyz[n[0]], b = mesh.node_xyz[n[1]], c = mesh.node_xyz[n[2]], middle = (a + b + c) / 3;
  const Vec2* uv = &mesh.corner_uv[3 * static_cast<std::size_t>(t)];
  const Vec2 at = foot(surface, middle, (1.0 / 3) * (uv[0] + uv[1] + uv[2]));
  const double angle = angle_between(cross(b - a, c - a), side * surface_normal(surface, at));
  stats.add(middle, distance(surface.point(at), middle), degrees(angle));
}

/// +1 for faces whose triangles run counter-clockwise in (u,v), -1 for those turned at output: by the sum of their
/// areas there.
std::vector<double> sides_of_faces(const SurfaceMesh& mesh, std::int32_t n_faces) {
  std::vector<double> side(n_faces, 0);
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const Vec2* uv = &mesh.corner_uv[3 * static_cast<std::size_t>(t)];
    side[mesh.triangle_face[t]] += cross(uv[1] - uv[0], uv[2] - uv[0]);
  }
  for (double& s : side) s = s < 0 ? -1 : 1;
  return side;
}

}  // namespace

SurfaceDeviation measure_deviation(const Model& model, const SurfaceMesh& mesh) {
  const ModelTables& tables = model.tables();
  SurfaceDeviation deviation;
  deviation.faces.resize(tables.n_faces());
  const std::vector<double> side = sides_of_faces(mesh, tables.n_faces());
  using Parts = std::map<FaceId, DeviationStats>;
  const auto n = static_cast<std::size_t>(mesh.n_triangles());
  std::vector<Parts> pieces((n + kPerPiece - 1) / kPerPiece);
  parallel_for(n, kPerPiece, [&](std::size_t begin, std::size_t end) {
    FaceSurface surface(model);
    for (std::size_t t = begin; t < end; ++t) {
      const FaceId f = mesh.triangle_face[t];
      add_triangle(surface.of(f), mesh, static_cast<TriangleId>(t), side[f], pieces[begin / kPerPiece][f]);
    }
  });
  for (const Parts& parts : pieces)
    for (const auto& [f, part] : parts) deviation.faces[f].add(part);
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    if (deviation.faces[f].max_distance > deviation.model.max_distance) deviation.worst_distance = f;
    if (deviation.faces[f].max_angle_deg > deviation.model.max_angle_deg) deviation.worst_angle = f;
    deviation.model.add(deviation.faces[f]);
  }
  return deviation;
}

std::vector<float> triangle_deviations(const Model& model, const SurfaceMesh& mesh) {
  std::vector<float> deviations(mesh.triangles.size());
  parallel_for(deviations.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    FaceSurface surface(model);
    for (std::size_t t = begin; t < end; ++t) {
      DeviationStats one;
      add_triangle(surface.of(mesh.triangle_face[t]), mesh, static_cast<TriangleId>(t), 1, one);
      deviations[t] = static_cast<float>(one.max_distance);
    }
  });
  return deviations;
}

}  // namespace st
