// The patches of a cube, as a mesher would hand them to the merger.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/corner_uv.h"
#include "mesh/merge.h"

namespace st::shapes {

/// The patch with other triangles; those in the place of others keep the (u,v) of their corners.
inline void set_triangles(FacePatch& patch, std::vector<Triangle> triangles) {
  std::vector<Vec2> uv = corner_uvs(patch);
  uv.resize(3 * triangles.size());
  patch.triangles = std::move(triangles);
  set_corner_uvs(uv, patch);
}

/// What a mesher hands over: edges, vertices and patches of a unit cube with two segments per edge and a node in each
/// face.
struct CubePatches {
  EdgeMesh edges;
  std::vector<Vec3> vertices;
  std::vector<VertexId> edge_vertices;
  std::vector<FacePatch> patches;
  std::vector<std::int32_t> groups{0, 0, 1, 1, 2, 2};

  CubePatches() {
    for (int v = 0; v < 8; ++v) vertices.push_back({double(v & 1), double(v >> 1 & 1), double(v >> 2)});
    vertices.push_back({9, 9, 9});  // of no edge
    edges.edge_offsets = {0};
    for (int a = 0; a < 8; ++a)
      for (int axis = 0; axis < 3; ++axis)
        if (!(a >> axis & 1)) add_edge(a, a | 1 << axis);
    for (FaceId f = 0; f < 6; ++f) add_face(f);
  }
  void add_edge(VertexId a, VertexId b) {
    edge_vertices.insert(edge_vertices.end(), {a, b});
    for (int i = 0; i < 3; ++i) {
      edges.node_t.push_back(0.5 * i);
      edges.node_xyz.push_back(vertices[a] + 0.5 * i * (vertices[b] - vertices[a]));
      edges.node_size.push_back(0.5 + 0.01 * static_cast<double>(edge_vertices.size()));
    }
    edges.edge_offsets.push_back(static_cast<std::int32_t>(edges.node_t.size()));
  }
  EdgeId edge_between(VertexId a, VertexId b) const {
    for (std::size_t e = 0; 2 * e < edge_vertices.size(); ++e)
      if (std::minmax(edge_vertices[2 * e], edge_vertices[2 * e + 1]) == std::minmax(a, b))
        return static_cast<EdgeId>(e);
    return kNone;
  }
  /// Face 2*axis + end, a fan of eight triangles around its middle.
  void add_face(FaceId f) {
    const int axis = f / 2, end = f % 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = end << axis;
    VertexId ring[4] = {base, base | u, base | u | v, base | v};
    if (!end) std::swap(ring[1], ring[3]);
    FacePatch p;
    p.face = f;
    p.n_boundary = 8;
    for (int i = 0; i < 4; ++i) {
      p.boundary_dim.insert(p.boundary_dim.end(), {0, 1});
      p.boundary_entity.insert(p.boundary_entity.end(), {ring[i], edge_between(ring[i], ring[(i + 1) % 4])});
      p.boundary_index.insert(p.boundary_index.end(), {0, 1});
      for (int h = 0; h < 2; ++h) p.triangles.push_back({{2 * i + h, (2 * i + h + 1) % 8, 8}});
    }
    p.inner_xyz = {0.5 * (vertices[ring[0]] + vertices[ring[2]]), {7, 7, 7}};  // the second belongs to no triangle
    p.inner_uv.resize(2);
    p.inner_size = {0.25, 0.25};
    std::vector<Vec2> uv;
    for (std::size_t c = 0; c < 3 * p.triangles.size(); ++c) uv.push_back({double(f), double(c)});
    set_corner_uvs(uv, p);
    patches.push_back(p);
  }
  MergeInput input() const { return {edges, vertices, edge_vertices, patches, groups}; }
  SurfaceMesh merge(OrientationReport& report) const { return merge_patches(input(), report); }
  SurfaceMesh merge() const {
    OrientationReport report;
    return merge(report);
  }
  void turn(FaceId f) {
    std::vector<Vec2> uv = corner_uvs(patches[f]);
    for (std::size_t t = 0; t < patches[f].triangles.size(); ++t) {
      std::swap(patches[f].triangles[t].n[1], patches[f].triangles[t].n[2]);
      std::swap(uv[3 * t + 1], uv[3 * t + 2]);
    }
    set_corner_uvs(uv, patches[f]);
  }
};

}  // namespace st::shapes
