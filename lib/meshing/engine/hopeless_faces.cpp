#include "meshing/engine/hopeless_faces.h"

#include <utility>

#include "meshing/engine/refinement_policy.h"

namespace st {

void HopelessFaces::add_meshed(FaceId f, std::int64_t n_triangles) {
  Effort& effort = efforts_[f];
  if (effort.n_meshed == 0) effort.n_first = n_triangles;
  effort.n_meshed += n_triangles;
  effort.n_last = n_triangles;
  n_meshed_ += n_triangles;
}

bool HopelessFaces::gives_up_folds(std::int64_t n_folds) {
  if (folds_.fewest == 0 || RefinementPolicy::is_clearly_fewer(n_folds, folds_.fewest)) {
    folds_ = {n_folds, 0, n_meshed_, n_meshed_};
    return false;
  }
  return RefinementPolicy::gives_up_folds(++folds_.n_without, n_meshed_ - folds_.n_before);
}

bool HopelessFaces::gives_up(Effort& effort, Count& count, std::int64_t n_bad) {
  if (effort.is_hopeless || std::exchange(count.n_asked, effort.n_meshed) == effort.n_meshed) return false;
  if (count.fewest == 0 || RefinementPolicy::is_clearly_fewer(n_bad, count.fewest)) {
    count = {n_bad, 0, effort.n_meshed, effort.n_meshed};
    return false;
  }
  return effort.is_hopeless = RefinementPolicy::gives_up(
             {++count.n_without, n_bad, effort.n_meshed - count.n_before, effort.n_last, effort.n_first});
}

std::vector<FaceId> HopelessFaces::all() const {
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < static_cast<FaceId>(efforts_.size()); ++f)
    if (contains(f)) faces.push_back(f);
  return faces;
}

}  // namespace st
