// When the rounds stop: every number that decides it, and the decisions that they make.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace st {

/// What rounds of refinement may cost and what they are worth. A length is a share of the requested one, unless said
/// otherwise. Origins: docs/design/heuristics.md, "Rounds". Pure: the same questions get the same answers.
struct RefinementPolicy {
  int max_rounds;                   ///< of loops, folds and narrow parts
  int max_crossing_rounds;          ///< of crossing triangles
  int max_promising_rounds;         ///< likewise where few are left, or it is known what parts them
  double crossing_floor;            ///< length at which refining crossing triangles ends
  std::size_t max_crossing_places;  ///< refined in one round

  // lengths
  static constexpr double kLoopFloor = 1.0 / 16;    ///< of loops, folds and narrow parts: refining ends there
  static constexpr double kObtuseFloor = 1.0 / 8;   ///< where lengths are alike in all directions and angles obtuse
  static constexpr double kLeastFactor = 1.0 / 32;  ///< of a triangle's length: walls that need less cannot be parted
  static constexpr double kCovering = 1.5;          ///< of half a triangle's longest side: a circle that covers it
  static constexpr double kWider = 0.75;            ///< more than that in each later round: new places crossed beside
  static constexpr double kLooser = 2;              ///< times a refined length that may be too short

  // places
  static constexpr std::uint64_t kFewCrossings = 200;    ///< so many may be refined for longer
  static constexpr std::size_t kMaxWallPlaces = 8000;    ///< in one round, where it is measured what parts walls
  static constexpr std::size_t kMostBadPlaces = 2000;    ///< that are looked at when refinements are taken back
  static constexpr std::int64_t kMoreBad = 2;            ///< times the folds before: they vary by chance as much
  static constexpr std::size_t kUnheldWeighs = 5;        ///< angles above 150 degrees: one station stands for many
  static constexpr std::size_t kMostEasedPlaces = 4000;  ///< whose lengths along become shorter in one round
  static constexpr std::size_t kFewRefined = 200;        ///< with more, no lengths are loosened: it takes too long

  // triangles
  static constexpr double kMostRepeated = 30;      ///< in all rounds, by those of the first one
  static constexpr double kFewTriangles = 200000;  ///< that may be meshed again in any case
  static constexpr double kMostEasedAgain = 2;     ///< meshed again to ease stretched ones, by those before
  static constexpr double kMostEasedWorst = 12;    ///< likewise, while angles are above 150 degrees or lengths not held
  static constexpr double kMostEasedGrowth = 2;    ///< times those before: more is not worth it
  static constexpr double kAround = 4;             ///< that a place of a wall makes shorter, about
  static constexpr double kMostForWalls = 1.5e6;   ///< that may part walls
  static constexpr double kPerWall = 2;  ///< times what parting walls should take: its rounds may mesh so many
  static constexpr std::int64_t kMuchRepeated = 500'000;  ///< meshed of a face since it was better: that is much
  static constexpr std::int64_t kMostTimes = 4;           ///< those of the first meshing of a face: beyond is too many
  static constexpr std::int64_t kFewOfFace = 1000;        ///< of a face, that are never too many

  // folds and crossings
  static constexpr double kClearlyFewer = 0.9;       ///< of those before: as many or more are no success
  static constexpr std::int64_t kManyBad = 100;      ///< of a face: that is much
  static constexpr std::int64_t kPerFailure = 1000;  ///< as bad as a face that fails
  static constexpr int kFewPairs = 50;               ///< with more pairs, faces that cross each other stay as they are

  static constexpr std::uint64_t kPerMended = 5000;  ///< triangles for each pair that is refilled before any is refined

  // times
  static constexpr int kMostWithout = 2;  ///< meshings of a face in a row that leave not clearly fewer
  static constexpr int kMostStuck = 3;    ///< rounds in a row that leave not clearly fewer pairs, where there are many
  static constexpr int kMostTakenBack = 4;  ///< that refinements at bad places are taken back: bad places move
  static constexpr int kMostLoosened = 4;   ///< that lengths are doubled: most are no finer than kLoopFloor
  static constexpr int kMostEased = 10;     ///< that lengths along become shorter: to 0.6 each time, 100 to 1 in nine
  static constexpr int kMostUneased = 5;    ///< likewise in a row that leave not fewer flaws, while any are above 150
                                            ///< degrees or not held
  static constexpr int kMostUneasedSteps = 2;  ///< likewise for steps alone
  static constexpr int kMostTried = 2;         ///< meshings each: places that are needed come to light

