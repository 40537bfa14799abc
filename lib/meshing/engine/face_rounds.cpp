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
#include "meshing/engine/close_failed.h"
#include "meshing/engine/dirty_parts.h"
#include "meshing/engine/last_resorts.h"
#include "meshing/engine/refinement_trials.h"
#include "meshing/engine/region_tasks.h"
#include "meshing/engine/stretch_easing.h"
#include "meshing/face/face_attempt.h"
#include "meshing/face/face_patch.h"
#include "meshing/face/fold_repair.h"

namespace st {
FaceRounds::FaceRounds(const Model& model, const MeshTopology& topology, const SizeField& field, MeshPlan plan,
                       const MeshOptions& options, const Executor& executor, MeshResult& result)
    : MeshRounds(field, kFacePolicy, executor, result),
      model_(model),
      topology_(topology),
      plan_(std::move(plan)),
      options_(options),
      dirty_edges_(plan_.edges),
      dirty_faces_(plan_.faces),
      edge_mesher_(model, topology, field, options, executor),
      faces_(model, topology, executor, options.parts_bodies, result.edges),
      paired_(model, topology, executor, options.pairs, faces_),
      hopeless_(topology.tables().n_faces()) {
  if (static_cast<FaceId>(plan_.face_weight.size()) == tables().n_faces())
    for (const double weight : plan_.face_weight) expected_.push_back(kTrianglesPerWeight * weight);
  if (expected_.empty()) options_.tile_triangles = 0;  // nothing tells what is heavy
  for (FaceId f = 0; f < tables().n_faces() && !options_.mends_faces; ++f) faces_.crossings().give_up(f);
  result.edges = std::move(plan_.kept_edges);
  for (FacePatch& p : std::exchange(plan_.kept_patches, {}))
    if (executor.is_root() && !p.triangles.empty()) faces_.put(p.face, std::move(p));
}

void FaceRounds::mesh_edges() { faces_.set_edges(edge_mesher_.mesh(dirty_edges_, refinements_, faces_.edges())); }

/// Collective. What these refinements reached, which are others or no more, is meshed once more: these faces. Holes are
/// closed and crossings searched unless more than `most_bad` are bad already.
std::vector<FaceId> FaceRounds::mesh_changed(const std::vector<Refinement>& changed, const char* why,
                                             std::int64_t most_bad) {
  if (executor_.is_root()) find_dirty(changed);
  share(executor_, dirty_edges_, dirty_faces_);
  log_info(fmt::format("refining at {} places {}: {} edges, {} faces again", changed.size(), why, dirty_edges_.size(),
                       dirty_faces_.size()));
  mesh_edges();
  mesh_dirty_faces();
  if (faces_.has_surely_more_bad(most_bad)) return dirty_faces_;
  close_holes();
  faces_.search_crossings();
  return dirty_faces_;
}

void FaceRounds::report(PatchesGo patches) {
  const RefinementTrials::MeshAgain mesh_again = std::bind_front(&FaceRounds::mesh_changed, this);
  RefinementTrials trials(tables(), executor_, hopeless_, faces_, refinements_, mesh_again);
  trials.take_back();
  if (!is_restored_) {
    if (is_worth_loosening()) trials.loosen();
    StretchEasing(tables(), field_, executor_, faces_, refinements_, options_.find_unheld, mesh_again).run();
  }
  refill_bad(faces_, executor_);
  if (field_.is_stretched()) mend_last_obtuse(faces_, field_.has_metrics(), executor_);
  part_touching(faces_, executor_);
  paired_.renew_images();
  faces_.hand_over(patches, result_);
}

/// Collective. Lengths that are longer mesh the faces of the last round once more.
bool FaceRounds::is_worth_loosening() const {
  std::int64_t n_again = 0;
  if (executor_.is_root())
    for (const FaceId f : dirty_faces_) n_again += n_triangles_of(faces_.place(f));
  char is_worth_it = RefinementPolicy::is_worth_loosening(result_.n_rounds, n_again);
  share(executor_, is_worth_it);
  return is_worth_it != 0;
}

/// Collective.
void FaceRounds::mesh_dirty_faces() {
  ++version_;
  std::map<FaceId, MadeFace> parted;
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
               .record = [&](const Bytes& result) { return record_whole(result); },
               .restore = [&](Bytes&& whole) { return restore_whole(std::move(whole)); }},
              TiledRegions(model_, faces_as_regions(), field_, refinements_, options_.of_face(),
                           time_limit(options_.tile_triangles)),
              made_from(), expected_.empty() ? tables().face_area : expected_, options_, executor_)
      .run(paired_.meshed_of(dirty_faces_));
  for (const FaceId f : paired_.make_images(dirty_faces_)) hopeless_.add_meshed(f, n_triangles_of(faces_.place(f)));
}

