#include "judge/cad_contacts.h"

#include <gtest/gtest.h>

#include "geometry/model/edit_model.h"
#include "support/shapes.h"

namespace st {
namespace {

/// Two squares [0,10]^2 in planes x = 0 (face 1) and z = height (face 2), and two triangles of them that cross near the
/// edge z = 0.
struct TwoSquares {
  Model model;
  SurfaceMesh mesh;

  explicit TwoSquares(double height, double reach)
      : model(append(transform(test::make_model("square"), reflection_at({1, 0, -1})),
                     transform(test::make_model("square"), {.translation = {-5, 0, height}}))) {
    mesh.node_xyz = {{0, 5, 0},        {0, 5 + reach, 0}, {0, 5, reach},
                     {-reach, 5, 0.1}, {reach, 5.1, 0.1}, {0, 5 + reach, 0.1}};
    mesh.triangles = {{{0, 1, 2}}, {{3, 4, 5}}};
    mesh.triangle_face = {0, 1};
  }
};

TEST(CadContacts, explain_a_crossing_where_one_face_ends_on_another) {
  const TwoSquares s(0, 1);
  CadContacts contacts(s.model, s.mesh);
  EXPECT_TRUE(contacts.touches({0, 1, 0}));
  EXPECT_FALSE(contacts.crosses({0, 1, 0}));
}

TEST(CadContacts, tell_faces_that_cross_from_faces_that_touch) {
  const TwoSquares s(0.3, 1);
  CadContacts contacts(s.model, s.mesh);
  EXPECT_FALSE(contacts.touches({0, 1, 0}));
  EXPECT_TRUE(contacts.crosses({0, 1, 0}));
}

TEST(CadContacts, explain_nothing_beyond_the_reach_of_the_triangles) {
  const TwoSquares near(3, 4), far(3, 0.5);
  CadContacts from_near(near.model, near.mesh), from_far(far.model, far.mesh);
  EXPECT_TRUE(from_near.crosses({0, 1, 0}));
  EXPECT_FALSE(from_far.crosses({0, 1, 0}));
}

TEST(CadContacts, explain_no_crossing_of_a_face_with_itself) {
  TwoSquares s(0, 1);
  s.mesh.triangle_face = {0, 0};
  CadContacts contacts(s.model, s.mesh);
  EXPECT_FALSE(contacts.touches({0, 1, 0}));
}

}  // namespace
}  // namespace st
