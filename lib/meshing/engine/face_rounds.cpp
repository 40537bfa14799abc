#include "meshing/engine/face_rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "base/current_work.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/limits.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/share.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "features/strip.h"
#include "geometry/model/cad_tolerance.h"
#include "meshing/engine/curve_tasks.h"
#include "meshing/engine/dirty_parts.h"
#include "meshing/engine/region_tasks.h"
#include "meshing/face/face_patch.h"
#include "meshing/face/failed_face.h"
#include "meshing/face/fold_repair.h"
#include "meshing/face/loop_closing.h"
#include "meshing/face/patch_refill.h"
#include "meshing/topology/curve_discretiser.h"
#include "meshing/topology/small_features.h"

namespace st {
namespace {

using Policy = RefinementPolicy;

constexpr double kNearEnough = 10;  // tolerances of the CAD: distance of a closed face's triangles from its surface
constexpr int kSamples = 32;        // of a curve, for its box
constexpr double kMargin = 0.05;    // of the box's diagonal: the curve may leave the box of its samples

Box3 box_of(const Curve& curve) {
  Box3 box;
  for (int i = 0; i <= kSamples; ++i)
    box.add(curve.point(curve.t_min() + (curve.t_max() - curve.t_min()) * i / kSamples));
  const double margin = kMargin * box.diagonal();
  box.lo -= {margin, margin, margin};
  box.hi += {margin, margin, margin};
  return box;
}

/// Twice as long where they are not needed as they are; none where the request is met then.
std::vector<Refinement> loosened(const std::vector<Refinement>& all, const std::vector<char>& is_needed) {
  std::vector<Refinement> looser;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Refinement r = all[i];
    if (!is_needed[i]) {
      r.reach -= (Policy::kLooser - 1) * r.length / kRefinementSlope;
      r.length *= Policy::kLooser;
    }
    if (r.reach > r.radius) looser.push_back(r);
  }
  return looser;
}

}  // namespace

FaceRounds::FaceRounds(const Model& model, const MeshTopology& topology, const SizeField& field, MeshPlan plan,
                       const MeshOptions& options, const Executor& executor, MeshResult& result)
    : MeshRounds(field, kFacePolicy, executor, result),
      model_(model),
      topology_(topology),
      tables_(topology.tables()),
      plan_(std::move(plan)),
      options_(options),
      face_tolerance_(face_tolerances(tables_.labels)),
      min_segments_(min_segments_per_edge(tables_)),
      dirty_edges_(plan_.edges),
      dirty_faces_(plan_.faces),
      outcomes_(tables_.n_faces()),
      store_(executor),
      places_(tables_.n_faces()),
      crossings_(model, store_, executor, options.parts_bodies),
      hopeless_(tables_.n_faces()) {
  if (static_cast<FaceId>(plan_.face_weight.size()) == tables_.n_faces())
    for (const double weight : plan_.face_weight) expected_.push_back(kTrianglesPerWeight * weight);
  if (expected_.empty()) options_.tile_triangles = 0;  // nothing tells what is heavy
  result_.edges = std::move(plan_.kept_edges);
  for (FacePatch& p : std::exchange(plan_.kept_patches, {}))
    if (executor.is_root() && !p.triangles.empty()) put(p.face, std::move(p));
  facing_ = find_facing_edges(topology, field.is_stretched());
}

/// The fresh nodes of edges that follow others; their leaders are fresh, too, or as before.
void FaceRounds::follow_leaders(EdgeMesh& fresh, std::vector<EdgeId>& place) const {
  std::vector<const FacingEdges*> dirty;
  for (const FacingEdges& f : facing_)
    if (place[f.edge] != kNone) dirty.push_back(&f);
  const auto nodes_of = [&](EdgeId e) {
    EdgeMesh nodes;
    if (place[e] == kNone && result_.edges.n_nodes(e) == 0) return make_edge(e);  // of another part
    place[e] == kNone ? nodes.append(result_.edges, e) : nodes.append(fresh, place[e]);
    return nodes;
  };
  const auto make = [&](std::int32_t i) {
    EdgeMesh nodes = facing_nodes(model_, field_, *dirty[i], nodes_of(dirty[i]->edge), nodes_of);
    end_at_vertices(dirty[i]->edge, nodes, nodes.n_nodes(0) - 1);
    return nodes;
  };
  const EdgeMesh followed = make_curve_nodes(static_cast<std::int32_t>(dirty.size()), make, executor_);
  for (EdgeId i = 0; i < followed.n_edges(); ++i) {
    place[dirty[i]->edge] = fresh.n_edges();
    fresh.append(followed, i);
  }
}

std::vector<Vec3> FaceRounds::nodes_of(const FacePatch& patch) const {
  return node_places(result_.edges, tables_.vertex_xyz, patch);
}

