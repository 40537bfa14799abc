#include "meshing/face/row_chains.h"

#include <gtest/gtest.h>

#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

TEST(RowChains, are_the_sides_with_long_segments_and_what_bounds_them) {
  const WallField field(0.1, 0, 1);
  const RowCase face({band(10, 10, {0.1, 0.2, 0.3}, {0.1, 0.3})}, field);
  const std::vector<RowChain> chains = find_row_chains(face.work);
  ASSERT_EQ(chains.size(), 2u);
  const RowChain& bottom = chains[0];
  EXPECT_EQ(bottom.nodes, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(bottom.after, (std::vector<std::int32_t>{10, 11, 12}));
  EXPECT_EQ(bottom.before, (std::vector<std::int32_t>{0, 24, 23, 22}));
  EXPECT_EQ(bottom.bottom, bottom.nodes);
  EXPECT_EQ(bottom.right, bottom.after);
  EXPECT_EQ(bottom.left, bottom.before);
  EXPECT_EQ(bottom.top.front(), 22);
  EXPECT_EQ(bottom.top.back(), 12);
  EXPECT_EQ(bottom.top.size(), 11u);
  EXPECT_FALSE(bottom.is_closed);
}

TEST(RowChains, end_where_segments_are_short) {
  const WallField field(0.1, 0, 1);
  std::vector<Vec2> loop;
  for (int i = 0; i < 50; ++i) loop.push_back({0.1 * i, 0});
  for (int i = 5; i <= 10; ++i) loop.push_back({1.0 * i, 0});
  loop.insert(loop.end(), {{10, 5}, {0, 5}});
  const std::vector<RowChain> chains = find_row_chains(RowCase({loop}, field).work);
  ASSERT_FALSE(chains.empty());
  EXPECT_EQ(chains[0].nodes, (std::vector<std::int32_t>{50, 51, 52, 53, 54, 55}));
  EXPECT_TRUE(chains[0].before.empty());
}

TEST(RowChains, are_none_across_the_direction_of_the_stretch) {
  const StretchedField field({0.1, 1, {0, 1, 0}});
  EXPECT_TRUE(find_row_chains(RowCase({band(10, 10, {5}, {5})}, field).work).empty());
}

TEST(RowChains, go_around_a_smooth_loop) {
  class Around : public UniformField {
   public:
    Around() : UniformField(0.05) {}
    bool is_stretched() const override { return true; }
    LocalSize local(Vec3 x, int&) const override { return {0.05, 1, normalized(Vec3{5 - x.y, x.x - 5, 0})}; }
  };
  std::vector<Vec2> loop;
  for (int i = 0; i < 40; ++i) loop.push_back({5 + 4 * std::cos(i * kPi / 20), 5 + 4 * std::sin(i * kPi / 20)});
  const std::vector<RowChain> chains = find_row_chains(RowCase({loop}, Around()).work);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].is_closed);
  ASSERT_EQ(chains[0].nodes.size(), 41u);
  EXPECT_EQ(chains[0].nodes.front(), chains[0].nodes.back());
}

TEST(Turning, is_positive_to_the_left) {
  EXPECT_NEAR(turning({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), kPi / 2, 1e-12);
  EXPECT_NEAR(turning({1, 0, 0}, {1, -1, 0}, {0, 0, 1}), -kPi / 4, 1e-12);
}

}  // namespace
}  // namespace st::test
