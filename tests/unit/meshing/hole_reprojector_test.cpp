// A mesh put onto its geometry moved.
#include "meshing/hole/hole_reprojector.h"

#include "base/error.h"
#include "geometry/model/edit_model.h"
#include "mesh/checks.h"
#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

class MovedSolid : public testing::TestWithParam<const char*> {};

TEST_P(MovedSolid, stays_as_it_was_where_nothing_moved) {
  const ShapeMesh solid(GetParam());
  const MovedMesh moved = move_mesh(solid.mesh, solid.model);
  EXPECT_TRUE(moved.spoilt.empty());
  const double size = solid.model.tables().reference_diagonal();
  for (NodeId n = 0; n < solid.mesh.n_nodes(); ++n) {
    EXPECT_LE(distance(moved.mesh.node_xyz[n], solid.mesh.node_xyz[n]), 1e-9 * size);
    EXPECT_EQ(moved.mesh.node_t[n], solid.mesh.node_t[n]);
  }
  for (std::size_t c = 0; c < solid.mesh.corner_uv.size(); ++c)
    EXPECT_TRUE(moved.mesh.corner_uv[c] == solid.mesh.corner_uv[c]) << c;
}

TEST_P(MovedSolid, takes_all_its_nodes_along) {
  const ShapeMesh solid(GetParam());
  const Similarity map = rotation_about({1, 0, 0}, radians(90)).then({.scale = 2, .translation = {5, 6, 7}});
  const auto at = [&](Vec3 x) { return Vec3{2 * x.x + 5, -2 * x.z + 6, 2 * x.y + 7}; };
  const Model there = transform(solid.model, map);
  const MovedMesh moved = move_mesh(solid.mesh, there);
  EXPECT_TRUE(moved.spoilt.empty());
  const double size = there.tables().reference_diagonal();
  for (NodeId n = 0; n < solid.mesh.n_nodes(); ++n)
    EXPECT_LE(distance(moved.mesh.node_xyz[n], at(solid.mesh.node_xyz[n])), 1e-6 * size);
  EXPECT_TRUE(check_topology(moved.mesh, edges_of(moved.mesh)).passes());
}

INSTANTIATE_TEST_SUITE_P(, MovedSolid, testing::ValuesIn(kSolids),
                         [](const auto& info) { return std::string(info.param); });

TEST(MoveMesh, follows_planes_whose_axes_are_others) {
  const BoxMesh box;
  for (const bool is_mirrored : {false, true}) {
    SurfaceMesh old = box.mesh;  // of a model whose planes have (u,v) turned by 30 degrees
    const double c = std::cos(radians(30)), s = is_mirrored ? -std::sin(radians(30)) : std::sin(radians(30));
    for (Vec2& uv : old.corner_uv)
      uv = {c * uv.x - s * uv.y + 5, is_mirrored ? s * uv.x - c * uv.y : s * uv.x + c * uv.y};
    const MovedMesh moved = move_mesh(old, box.model);
    EXPECT_TRUE(moved.spoilt.empty());
    for (NodeId n = 0; n < old.n_nodes(); ++n)
      ASSERT_LE(distance(moved.mesh.node_xyz[n], old.node_xyz[n]), 1e-9 * box.model.tables().reference_diagonal());
    for (std::size_t i = 0; i < old.corner_uv.size(); ++i)
      ASSERT_LE(norm(moved.mesh.corner_uv[i] - box.mesh.corner_uv[i]), 1e-9 * box.model.tables().reference_diagonal());
  }
}

TEST(MoveMesh, lists_what_the_move_distorts) {
  const ShapeMesh thick("cylinder");
  const Model thin = make_model("thin_cylinder");
  ASSERT_EQ(thin.tables().n_faces(), thick.model.tables().n_faces());
  const MovedMesh moved = move_mesh(thick.mesh, thin);
  const auto quality = [](const SurfaceMesh& m, TriangleId t) {
    const NodeId* n = m.triangles[t].n;
    return triangle_quality(m.node_xyz[n[0]], m.node_xyz[n[1]], m.node_xyz[n[2]]);
  };
  std::int64_t n_bad = 0;
  for (TriangleId t = 0; t < thick.mesh.n_triangles(); ++t) {
    const bool is_bad = quality(moved.mesh, t) < 0.3 && quality(moved.mesh, t) < quality(thick.mesh, t);
    n_bad += is_bad;
    if (is_bad) {
      EXPECT_TRUE(std::binary_search(moved.spoilt.begin(), moved.spoilt.end(), t)) << t;
    }
  }
  EXPECT_GT(n_bad, 0) << "a move that distorts";
}

TEST(MoveMesh, refuses_another_topology) {
  const BoxMesh box;
  EXPECT_THROW(move_mesh(box.mesh, make_model("cylinder")), Error);
  EXPECT_THROW(move_mesh(box.mesh, make_model("drilled_block")), Error);
}

}  // namespace
}  // namespace st::test
