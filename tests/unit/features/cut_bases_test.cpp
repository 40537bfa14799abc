// Bases whose long sides are in pieces.
#include "features/cut_bases.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/base_strips.h"
#include "support/shapes.h"

namespace st {
namespace {

TEST(CutBases, have_a_strip_for_each_piece) {
  const Model model = test::make_model("wing_with_cut_base");
  const std::vector<Strip> cut = find_cut_bases(model);
  ASSERT_EQ(cut.size(), 6u);
  double length[2] = {0, 0};
  for (const Strip& s : cut) {
    ASSERT_TRUE(s.cut_side);
    EXPECT_EQ(s.face, cut[0].face);
    EXPECT_NEAR(s.row, 30, 1e-6);
    length[*s.cut_side] += s.length;
    EXPECT_NE(s.edges[0], s.edges[1]);
    for (const Strip::Station& station : s.stations) EXPECT_NEAR(station.width(), cut[0].stations[0].width(), 1e-6);
  }
  EXPECT_NEAR(length[0], 30, 1e-6);
  EXPECT_NEAR(length[1], 30, 1e-6);
}

TEST(CutBases, are_none_of_whole_strips_and_other_faces) {
  for (const char* shape : {"blunt_wing", "box", "l_face", "thin_plate"})
    EXPECT_TRUE(find_cut_bases(test::make_model(shape)).empty()) << shape;
}

TEST(CutBases, are_bases_of_trailing_edges) {
  const Model model = test::make_model("wing_with_cut_base");
  const std::vector<Strip> strips = find_base_strips(model, find_strips(model));
  EXPECT_EQ(std::ranges::count_if(strips, [](const Strip& s) { return s.cut_side.has_value(); }), 6);
}

}  // namespace
}  // namespace st
