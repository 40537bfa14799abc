#include "judge/same_place.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/similarity.h"
#include "geometry/model/edit_model.h"
#include "support/shapes.h"

namespace st {
namespace {

/// A shape, and behind it the same one moved.
SamePlaces twice(const std::string& shape, const std::string& steps) {
  const Model first = test::make_model(shape);
  const Model both = append(first, transform(first, parse_similarity(steps, "--transform")));
  const auto n = static_cast<std::size_t>(first.tables().n_faces());
  std::vector<std::int32_t> placement(2 * n, 0);
  std::fill(placement.begin() + static_cast<std::ptrdiff_t>(n), placement.end(), 1);
  return find_same_places(both, placement);
}

TEST(SamePlace, a_body_that_is_there_twice_is_found) {
  for (const char* shape : {"box", "cylinder", "sphere", "torus", "cone", "drilled_block", "sharp_wing"}) {
    const SamePlaces found = twice(shape, "translate 0 0 0");
    EXPECT_EQ(found.bodies.size(), 1u) << shape;
    EXPECT_EQ(found.faces.size(), static_cast<std::size_t>(test::make_model(shape).tables().n_faces())) << shape;
  }
}

TEST(SamePlace, turned_and_mirrored_onto_itself_a_body_is_still_the_same) {
  EXPECT_EQ(twice("cylinder", "rotate 0 0 1 37").bodies.size(), 1u) << "the seam is elsewhere";
  EXPECT_EQ(twice("sphere", "rotate 1 0 0 90").bodies.size(), 1u);
  EXPECT_EQ(twice("torus", "mirror 0 0 1").bodies.size(), 1u);
}

TEST(SamePlace, bodies_that_only_touch_share_faces_at_most) {
  const Box3 box = test::make_model("box").tables().box();
  const SamePlaces beside = twice("box", "translate " + std::to_string(box.hi.x - box.lo.x) + " 0 0");
  EXPECT_TRUE(beside.bodies.empty());
  EXPECT_EQ(beside.faces.size(), 1u);
  EXPECT_TRUE(twice("box", "translate 0.01 0 0").faces.empty() || twice("box", "translate 0.01 0 0").bodies.empty());
  EXPECT_TRUE(twice("sharp_triangle", "rotate 0 0 1 180 at 10 1 0").faces.empty()) << "the other half of a rectangle";
}

}  // namespace
}  // namespace st
