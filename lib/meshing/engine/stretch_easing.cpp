#include "meshing/engine/stretch_easing.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "base/share.h"
#include "mesh/merge.h"
#include "meshing/engine/last_resorts.h"
#include "meshing/engine/refinement_policy.h"
#include "meshing/face/flaw_mending.h"

namespace st {

using Policy = RefinementPolicy;

void StretchEasing::run() {
  if (!field_.is_stretched() || field_.has_metrics()) return;  // a solver asks for what metrics make obtuse
  n_bad_ = Policy::n_bad_while_easing(faces_.n_bad());
  share(executor_, n_bad_);
  n_first_ = n_triangles(all_faces());
  flaws_ = find_flaws(0);
  const bool has_obtuse = is_on_root(!flaws_.obtuse.empty());
  if (!is_on_root(flaws_.has_eased()) && !has_obtuse) return;
  best_ = {count_flaws(), has_obtuse, faces_.state(), refinements_.all()};
  run_rounds([&] { return shorten_along(); });
  if (!is_best_) go_back();
  mix_rounds();
  if (!best_.has_obtuse) return;
  flaws_ = find_flaws(0);
  run_rounds([&] { return shorten(flaws_.obtuse, Shortens::kAll); });
  if (!is_best_) go_back();
}

/// Whether it is on rank 0, which knows.
bool StretchEasing::is_on_root(bool is_here) const {
  char is = is_here;
  share(executor_, is);
  return is != 0;
}

void StretchEasing::run_rounds(const std::function<std::vector<Refinement>()>& shorten_more) {
  const std::size_t first = refinements_.all().size();
  rounds_ = {{refinements_.all(), flaws_.all}};
  for (int i = 0, n_without = 0; Policy::goes_on_easing(i, n_without, n_worst(), n_first_, n_again_); ++i) {
    const std::vector<Refinement> shorter = shorten_more();
    if (shorter.empty()) break;
    n_again_ += n_triangles(
        mesh_again_(shorter, "where stretched triangles are obtuse or too large", RefinementTrials::kAnyBad));
    take_back_spoiling(first);
    flaws_ = find_flaws(i + 1);
    rounds_.push_back({refinements_.all(), flaws_.all});
    n_without = keep_if_better() ? 0 : n_without + 1;
  }
}

std::vector<FaceId> StretchEasing::all_faces() const {
  std::vector<FaceId> all(tables_.n_faces());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The same on all ranks.
std::int64_t StretchEasing::n_triangles(const std::vector<FaceId>& of) const {
  std::int64_t n = 0;
  for (const FaceId f : of)
    for (const PatchPlace& section : faces_.places()[f]) n += section.n_triangles;
  share(executor_, n);
  return n;
}

/// On rank 0.
StretchFlaws StretchEasing::find_flaws(int n_tries) {
  mend_last_obtuse(faces_, false, executor_);
  const Patches patches = faces_.bring(all_faces());
  if (!executor_.is_root()) return {};
  std::vector<const FacePatch*> of_faces;
  for (const auto& [f, patch] : patches) of_faces.push_back(&patch);
  const SurfaceMesh mesh = weld_patches(faces_.edges(), tables_.vertex_xyz, of_faces).mesh;
  const RefinedField present(field_, refinements_.all());
  StretchFlaws flaws = find_stretch_flaws(mesh.node_xyz, mesh.triangles, present, n_tries);
  if (!find_unheld_) return flaws;
  int hint = 0;
  for (const RefinementPoint& place : find_unheld_(mesh)) flaws.add_unheld(place, present.local(place.x, hint));
  return flaws;
}

StretchEasing::Count StretchEasing::count_flaws() const {
  std::int64_t n_bad = std::max(faces_.n_bad(), n_bad_);  // as many as before are for others to mend
  std::size_t n_far = flaws_.n_far, n_unheld = flaws_.n_unheld, n_obtuse = flaws_.n_obtuse, n_large = flaws_.n_large;
  share(executor_, n_bad, n_far, n_unheld, n_obtuse, n_large);
  return {n_bad, n_far + Policy::kUnheldWeighs * n_unheld, n_far, n_obtuse, n_large};
}

/// Sets is_best_.
bool StretchEasing::keep_if_better() {
  const Count n_flaws = count_flaws();
  is_best_ = n_flaws < best_.n_flaws && Policy::is_worth_easing(n_first_, n_triangles(all_faces()));
  const bool has_obtuse = is_on_root(!flaws_.obtuse.empty());
  if (is_best_) best_ = {n_flaws, has_obtuse, faces_.state(), refinements_.all()};
  std::vector<FacePlace> others;
  if (executor_.is_root()) others = best_.state.patches.places;
  faces_.keep_only(std::move(others));
  return is_best_;
}

/// Those that are new.
std::vector<Refinement> StretchEasing::shorten(const Places& places, Shortens shortens) {
  const std::size_t n_before = refinements_.all().size(), step = places.size() / Policy::kMostEasedPlaces + 1;
  for (std::size_t i = 0; i < places.size(); i += step)
    if (std::ranges::none_of(spoiling_, [&](const Refinement& r) { return distance(r.x, places[i].x) < r.reach; }))
      refinements_.add(places[i], Policy::kObtuseFloor, shortens);
  std::vector<Refinement> all = refinements_.all();
  share(executor_, all);
  refinements_.assign(all);
  return {all.begin() + static_cast<std::ptrdiff_t>(n_before), all.end()};
}

/// Of what is stretched.
std::vector<Refinement> StretchEasing::shorten_along() {
  Places wide, nearby;
  (flaws_.is_wide() ? wide : nearby) = flaws_.stretched;
  if (flaws_.eases_steps()) {
    for (const RefinementPoint& step : flaws_.steps)
      flaws_.is_beside_unheld(step) ? wide.push_back(further(step)) : nearby.push_back(step);
  }
  std::vector<Refinement> all = shorten(wide, Shortens::kAlong);
  const std::vector<Refinement> others = shorten(nearby, Shortens::kAlongNearby);
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

/// Where more folds and crosses than at the beginning: shorter lengths that reach these places are given up for good.
void StretchEasing::take_back_spoiling(std::size_t first) {
  char is_worse = faces_.n_bad() > n_bad_;
  share(executor_, is_worse);
  if (!is_worse) return;
  const std::vector<Vec3> bad = faces_.bad_places();
  std::vector<Refinement> kept, dropped;
  for (std::size_t i = 0; i < refinements_.all().size(); ++i) {
    const Refinement& r = refinements_.all()[i];
    const bool reaches = std::ranges::any_of(bad, [&](Vec3 x) { return distance(r.x, x) < r.reach; });
    (i >= first && reaches ? dropped : kept).push_back(r);
  }
  share(executor_, kept, dropped);
  if (dropped.empty()) return;
  spoiling_.insert(spoiling_.end(), dropped.begin(), dropped.end());
  refinements_.assign(std::move(kept));
  n_again_ += n_triangles(mesh_again_(dropped, "spoils triangles", RefinementTrials::kAnyBad));
}

/// Some places may be better after one round, others after another one or as they were.
void StretchEasing::mix_rounds() {
  if (best_.n_flaws == Count{n_bad_, 0, 0, 0, 0}) return;
  const std::size_t first = rounds_.front().refinements.size();
  const std::vector<Refinement> before = refinements_.all();
  std::vector<Refinement> mixed = executor_.is_root() ? best_of_places(rounds_) : std::vector<Refinement>();
  share(executor_, mixed);
  std::vector<Refinement> changed;
  const auto add_missing = [&](const std::vector<Refinement>& from, const std::vector<Refinement>& in) {
    std::ranges::copy_if(from, std::back_inserter(changed), [&](const Refinement& r) { return !contains(in, r); });
  };
  add_missing(before, mixed);
  add_missing(mixed, before);
  if (changed.empty()) return;
  refinements_.assign(mixed);
  n_again_ += n_triangles(mesh_again_(changed, "where another round of easing is better", RefinementTrials::kAnyBad));
  take_back_spoiling(first);
  flaws_ = find_flaws(0);
  keep_if_better();
  if (!is_best_) go_back();
}

void StretchEasing::go_back() {
  refinements_.assign(best_.refinements);
  faces_.go_back(best_.state);
  is_best_ = true;
}

}  // namespace st
