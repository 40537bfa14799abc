#include "meshing/engine/meshed_faces.h"

#include <algorithm>
#include <utility>

#include "base/share.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "meshing/engine/refinement_policy.h"
#include "meshing/face/patch_refill.h"

namespace st {

using Policy = RefinementPolicy;

MeshedFaces::MeshedFaces(const Model& model, const MeshTopology& topology, const Executor& executor, bool across_bodies,
                         EdgeMesh& edges)
    : topology_(topology),
      tables_(topology.tables()),
      executor_(executor),
      edges_(edges),
      outcomes_(tables_.n_faces()),
      places_(tables_.n_faces()),
      store_(executor),
      crossings_(model, store_, executor, across_bodies) {}

void MeshedFaces::set_edges(EdgeMesh edges) {
  edges_ = std::move(edges);
  numbering_.emplace(topology_, edges_);
}

std::vector<Vec3> MeshedFaces::nodes_of(const FacePatch& patch) const {
  return node_places(edges_, tables_.vertex_xyz, patch);
}

void MeshedFaces::set(FaceId f, FacePlace place, FaceOutcome outcome) {
  places_[f] = std::move(place);
  outcomes_[f] = std::move(outcome);
  crossings_.renew(f);
}

void MeshedFaces::put(FaceId f, FacePatch&& patch) {
  places_[f] = place_of(store_.put(std::move(patch), 0, --own_version_, edges_, tables_.vertex_xyz));
  crossings_.renew(f);
}

void MeshedFaces::close(FaceId f, FacePatch&& patch, bool is_near, double deviation) {
  FaceOutcome& o = outcomes_[f];
  o.is_closed = true;
  o.is_near = is_near;
  o.deviation = deviation;
  put(f, std::move(patch));
}

bool MeshedFaces::has_holes() const {
  return std::ranges::any_of(outcomes_, [](const FaceOutcome& o) { return o.is_hole(); });
}

std::int64_t MeshedFaces::n_bad() const { return n_bad_alone() + crossings_.n_pairs(); }

bool MeshedFaces::has_surely_more_bad(std::int64_t n) const {
  char has_more = n_bad_alone() > n;
  share(executor_, has_more);
  return has_more != 0;
}

std::int64_t MeshedFaces::n_bad_alone() const {
  std::int64_t n = 0;
  for (const FaceOutcome& o : outcomes_) n += o.n_folds + (o.cause == FailureCause::kNone ? 0 : Policy::kPerFailure);
  return n;
}

std::vector<FaceId> MeshedFaces::sound_faces() const {
  const std::vector<FaceId> crossing = crossings_.crossing_faces(true);
  std::vector<FaceId> sound;
  for (FaceId f = 0; f < tables_.n_faces(); ++f)
    if (const FaceOutcome& o = outcomes_[f]; o.cause == FailureCause::kNone && o.n_folds == 0)
      if (!std::ranges::binary_search(crossing, f)) sound.push_back(f);
  return sound;
}

std::vector<FaceId> MeshedFaces::suspects() const {
  std::vector<FaceId> faces = crossings_.crossing_faces(crossings_.n_pairs() <= Policy::kFewPairs);
  for (FaceId f = 0; f < tables_.n_faces(); ++f)
    if (!outcomes_[f].wanted.empty() || outcomes_[f].is_closed) faces.push_back(f);
  sort_once(faces);
  return faces;
}

MeshedFaces::BadTriangles MeshedFaces::bad_triangles(const Patches& patches) const {
  BadTriangles bad;
  for (const auto& [f, patch] : patches) {
    std::vector<std::size_t> own = crossings_.crossing_in(f, crossings_.n_pairs() <= Policy::kFewPairs);
    if (!outcomes_[f].wanted.empty() || outcomes_[f].is_closed) {
      const std::vector<std::size_t> flawed = find_flawed(nodes_of(patch), patch);
      own.insert(own.end(), flawed.begin(), flawed.end());
    }
    if (!own.empty()) bad[f] = std::move(own);
  }
  return bad;
}

MeshedFaces::Patches MeshedFaces::bring(const std::vector<FaceId>& faces) const {
  std::vector<FacePlace> wanted;
  for (const FaceId f : faces)
    if (!places_[f].empty()) wanted.push_back(places_[f]);
  Patches patches;
  for (FacePatch& p : store_.bring(std::move(wanted))) {
    const FaceId f = p.face;
    patches[f] = std::move(p);
  }
  return patches;
}

std::vector<Vec3> MeshedFaces::bad_places() const {
  std::vector<Vec3> places;
  for (const FaceOutcome& o : outcomes_)
    for (const RefinementPoint& p : o.wanted) places.push_back(p.x);
  for (const auto& [f, patch] : bring(crossings_.crossing_faces(true))) {
    const std::vector<Vec3> xyz = nodes_of(patch);
    for (const std::size_t t : crossings_.crossing_in(f, true)) {
      const NodeId* n = patch.triangles[t].n;
      places.push_back((xyz[n[0]] + xyz[n[1]] + xyz[n[2]]) / 3);
    }
  }
  const std::size_t step = places.size() / Policy::kMostBadPlaces + 1;
  for (std::size_t i = 1; i * step < places.size(); ++i) places[i] = places[i * step];
  places.resize((places.size() + step - 1) / step);
  return places;
}

void MeshedFaces::go_back(const State& before) {
  set_edges(before.edges);
  if (executor_.is_root()) outcomes_ = before.outcomes;
  go_back(before.patches);
}

void MeshedFaces::go_back(const PatchState& before) {
  if (executor_.is_root()) places_ = before.places;
  crossings_.go_back(before.crossings);
  search_crossings();  // of what had not been compared then
}

void MeshedFaces::keep_only(std::vector<FacePlace> others) {
  others.insert(others.end(), places_.begin(), places_.end());
  std::vector<PatchPlace> live;
  for (const FacePlace& face : others) live.insert(live.end(), face.begin(), face.end());
  share(executor_, live);
  store_.keep_only(live);
}

void MeshedFaces::report(MeshResult& result) const {
  result.n_crossing_pairs = crossings_.n_pairs();
  const std::vector<FaceId> sound = sound_faces();
  for (FaceId f = 0; f < tables_.n_faces(); ++f) {
    const FaceOutcome& o = outcomes_[f];
    if (!std::ranges::binary_search(sound, f)) result.bad_faces.push_back(f);
    if (o.n_folds > 0) result.folds.insert(result.folds.end(), o.wanted.begin(), o.wanted.end());
    if (o.cause == FailureCause::kNone) continue;
    result.failures.push_back({f, o.error.empty() ? text_of(o.cause) : o.error, remedy_of(o.cause),
                               o.wanted.empty() ? tables_.face_box[f].center() : o.wanted[0].x, o.is_closed, o.is_near,
                               o.deviation});
    result.attempts.push_back(o.attempt);
  }
}

/// Local: a patch that is all here, which is not kept any more.
FacePatch MeshedFaces::take_whole(FaceId f) {
  std::vector<FacePatch> rows;
  for (std::size_t s = 0; s < places_[f].size(); ++s)
    if (places_[f][s].is_there()) rows.push_back(store_.take(places_[f], s));
  return join_rows(std::move(rows));
}

/// Collective.
void MeshedFaces::hand_to_root(MeshResult& result) {
  std::vector<FaceId> elsewhere;
  for (FaceId f = 0; f < tables_.n_faces(); ++f)
    if (std::ranges::any_of(places_[f], [](const PatchPlace& p) { return p.rank > 0; })) elsewhere.push_back(f);
  Patches remote = bring(elsewhere);
  result.patches.resize(tables_.n_faces());
  for (FaceId f = 0; f < tables_.n_faces(); ++f) {
    if (const auto it = remote.find(f); it != remote.end())
      result.patches[f] = std::move(it->second);
    else if (executor_.is_root())
      result.patches[f] = take_whole(f);
    result.patches[f].face = f;
  }
}

void MeshedFaces::hand_over(PatchesGo patches, MeshResult& result) {
  share(executor_, places_);
  report(result);
  if (patches == PatchesGo::kToRoot) return hand_to_root(result);
  for (const FacePlace& sections : places_)
    for (const PatchPlace& section : sections)
      if (store_.is_own(section)) result.own_places.push_back(section);
  result.patches.resize(result.own_places.size());
  parallel_for(result.patches.size(), 1, [&](std::size_t i, std::size_t) {
    const PatchPlace& own = result.own_places[i];
    result.patches[i] = store_.take(places_[own.face], static_cast<std::size_t>(own.section));
  });
  result.places = places_;
}

}  // namespace st
