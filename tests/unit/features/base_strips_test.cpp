// Narrow faces as bases of trailing edges.
#include "features/base_strips.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

std::vector<Strip> bases_of(const std::string& shape) {
  const Model model = test::make_model(shape);
  return find_base_strips(model, find_strips(model));
}

TEST(BaseStrips, of_a_wing_have_rows_of_their_own_length) {
  const std::vector<Strip> bases = bases_of("blunt_wing");
  const auto base = std::ranges::find_if(bases, [](const Strip& s) { return s.stations[0].width() < 0.1; });
  ASSERT_NE(base, bases.end());
  EXPECT_NEAR(base->row, base->length, 1e-9);
  EXPECT_TRUE(base->others.empty());
}

TEST(BaseStrips, beside_each_other_are_one) {
  const Model model = test::make_channel(3);
  const std::vector<Strip> bases = find_base_strips(model, find_strips(model));
  const auto base = std::ranges::find_if(bases, [](const Strip& s) { return !s.others.empty(); });
  ASSERT_NE(base, bases.end());
  EXPECT_EQ(base->others.size(), 2u);
  EXPECT_NEAR(base->stations[0].width(), 0.03, 1e-9);
}

TEST(BaseStrips, have_no_face_of_another_base) {
  const Model model = test::make_channel(20);
  std::vector<FaceId> faces;
  for (const Strip& base : find_base_strips(model, find_strips(model))) {
    faces.push_back(base.face);
    faces.insert(faces.end(), base.others.begin(), base.others.end());
  }
  EXPECT_GE(faces.size(), 20u);
  std::ranges::sort(faces);
  EXPECT_EQ(std::ranges::adjacent_find(faces), faces.end());
}

TEST(BaseStrips, are_the_ends_of_a_pipe_from_circle_to_circle) {
  const Model model = test::make_model("thin_pipe");
  EXPECT_TRUE(find_strips(model).empty());
  const std::vector<Strip> rings = find_base_strips(model, {});
  ASSERT_EQ(rings.size(), 2u);
  for (const Strip& ring : rings) {
    const double width = ring.stations[0].width();
    EXPECT_GT(width, 0);
    for (const Strip::Station& s : ring.stations) EXPECT_NEAR(s.width(), width, 1e-6 * ring.length);
  }
}

TEST(BaseStrips, are_no_sides_of_plain_bodies) {
  for (const char* shape : {"box", "sphere", "cone"}) EXPECT_TRUE(bases_of(shape).empty()) << shape;
}

}  // namespace
}  // namespace st
