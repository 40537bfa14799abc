// Pairs of triangles that cross, found by trees of boxes over the triangles.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/crossing.h"

namespace st {

/// Triangles, seen by group: those of group g are [begin[g], begin[g + 1]).
struct TriangleGroups {
  std::span<const Vec3> points;               ///< node coordinates, finite
  std::span<const Triangle> triangles;        ///< by group
  std::span<const std::int32_t> begin;        ///< [n_groups+1] ascending from 0
  std::span<const TriangleId> previous = {};  ///< [n_triangles] two that were there before (not kNone) are not
                                              ///< compared; empty: all are
};

/// Which pairs inside a group are compared.
enum class WithinGroup {
  kAll,
  kUnlessAlike,  ///< not those inside a part whose normals all lie within 60 degrees of one direction
};

/// Comparisons of boxes that a search among so many triangles may take. Sound meshes need some hundred for a triangle,
/// stretched ones a few thousand; triangles that lie in each other without end need as many as there are pairs.
constexpr std::int64_t most_comparisons(std::size_t n_triangles) {
  constexpr std::int64_t kAlways = 400'000'000;
  constexpr std::int64_t kPerTriangle = 20'000;
  return kAlways + kPerTriangle * static_cast<std::int64_t>(n_triangles);
}

/// The pairs of triangles_cross() within a group (twice the same number) or between two, for each of `searches`, sorted
/// by (a, b). Triangles of no area are in none. A tree is only built as deep as it is descended. The search is ended
/// after most_comparisons(): then `was_ended` is set, and these are not all pairs. The same at any number of threads.
/// `n_compared` gets the number of comparisons, unless null.
std::vector<TrianglePair> find_pairs(const TriangleGroups& groups, WithinGroup rule,
                                     std::vector<std::pair<std::int32_t, std::int32_t>> searches, bool& was_ended,
                                     std::int64_t* n_compared = nullptr);

}  // namespace st
