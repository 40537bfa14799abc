// Faces to mesh, and what must hold of any mesh of one.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "geometry/shape/analytic.h"
#include "mesh/conformity.h"
#include "mesh/quality.h"
#include "meshing/face/face_boundary.h"
#include "meshing/face/face_mesher.h"
#include "meshing/topology/curve_discretiser.h"
#include "support/shapes.h"

namespace st::test {

/// Length `at` x0, growing by `slope` with the distance from it.
class LinearField : public SizeField {
 public:
  LinearField(Vec3 x0, double at, double slope) : x0_(x0), at_(at), slope_(slope) {}
  using SizeField::size;
  double size(Vec3 x, int&) const override { return at_ + slope_ * distance(x, x0_); }
  double min_size() const override { return at_; }
  double slope() const override { return slope_; }

 private:
  Vec3 x0_;
  double at_, slope_;
};

/// The same two lengths and direction everywhere.
class StretchedField : public UniformField {
 public:
  explicit StretchedField(const LocalSize& size) : UniformField(size.length), size_(size) {}
  LocalSize local(Vec3, int&) const override { return size_; }
  bool is_stretched() const override { return true; }

 private:
  LocalSize size_;
};

/// Leaves another hint at every query, as a field with leaves does.
class RestlessField : public UniformField {
 public:
  using UniformField::UniformField;
  double size(Vec3 x, int& hint) const override {
    hint = hint * 7 + 3;
    return UniformField::size(x, hint);
  }
};

inline EdgeMesh discretise_edges(const Model& model, const SizeField& field) {
  const ModelTables& t = model.tables();
  const std::vector<int> least = min_segments_per_edge(t);
  EdgeMesh m;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    EdgeMesh n = EdgeMesh::of_edges(1);
    if (!t.edge_is_degenerate[e]) {
      n = discretise_curve(*model.curve(e), field, {30, least[e]});
      end_at_vertices(n, t.vertex_xyz[t.edge_vertices[2 * e]], t.vertex_xyz[t.edge_vertices[2 * e + 1]], least[e]);
    }
    m.append(n);
  }
  return m;
}

/// Face `id` of a shape with its edges discretised by `field`.
struct FaceCase {
  Model model;
  FaceId id;
  EdgeMesh edges;
  std::unique_ptr<Surface> surface;
  FaceBoundary boundary;

  FaceCase(const std::string& shape, const SizeField& field, FaceId face = 0)
      : model(make_model(shape)), id(face), edges(discretise_edges(model, field)), surface(model.surface(face)) {
    boundary = make_face_boundary(model, *surface, face, BoundaryNumbering(MeshTopology(model.tables()), edges));
  }
  double area() const { return model.tables().face_area[id]; }
  FaceMesh mesh(const SizeField& field, const FaceMeshOptions& options = {}) const {
    return mesh_face(*surface, boundary, field, options);
  }
};

/// A hand-made boundary on kPlane: loops counter-clockwise, holes clockwise.
inline FaceBoundary polygons(const std::vector<std::vector<Vec2>>& loops, double h) {
  FaceBoundary b;
  for (const auto& loop : loops) {
    const std::int32_t first = static_cast<std::int32_t>(b.nodes.size()), n = static_cast<std::int32_t>(loop.size());
    for (std::int32_t i = 0; i < n; ++i) {
      b.nodes.push_back({loop[i], {loop[i].x, loop[i].y, 0}, h, first + i, false});
      b.segments.push_back({first + i, first + (i + 1) % n});
    }
  }
  return b;
}

