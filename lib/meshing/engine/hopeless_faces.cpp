#include "meshing/engine/hopeless_faces.h"

#include <algorithm>
#include <utility>

namespace st {
namespace {

constexpr int kMostWithout = 2;                  // meshings in a row that leave not clearly fewer
constexpr std::int64_t kManyBad = 100;           // folds and crossings of a face
constexpr std::int64_t kMuchRepeated = 500'000;  // triangles of these meshings

constexpr std::int64_t kMostTimes = 4;  // the triangles of the first meshing
constexpr std::int64_t kFew = 1000;     // triangles of a face that are no harm

}  // namespace

void HopelessFaces::add_meshed(FaceId f, std::int64_t n_triangles) {
  Effort& effort = efforts_[f];
  if (effort.n_meshed == 0) effort.n_first = n_triangles;
  effort.n_meshed += n_triangles;
  effort.n_last = n_triangles;
}

bool HopelessFaces::gives_up(Effort& effort, Count& count, std::int64_t n_bad) {
  if (effort.is_hopeless || std::exchange(count.n_asked, effort.n_meshed) == effort.n_meshed) return false;
  if (count.fewest == 0 || static_cast<double>(n_bad) < kClearlyFewer * static_cast<double>(count.fewest)) {
    count = {n_bad, 0, effort.n_meshed, effort.n_meshed};
    return false;
  }
  const bool is_much = n_bad >= kManyBad || effort.n_meshed - count.n_before >= kMuchRepeated;
  const bool is_over = effort.n_last > std::max(kMostTimes * effort.n_first, kFew);
  return effort.is_hopeless = (++count.n_without >= kMostWithout && is_much) || is_over;
}

std::vector<FaceId> HopelessFaces::all() const {
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < static_cast<FaceId>(efforts_.size()); ++f)
    if (contains(f)) faces.push_back(f);
  return faces;
}

}  // namespace st
