#include "sizing/near_faces.h"

#include <gtest/gtest.h>

#include "unit/sizing/background_meshes.h"
#include "unit/sizing/shock_metric.h"

namespace st {
namespace {

/// A face in the first cell of a root cube of edge 1 that was halved twice.
struct FaceInACorner {
  OctreeShape octree;
  FaceCells faces;
  explicit FaceInACorner(Vec3 lo) {
    octree = build_octree({lo, lo + Vec3{1, 1, 1}}, {}).shape;
    faces.append_face(std::vector<CellArea>{{0, 1, {0.1F, 0.1F, 0}, {0, 0, 1}}});
  }
};

TEST(NearTets, are_those_around_cells_with_faces_with_their_nodes) {
  BackgroundMesh mesh = test::cube_of_tets(10, [](Vec3) { return 0.1; });
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i)
    mesh.node_metric.push_back(test::metric_of_shock({1, 0, 0}, 0.1 + 0.001 * mesh.node_xyz[i].x, 1));
  const std::size_t n_before = mesh.tets.size();
  const FaceInACorner model({-0.8, -0.8, -0.8});  // its upper corner is (0.2,0.2,0.2)
  keep_near_tets(model.faces, model.octree.view(), mesh);
  EXPECT_LT(mesh.tets.size(), n_before / 5);
  EXPECT_GE(mesh.tets.size(), 6 * 2 * 2 * 2U);
  ASSERT_EQ(mesh.node_metric.size(), mesh.node_xyz.size());
  ASSERT_EQ(mesh.node_size.size(), mesh.node_xyz.size());
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i)
    EXPECT_NEAR(size_of_metric(mesh.node_metric[i]).length, 0.1 + 0.001 * mesh.node_xyz[i].x, 1e-12);
}

TEST(NearTets, are_all_where_none_is_near) {
  BackgroundMesh mesh = test::cube_of_tets(2, [](Vec3) { return 0.1; });
  const FaceInACorner model({50, 50, 50});
  keep_near_tets(model.faces, model.octree.view(), mesh);
  EXPECT_EQ(mesh.tets.size(), 48U);
}

}  // namespace
}  // namespace st
