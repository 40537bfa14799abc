// Bodies around lifting surfaces.
#include "features/bodies.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

Bodies bodies_of(const Model& model) {
  const FaceRoles roles = face_roles(model.tables());
  return find_bodies(model, roles,
                     find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model))));
}

/// The body of the first face whose box lies within x and z of these bounds.
const Body* body_within(const Model& model, const Bodies& bodies, Box3 bounds) {
  for (FaceId f = 0; f < model.tables().n_faces(); ++f) {
    const Box3& box = model.tables().face_box[f];
    if (box.lo.x > bounds.lo.x && box.hi.x < bounds.hi.x && box.lo.z > bounds.lo.z && box.hi.z < bounds.hi.z)
      return bodies.of_face[f] == kNone ? nullptr : &bodies.body[bodies.of_face[f]];
  }
  return nullptr;
}

TEST(Bodies, are_none_without_lifting_surfaces) {
  for (const char* shape : {"box", "wedge_strip"}) {
    const Bodies bodies = bodies_of(test::make_model(shape));
    EXPECT_TRUE(bodies.body.empty()) << shape;
    for (const std::int32_t own : bodies.of_face) EXPECT_EQ(own, kNone);
  }
}

TEST(Bodies, of_a_wing_alone_are_its_tip_caps) {
  const Bodies bodies = bodies_of(test::make_model("sharp_wing"));
  ASSERT_EQ(bodies.body.size(), 2u);
  for (const Body& cap : bodies.body) {
    EXPECT_TRUE(cap.is_wing_piece);
    EXPECT_NEAR(cap.chord, 10, 0.05);
  }
}

TEST(Bodies, end_where_a_pod_stands_on_the_wing) {
  const Model model = test::make_model("wing_with_pod");
  const Bodies bodies = bodies_of(model);
  ASSERT_EQ(bodies.body.size(), 3u) << "two tip caps and the pod";
  const Body* pod = body_within(model, bodies, {{1.9, -9, 14}, {5.6, 9, 16}});
  ASSERT_TRUE(pod);
  EXPECT_FALSE(pod->is_wing_piece);
  EXPECT_NEAR(pod->girth, 0.5 * kPi * 1.95, 0.15);
  EXPECT_NEAR(pod->diagonal, 3.8, 0.2);
}

}  // namespace
}  // namespace st
