#include "features/own_axes.h"

#include <gtest/gtest.h>

#include "base/similarity.h"
#include "features/certain_wing_edges.h"
#include "features/face_roles.h"
#include "features/lifting_surface.h"
#include "features/strip.h"
#include "geometry/model/edit_model.h"
#include "support/shapes.h"

namespace st {
namespace {

const char* const kShapes[] = {"box",        "stepped_box",     "drilled_block", "thin_plate", "drilled_cylinder",
                               "sharp_wing", "half_blunt_wing", "wing_on_body",  "loose_box",  "plate_with_hole"};

TEST(OwnAxes, are_those_of_space_where_a_model_is_drawn_along_them) {
  for (const char* shape : kShapes) {
    const Model model = test::make_model(shape);
    EXPECT_EQ(find_own_axes(model).axis, OwnAxes().axis) << shape;
    EXPECT_EQ(face_roles(model).reference_diagonal, face_roles(model.tables()).reference_diagonal) << shape;
  }
}

Model turned(const Model& model, Vec3 axis, double angle_deg) {
  return transform(model, rotation_about(normalized(axis), radians(angle_deg)));
}

TEST(OwnAxes, give_a_model_the_same_diagonal_however_it_is_turned) {
  for (const char* shape : kShapes) {
    const Model model = test::make_model(shape);
    const double diagonal = face_roles(model).reference_diagonal;
    for (const Vec3 axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{1, 2, 3}})
      for (const double angle_deg : {30.0, 45.0, 110.0})
        EXPECT_NEAR(face_roles(turned(model, axis, angle_deg)).reference_diagonal, diagonal, 0.011 * diagonal)
            << shape << " " << axis.x << " " << angle_deg;
  }
}

TEST(OwnAxes, bound_the_diagonal_without_facets) {
  for (const char* shape : kShapes)
    for (const double angle_deg : {0.0, 30.0, 110.0}) {
      const Model model = turned(test::make_model(shape), {1, 2, 3}, angle_deg);
      const FaceRoles in_space = face_roles(model.tables());
      const LengthBounds bounds = bound_reference_diagonal(model, in_space);
      const double diagonal = face_roles(model).reference_diagonal;
      EXPECT_LE(bounds.least, diagonal) << shape << " " << angle_deg;
      EXPECT_GE(bounds.most, diagonal) << shape << " " << angle_deg;
      EXPECT_LT(bounds.most, 3 * bounds.least) << shape << " " << angle_deg;
      EXPECT_EQ(bounds.least == bounds.most, angle_deg == 0) << shape;
    }
}

TEST(OwnAxes, tell_a_body_in_its_domain_however_it_is_turned) {
  const Model model = test::make_model("wing_in_box");
  const FaceRoles roles = face_roles(model), there = face_roles(turned(model, {1, 2, 3}, 40));
  EXPECT_EQ(there.role, roles.role);
}

TEST(OwnAxes, cut_wings_square_to_their_span_however_they_are_turned) {
  const auto wings_of = [](const Model& model) {
    const FaceRoles roles = face_roles(model);
    return find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  };
  const Model model = test::make_model("sharp_wing");
  const std::vector<LiftingSurface> wings = wings_of(model), there = wings_of(turned(model, {1, 2, 3}, 40));
  ASSERT_EQ(there.size(), wings.size());
  EXPECT_NEAR(there[0].median_chord, wings[0].median_chord, 0.01 * wings[0].median_chord);
}

}  // namespace
}  // namespace st