/// Folds of faces that were given up stay.
std::vector<RefinementPoint> FaceRounds::mesh_regions() {
  mesh_dirty_faces();
  give_up(false);
  const bool folds_stay = !options_.mends_faces || gives_up_folds();
  std::vector<RefinementPoint> all;
  for (const FaceId f : paired_.meshed_of(dirty_faces_))
    if (const FaceOutcome& o = faces_.outcome(f);
        !(folds_stay || hopeless_.contains(f)) || o.cause != FailureCause::kNone)
      all.insert(all.end(), o.wanted.begin(), o.wanted.end());
  return paired_.with_images(std::move(all));
}

/// Local, on rank 0. Whether smaller triangles fold no less, all faces taken together.
bool FaceRounds::gives_up_folds() {
  std::int64_t n_folds = 0;
  for (FaceId f = 0; f < tables().n_faces(); ++f)
    if (!hopeless_.contains(f)) n_folds += faces_.outcome(f).n_folds;
  return hopeless_.gives_up_folds(n_folds);
}

/// Local, on rank 0. Faces that refining did not help, by their folds or also by their crossings of the last search:
/// says so, once for each.
void FaceRounds::give_up(bool by_crossings) {
  if (!options_.mends_faces) return;
  std::vector<std::int64_t> n_crossing(tables().n_faces(), 0);
  if (by_crossings) n_crossing = faces_.crossings().n_pairs_within();
  for (FaceId f = 0; f < tables().n_faces(); ++f) {
    const std::int64_t n_bad = faces_.outcome(f).n_folds + n_crossing[f];
    if (!(by_crossings ? hopeless_.gives_up_crossing(f, n_bad) : hopeless_.gives_up_folded(f, n_bad))) continue;
    faces_.crossings().give_up(f);
    log_warning(
        fmt::format("{}: its triangles fold or cross each other {} times, and smaller ones no less: refining there was "
                    "ended; its surface is damaged or crosses itself, so repair it in the CAD system",
                    tables().face_label(f), n_bad));
  }
}

Regions FaceRounds::faces_as_regions() const {
  return {
      [](FaceId f) { return f; },
      [this](FaceId f, const Surface& surface) { return make_face_boundary(model_, surface, f, faces_.numbering()); },
      [this](const FaceBoundary& boundary) { return boundary_places(boundary, faces_.numbering()); }};
}

/// After it something must be wrong with so many triangles.
WorkLimit FaceRounds::time_limit(double n_triangles) const {
  constexpr double kAlways = 600, kPerTriangle = 50 * 3e-6;
  return {options_.time_limit.value_or(kAlways + kPerTriangle * n_triangles), options_.when_late};
}

/// A face, and a tile of it, is a function of the inputs, of the nodes on edges and of what was refined.
std::string FaceRounds::made_from() const {
  const Bytes bytes = packed(faces_.edges(), refinements_.all());
  return hash_hex(bytes.data(), bytes.size());
}

/// Local, on any rank: the patch, or its last section, stays here.
FaceRounds::MadeFace FaceRounds::keep(FaceResult&& result) {
  PatchPlace& place = result.made.place;
  place = faces_.keep(std::move(result.patch), place.section, version_);
  return std::move(result.made);
}

