// A symmetric mesh: one half is meshed, the other is its image.
#include "meshing/engine/mirrored_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "base/log.h"
#include "geometry/shape/surface.h"
#include "sizing/mirrored_field.h"
#include "support/meshed.h"
#include "unit/geometry/mirrored_import.h"

namespace st {
namespace {

/// Finer on one side of y = 5 than on the other.
class LopsidedField : public SizeField {
 public:
  using SizeField::size;
  double size(Vec3 x, int&) const override { return 1.5 + 0.1 * std::abs(x.y - 8); }
  double min_size() const override { return 1.5; }
  double slope() const override { return 0.1; }
};

struct MirroredMesh {
  ImportResult imported;
  Model model;
  LopsidedField lopsided;
  MirroredField field;
  MeshTopology topology;
  MeshResult result;
  ModelTables placed;
  OrientationReport orientation;
  SurfaceMesh mesh;

  MirroredMesh(const std::string& shape, const std::string& plane)
      : imported(test::import_mirrored(shape, plane)),
        model(imported.tables, imported.brep),
        field(lopsided, imported.mirror),
        topology(model.tables(), mirrored(merge_small_features(model, field, 0.2, test::one_rank).merged(),
                                          imported.mirror, model.tables())) {
    set_verbosity(Verbosity::kQuiet);
    result = mesh_regions(model, topology, field, plan_part(topology, faces_to_mesh(imported.mirror), {}), {},
                          test::one_rank);
    placed = add_image(imported.mirror, model.tables(), topology, result);
    const ModelTables& t = topology.tables();
    std::vector<FacePatch> patches = result.patches;
    std::erase_if(patches, [](const FacePatch& p) { return p.triangles.empty(); });
    mesh = merge_patches({result.edges, placed.vertex_xyz, t.edge_vertices, patches, t.labels.face_group}, orientation);
  }
};

using Point = std::tuple<double, double, double>;
Point key(Vec3 x) { return {x.x + 0.0, x.y + 0.0, x.z + 0.0}; }

/// Counter-clockwise, from the smallest corner on.
std::array<Point, 3> corners(Vec3 a, Vec3 b, Vec3 c) {
  std::array<Point, 3> p{key(a), key(b), key(c)};
  std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
  return p;
}

/// Triangles without an image that is turned over and on the face that is the partner.
int count_without_image(const SurfaceMesh& m, const Mirror& mirror) {
  std::map<std::array<Point, 3>, FaceId> there;
  const auto at = [&](TriangleId t, int k) { return m.node_xyz[m.triangles[t].n[k]]; };
  for (TriangleId t = 0; t < m.n_triangles(); ++t) there[corners(at(t, 0), at(t, 1), at(t, 2))] = m.triangle_face[t];
  int n = 0;
  for (TriangleId t = 0; t < m.n_triangles(); ++t) {
    const auto image = [&](int k) { return mirror.image_of(at(t, k)); };
    const auto found = there.find(corners(image(0), image(2), image(1)));
    n += found == there.end() || found->second != mirror.face[m.triangle_face[t]];
  }
  return n;
}

class MirroredShape : public testing::TestWithParam<std::string> {};

TEST_P(MirroredShape, its_mesh_is_its_own_image_to_the_last_bit) {
  const MirroredMesh m(GetParam(), "y=0");
  ASSERT_TRUE(m.result.failures.empty());
  EXPECT_GT(m.mesh.n_triangles(), 50);
  EXPECT_EQ(count_without_image(m.mesh, m.imported.mirror), 0);
}

TEST_P(MirroredShape, nodes_are_on_their_own_faces_with_their_own_parameters) {
  const MirroredMesh m(GetParam(), "y=0");
  constexpr double kWall = 0.05;  // of the thin pipe: its ends are closed, and a node of one edge is off the other
  const double tolerance = m.topology.merged().empty() ? 1e-6 * m.model.tables().box().diagonal() : 1.01 * kWall;
  for (TriangleId t = 0; t < m.mesh.n_triangles(); ++t) {
    const auto surface = m.model.surface(m.mesh.triangle_face[t]);
    for (int k = 0; k < 3; ++k)
      EXPECT_LE(distance(surface->point(m.mesh.corner_uv[3 * t + k]), m.mesh.node_xyz[m.mesh.triangles[t].n[k]]),
                tolerance);
  }
  for (std::size_t n = 0; n < m.mesh.node_xyz.size(); ++n) {
    if (m.mesh.node_entity_dim[n] != static_cast<std::uint8_t>(EntityDim::kEdge)) continue;
    EXPECT_LE(distance(m.model.curve(m.mesh.node_entity[n])->point(m.mesh.node_t[n]), m.mesh.node_xyz[n]), tolerance);
  }
}

// About y = 0 each of these is symmetric; the sphere, torus, cylinder and cone have their seams in the plane.
INSTANTIATE_TEST_SUITE_P(Shapes, MirroredShape,
                         testing::Values("sphere", "torus", "cylinder", "cone", "disc", "rational_torus", "thin_pipe",
                                         "drilled_cylinder"));

TEST(MirroredMesh, lengths_of_both_sides_count_on_both) {
  const MirroredMesh m("sphere", "y=0");
  int hint = 0;
  EXPECT_EQ(m.field.size({0, -8, 0}, hint), 1.5);
  EXPECT_EQ(m.field.size({0, 8, 0}, hint), 1.5);
}

TEST(MirroredMesh, a_wrong_pairing_is_not_its_own_image) {
  MirroredMesh m("drilled_cylinder", "y=0");
  Mirror wrong = m.imported.mirror;
  std::vector<FaceId> images;
  for (FaceId f = 0; f < m.model.tables().n_faces(); ++f)
    if (wrong.face_is_image[f]) images.push_back(f);
  ASSERT_GE(images.size(), 2U);
  std::swap(wrong.face[wrong.face[images[0]]], wrong.face[wrong.face[images[1]]]);
  std::swap(wrong.face[images[0]], wrong.face[images[1]]);
  EXPECT_GT(count_without_image(m.mesh, wrong), 0);
}

TEST(MirroredMesh, what_is_merged_is_merged_on_both_sides_and_not_in_the_plane) {
  const ImportResult r = test::import_mirrored("drilled_cylinder", "y=0");
  const ModelTables& t = r.tables;
  MergedFeatures all;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (!t.edge_is_degenerate[e]) all.edge.push_back(e);
  const MergedFeatures both = mirrored(all, r.mirror, t);
  EXPECT_TRUE(std::is_sorted(both.edge.begin(), both.edge.end()));
  EXPECT_FALSE(both.edge.empty());
  for (const EdgeId e : both.edge) {
    EXPECT_TRUE(std::binary_search(both.edge.begin(), both.edge.end(), r.mirror.edge[e]));
    for (int k = 0; k < 2 && r.mirror.edge[e] != e; ++k)
      EXPECT_NE(r.mirror.vertex[t.edge_vertices[2 * e + k]], t.edge_vertices[2 * e + k]);
  }
}

}  // namespace
}  // namespace st
