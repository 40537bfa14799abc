#include "sizing/end_stretch.h"

#include <gtest/gtest.h>

#include <vector>

#include "features/strip.h"
#include "support/shapes.h"

namespace st {
namespace {

/// Of a square of 10 in the plane z = 0: coedge 0 lies at x = 0, 1 at y = 0, 2 at x = 10.
std::vector<SpaceSide> sides_of_square() {
  return {{{0, 10, 0}, {0, -1, 0}, {1, 0, 0}, 10, 0},
          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 10, 1},
          {{10, 0, 0}, {0, 1, 0}, {-1, 0, 0}, 10, 2}};
}
/// The surface goes on beyond coedge 2.
bool ends_at(CoedgeId c) { return c != 2; }

/// A sample of 0.1, twenty times as long along x.
RasterBox long_box(Vec3 x) {
  RasterBox box;
  box.center = x;
  box.half = 0.2F;
  box.length = 0.1F;
  box.stretch = {SmallNormal({1, 0, 0}), 2};
  return box;
}

GapPatch patch_at(Vec3 x, Vec3 way) {
  GapPatch patch;
  patch.shape.x = x;
  patch.shape.s_lo = patch.shape.t_lo = -0.2;
  patch.shape.s_hi = patch.shape.t_hi = 0.2;
  patch.stretch.max_aspect = 20;
  patch.way = way;
  return patch;
}

TEST(IsTip, is_where_a_face_looks_outward) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  ChordEdge trailing =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model))).at(0).trailing.at(0);
  for (const std::size_t k : {0, 1}) {
    EXPECT_TRUE(is_tip(model, false, trailing, k)) << "a wing of one chord has two";
    EXPECT_FALSE(is_tip(model, true, trailing, k)) << "a hub";
  }
}

TEST(IsTip, looks_out_of_the_wing_in_a_domain) {
  const Model model = test::make_model("wing_in_box");
  FaceRoles roles = face_roles(model.tables());
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    if (model.tables().face_box[f].diagonal() > 50) roles.role[f] = FaceRole::kFarfield;
  ASSERT_TRUE(is_material_ahead(model.tables(), roles));
  ChordEdge trailing =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model))).at(0).trailing.at(0);
  EXPECT_TRUE(is_tip(model, true, trailing, 1));
}

TEST(EndStretch, is_no_longer_than_its_face_is_wide) {
  std::vector<RasterBox> boxes{long_box({4, 5, 0}), long_box({5, 5, 0}), long_box({5, 5, 0}), long_box({5, 5, 0})};
  boxes[1].stretch.along = 12;
  boxes[2].stretch.along = 9;
  boxes[3].stretch = {SmallNormal({0, 1, 0}), 12};
  bound_stretch_by_widths(sides_of_square(), 1, boxes);
  EXPECT_FLOAT_EQ(boxes[0].stretch.along, 2) << "before the first";
  EXPECT_FLOAT_EQ(boxes[1].stretch.along, 10);
  EXPECT_FLOAT_EQ(boxes[2].stretch.along, 9);
  EXPECT_FLOAT_EQ(boxes[3].stretch.along, 12) << "no side ahead";
}

TEST(EndStretch, is_bounded_at_sides_across_it_alone) {
  std::vector<RasterBox> boxes{long_box({0.3, 5, 0}), long_box({0.3, 5, 0}), long_box({5, 5, 0}),
                               long_box({5, 0.2, 0}), long_box({9.8, 5, 0}), long_box({0.3, 0.1, 0})};
  boxes.push_back(long_box({0.3, 5, 0}));
  boxes.back().stretch.along = 0.25F;
  std::vector<GapPatch> patches;
  bound_stretch_at_ends(sides_of_square(), ends_at, 1, boxes, patches);
  EXPECT_FLOAT_EQ(boxes[0].stretch.along, 2) << "before the first";
  EXPECT_FLOAT_EQ(boxes[1].stretch.along, kEndAspect * 0.1F);
  EXPECT_FLOAT_EQ(boxes[2].stretch.along, 2) << "far away";
  EXPECT_FLOAT_EQ(boxes[3].stretch.along, 2) << "the side lies along the stretch";
  EXPECT_FLOAT_EQ(boxes[4].stretch.along, 2) << "the surface goes on";
  EXPECT_FLOAT_EQ(boxes[5].stretch.along, kEndAspect * 0.1F) << "a nearer side lies along it";
  EXPECT_FLOAT_EQ(boxes[6].stretch.along, 0.25F) << "short enough";
}

TEST(EndStretch, is_told_to_patches_that_reach_an_end) {
  std::vector<GapPatch> patches{patch_at({0.3, 5, 0}, {1, 0, 0}), patch_at({0.3, 5, 0}, {}),
                                patch_at({0.3, 5, 0}, {0, 1, 0}), patch_at({5, 5, 0}, {1, 0, 0}),
                                patch_at({9.8, 5, 0}, {1, 0, 0}), patch_at({0.3, 5, 0}, {1, 0, 0})};
  patches.back().stretch.max_aspect = 2;
  std::vector<RasterBox> boxes;
  bound_stretch_at_ends(sides_of_square(), ends_at, 0, boxes, patches);
  EXPECT_EQ(patches[0].end, (Vec3{0, -1, 0}));
  EXPECT_EQ(patches[1].end, (Vec3{0, -1, 0})) << "without a way of its own any end counts";
  EXPECT_EQ(patches[2].end, Vec3{}) << "along its way";
  EXPECT_EQ(patches[3].end, Vec3{}) << "far away";
  EXPECT_EQ(patches[4].end, Vec3{}) << "the surface goes on";
  EXPECT_EQ(patches[5].end, Vec3{}) << "hardly longer";
}

TEST(EndStretch, is_allowed_along_an_end) {
  EXPECT_EQ(most_aspect_at({0, 1, 0}, {1, 0, 0}), kEndAspect);
  EXPECT_GT(most_aspect_at({0, 1, 0}, {0, 1, 0}), 1e300);
  EXPECT_GT(most_aspect_at({}, {1, 0, 0}), 1e300);
}

}  // namespace
}  // namespace st
