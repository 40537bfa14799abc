#include "meshing/engine/last_resorts.h"

#include <numeric>
#include <utility>
#include <vector>

#include "base/share.h"
#include "meshing/engine/refinement_policy.h"
#include "meshing/face/blunt_swaps.h"
#include "meshing/face/flaw_mending.h"
#include "meshing/face/patch_refill.h"

namespace st {
namespace {

std::size_t count(const MeshedFaces::BadTriangles& bad) {
  std::size_t n = 0;
  for (const auto& [f, triangles] : bad) n += triangles.size();
  return n;
}

/// Collective. Whether it stays and may be worth another time.
bool refill_once(MeshedFaces& faces, const Executor& executor) {
  MeshedFaces::Patches patches = faces.bring(faces.suspects());
  const MeshedFaces::BadTriangles bad = faces.bad_triangles(patches);
  char is_sound = bad.empty();
  share(executor, is_sound);
  if (is_sound) return false;
  const int n_pairs = faces.crossings().n_pairs();
  const MeshedFaces::PatchState before = faces.patch_state();
  for (const auto& [f, triangles] : bad)
    if (FacePatch& patch = patches[f]; refill(faces.nodes_of(patch), triangles, patch) > 0)
      faces.put(f, std::move(patch));
  faces.search_crossings();
  const MeshedFaces::BadTriangles left = faces.bad_triangles(faces.bring(faces.suspects()));
  char is_worse = faces.crossings().n_pairs() > n_pairs || !RefinementPolicy::refill_stays(count(left), count(bad));
  share(executor, is_worse);
  if (is_worse) faces.go_back(before);
  return !is_worse;
}

}  // namespace

void refill_bad(MeshedFaces& faces, const Executor& executor) {
  while (refill_once(faces, executor)) {  // each leaves a tenth less at least
  }
}

bool refill_all_bad(MeshedFaces& faces, const Executor& executor) {
  const MeshedFaces::PatchState before = faces.patch_state();
  refill_bad(faces, executor);
  char is_sound = faces.n_bad() == 0;
  share(executor, is_sound);
  if (!is_sound) faces.go_back(before);
  return is_sound != 0;
}

void mend_obtuse(MeshedFaces& faces, const std::vector<FaceId>& which, double above, const Executor& executor) {
  int n_pairs = faces.crossings().n_pairs();
  share(executor, n_pairs);
  MeshedFaces::Patches patches = faces.bring(which);
  const MeshedFaces::PatchState before = faces.patch_state();
  char has_changed = false;
  for (auto& [f, patch] : patches) {
    if (mend_blunt(faces.nodes_of(patch), patch, above) == 0) continue;
    has_changed = true;
    faces.put(f, std::move(patch));
  }
  share(executor, has_changed);
  if (!has_changed) return;
  faces.search_crossings();
  char is_worse = faces.crossings().n_pairs() > n_pairs;
  share(executor, is_worse);
  if (is_worse) faces.go_back(before);
}

void mend_last_obtuse(MeshedFaces& faces, bool has_metrics, const Executor& executor) {
  mend_obtuse(faces, faces.suspects(), kMostAngle, executor);
  if (has_metrics) return;  // a solver asks for what they make obtuse
  std::vector<FaceId> all(faces.places().size());
  std::iota(all.begin(), all.end(), 0);
  mend_obtuse(faces, all, kFarAngle, executor);
}

void part_touching(MeshedFaces& faces, const Executor& executor) {
  int n_pairs = faces.crossings().n_pairs();
  share(executor, n_pairs);
  if (n_pairs == 0) return;
  MeshedFaces::Patches patches = faces.bring(faces.crossings().crossing_faces(true));
  const MeshedFaces::PatchState before = faces.patch_state();
  std::vector<FaceId> moved;
  if (executor.is_root()) moved = faces.crossings().move_touching_apart(faces.numbering(), patches);
  share(executor, moved);
  if (moved.empty()) return;
  if (executor.is_root())
    for (const FaceId f : moved) faces.put(f, std::move(patches[f]));
  faces.search_crossings();
  char is_better = faces.crossings().n_pairs() < n_pairs;
  share(executor, is_better);
  if (!is_better) faces.go_back(before);
}

}  // namespace st
