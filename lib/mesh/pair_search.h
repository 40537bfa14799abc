// Searches for pairs of triangles, whose work is bounded.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "mesh/crossing.h"

namespace st {

/// Comparisons of boxes that a search among so many triangles may take. Sound meshes need some hundred for a triangle,
/// stretched ones a few thousand; triangles that lie in each other without end need as many as there are pairs.
constexpr std::int64_t most_comparisons(std::size_t n_triangles) {
  constexpr std::int64_t kAlways = 400'000'000;
  constexpr std::int64_t kPerTriangle = 20'000;
  return kAlways + kPerTriangle * static_cast<std::int64_t>(n_triangles);
}

/// As find_crossing_triangles() of crossing.h. Where triangles lie in each other without end the search is ended
/// (most_comparisons()): then `was_ended` is set, and these are not all pairs.
std::vector<TrianglePair> find_crossing_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                                  bool& was_ended);

/// What a search has found so far, and for how much work.
class PairSearch {
 public:
  explicit PairSearch(std::int64_t most) : most_(most) {}

  void count(std::int64_t n_boxes) { n_compared_ += n_boxes; }
  bool is_over() const { return n_compared_ > most_; }
  /// Adds the pair where it crosses.
  void test(std::span<const Vec3> points, std::span<const Triangle> triangles, TriangleId s, TriangleId t) {
    constexpr std::int64_t kPerTest = 16;   // comparisons of boxes: an exact test takes as long
    constexpr std::int64_t kPerPair = 600;  // likewise: a pair takes memory, too
    n_compared_ += kPerTest;
    const auto [a, b] = std::minmax(s, t);
    int n_shared = 0;
    if (!triangles_cross(points, triangles[a], triangles[b], n_shared)) return;
    n_compared_ += kPerPair;
    pairs_.push_back({a, b, n_shared});
  }

  std::int64_t n_compared() const { return n_compared_; }
  const std::vector<TrianglePair>& pairs() const { return pairs_; }

 private:
  std::int64_t most_, n_compared_ = 0;
  std::vector<TrianglePair> pairs_;
};

/// Runs search(i, PairSearch&) for i in [0, n), on all threads, until all together took more than `most` comparisons;
/// each should end when it is_over(). What counts are the first searches that are enough for that, so the result does
/// not depend on the number of threads: their pairs, sorted by (a, b).
template <class Search>
std::vector<TrianglePair> find_bounded(std::size_t n, std::int64_t most, bool& was_ended, const Search& search) {
  std::vector<PairSearch> parts(n, PairSearch(most));
  std::vector<char> is_done(n, 0);
  std::atomic<std::int64_t> sum = 0;
  parallel_for(n, 1, [&](std::size_t i, std::size_t) {
    if (sum > most) return;
    search(i, parts[i]);
    is_done[i] = 1;
    sum += parts[i].n_compared();
  });
  std::vector<TrianglePair> pairs;
  std::int64_t n_compared = 0;
  for (std::size_t i = 0; i < n && n_compared <= most; ++i) {
    if (!is_done[i]) search(i, parts[i]);  // one that a later one overtook
    n_compared += parts[i].n_compared();
    pairs.insert(pairs.end(), parts[i].pairs().begin(), parts[i].pairs().end());
  }
  was_ended = n_compared > most;
  std::sort(pairs.begin(), pairs.end(),
            [](const TrianglePair& x, const TrianglePair& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  return pairs;
}

}  // namespace st
