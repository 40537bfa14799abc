#include "meshing/face/tile_groups.h"

#include <algorithm>
#include <cmath>

namespace st {
namespace {

constexpr std::int32_t kFewTiles = 12;  // whose cuts are enhanced at once

}  // namespace

std::vector<std::array<std::int32_t, 2>> tiles_of_cuts(const TileCut& cut) {
  std::vector<std::array<std::int32_t, 2>> tiles(cut.nodes.size(), {kNone, kNone});
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(cut.tiles.size()); ++i)
    for (const auto& segment : cut.tiles[i].segments)
      for (const std::int32_t n : segment) {
        if (n < cut.n_boundary) continue;
        auto& [first, last] = tiles[n - cut.n_boundary];
        last = i;
        if (first == kNone) first = i;
      }
  return tiles;
}

TileGroups::TileGroups(const TileCut& cut) : n_tiles_(static_cast<std::int32_t>(cut.tiles.size())), n_groups_(0) {
  // so many that the cuts within a group are as long as those between all groups, about
  if (n_tiles_ > kFewTiles) n_groups_ = static_cast<std::int32_t>(std::lround(std::cbrt(n_tiles_)));
  std::vector<std::int32_t> group(n_tiles_, 0);
  for (std::int32_t g = 0; g < n_groups_; ++g)
    std::fill(group.begin() + first_tile(g), group.begin() + first_tile(g + 1), g);
  group_of_.assign(cut.nodes.size(), kNone);
  if (n_groups_ == 0) return;
  const std::vector<std::array<std::int32_t, 2>> tiles = tiles_of_cuts(cut);
  for (std::size_t i = 0; i < tiles.size(); ++i)  // all tiles between the first and the last are of their group
    if (const auto [first, last] = tiles[i]; first != kNone && group[first] == group[last]) group_of_[i] = group[first];
}

std::int32_t TileGroups::first_tile(std::int32_t group) const {
  return static_cast<std::int32_t>(std::int64_t{n_tiles_} * group / n_groups_);
}

std::array<std::int32_t, 2> TileGroups::members(std::int32_t group) const {
  return {first_tile(group), first_tile(group + 1)};
}

std::array<std::int32_t, 2> TileGroups::members_of_face() const {
  return n_groups_ > 0 ? std::array{n_tiles_, n_tiles_ + n_groups_} : std::array{0, n_tiles_};
}

}  // namespace st
