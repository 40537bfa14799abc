// Faces between two long edges.
#include "features/strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/tapered_strip.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(Strip, is_no_square_face_nor_one_with_a_seam) {
  EXPECT_TRUE(find_strips(test::make_model("box")).empty());
  EXPECT_TRUE(find_strips(test::make_model("cylinder")).empty());
}

TEST(Strip, knows_its_width_along_its_length) {
  const Strip strip = test::tapered_strip();
  ASSERT_NE(strip.face, kNone);
  for (const Strip::Station& s : strip.stations) EXPECT_NEAR(s.width(), 0.02 + 0.98 * s.x.x / 20, 2e-3);
}

/// The sides of the band about the shape banded_pie.
StripSides sides_of_band(const Model& model) {
  for (const StripSides& s : find_strip_sides(model.tables()))
    if (model.tables().face_type[s.face] == SurfaceType::kCylinder && s.width < 0.01) return s;
  return {};
}

TEST(Strip, has_edges_that_are_one_where_they_cross_within_their_tolerance) {
  const auto strip_of = [](const char* shape) {
    ImportResult r = test::import_narrow(shape);
    const Model model(std::move(r.tables), std::move(r.brep));
    const std::vector<Strip> strips = find_strips(model);
    return strips.empty() ? Strip() : strips[0];
  };
  const Strip crossing = strip_of("blend_edges"), apart = strip_of("blend_curves");
  ASSERT_EQ(crossing.face, 0);
  ASSERT_EQ(apart.face, 0);
  EXPECT_NEAR(crossing.exact, 2 * 0.6 * std::sqrt(2) * 0.04, 1e-6) << "that of both edges";
  EXPECT_TRUE(crossing.is_one_edge());
  EXPECT_EQ(apart.exact, 0) << "though the tolerance is no less";
  EXPECT_FALSE(apart.is_one_edge());
  EXPECT_EQ(test::tapered_strip().exact, 0);
}

TEST(StripSides, may_be_one_edge_and_several_end_to_end) {
  const Model model = test::make_model("banded_pie");
  const StripSides band = sides_of_band(model);
  ASSERT_NE(band.face, kNone);
  EXPECT_NEAR(band.width, 0.002, 1e-6);
  ASSERT_EQ(band.across.size(), 2);
  const auto single = model.curve(band.single);
  Vec3 at = single->point(single->t_min());
  for (const StripSides::Side& s : band.across) {
    const auto curve = model.curve(s.edge);
    EXPECT_NEAR(distance(curve->point(s.is_opposed ? curve->t_max() : curve->t_min()), at), 0, 0.0021);
    at = curve->point(s.is_opposed ? curve->t_min() : curve->t_max());
  }
  EXPECT_NEAR(distance(single->point(single->t_max()), at), 0, 0.0021);
}

TEST(StripSides, are_no_sides_of_wide_faces) {
  EXPECT_TRUE(find_strip_sides(test::make_model("box").tables()).empty());
  EXPECT_TRUE(find_strip_sides(test::make_model("cylinder").tables()).empty());
}

}  // namespace
}  // namespace st