  /// Whether loops, folds and narrow parts are refined after this round, the first one being 1.
  bool refines_loops(int round) const { return round <= max_rounds; }
  /// Whether crossing triangles at `n_places` may be refined for longer. `is_measured`: it is known what parts some.
  static bool is_promising(std::uint64_t n_places, bool is_measured) {
    return n_places <= kFewCrossings || is_measured;
  }
  /// Whether they are refined after so many rounds of that.
  bool refines_crossings(int n_rounds, bool is_promising) const {
    return n_rounds < (is_promising ? max_promising_rounds : max_crossing_rounds);
  }
  /// Whether smaller triangles cross no less: rounds since there were clearly more pairs, and those there are.
  static bool is_stuck(int n_without, std::int64_t n_pairs) { return n_without >= kMostStuck && n_pairs >= kManyBad; }
  static int most_uneased(std::size_t n_worst) { return n_worst > 0 ? kMostUneased : kMostUneasedSteps; }
  /// Whether lengths along become shorter once more, after `n_rounds`, `n_without` success lately. `n_worst`: angles
  /// above 150 degrees and places that are not held. `n_again`: triangles meshed for that so far.
  static bool goes_on_easing(int n_rounds, int n_without, std::size_t n_worst, std::int64_t n_first,
                             std::int64_t n_again) {
    const double most =
        (n_worst > 0 ? kMostEasedWorst : kMostEasedAgain) * static_cast<double>(n_first) + kFewTriangles;
    return n_rounds < kMostEased && n_without < most_uneased(n_worst) && static_cast<double>(n_again) < most;
  }
  /// Whether a mesh of `n` triangles is worth that it has fewer flaws.
  static bool is_worth_easing(std::int64_t n_first, std::int64_t n) {
    return static_cast<double>(n) < kMostEasedGrowth * static_cast<double>(n_first);
  }
  /// Whether more was meshed than rounds can be worth, as on damaged surfaces. `n_for_walls`: of these, to part walls.
  static bool runs_away(std::uint64_t n_meshed, std::uint64_t n_first, double n_for_walls) {
    return static_cast<double>(n_meshed) >
           kMostRepeated * static_cast<double>(n_first) + kFewTriangles + kPerWall * n_for_walls;
  }
  /// Whether lengths are doubled after so many rounds, the first one included, where that meshes `n_again` triangles:
  /// twice the lengths of one round of refining are about those that were bad.
  static bool is_worth_loosening(int n_rounds, std::int64_t n_again) {
    return n_rounds > 2 || static_cast<double>(n_again) < kFewTriangles;
  }
  static bool affords_walls(double n_triangles) { return n_triangles < kMostForWalls; }
  static bool is_clearly_fewer(std::int64_t n, std::int64_t n_before) {
    return static_cast<double>(n) < kClearlyFewer * static_cast<double>(n_before);
  }
  /// What faces that were given up, with `n` folds and crossings, may have more without their refinements, which left
  /// not clearly fewer. No face may fail for that.
  static std::int64_t n_more_allowed(std::int64_t n) {
    return std::min(kPerFailure - 1, static_cast<std::int64_t>((1 / kClearlyFewer - 1) * static_cast<double>(n)));
  }
  /// Whether crossing triangles are refilled before any are refined: nothing else is bad among `n` triangles, they are
  /// few, and it is not known what parts them.
  static bool mends_first(std::int64_t n_bad, std::int64_t n_unmeasured_pairs, std::uint64_t n) {
    return n_bad == n_unmeasured_pairs && n_bad <= kFewPairs && static_cast<std::uint64_t>(n_bad) * kPerMended <= n;
  }
  /// What easing may leave of folds and crossings, where `n` were before: others mend them. No face may fail for that.
  static std::int64_t n_bad_while_easing(std::int64_t n) { return n + std::min(kPerFailure - 1, kMoreBad * n); }
  /// Triangles that bad ones were refilled by: they stay where so many are bad.
  static bool refill_stays(std::size_t n_left, std::size_t n_bad) {
    return static_cast<double>(n_left) <= kClearlyFewer * static_cast<double>(n_bad);
  }
  /// Of a face: meshings in a row that left not clearly fewer, what is bad, triangles that were meshed since it was
  /// better, and those of its last and of its first meshing.
  struct FaceEffort {
    int n_without;
    std::int64_t n_bad, n_since, n_last, n_first;
  };
  static bool gives_up(const FaceEffort& e) {
    const bool is_much = e.n_bad >= kManyBad || e.n_since >= kMuchRepeated;
    return (e.n_without >= kMostWithout && is_much) || e.n_last > std::max(kMostTimes * e.n_first, kFewOfFace);
  }
  /// Likewise the folds of all faces: rounds in a row that left not clearly fewer, and triangles meshed in these.
  static bool gives_up_folds(int n_without, std::int64_t n_since) {
    return n_without >= kMostWithout && static_cast<double>(n_since) >= kFewTriangles;
  }
};

/// The policy for the faces of a model.
inline constexpr RefinementPolicy kFacePolicy{.max_rounds = 6,
                                              .max_crossing_rounds = 8,
                                              .max_promising_rounds = 14,
                                              .crossing_floor = 1.0 / 64,
                                              .max_crossing_places = 2000};
/// The policy for the holes of a mesh: one that cannot be filled grows, sizes do not help.
inline constexpr RefinementPolicy kHolePolicy{.max_rounds = 0,
                                              .max_crossing_rounds = 4,
                                              .max_promising_rounds = 4,
                                              .crossing_floor = 1.0 / 8,
                                              .max_crossing_places = 500};

}  // namespace st
