#include "meshing/engine/refinement_trials.h"

#include <algorithm>
#include <utility>

#include "base/share.h"
#include "meshing/engine/refinement_policy.h"

namespace st {
namespace {

using Policy = RefinementPolicy;

/// Twice as long where they are not needed as they are; none where the request is met then.
std::vector<Refinement> loosened(const std::vector<Refinement>& all, const std::vector<char>& is_needed) {
  std::vector<Refinement> looser;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Refinement r = all[i];
    if (!is_needed[i]) {
      r.reach -= (Policy::kLooser - 1) * r.length / slope_of(r.shortens);
      r.length *= Policy::kLooser;
    }
    if (r.reach > r.radius) looser.push_back(r);
  }
  return looser;
}

}  // namespace

void RefinementTrials::take_back() {
  char has_hopeless = !hopeless_.all().empty();
  share(executor_, has_hopeless);
  if (has_hopeless) take_back_once(TakeBack::kOfHopelessFacesToo);
  for (int i = 0; i < Policy::kMostTakenBack && take_back_once(TakeBack::kAtBadPlaces); ++i) {
  }
}

/// Whether there may be more.
bool RefinementTrials::take_back_once(TakeBack what) {
  std::int64_t n_before = faces_.n_bad();
  share(executor_, n_before);
  if (n_before == 0 || refinements_.all().empty()) return false;
  std::int64_t n_allowed = n_before;
  std::vector<FaceId> sound;  // and must stay so
  if (what == TakeBack::kOfHopelessFacesToo) {
    n_allowed += n_more_of_hopeless();
    sound = faces_.sound_faces();
  }
  const std::vector<Refinement> refined = refinements_.all();
  const MeshedFaces::State before = faces_.state();
  const std::vector<Refinement> useless = drop_useless(what);
  if (useless.empty()) return false;
  mesh_again_(useless, "did not help", n_allowed);
  char is_worse = faces_.n_bad() > n_allowed || !std::ranges::includes(faces_.sound_faces(), sound);
  share(executor_, is_worse);
  if (!is_worse) return true;
  refinements_.assign(refined);
  faces_.go_back(before);
  return false;
}

/// Takes out those about places that are bad after all rounds, or in the boxes of faces that were given up, and returns
/// them.
std::vector<Refinement> RefinementTrials::drop_useless(TakeBack what) {
  std::vector<Refinement> useless, kept;
  const std::vector<Vec3> bad = faces_.bad_places();
  std::vector<FaceId> hopeless;
  if (what == TakeBack::kOfHopelessFacesToo) hopeless = hopeless_.all();
  for (const Refinement& r : refinements_.all()) {
    const bool is_useless =
        std::ranges::any_of(hopeless, [&](FaceId f) { return box_distance(tables_.face_box[f], r.x) == 0; }) ||
        std::ranges::any_of(bad, [&](Vec3 x) { return distance(r.x, x) < r.reach; });
    (is_useless ? useless : kept).push_back(r);
  }
  share(executor_, useless, kept);
  refinements_.assign(std::move(kept));
  return useless;
}

/// Local, on rank 0. What the faces that were given up may fold and cross themselves more often without sizes that left
/// not clearly fewer. No face may fail for that.
std::int64_t RefinementTrials::n_more_of_hopeless() const {
  const std::vector<std::int64_t> n_crossing = faces_.crossings().n_pairs_within();
  std::int64_t n = 0;
  for (const FaceId f : hopeless_.all()) n += faces_.outcome(f).n_folds + n_crossing[f];
  return Policy::n_more_allowed(n);
}

void RefinementTrials::loosen() {
  char is_sound = faces_.n_bad() == 0;
  share(executor_, is_sound);
  if (!is_sound || refinements_.all().size() > Policy::kFewRefined) return;
  for (int i = 0; i < Policy::kMostLoosened && loosen_once(); ++i) {
  }
}

/// All lengths twice as long, but for those that must stay, and those about places that are bad then. Whether some stay
/// so.
bool RefinementTrials::loosen_once() {
  const std::vector<Refinement> refined = refinements_.all();
  const MeshedFaces::State before = faces_.state();
  std::vector<char> is_needed = must_stay();
  std::vector<Refinement> changed;
  for (std::size_t k = 0; k < is_needed.size(); ++k)
    if (!is_needed[k]) changed.push_back(refined[k]);
  bool has_meshed = false;
  for (int i = 0; i < Policy::kMostTried && !changed.empty() && std::ranges::count(is_needed, 0) > 0; ++i) {
    refinements_.assign(loosened(refined, is_needed));
    mesh_again_(changed, i == 0 ? "may be too much" : "is needed", kAnyBad);
    has_meshed = true;
    char is_sound = faces_.n_bad() == 0;
    share(executor_, is_sound);
    if (is_sound) return true;
    changed = find_needed(refined, is_needed);
  }
  if (!has_meshed) return false;
  refinements_.assign(refined);
  faces_.go_back(before);
  return false;
}

/// By refinement: its length was measured, or it reaches faces of bodies in contact, which may cross, so that nothing
/// tells what is sound there.
std::vector<char> RefinementTrials::must_stay() const {
  const std::vector<FaceId> touching = faces_.crossings().touching_faces();
  std::vector<char> stays;
  for (const Refinement& r : refinements_.all())
    stays.push_back(r.radius > 0 || std::ranges::any_of(touching, [&](FaceId f) {
                      return box_distance(tables_.face_box[f], r.x) < r.reach;
                    }));
  share(executor_, stays);
  return stays;
}

/// Marks and returns those of `all` that reach places that are bad now.
std::vector<Refinement> RefinementTrials::find_needed(const std::vector<Refinement>& all,
                                                      std::vector<char>& is_needed) const {
  const std::vector<Vec3> bad = faces_.bad_places();
  std::vector<Refinement> needed;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Refinement& r = all[k];
    if (is_needed[k] || std::ranges::none_of(bad, [&](Vec3 x) { return distance(r.x, x) < r.reach; })) continue;
    is_needed[k] = 1;
    needed.push_back(r);
  }
  share(executor_, is_needed, needed);
  return needed;
}

}  // namespace st
