// Small meshes for tests: closed, oriented outwards, one CAD face per side.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st::shapes {

/// A mesh from plain arrays: one CAD face, nodes inside it, unit sizes.
inline SurfaceMesh from(std::vector<Vec3> points, std::vector<Triangle> triangles, std::vector<FaceId> faces = {}) {
  SurfaceMesh m;
  m.node_xyz = std::move(points);
  m.triangles = std::move(triangles);
  m.triangle_face = faces.empty() ? std::vector<FaceId>(m.triangles.size(), 0) : std::move(faces);
  m.node_entity_dim.assign(m.node_xyz.size(), static_cast<std::uint8_t>(EntityDim::kFace));
  m.node_entity.assign(m.node_xyz.size(), 0);
  m.node_t.assign(m.node_xyz.size(), 0);
  m.node_size.assign(m.node_xyz.size(), 1);
  m.triangle_group.assign(m.triangles.size(), 0);
  m.corner_uv.resize(3 * m.triangles.size());
  FaceId n_faces = 1;
  for (const FaceId f : m.triangle_face) n_faces = std::max(n_faces, f + 1);
  m.labels.face_name.resize(n_faces);
  m.labels.group_name = {"default"};
  return m;
}

/// Box [lo, lo+size]^3 of n x n quads per side; face ids: x-, x+, y-, y+, z-, z+.
inline SurfaceMesh cube(int n, Vec3 lo = {0, 0, 0}, double size = 1) {
  std::map<std::array<int, 3>, NodeId> ids;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<FaceId> faces;
  const auto node = [&](std::array<int, 3> p) {
    const auto [it, is_new] = ids.emplace(p, static_cast<NodeId>(points.size()));
    if (is_new) points.push_back(lo + (size / n) * Vec3{double(p[0]), double(p[1]), double(p[2])});
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int a, int b) {
            std::array<int, 3> p{};
            p[axis] = end * n, p[(axis + 1) % 3] = a, p[(axis + 2) % 3] = b;
            return node(p);
          };
          const NodeId q[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
          for (int h = 0; h < 2; ++h) {
            Triangle t{{q[0], q[h + 1], q[h + 2]}};
            if (end == 0) std::swap(t.n[1], t.n[2]);
            triangles.push_back(t);
            faces.push_back(2 * axis + end);
          }
        }
  return from(points, triangles, faces);
}

/// Torus around z with n x m quads.
inline SurfaceMesh torus(int n, int m, double major = 2, double minor = 0.5, Vec3 center = {}) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = 2 * kPi * i / n, v = 2 * kPi * j / m, r = major + minor * std::cos(v);
      points.push_back(center + Vec3{r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
      const auto at = [&](int a, int b) { return static_cast<NodeId>((a % n) * m + b % m); };
      triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  return from(points, triangles);
}

/// Sphere: the cube's nodes pushed outwards.
inline SurfaceMesh sphere(int n, Vec3 center = {}, double radius = 1) {
  SurfaceMesh m = cube(n, {-1, -1, -1}, 2);
  for (Vec3& p : m.node_xyz) p = center + radius * normalized(p);
  m.triangle_face.assign(m.triangles.size(), 0);
  return m;
}

/// Both meshes side by side, faces of `b` numbered after those of `a`.
inline SurfaceMesh join(const SurfaceMesh& a, const SurfaceMesh& b) {
  std::vector<Vec3> points = a.node_xyz;
  points.insert(points.end(), b.node_xyz.begin(), b.node_xyz.end());
  std::vector<Triangle> triangles = a.triangles;
  std::vector<FaceId> faces = a.triangle_face;
  const auto shift = static_cast<NodeId>(a.node_xyz.size());
  for (const Triangle& t : b.triangles) triangles.push_back({{t.n[0] + shift, t.n[1] + shift, t.n[2] + shift}});
  for (const FaceId f : b.triangle_face) faces.push_back(f + static_cast<FaceId>(a.labels.face_name.size()));
  return from(points, triangles, faces);
}

/// Turns the triangles of one face (all: kNone) inside out.
inline void turn(SurfaceMesh& m, FaceId face = kNone) {
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (face == kNone || m.triangle_face[t] == face) std::swap(m.triangles[t].n[1], m.triangles[t].n[2]);
}

/// Equal to the last bit.
inline bool same(const SurfaceMesh& a, const SurfaceMesh& b) {
  return a.node_xyz == b.node_xyz && a.node_entity_dim == b.node_entity_dim && a.node_entity == b.node_entity &&
         a.node_t == b.node_t && a.node_size == b.node_size &&
         std::equal(a.triangles.begin(), a.triangles.end(), b.triangles.begin(), b.triangles.end(),
                    [](const Triangle& x, const Triangle& y) { return std::equal(x.n, x.n + 3, y.n); }) &&
         a.triangle_face == b.triangle_face && a.triangle_group == b.triangle_group && a.corner_uv == b.corner_uv;
}

inline double volume(const SurfaceMesh& m) {
  double v = 0;
  for (const Triangle& t : m.triangles) v += dot(m.node_xyz[t.n[0]], cross(m.node_xyz[t.n[1]], m.node_xyz[t.n[2]])) / 6;
  return v;
}

}  // namespace st::shapes
