// Which part of a mesh is which part of a model.
#include "meshing/associate/part_matching.h"

#include "unit/mesh/shapes.h"
#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

TEST(MatchedParts, give_each_vertex_the_part_of_its_node) {
  const ShapeMesh boxes("two_boxes");
  const MatchedParts parts = match_parts(boxes.mesh, boxes.model.tables());
  ASSERT_EQ(parts.n_parts, 2);
  for (NodeId n = 0; n < boxes.mesh.n_nodes(); ++n) {
    EXPECT_TRUE(parts.node_part[n] == 0 || parts.node_part[n] == 1);
    if (boxes.mesh.node_entity_dim[n] == 0) {
      EXPECT_EQ(parts.node_part[n], parts.vertex_part[boxes.mesh.node_entity[n]]) << n;
    }
  }
}

TEST(MatchedParts, are_one_where_mesh_and_model_have_not_as_many) {
  const ShapeMesh boxes("two_boxes");
  const SurfaceMesh three = shapes::join(boxes.mesh, shapes::cube(1, {100, 0, 0}));
  EXPECT_EQ(match_parts(three, boxes.model.tables()).n_parts, 1);
  EXPECT_EQ(match_parts(shapes::cube(1), boxes.model.tables()).n_parts, 1);
}

TEST(MatchedParts, leave_a_node_of_no_triangle_out) {
  ShapeMesh boxes("two_boxes");
  boxes.mesh.node_xyz.push_back({0, 0, 0});
  EXPECT_EQ(match_parts(boxes.mesh, boxes.model.tables()).node_part.back(), kNone);
}

}  // namespace
}  // namespace st::test
