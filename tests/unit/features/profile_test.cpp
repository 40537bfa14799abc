// Profiles of wings in cuts through facets.
#include "features/profile.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(Profile, of_a_wing_is_as_thick_as_its_aerofoil) {
  const Model model = test::make_model("sharp_wing");
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(model.tables().n_faces()), 1);
  const Facets facets = make_facets(model, all, {.deflection = 0.01});
  const auto profile = ProfileCutter(facets).cut({10, 0, 15}, {0, 0, 1}, 0.02);
  ASSERT_TRUE(profile);
  EXPECT_NEAR(profile->chord, 10, 0.01);
  EXPECT_NEAR(profile->thickness, 0.12, 0.003);
  EXPECT_FALSE(ProfileCutter(facets).cut({10, 0, 15}, {1, 0, 0}, 0.02)) << "along the edge";
  EXPECT_FALSE(ProfileCutter(facets).cut({20, 0, 15}, {0, 0, 1}, 0.02)) << "off the wing";
}

}  // namespace
}  // namespace st