/// Local, on the rank of the patch: a FaceResult.
Bytes FaceRounds::record_whole(const Bytes& bytes) const {
  MadeFace made;
  unpack(bytes, made);
  if (!made.place.is_there()) return packed(FacePatch(), made);
  return packed(*faces_.store().get(made.place), made);
}

Bytes FaceRounds::restore_whole(Bytes&& whole) {
  FaceResult result;
  unpack(whole, result);
  return packed(keep(std::move(result)));
}

void FaceRounds::take_whole(FaceId f, const Bytes& bytes) {
  MadeFace made;
  unpack(bytes, made);
  take_face(f, std::move(made.outcome), place_of(made.place));
}

/// Local, on rank 0. False where a tile failed or tiles do not fit; `parted`: patches that have more sections.
bool FaceRounds::take_seams(FaceId f, const Bytes& bytes, std::map<FaceId, MadeFace>& parted) {
  MadeFace made;
  unpack(bytes, made);
  if (made.outcome.cause != FailureCause::kNone) return false;
  made.is_parted ? void(parted[f] = std::move(made)) : take_whole(f, bytes);
  return true;
}

/// The seams as the last section of the patch; the whole patch where it has folds to be repaired.
FaceRounds::FaceResult FaceRounds::mesh_seams_of(FaceId f, TiledRegions& tiled) const {
  bool is_parted = false;
  Piece seams;
  const auto make_mesh = [&](const Surface& surface, const FaceBoundary& boundary, const SizeField&) {
    seams = tiled.seams(surface, f, boundary, executor_);
    is_parted = seams.mesh.n_folds == 0 && !seams.mesh.corners.empty();
    return is_parted ? std::move(seams.mesh) : tiled.join(f, boundary, std::move(seams), executor_);
  };
  FaceResult result = make_face(f, make_mesh);
  if (!is_parted || result.made.outcome.cause != FailureCause::kNone) return result;
  result.made.is_parted = true;
  result.made.place.section = tiled.n_sections_of(f);
  result.patch.owner = std::move(seams.owner);
  return result;
}

/// Collective. What is left of tiles and groups are sections of the patches of these faces (rank 0's), where they are.
/// Returns those with numbers that are none, of which none is part of the mesh: as wholes they say what is wrong.
std::vector<FaceId> FaceRounds::store_sections(TiledRegions& tiled, std::map<FaceId, MadeFace>&& parted) {
  std::vector<std::int32_t> sections;
  for (std::int32_t s = 0; s < tiled.n_sections(); ++s)
    if (parted.contains(tiled.section(s).region)) sections.push_back(s);
  share(executor_, sections);
  std::map<FaceId, std::vector<PatchPlace>> places;
  std::set<FaceId> unsound;
  for (auto& [f, made] : parted) places[f].resize(tiled.n_sections_of(f));
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
        FacePatch section = make_section(tables(), f, tiled.take(sections[task]), faces_.numbering());
        const char is_sound = has_numbers_only(section);
        if (!is_sound) return packed(is_sound, PatchPlace());
        return packed(is_sound, faces_.keep(std::move(section), index, version_));
      },
      [&](std::int32_t task, Bytes&& bytes) {
        const auto [f, index] = tiled.section(sections[task]);
        char is_sound = 0;
        unpack(bytes, is_sound, places[f][index]);
        if (!is_sound) unsound.insert(f);
      });
  for (auto& [f, made] : parted) {
    if (unsound.contains(f)) continue;
    places[f].push_back(made.place);
    take_face(f, std::move(made.outcome), place_of(std::move(places[f])));
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
  FaceOutcome& outcome = result.made.outcome;
  FaceBoundary boundary;
  result.patch.face = f;
  try {
    if (const auto it = options_.left_out.find(f); it != options_.left_out.end())
      throw Error(ExitCode::kInternal, it->second);
    const auto surface = model_.surface(f);
    boundary = make_face_boundary(model_, *surface, f, faces_.numbering());
    const FaceField field(field_, refinements_, tables().face_box[f]);
    mesh = make_mesh(*surface, boundary, field.get());
    if (options_.mends_faces) repair_folds(*surface, boundary, field.get(), options_.of_face(), mesh);
    if (mesh.cause == FailureCause::kNone) result.patch = make_patch(tables(), f, boundary, mesh, faces_.numbering());
    if (!has_numbers_only(result.patch)) {
      result.patch = FacePatch();
      result.patch.face = f;
      throw Error(ExitCode::kGeometry,
                  "a place or (u,v) of its mesh is no number; repair its surface in the CAD system");
    }
  } catch (const Error& e) {
    mesh.cause = FailureCause::kError;
    outcome.error = e.what();
  }
  if (mesh.cause != FailureCause::kNone) outcome.attempt = describe_attempt(faces_.numbering(), f, boundary, mesh);
  outcome.cause = mesh.cause;
  outcome.wanted = std::move(mesh.refinement);
  outcome.n_folds = mesh.n_folds;
  return result;
}