/// Local, on rank 0: its own patch of the face, from now on.
void FaceRounds::put(FaceId f, FacePatch&& patch) {
  places_[f] = FacePlace(store_.put({std::move(patch)}, 0, --own_version_, result_.edges, tables_.vertex_xyz));
  crossings_.renew(f);
}

/// Collective. Copies of these patches (rank 0's choice) on rank 0.
FaceRounds::Patches FaceRounds::bring(const std::vector<FaceId>& faces) const {
  std::vector<PlacedFace> wanted;
  for (const FaceId f : faces)
    if (places_[f].is_there()) wanted.push_back({f, places_[f]});
  Patches patches;
  for (FacePatch& p : store_.bring(std::move(wanted))) {
    const FaceId f = p.face;
    patches[f] = std::move(p);
  }
  return patches;
}

/// Local, on rank 0. Faces of which triangles may be bad, ascending.
std::vector<FaceId> FaceRounds::suspects() const {
  std::vector<FaceId> faces = crossings_.crossing_faces(crossings_.n_pairs() <= Policy::kFewPairs);
  for (FaceId f = 0; f < tables_.n_faces(); ++f)
    if (!outcomes_[f].fold_places.empty() || outcomes_[f].is_closed) faces.push_back(f);
  sort_once(faces);
  return faces;
}

/// Local, on rank 0. By face: folded onto a neighbour, without area, or crossing others. `patches`: of all suspects.
FaceRounds::BadTriangles FaceRounds::bad_triangles(const Patches& patches) const {
  BadTriangles bad;
  for (const auto& [f, patch] : patches) {
    std::vector<std::size_t> own = crossings_.crossing_in(f, crossings_.n_pairs() <= Policy::kFewPairs);
    if (!outcomes_[f].fold_places.empty() || outcomes_[f].is_closed) {
      const std::vector<std::size_t> flawed = find_flawed(nodes_of(patch), patch);
      own.insert(own.end(), flawed.begin(), flawed.end());
    }
    if (!own.empty()) bad[f] = std::move(own);
  }
  return bad;
}

/// Local, on rank 0. Failures, folds and crossings.
std::int64_t FaceRounds::n_bad() const {
  std::int64_t n = crossings_.n_pairs();
  for (const FaceOutcome& o : outcomes_) n += o.n_folds + (o.cause == FailureCause::kNone ? 0 : Policy::kPerFailure);
  return n;
}

