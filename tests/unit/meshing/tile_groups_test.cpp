#include "meshing/face/tile_groups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "unit/meshing/tiled_faces.h"

namespace st {
namespace {

TEST(TileGroups, have_all_tiles_in_order_and_all_cut_nodes_that_only_they_touch) {
  constexpr double kTriangles = 1000;  // of a tile
  const UniformField field(
      std::sqrt(kTrianglesPerWeight * test::make_model("square").tables().face_area[0] / (30 * kTriangles)));
  const test::FaceCase face("square", field);
  const TileCut cut = test::cut(face, field, kTriangles);
  const TileGroups groups(cut);
  std::vector<std::int32_t> group_of_tile;
  for (std::int32_t g = 0; g < groups.n_groups(); ++g) {
    const auto [first, end] = groups.members(g);
    EXPECT_EQ(first, static_cast<std::int32_t>(group_of_tile.size()));
    for (std::int32_t t = first; t < end; ++t) group_of_tile.push_back(g);
  }
  ASSERT_EQ(group_of_tile.size(), cut.tiles.size());
  std::map<std::int32_t, std::set<std::int32_t>> groups_at;
  for (std::size_t t = 0; t < group_of_tile.size(); ++t)
    for (const auto& segment : cut.tiles[t].segments)
      for (const std::int32_t n : segment)
        if (n >= cut.n_boundary) groups_at[n - cut.n_boundary].insert(group_of_tile[t]);
  int n_between = 0;
  for (const auto& [node, at] : groups_at) {
    EXPECT_EQ(groups.group_of(node), at.size() == 1 ? *at.begin() : kNone);
    n_between += at.size() > 1;
  }
  EXPECT_GT(n_between, 0);
  EXPECT_LT(n_between, static_cast<int>(groups_at.size()) / 2) << "groups are of neighbours";
}

TEST(TileGroups, of_few_tiles_are_none) {
  TileCut cut;
  cut.tiles.resize(12);
  const TileGroups few(cut);
  EXPECT_EQ(few.n_groups(), 0);
  EXPECT_EQ(few.members_of_face(), (std::array<std::int32_t, 2>{0, 12}));
  cut.tiles.resize(13);
  EXPECT_EQ(TileGroups(cut).n_groups(), 2);
  EXPECT_EQ(TileGroups(cut).members_of_face(), (std::array<std::int32_t, 2>{13, 15}));
}

}  // namespace
}  // namespace st