/// Local, on rank 0.
void FaceRounds::take_face(FaceId f, FaceOutcome&& outcome, FacePlace&& place) {
  const std::int64_t n_triangles = n_triangles_of(place);
  require_countable(static_cast<std::uint64_t>(n_triangles), "triangles of a face", kMaxTriangles);
  n_meshed_ += static_cast<std::uint64_t>(n_triangles);
  hopeless_.add_meshed(f, n_triangles);
  faces_.set(f, std::move(place), std::move(outcome));
}

/// Where refining made a face fail for good: the mesh before it. A fold or a crossing is better than a hole. Where a
/// face fails in any case, its loops are closed.
void FaceRounds::join() {
  char restores = whole_ && faces_.has_holes();
  share(executor_, restores);
  is_restored_ = restores != 0;
  if (!is_restored_) return close_holes();
  EdgeMesh edges;
  if (executor_.is_root()) {
    edges = std::move(whole_->edges);
    for (auto& [f, before] : whole_->faces) faces_.set(f, std::move(before.first), std::move(before.second));
  }
  share(executor_, edges);
  faces_.set_edges(std::move(edges));
}

void FaceRounds::close_holes() {
  const auto limit = [this](FaceId f) { return time_limit(expected_.empty() ? 0 : expected_[f]); };
  close_failed({model_, field_, refinements_, options_.left_out, limit}, faces_);
}

/// None where the mesh before was restored: refining does not help.
std::vector<RefinementPoint> FaceRounds::find_crossings() {
  return_freed_memory();
  faces_.search_crossings();
  result_.n_crossing_pairs = faces_.crossings().n_pairs();
  n_unmeasured_pairs_ = faces_.crossings().n_unmeasured_pairs();
  if (is_restored_) return {};
  give_up(true);
  return paired_.with_images(faces_.crossings_to_refine());
}

/// Not where sizes are stretched: easing meshes faces again, and they would cross again.
bool FaceRounds::mend_crossings() {
  char is_worth_it =
      !field_.is_stretched() && RefinementPolicy::mends_first(faces_.n_bad(), n_unmeasured_pairs_, n_meshed_);
  share(executor_, is_worth_it);
  if (!is_worth_it) return false;
  return refill_all_bad(faces_, executor_);
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
  if (!faces_.has_holes()) whole_ = WholeMesh{faces_.edges(), {}};
  if (!whole_) return;
  for (const FaceId f : dirty_faces_) whole_->faces.try_emplace(f, faces_.place(f), faces_.outcome(f));
}

/// Collective. Patches that are neither part of the mesh nor of the one to go back to.
void FaceRounds::drop_replaced() {
  std::vector<FacePlace> before;
  if (whole_)
    for (const auto& [f, face] : whole_->faces) before.push_back(face.first);
  faces_.keep_only(std::move(before));
}

/// Edges and faces of the plan that these reach.
void FaceRounds::find_dirty(std::span<const Refinement> refinements) {
  DirtyParts dirty = find_dirty_parts(topology_, faces_.edges(), refinements, edge_mesher_.followers());
  paired_.spread(dirty.face);
  dirty_edges_ = chosen_of(plan_.edges, dirty.edge);
  dirty_faces_ = chosen_of(plan_.faces, dirty.face);
}

}  // namespace st