/// Collective. Where faces fail, fold or cross; on rank 0.
std::vector<Vec3> FaceRounds::bad_places() const {
  std::vector<Vec3> places;
  for (const FaceOutcome& o : outcomes_)
    for (const auto* some : {&o.fold_places, &o.failed_places})
      for (const RefinementPoint& p : *some) places.push_back(p.x);
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

/// Collective. Takes out those about places that are bad after all rounds, or in the boxes of faces that were given up,
/// and returns them.
std::vector<Refinement> FaceRounds::drop_useless_refinements(TakeBack what) {
  std::vector<Refinement> useless, kept;
  const std::vector<Vec3> bad = bad_places();
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

/// Collective. What these refinements reached, which are others or no more, is meshed once more.
void FaceRounds::mesh_without(const std::vector<Refinement>& changed, const char* why) {
  if (executor_.is_root()) find_dirty(changed);
  share(executor_, dirty_edges_, dirty_faces_);
  log_info(fmt::format("refining at {} places {}: {} edges, {} faces again", changed.size(), why, dirty_edges_.size(),
                       dirty_faces_.size()));
  mesh_edges();
  mesh_dirty_faces();
  close_holes();
  crossings_.run(*numbering_, places_);
}

/// Collective. Smaller lengths about places that are bad all the same are no use, and go; first all those of faces that
/// were given up. The mesh stays as it is where more were bad without them.
void FaceRounds::take_back_refinements() {
  char has_hopeless = !hopeless_.all().empty();
  share(executor_, has_hopeless);
  if (has_hopeless) take_back_once(TakeBack::kOfHopelessFacesToo);
  for (int i = 0; i < Policy::kMostTakenBack && take_back_once(TakeBack::kAtBadPlaces); ++i) {
  }
}

/// Local, on rank 0. What the faces that were given up may fold and cross themselves more often without sizes that left
/// not clearly fewer. No face may fail for that.
std::int64_t FaceRounds::n_more_of_hopeless() const {
  const std::vector<std::int64_t> n_crossing = crossings_.n_pairs_within();
  std::int64_t n = 0;
  for (const FaceId f : hopeless_.all()) n += outcomes_[f].n_folds + n_crossing[f];
  return Policy::n_more_allowed(n);
}

/// Local, on rank 0. Faces without a fold, crossing or failure, ascending.
std::vector<FaceId> FaceRounds::sound_faces() const {
  const std::vector<FaceId> crossing = crossings_.crossing_faces(true);
  std::vector<FaceId> sound;
  for (FaceId f = 0; f < tables_.n_faces(); ++f)
    if (const FaceOutcome& o = outcomes_[f]; o.cause == FailureCause::kNone && o.n_folds == 0)
      if (!std::ranges::binary_search(crossing, f)) sound.push_back(f);
  return sound;
}

/// Collective. Whether there may be more.
bool FaceRounds::take_back_once(TakeBack what) {
  std::int64_t n_before = n_bad();
  share(executor_, n_before);
  if (n_before == 0 || refinements_.all().empty()) return false;
  std::int64_t n_allowed = n_before;
  std::vector<FaceId> sound;  // and must stay so
  if (what == TakeBack::kOfHopelessFacesToo) {
    n_allowed += n_more_of_hopeless();
    sound = sound_faces();
  }
  const Trial before = begin_trial();
  const std::vector<Refinement> useless = drop_useless_refinements(what);
  if (useless.empty()) return false;
  mesh_without(useless, "did not help");
  char is_worse = n_bad() > n_allowed || !std::ranges::includes(sound_faces(), sound);
  share(executor_, is_worse);
  if (!is_worse) return true;
  go_back(before, dirty_faces_);
  return false;
}

FaceRounds::Trial FaceRounds::begin_trial() const { return {refinements_.all(), result_.edges, places_, outcomes_}; }

/// Collective. To the mesh from before; `meshed`: faces that were done again since then.
void FaceRounds::go_back(const Trial& before, const std::vector<FaceId>& meshed) {
  refinements_.assign(before.refinements);
  result_.edges = before.edges;
  numbering_.emplace(topology_, result_.edges);
  if (executor_.is_root()) {
    places_ = before.places;
    outcomes_ = before.outcomes;
    for (const FaceId f : meshed) crossings_.renew(f);
  }
  crossings_.run(*numbering_, places_);
}

/// Collective. Rounds ask for half of a length at once, also beside places that need nothing any more. Where all is
/// sound in the end, longer lengths with which it stays so are taken.
void FaceRounds::loosen_refinements() {
  char is_sound = !is_restored_ && n_bad() == 0;
  share(executor_, is_sound);
  if (!is_sound || refinements_.all().size() > Policy::kFewRefined) return;
  for (int i = 0; i < Policy::kMostLoosened && loosen_once(); ++i) {
  }
}

/// Collective. All lengths twice as long, but for those that must stay, and those about places that are bad then.
/// Whether some stay so.
bool FaceRounds::loosen_once() {
  const Trial before = begin_trial();
  std::vector<char> is_needed = must_stay();
  std::vector<Refinement> changed;
  for (std::size_t k = 0; k < is_needed.size(); ++k)
    if (!is_needed[k]) changed.push_back(before.refinements[k]);
  std::vector<FaceId> meshed;
  for (int i = 0; i < Policy::kMostTried && !changed.empty() && std::ranges::count(is_needed, 0) > 0; ++i) {
    refinements_.assign(loosened(before.refinements, is_needed));
    mesh_without(changed, i == 0 ? "may be too much" : "is needed");
    meshed.insert(meshed.end(), dirty_faces_.begin(), dirty_faces_.end());
    char is_sound = n_bad() == 0;
    share(executor_, is_sound);
    if (is_sound) return true;
    changed = find_needed(before.refinements, is_needed);
  }
  if (!meshed.empty()) go_back(before, meshed);
  return false;
}

/// Collective. By refinement: its length was measured, or it reaches faces of bodies in contact, which may cross, so
/// that nothing tells what is sound there.
std::vector<char> FaceRounds::must_stay() const {
  const std::vector<FaceId> touching = crossings_.touching_faces();
  std::vector<char> stays;
  for (const Refinement& r : refinements_.all())
    stays.push_back(r.radius > 0 || std::ranges::any_of(touching, [&](FaceId f) {
                      return box_distance(tables_.face_box[f], r.x) < r.reach;
                    }));
  share(executor_, stays);
  return stays;
}

/// Collective. Marks and returns those of `all` that reach places that are bad now.
std::vector<Refinement> FaceRounds::find_needed(const std::vector<Refinement>& all,
                                                std::vector<char>& is_needed) const {
  const std::vector<Vec3> bad = bad_places();
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

/// Folds and crossings that no smaller sizes could help: triangles of the same nodes without them, off the surface
/// rather than through themselves.
void FaceRounds::refill_bad() {
  while (refill_once()) {  // each leaves a tenth less at least
  }
}

/// Collective. Stays only where clearly fewer are left; whether it stays and may be worth another time.
bool FaceRounds::refill_once() {
  const auto count = [](const BadTriangles& bad) {
    std::size_t n = 0;
    for (const auto& [f, triangles] : bad) n += triangles.size();
    return n;
  };
  Patches patches = bring(suspects());
  const BadTriangles bad = bad_triangles(patches);
  char is_sound = bad.empty();
  share(executor_, is_sound);
  if (is_sound) return false;
  const int n_pairs = crossings_.n_pairs();
  const std::vector<FacePlace> before = places_;
  for (const auto& [f, triangles] : bad)
    if (FacePatch& patch = patches[f]; refill(nodes_of(patch), triangles, patch) > 0) put(f, std::move(patch));
  crossings_.run(*numbering_, places_);
  const BadTriangles left = bad_triangles(bring(suspects()));
  char is_worse = crossings_.n_pairs() > n_pairs || !Policy::refill_stays(count(left), count(bad));
  share(executor_, is_worse);
  if (is_worse) {
    places_ = before;
    for (const auto& [f, triangles] : bad) crossings_.renew(f);
    crossings_.run(*numbering_, places_);
  }
  return !is_worse;
}

/// Collective. Triangles that touch because the CAD touches itself: a hair apart. Stays only where fewer are left.
void FaceRounds::part_touching() {
  int n_pairs = crossings_.n_pairs();
  share(executor_, n_pairs);
  if (n_pairs == 0) return;
  Patches patches = bring(crossings_.crossing_faces(true));
  const std::vector<FacePlace> before = places_;
  std::vector<FaceId> moved;
  if (executor_.is_root()) moved = crossings_.move_touching_apart(*numbering_, patches);
  share(executor_, moved);
  if (moved.empty()) return;
  if (executor_.is_root())
    for (const FaceId f : moved) put(f, std::move(patches[f]));
  crossings_.run(*numbering_, places_);
  char is_better = crossings_.n_pairs() < n_pairs;
  share(executor_, is_better);
  if (is_better) return;
  places_ = before;
  for (const FaceId f : moved) crossings_.renew(f);
  crossings_.run(*numbering_, places_);
}

void FaceRounds::report(PatchesGo patches) {
  take_back_refinements();
  loosen_refinements();
  refill_bad();
  part_touching();
  share(executor_, places_);
  result_.n_crossing_pairs = crossings_.n_pairs();
  for (FaceId f = 0; f < tables_.n_faces(); ++f) {
    const FaceOutcome& o = outcomes_[f];
    result_.folds.insert(result_.folds.end(), o.fold_places.begin(), o.fold_places.end());
    if (o.cause == FailureCause::kNone) continue;
    result_.failures.push_back({f, o.error.empty() ? text_of(o.cause) : o.error, remedy_of(o.cause), o.cause_xyz,
                                o.is_closed, o.is_near, o.deviation});
    result_.failed_faces.push_back(o.failed);
  }
  hand_over(patches);
}

/// Local: a patch that is all here, which is not kept any more.
FacePatch FaceRounds::take_whole(FaceId f) {
  const std::vector<SectionBegin> begins = places_[f].begins();
  std::vector<SectionRows> rows;
  for (std::size_t s = 0; s < begins.size(); ++s)
    if (places_[f].sections[s].is_there()) rows.push_back(store_.take(f, places_[f], s, begins));
  return join_rows(std::move(rows));
}

/// Collective. The patches go into the result.
void FaceRounds::hand_over(PatchesGo patches) {
  if (patches == PatchesGo::kToRoot) {
    std::vector<FaceId> elsewhere;
    for (FaceId f = 0; f < tables_.n_faces(); ++f)
      if (std::ranges::any_of(places_[f].sections, [](const PatchPlace& p) { return p.rank > 0; }))
        elsewhere.push_back(f);
    Patches remote = bring(elsewhere);
    result_.patches.resize(tables_.n_faces());
    for (FaceId f = 0; f < tables_.n_faces(); ++f) {
      if (const auto it = remote.find(f); it != remote.end())
        result_.patches[f] = std::move(it->second);
      else if (executor_.is_root())
        result_.patches[f] = take_whole(f);
      result_.patches[f].face = f;
    }
    return;
  }
  struct OwnSection {
    FaceId face;
    std::size_t number;
    std::shared_ptr<const std::vector<SectionBegin>> begins;
  };
  std::vector<OwnSection> own;
  for (FaceId f = 0; f < tables_.n_faces(); ++f) {
    const auto begins = std::make_shared<const std::vector<SectionBegin>>(places_[f].begins());
    for (std::size_t s = 0; s < begins->size(); ++s)
      if (store_.is_own(places_[f].sections[s])) own.push_back({f, s, begins});
  }
  result_.rows.resize(own.size());
  parallel_for(own.size(), 1, [&](std::size_t i, std::size_t) {
    const auto& [f, number, begins] = own[i];
    result_.rows[i] = store_.take(f, places_[f], number, *begins);
  });
  result_.places = places_;
}

void FaceRounds::mesh_edges() {
  std::vector<EdgeId> own;
  std::vector<const MeshTopology::Strip*> strips;
  for (const EdgeId e : dirty_edges_) {
    if (topology_.strip_closed_at(e)) continue;
    own.push_back(e);
    if (const auto* strip = topology_.strip_kept_at(e)) strips.push_back(strip);
  }
  EdgeMesh fresh = make_curve_nodes(
      static_cast<std::int32_t>(own.size()), [&](std::int32_t i) { return make_edge(own[i]); }, executor_);
  std::vector<EdgeId> place(tables_.n_edges(), kNone);  // in `fresh`
  for (EdgeId i = 0; i < fresh.n_edges(); ++i) place[own[i]] = i;
  follow_leaders(fresh, place);
  const auto mirror = [&](std::int32_t i) {
    EdgeMesh kept;
    kept.append(fresh, place[strips[i]->kept]);
    return make_mirrored(*strips[i], kept);
  };
  const EdgeMesh mirrored = make_curve_nodes(static_cast<std::int32_t>(strips.size()), mirror, executor_);
  for (EdgeId i = 0; i < mirrored.n_edges(); ++i) {
    place[strips[i]->closed] = fresh.n_edges();
    fresh.append(mirrored, i);
  }
  EdgeMesh next;
  for (EdgeId e = 0; e < tables_.n_edges(); ++e)
    place[e] == kNone ? next.append(result_.edges, e) : next.append(fresh, place[e]);
  result_.edges = std::move(next);
  numbering_.emplace(topology_, result_.edges);
}

void FaceRounds::end_at_vertices(EdgeId e, EdgeMesh& nodes, int min_segments) const {
  const auto end = [&](int side) { return tables_.vertex_xyz[tables_.edge_vertices[2 * e + side]]; };
  st::end_at_vertices(nodes, end(0), end(1), min_segments);
}

EdgeMesh FaceRounds::make_edge(EdgeId e) const {
  const CurrentWork at_edge("edge", e + 1);
  const auto curve = model_.curve(e);
  const RefinedField field(field_, refinements_.near(box_of(*curve)));
  EdgeMesh nodes = discretise_curve(*curve, field, {options_.max_turning_deg, min_segments_[e]});
  end_at_vertices(e, nodes, min_segments_[e]);
  return nodes;
}

/// The nodes of a strip's other edge follow those of the kept one.
EdgeMesh FaceRounds::make_mirrored(const MeshTopology::Strip& strip, const EdgeMesh& kept) const {
  const double tolerance = face_tolerance_.empty() ? 0 : face_tolerance_[strip.face];
  const bool is_ring = tables_.edge_vertices[2 * strip.kept] == tables_.edge_vertices[2 * strip.kept + 1];
  const double exact = is_ring ? cad_tolerance(tables_, strip.face)
                               : strip_exactness(model_, strip.kept, strip.closed, strip.is_opposed);
  EdgeMesh nodes = mirror_nodes(*model_.curve(strip.kept), kept, *model_.curve(strip.closed), strip.is_opposed,
                                {options_.merge_below, tolerance, exact});
  end_at_vertices(strip.closed, nodes, nodes.n_nodes(0) - 1);
  return nodes;
}

/// Collective.
void FaceRounds::mesh_dirty_faces() {
  ++version_;
  wanted_.assign(outcomes_.size(), {});
  std::map<FaceId, FaceReport> parted;
  RegionTasks({.cut = "cut",
               .whole = "face",
               .tile = "tile",
               .seams = "seams",
               .progress = "meshing",
               .unit = expected_.empty() ? "" : "triangles",
               .make_whole = [&](FaceId f) { return packed(keep(mesh_whole(f))); },
               .take_whole = [&](FaceId f, Bytes&& result) { take_whole(f, result); },
               .make_seams = [&](FaceId f, TiledRegions& tiled) { return packed(keep(mesh_seams_of(f, tiled))); },
               .take_seams = [&](FaceId f, Bytes&& result) { return take_seams(f, result, parted); },
               .finish = [&](TiledRegions& tiled) { return store_sections(tiled, std::move(parted)); },
               .record = [&](FaceId f, const Bytes& result) { return record_whole(f, result); },
               .restore = [&](Bytes&& whole) { return restore_whole(std::move(whole)); }},
              TiledRegions(model_, faces_as_regions(), field_, refinements_, options_.of_face(),
                           time_limit(options_.tile_triangles)),
              made_from(), expected_.empty() ? tables_.face_area : expected_, options_, executor_)
      .run(dirty_faces_);
}

/// Folds of faces that were given up stay.
std::vector<RefinementPoint> FaceRounds::mesh_regions() {
  mesh_dirty_faces();
  give_up(false);
  std::vector<RefinementPoint> all;
  for (FaceId f = 0; f < tables_.n_faces(); ++f)
    if (!hopeless_.contains(f) || outcomes_[f].cause != FailureCause::kNone)
      all.insert(all.end(), wanted_[f].begin(), wanted_[f].end());
  return all;
}

/// Local, on rank 0. Faces that refining did not help, by their folds or also by their crossings of the last search:
/// says so, once for each.
void FaceRounds::give_up(bool by_crossings) {
  std::vector<std::int64_t> n_crossing(tables_.n_faces(), 0);
  if (by_crossings) n_crossing = crossings_.n_pairs_within();
  for (FaceId f = 0; f < tables_.n_faces(); ++f) {
    const std::int64_t n_bad = outcomes_[f].n_folds + n_crossing[f];
    if (!(by_crossings ? hopeless_.gives_up_crossing(f, n_bad) : hopeless_.gives_up_folded(f, n_bad))) continue;
    crossings_.give_up(f);
    if (!options_.tells_damage) continue;
    log_warning(
        fmt::format("{}: its triangles fold or cross each other {} times, and smaller ones no less: refining there was "
                    "ended; its surface is damaged or crosses itself, so repair it in the CAD system",
                    tables_.face_label(f), n_bad));
  }
}

Regions FaceRounds::faces_as_regions() const {
  return {[](FaceId f) { return f; },
          [this](FaceId f, const Surface& surface) { return make_face_boundary(model_, surface, f, *numbering_); },
          [this](const FaceBoundary& boundary) { return boundary_places(boundary, *numbering_); }};
}

/// After it something must be wrong with so many triangles.
WorkLimit FaceRounds::time_limit(double n_triangles) const {
  constexpr double kAlways = 600, kPerTriangle = 50 * 3e-6;
  return {options_.time_limit.value_or(kAlways + kPerTriangle * n_triangles), options_.when_late};
}

/// A face, and a tile of it, is a function of the inputs, of the nodes on edges and of what was refined.
std::string FaceRounds::made_from() const {
  const Bytes bytes = packed(result_.edges, refinements_.all());
  return hash_hex(bytes.data(), bytes.size());
}

/// Local, on any rank: the patch, or its last section, stays here.
FaceRounds::FaceReport FaceRounds::keep(FaceResult&& result) {
  PatchPlace& place = result.report.place;
  place = store_.put(std::move(result.section), place.section, version_, result_.edges, tables_.vertex_xyz);
  return std::move(result.report);
}

/// Local, on the rank of the patch: a FaceResult.
Bytes FaceRounds::record_whole(FaceId f, const Bytes& bytes) const {
  FaceReport report;
  unpack(bytes, report);
  if (!report.place.is_there()) return packed(PatchSection(), report);
  return packed(store_.get(f, report.place)->section, report);
}

Bytes FaceRounds::restore_whole(Bytes&& whole) {
  FaceResult result;
  unpack(whole, result);
  return packed(keep(std::move(result)));
}

void FaceRounds::take_whole(FaceId f, const Bytes& bytes) {
  FaceReport report;
  unpack(bytes, report);
  FacePlace place(report.place);
  take_face(f, std::move(report), std::move(place));
}

/// Local, on rank 0. False where a tile failed or tiles do not fit; `parted`: patches that have more sections.
bool FaceRounds::take_seams(FaceId f, const Bytes& bytes, std::map<FaceId, FaceReport>& parted) {
  FaceReport report;
  unpack(bytes, report);
  if (report.cause != FailureCause::kNone) return false;
  report.is_parted ? void(parted[f] = std::move(report)) : take_whole(f, bytes);
  return true;
}

/// The seams as the last section of the patch; the whole patch where it has folds to be repaired.
FaceRounds::FaceResult FaceRounds::mesh_seams_of(FaceId f, TiledRegions& tiled) const {
  bool is_parted = false;
  SeamMesh seams;
  const auto make_mesh = [&](const Surface& surface, const FaceBoundary& boundary, const SizeField&) {
    seams = tiled.seams(surface, f, boundary, executor_);
    is_parted = seams.mesh.n_folds == 0 && !seams.mesh.corners.empty();
    return is_parted ? std::move(seams.mesh) : tiled.join(f, boundary, std::move(seams), executor_);
  };
  FaceResult result = make_face(f, make_mesh);
  if (!is_parted || result.report.cause != FailureCause::kNone) return result;
  result.report.is_parted = true;
  result.report.place.section = tiled.n_sections_of(f);
  set_owners(seams.owner, result.section);
  return result;
}

/// Collective. What is left of tiles and groups are sections of the patches of these faces (rank 0's), where they are.
/// Returns those with numbers that are none, of which none is part of the mesh: as wholes they say what is wrong.
std::vector<FaceId> FaceRounds::store_sections(TiledRegions& tiled, std::map<FaceId, FaceReport>&& parted) {
  std::vector<std::int32_t> sections;
  for (std::int32_t s = 0; s < tiled.n_sections(); ++s)
    if (parted.contains(tiled.section(s).region)) sections.push_back(s);
  share(executor_, sections);
  std::map<FaceId, std::vector<PatchPlace>> places;
  std::set<FaceId> unsound;
  for (auto& [f, report] : parted) places[f].resize(tiled.n_sections_of(f));
  NamedTasks tasks;
  for (const std::int32_t s : sections) tasks.home.push_back(tiled.rank_of(s));
  tasks.order.resize(sections.size());
  std::iota(tasks.order.begin(), tasks.order.end(), 0);
  tasks.label = [&](std::int32_t task) {
    return TaskLabel{"section", tiled.section(sections[task]).region, tiled.section(sections[task]).index};
  };
  executor_.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        const auto [f, index] = tiled.section(sections[task]);
        PatchSection section = make_section(tables_, f, index, tiled.take(sections[task]), *numbering_);
        const char is_sound = has_numbers_only(section.patch);
        if (!is_sound) return packed(is_sound, PatchPlace());
        return packed(is_sound, store_.put(std::move(section), index, version_, result_.edges, tables_.vertex_xyz));
      },
      [&](std::int32_t task, Bytes&& bytes) {
        const auto [f, index] = tiled.section(sections[task]);
        char is_sound = 0;
        unpack(bytes, is_sound, places[f][index]);
        if (!is_sound) unsound.insert(f);
      });
  for (auto& [f, report] : parted) {
    if (unsound.contains(f)) continue;
    places[f].push_back(report.place);
    take_face(f, std::move(report), FacePlace(std::move(places[f])));
  }
  return {unsound.begin(), unsound.end()};
}

FaceRounds::FaceResult FaceRounds::mesh_whole(FaceId f) const {
  return make_face(f, [&](const Surface& surface, const FaceBoundary& boundary, const SizeField& field) {
    if (boundary.nodes.empty() && topology_.strip_of(f)) return FaceMesh();  // closed: its neighbours share its nodes
    return mesh_face(surface, boundary, field, options_.of_face());
  });
}

/// From the mesh to the patch, or to what is to be known of a failure.
FaceRounds::FaceResult FaceRounds::make_face(FaceId f, const MakeMesh& make_mesh) const {
  const CurrentWork at_face("face", f + 1, time_limit(expected_.empty() ? 0 : expected_[f]));
  FaceMesh mesh;
  FaceResult result;
  FaceReport& report = result.report;
  FaceBoundary boundary;
  result.section.patch.face = f;
  try {
    if (const auto it = options_.left_out.find(f); it != options_.left_out.end())
      throw Error(ExitCode::kInternal, it->second);
    const auto surface = model_.surface(f);
    boundary = make_face_boundary(model_, *surface, f, *numbering_);
    const FaceField field(field_, refinements_, tables_.face_box[f]);
    mesh = make_mesh(*surface, boundary, field.get());
    repair_folds(*surface, boundary, field.get(), options_.of_face(), mesh);
    if (mesh.cause == FailureCause::kNone) result.section.patch = make_patch(tables_, f, boundary, mesh, *numbering_);
    if (!has_numbers_only(result.section.patch)) {
      result.section.patch = FacePatch();
      result.section.patch.face = f;
      throw Error(ExitCode::kGeometry,
                  "a place or (u,v) of its mesh is no number; repair its surface in the CAD system");
    }
  } catch (const Error& e) {
    mesh.cause = FailureCause::kError;
    report.error = e.what();
  }
  if (mesh.cause != FailureCause::kNone) report.failed = describe_failure(*numbering_, f, boundary, mesh);
  report.cause = mesh.cause;
  report.wanted = std::move(mesh.refinement);
  report.n_folds = mesh.n_folds;
  return result;
}

/// Local, on rank 0.
void FaceRounds::take_face(FaceId f, FaceReport&& report, FacePlace&& place) {
  require_countable(static_cast<std::uint64_t>(place.n_triangles()), "triangles of a face", kMaxTriangles);
  FaceOutcome& o = outcomes_[f];
  n_meshed_ += static_cast<std::uint64_t>(place.n_triangles());
  hopeless_.add_meshed(f, place.n_triangles());
  places_[f] = std::move(place);
  o.cause = report.cause;
  o.error = std::move(report.error);
  o.failed = std::move(report.failed);
  o.is_closed = false;
  o.n_folds = report.n_folds;
  o.fold_places = report.n_folds ? report.wanted : std::vector<RefinementPoint>();
  o.failed_places = report.cause == FailureCause::kNone ? std::vector<RefinementPoint>() : report.wanted;
  o.cause_xyz = report.wanted.empty() ? tables_.face_box[f].center() : report.wanted[0].x;
  crossings_.renew(f);
  wanted_[f] = std::move(report.wanted);
}

bool FaceRounds::has_holes() const {
  return std::any_of(outcomes_.begin(), outcomes_.end(), [](const FaceOutcome& o) { return o.is_hole(); });
}

/// Where refining made a face fail for good: the mesh before it. A fold or a crossing is better than a hole. Where a
/// face fails in any case, its loops are closed.
void FaceRounds::join() {
  char restores = whole_ && has_holes();
  share(executor_, restores);
  is_restored_ = restores != 0;
  if (!is_restored_) return close_holes();
  EdgeMesh& edges = result_.edges;
  if (executor_.is_root()) {
    edges = std::move(whole_->edges);
    for (auto& [f, before] : whole_->faces) {
      places_[f] = before.first;
      outcomes_[f] = std::move(before.second);
      crossings_.renew(f);
    }
  }
  share(executor_, edges);
  numbering_.emplace(topology_, edges);
}

/// Local, on rank 0. What cannot be closed either stays a hole.
void FaceRounds::close_holes() {
  for (FaceId f = 0; f < tables_.n_faces(); ++f) try {
      if (outcomes_[f].is_hole() && !options_.left_out.contains(f)) close_hole(f);
    } catch (const Error& e) {
      log_info(fmt::format("{} is not closed either: {}", tables_.face_label(f), e.what()));
    }
}

void FaceRounds::close_hole(FaceId f) {
  const CurrentWork at_face("face", f + 1, time_limit(expected_.empty() ? 0 : expected_[f]));
  const FaceField field(field_, refinements_, tables_.face_box[f]);
  std::unique_ptr<Surface> surface;
  FaceBoundary boundary;
  try {
    surface = model_.surface(f);
    boundary = make_face_boundary(model_, *surface, f, *numbering_);
  } catch (const Error&) {
    surface.reset();
    boundary = make_boundary_in_space(f, *numbering_);
  }
  const ClosedFace closed = close_loops(surface.get(), boundary, field.get(), kNearEnough * cad_tolerance(tables_, f));
  if (closed.mesh.cause != FailureCause::kNone) return;
  FacePatch patch = make_patch(tables_, f, boundary, closed.mesh, *numbering_);
  if (!has_numbers_only(patch)) return;
  FaceOutcome& o = outcomes_[f];
  o.is_closed = true;
  o.is_near = closed.is_near;
  o.deviation = closed.deviation;
  put(f, std::move(patch));
}

/// None where the mesh before was restored: refining does not help.
std::vector<RefinementPoint> FaceRounds::find_crossings() {
  return_freed_memory();
  crossings_.run(*numbering_, places_);
  result_.n_crossing_pairs = crossings_.n_pairs();
  if (is_restored_) return {};
  give_up(true);
  return crossings_.places_to_refine(*numbering_, places_);
}

void FaceRounds::choose_again(std::size_t first_refinement) {
  if (executor_.is_root()) find_dirty(std::span(refinements_.all()).subspan(first_refinement));
  share(executor_, dirty_edges_, dirty_faces_);
  log_info("refining at " + std::to_string(refinements_.all().size() - first_refinement) + " places: " +
           std::to_string(dirty_edges_.size()) + " edges, " + std::to_string(dirty_faces_.size()) + " faces again");
  if (executor_.is_root()) remember_whole();
  drop_replaced();
}

/// Before the dirty faces are meshed again.
void FaceRounds::remember_whole() {
  if (!has_holes()) whole_ = WholeMesh{result_.edges, {}};
  if (!whole_) return;
  for (const FaceId f : dirty_faces_) whole_->faces.try_emplace(f, places_[f], outcomes_[f]);
}

/// Collective. Patches that are neither part of the mesh nor of the one to go back to.
void FaceRounds::drop_replaced() {
  std::vector<PlacedPatch> live;
  const auto add = [&](FaceId f, const FacePlace& place) {
    for (const PatchPlace& section : place.sections) live.push_back({f, section});
  };
  for (FaceId f = 0; f < tables_.n_faces(); ++f) add(f, places_[f]);
  if (whole_)
    for (const auto& [f, before] : whole_->faces) add(f, before.first);
  share(executor_, live);
  store_.keep_only(live);
}

/// Edges and faces of the plan that these reach.
void FaceRounds::find_dirty(std::span<const Refinement> refinements) {
  std::vector<std::pair<EdgeId, EdgeId>> followers;
  for (const FacingEdges& f : facing_)
    for (const FacingEdges::Leader& l : f.leaders) followers.push_back({f.edge, l.edge});
  const DirtyParts dirty_parts = find_dirty_parts(topology_, result_.edges, refinements, followers);
  const auto of_plan = [](const std::vector<std::int32_t>& plan, const std::vector<char>& is_dirty) {
    std::vector<std::int32_t> dirty;
    std::copy_if(plan.begin(), plan.end(), std::back_inserter(dirty), [&](std::int32_t i) { return is_dirty[i]; });
    return dirty;
  };
  dirty_edges_ = of_plan(plan_.edges, dirty_parts.edge);
  dirty_faces_ = of_plan(plan_.faces, dirty_parts.face);
}

}  // namespace st