/// (u,v) are x and y, in [0, 10].
inline const PlaneSurface kPlane({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, 10, 0, 10);

/// A mesh with its corners resolved.
struct MeshView {
  const FaceBoundary& boundary;
  const FaceMesh& mesh;

  std::int32_t n_boundary() const { return static_cast<std::int32_t>(boundary.nodes.size()); }
  std::size_t n_triangles() const { return mesh.corners.size() / 3; }
  Vec3 x(std::int32_t c) const { return c < n_boundary() ? boundary.nodes[c].x : mesh.inner[c - n_boundary()].x; }
  Vec2 uv(std::int32_t c) const { return c < n_boundary() ? boundary.nodes[c].uv : mesh.inner[c - n_boundary()].uv; }
  double h(std::int32_t c) const { return c < n_boundary() ? boundary.nodes[c].h : mesh.inner[c - n_boundary()].h; }
  /// The node outside the face: seam twins and nodes of a pole are one.
  std::int64_t key(std::int32_t c) const {
    return c < n_boundary() ? boundary.nodes[c].id : (std::int64_t{1} << 32) + c;
  }

  double area() const {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
      const Vec3 a = x(mesh.corners[i]);
      sum += 0.5 * norm(cross(x(mesh.corners[i + 1]) - a, x(mesh.corners[i + 2]) - a));
    }
    return sum;
  }
  /// Qualities of all triangles, ascending.
  std::vector<double> qualities() const {
    std::vector<double> q;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
      q.push_back(triangle_quality(x(mesh.corners[i]), x(mesh.corners[i + 1]), x(mesh.corners[i + 2])));
    std::sort(q.begin(), q.end());
    return q;
  }
  double mean_quality() const {
    double sum = 0;
    for (double q : qualities()) sum += q;
    return sum / static_cast<double>(n_triangles());
  }
  using Uses = std::map<std::pair<std::int64_t, std::int64_t>, int>;
  /// How often each directed edge occurs.
  Uses directed_edges() const {
    Uses uses;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
      ++uses[{key(mesh.corners[i]), key(mesh.corners[i % 3 == 2 ? i - 2 : i + 1])}];
    return uses;
  }
  std::int64_t euler() const {
    std::set<std::int64_t> nodes;
    std::set<std::pair<std::int64_t, std::int64_t>> edges;
    for (const auto& [edge, n] : directed_edges()) {
      nodes.insert(edge.first);
      edges.insert(std::minmax(edge.first, edge.second));
    }
    return static_cast<std::int64_t>(nodes.size()) - static_cast<std::int64_t>(edges.size()) +
           static_cast<std::int64_t>(n_triangles());
  }
  /// Share of the edges with an inner node whose length is within [0.7, 1.4] of the field's length at their middle.
  double conformity(const SizeField& field) const {
    ConformityStats stats;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
      const std::int32_t a = mesh.corners[i], b = mesh.corners[i % 3 == 2 ? i - 2 : i + 1];
      if (std::max(a, b) >= n_boundary()) stats.add(distance(x(a), x(b)) / field.size(0.5 * (x(a) + x(b))));
    }
    return stats.share();
  }
};

/// What holds of every mesh of a face: complete, no repeated node, positive in (u,v), every boundary segment used once
/// and in its direction, every other edge once each way.
inline void expect_valid(const FaceBoundary& boundary, const FaceMesh& mesh) {
  ASSERT_EQ(mesh.cause, FailureCause::kNone);
  EXPECT_EQ(mesh.n_folds, 0);
  const MeshView view{boundary, mesh};
  ASSERT_GT(view.n_triangles(), 0u);
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    const std::int32_t* c = &mesh.corners[i];
    EXPECT_GT(orient2d(view.uv(c[0]), view.uv(c[1]), view.uv(c[2])), 0) << "triangle " << i / 3;
    EXPECT_TRUE(view.key(c[0]) != view.key(c[1]) && view.key(c[1]) != view.key(c[2]) &&
                view.key(c[2]) != view.key(c[0]));
  }
  MeshView::Uses uses = view.directed_edges(), wanted;
  for (const auto& [a, b] : boundary.segments)
    if (boundary.nodes[a].id != boundary.nodes[b].id) ++wanted[{boundary.nodes[a].id, boundary.nodes[b].id}];
  for (const auto& [edge, n] : wanted) EXPECT_EQ(uses[edge], n) << "segment " << edge.first << " - " << edge.second;
  for (const auto& [edge, n] : uses) {
    if (wanted.count(edge)) continue;
    const auto back = std::make_pair(edge.second, edge.first);
    EXPECT_EQ(n, 1) << edge.first << " - " << edge.second;
    if (!wanted.count(back)) {
      EXPECT_TRUE(uses.count(back)) << "open edge " << edge.first << " - " << edge.second;
    }
  }
}

}  // namespace st::test
