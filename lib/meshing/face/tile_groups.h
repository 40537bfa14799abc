// The tiles of a heavy face in groups of neighbours, whose cuts are enhanced group by group.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshing/face/face_tiles.h"

namespace st {

/// For each cut node the first and the last tile that have it, kNone: none has.
std::vector<std::array<std::int32_t, 2>> tiles_of_cuts(const TileCut& cut);

/// Which tiles make up a group: those that follow each other. One group of all is none.
class TileGroups {
 public:
  explicit TileGroups(const TileCut& cut);

  std::int32_t n_tiles() const { return n_tiles_; }
  std::int32_t n_groups() const { return n_groups_; }  ///< 0: all cuts are enhanced at once
  /// Sections that give their bands to this group, to the face where there is none: [first, end).
  std::array<std::int32_t, 2> members(std::int32_t group) const;
  std::array<std::int32_t, 2> members_of_face() const;
  /// The group that a cut node lies within, kNone: between several.
  std::int32_t group_of(std::int32_t cut_node) const { return group_of_[cut_node]; }

 private:
  std::int32_t first_tile(std::int32_t group) const;
  std::int32_t n_tiles_, n_groups_;
  std::vector<std::int32_t> group_of_;
};

}  // namespace st
