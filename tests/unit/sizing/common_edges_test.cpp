// Edges in which two faces meet.
#include "sizing/common_edges.h"

#include <gtest/gtest.h>

#include <vector>

#include "geometry/model/edge_faces.h"
#include "support/shapes.h"

namespace st {
namespace {

TEST(CommonEdges, are_one_for_each_two_sides_of_a_box_that_are_not_opposite) {
  const Model model = test::make_model("box");
  const CommonEdges edges(model);
  int n_meeting = 0;
  for (FaceId a = 0; a < 6; ++a)
    for (FaceId b = 0; b < 6; ++b) n_meeting += a != b && edges.nearest(a, b, {}).has_value() ? 1 : 0;
  EXPECT_EQ(n_meeting, 24);
}

TEST(CommonEdges, have_the_place_next_to_a_point) {
  const Model model = test::make_model("box");
  const ModelTables& t = model.tables();
  const CommonEdges edges(model);
  const EdgeFaces faces(t);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const Vec3 a = t.vertex_xyz[t.edge_vertices[2 * e]], b = t.vertex_xyz[t.edge_vertices[2 * e + 1]];
    const Vec3 place = a + 0.3 * (b - a);
    const std::optional<Vec3> found =
        edges.nearest(faces[e][1], faces[e][0], place + 0.01 * (place - t.box().center()));
    ASSERT_TRUE(found);
    EXPECT_LT(distance(*found, place), 0.02 * t.box().diagonal());
    EXPECT_LT(distance(*edges.nearest(faces[e][0], faces[e][1], place), place), 1e-9);
  }
}

}  // namespace
}  // namespace st
