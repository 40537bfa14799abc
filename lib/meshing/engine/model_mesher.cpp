#include "meshing/engine/model_mesher.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/log.h"
#include "base/share.h"
#include "mesh/patch_crossing.h"
#include "meshing/engine/joined_patches.h"
#include "meshing/face/face_patch.h"
#include "meshing/topology/small_features.h"

namespace st {
namespace {

constexpr std::int32_t kEdgesPerTask = 24;
// of the requested length, where refinements end
constexpr double kLoopFloor = 1.0 / 16;           // of loops, folds and narrow parts
constexpr double kCrossingFloor = 1.0 / 8;        // of crossing facets
constexpr double kPromisingFloor = 1.0 / 64;      // likewise where few cross, or ever fewer
constexpr std::size_t kFewCrossings = 200;        // places
constexpr double kPromising = 0.8;                // of the places before: as many or less is getting better
constexpr std::size_t kMaxCrossingPlaces = 2000;  // proposed in one round

std::vector<std::int32_t> heaviest_first(const std::vector<double>& weight) {
  std::vector<std::int32_t> order(weight.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return weight[a] > weight[b]; });
  return order;
}

void pack(Packer& p, EdgeId e, const CurveNodes& nodes) {
  p.add(e);
  p.add(nodes.t);
  p.add(nodes.x);
  p.add(nodes.h);
}

}  // namespace

ModelMesher::ModelMesher(const Model& model, const SizeField& field, std::vector<double> face_weight,
                         const ModelMesherOptions& options, const Executor& executor)
    : model_(model),
      field_(field),
      options_(options),
      executor_(executor),
      topology_(model.tables(), find_small_features()),
      tables_(topology_.tables()),
      face_tolerance_(face_tolerances(tables_.group_names())),
      face_weight_(std::move(face_weight)),
      refinements_(field) {
  const ModelTables& t = tables_;
  min_segments_ = min_segments_per_edge(t);
  if (static_cast<std::int32_t>(face_weight_.size()) != t.n_faces()) face_weight_ = t.face_area;
  patches.resize(t.n_faces());
  outcomes_.resize(t.n_faces());
  face_is_fresh_.assign(t.n_faces(), 1);
  edges = EdgeMesh::of_edges(t.n_edges());
  edge_in_scope_.assign(t.n_edges(), 1);
  face_in_scope_.assign(t.n_faces(), 1);
}

/// Collective. Rank 0 decides.
MergedFeatures ModelMesher::find_small_features() const {
  if (options_.merged) return *options_.merged;
  MergedFeatures merged;
  if (executor_.is_root()) merged = find_merged_features(model_, field_, options_.merge_below);
  share(executor_, merged.edge, merged.strip_face, merged.strip_kept, merged.strip_closed, merged.strip_is_opposed);
  return merged;
}

void ModelMesher::limit_scope(const std::vector<EdgeId>& edges_in, const std::vector<FaceId>& faces_in) {
  std::fill(edge_in_scope_.begin(), edge_in_scope_.end(), 0);
  std::fill(face_in_scope_.begin(), face_in_scope_.end(), 0);
  for (EdgeId e : edges_in) edge_in_scope_[e] = 1;
  for (FaceId f : faces_in) face_in_scope_[f] = 1;
}

void ModelMesher::run() {
  std::vector<EdgeId> all_edges;
  for (EdgeId e = 0; e < tables_.n_edges(); ++e)
    if (!tables_.edge_is_degenerate[e]) all_edges.push_back(e);
  std::vector<FaceId> all_faces(tables_.n_faces());
  std::iota(all_faces.begin(), all_faces.end(), 0);
  rounds(std::move(all_edges), std::move(all_faces));
}

void ModelMesher::run_part(const std::vector<FaceId>& faces, EdgeMesh fixed) {
  const ModelTables& t = tables_;
  if (!fixed.edge_offsets.empty()) edges = std::move(fixed);
  std::vector<char> used(t.n_edges(), 0);
  for (FaceId f : faces)
    for (const EdgeId e : t.edges_of(f)) used[e] = 1;
  for (const MeshTopology::Strip& strip : topology_.strips())
    if (used[strip.closed]) used[strip.kept] = 1;
  std::vector<EdgeId> dirty;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (used[e] && !t.edge_is_degenerate[e] && edges.n_nodes(e) == 0) dirty.push_back(e);
  limit_scope(dirty, faces);
  rounds(std::move(dirty), faces);
}

void ModelMesher::run_from(EdgeMesh old_edges, std::vector<FacePatch> old_patches,
                           const std::vector<FaceId>& faces_to_redo) {
  edges = std::move(old_edges);
  patches = std::move(old_patches);
  patches.resize(tables_.n_faces());
  std::vector<char> redo(tables_.n_faces(), 0);
  for (FaceId f : faces_to_redo) redo[f] = 1;
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  tables_.edge_faces(offsets, faces);
  std::vector<EdgeId> dirty;
  for (EdgeId e = 0; e < tables_.n_edges(); ++e) {
    bool all = !tables_.edge_is_degenerate[e] && offsets[e + 1] > offsets[e];
    if (!options_.keep_edge.empty()) all = all && !options_.keep_edge[e];
    for (std::int32_t i = offsets[e]; i < offsets[e + 1]; ++i) all = all && redo[faces[i]];
    if (all) dirty.push_back(e);
  }
  limit_scope(dirty, faces_to_redo);
  rounds(std::move(dirty), faces_to_redo);
}

void ModelMesher::rounds(std::vector<EdgeId> dirty_edges, std::vector<FaceId> dirty_faces) {
  int n_crossing_rounds = 0;
  std::size_t n_last = 0;  // places of the last search for crossings
  for (;;) {
    Timer timer;
    mesh_edges(dirty_edges);
    times.edges += timer.seconds();
    timer = Timer();
    std::vector<RefinementPoint> wanted = mesh_faces(dirty_faces);
    times.faces += timer.seconds();
    ++n_rounds;
    const bool may_refine = n_rounds - n_crossing_rounds <= options_.max_rounds;
    if (may_refine && accept(wanted, kLoopFloor, dirty_edges, dirty_faces)) {
      keep_whole(dirty_faces);
      continue;
    }
    const bool restored = restore_whole();
    timer = Timer();
    wanted = find_crossings();
    times.crossing += timer.seconds();
    const bool is_promising = wanted.size() <= kFewCrossings || wanted.size() < kPromising * n_last;
    const int max_crossing_rounds = is_promising ? options_.max_promising_rounds : options_.max_crossing_rounds;
    if (restored || wanted.empty() || n_crossing_rounds++ >= max_crossing_rounds) break;
    n_last = wanted.size();
    if (!accept(wanted, is_promising ? kPromisingFloor : kCrossingFloor, dirty_edges, dirty_faces)) break;
    keep_whole(dirty_faces);
  }
  if (!executor_.is_root()) return;
  for (FaceId f = 0; f < tables_.n_faces(); ++f) {
    const FaceOutcome& o = outcomes_[f];
    folds.insert(folds.end(), o.fold_places.begin(), o.fold_places.end());
    if (o.cause != FailureCause::kNone)
      failures.push_back({f, o.error.empty() ? text_of(o.cause) : o.error, remedy_of(o.cause), o.cause_xyz});
  }
  for (auto& [f, failed] : failed_faces_) failed_faces.push_back(std::move(failed));
}

/// Before `dirty` are redone.
void ModelMesher::keep_whole(const std::vector<FaceId>& dirty) {
  if (!executor_.is_root()) return;
  if (failed_faces_.empty()) whole_ = WholeMesh{edges, {}};
  if (!whole_) return;
  for (const FaceId f : dirty) whole_->faces.try_emplace(f, patches[f], outcomes_[f]);
}

/// Collective. Where refining made a face fail for good: the mesh before it. A fold or a crossing is better than a
/// hole.
bool ModelMesher::restore_whole() {
  char restores = whole_ && !failed_faces_.empty();
  share(executor_, restores);
  if (!restores) return false;
  if (executor_.is_root()) {
    edges = std::move(whole_->edges);
    for (auto& [f, before] : whole_->faces) {
      patches[f] = std::move(before.first);
      outcomes_[f] = std::move(before.second);
      face_is_fresh_[f] = 1;
    }
    failed_faces_.clear();
  }
  broadcast_edges();
  numbering_.emplace(topology_, edges);
  return true;
}

/// Collective. New places become part of the field, no finer than `floor` times the request; what they reach is done
/// again. False when none changes anything. Rank 0 decides.
bool ModelMesher::accept(const std::vector<RefinementPoint>& points, double floor, std::vector<EdgeId>& dirty_edges,
                         std::vector<FaceId>& dirty_faces) {
  const std::size_t n_before = refinements_.all().size();
  std::vector<Refinement> all;
  std::vector<EdgeId> edges_again;
  std::vector<FaceId> faces_again;
  if (executor_.is_root()) {
    for (const RefinementPoint& p : points) refinements_.add(p, floor);
    all = refinements_.all();
    if (all.size() > n_before) find_dirty(n_before, edges_again, faces_again);
  }
  share(executor_, all, edges_again, faces_again);
  if (all.size() == n_before) return false;
  n_refinements += static_cast<int>(all.size() - n_before);
  log_info("refining at " + std::to_string(all.size() - n_before) + " places: " + std::to_string(edges_again.size()) +
           " edges, " + std::to_string(faces_again.size()) + " faces again");
  refinements_.assign(std::move(all));
  dirty_edges = std::move(edges_again);
  dirty_faces = std::move(faces_again);
  return true;
}

/// Local. Edges and faces that refinements from this one on reach, with all faces of these edges; within the scope.
void ModelMesher::find_dirty(std::size_t first_refinement, std::vector<EdgeId>& dirty_edges,
                             std::vector<FaceId>& dirty_faces) const {
  const ModelTables& t = tables_;
  std::vector<char> edge_dirty(t.n_edges(), 0), face_dirty(t.n_faces(), 0);
  const std::vector<Refinement>& all = refinements_.all();
  for (std::size_t r = first_refinement; r < all.size(); ++r) {
    for (EdgeId e = 0; e < t.n_edges(); ++e)
      for (std::int32_t i = edges.first_node(e); !edge_dirty[e] && i < edges.first_node(e) + edges.n_nodes(e); ++i)
        edge_dirty[e] = distance(edges.node_xyz[i], all[r].x) < all[r].reach + edges.node_size[i];
    for (FaceId f = 0; f < t.n_faces(); ++f) face_dirty[f] |= box_distance(t.face_box[f], all[r].x) < all[r].reach;
  }
  for (const MeshTopology::Strip& strip : topology_.strips())
    edge_dirty[strip.closed] = edge_dirty[strip.kept] |= edge_dirty[strip.closed];
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const LoopId l : t.loops(f))
      for (const CoedgeId c : t.loop_coedges(l)) face_dirty[f] |= edge_dirty[t.coedge_edge[c]];
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (edge_dirty[e] && edge_in_scope_[e]) dirty_edges.push_back(e);
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (face_dirty[f] && face_in_scope_[f]) dirty_faces.push_back(f);
}

Bytes ModelMesher::compute_edges(const std::vector<EdgeId>& batch) const {
  const ModelTables& t = tables_;
  Packer packer;
  for (EdgeId e : batch) {
    if (topology_.strip_closed_at(e)) continue;
    const auto curve = model_.curve(e);
    Box3 box;
    const int n_samples = 32;
    for (int i = 0; i <= n_samples; ++i)
      box.add(curve->point(curve->t_min() + (curve->t_max() - curve->t_min()) * i / n_samples));
    const double margin = 0.05 * box.diagonal();
    box.lo -= {margin, margin, margin};
    box.hi += {margin, margin, margin};
    const RefinedField field(field_, refinements_.near(box));
    CurveNodes nodes = discretise_curve(*curve, field, {options_.max_turning_deg, min_segments_[e]});
    nodes.x.front() = t.vertex_xyz[t.edge_vertices[2 * e]];
    nodes.x.back() = t.vertex_xyz[t.edge_vertices[2 * e + 1]];
    pack(packer, e, nodes);
    if (const auto* strip = topology_.strip_kept_at(e)) add_mirrored(*strip, *curve, nodes, packer);
  }
  return packer.take();
}

/// The nodes of a strip's other edge follow those of the kept one.
void ModelMesher::add_mirrored(const MeshTopology::Strip& strip, const Curve& curve, const CurveNodes& nodes,
                               Packer& packer) const {
  const EdgeId closed = strip.closed;
  const double tolerance = face_tolerance_.empty() ? 0 : face_tolerance_[strip.face];
  CurveNodes mirrored =
      mirror_nodes(curve, nodes, *model_.curve(closed), strip.is_opposed, {options_.merge_below, tolerance});
  mirrored.x.front() = tables_.vertex_xyz[tables_.edge_vertices[2 * closed]];
  mirrored.x.back() = tables_.vertex_xyz[tables_.edge_vertices[2 * closed + 1]];
  pack(packer, closed, mirrored);
}

void ModelMesher::mesh_edges(const std::vector<EdgeId>& dirty) {
  const std::int32_t n_tasks = (static_cast<std::int32_t>(dirty.size()) + kEdgesPerTask - 1) / kEdgesPerTask;
  const std::int32_t n_edges = tables_.n_edges();
  std::vector<CurveNodes> fresh(n_edges);
  std::vector<std::int32_t> order(n_tasks);
  std::iota(order.begin(), order.end(), 0);
  const auto batch_of = [&](std::int32_t task) {
    const auto first = dirty.begin() + static_cast<std::ptrdiff_t>(task) * kEdgesPerTask;
    const auto last =
        static_cast<std::size_t>(task + 1) * kEdgesPerTask < dirty.size() ? first + kEdgesPerTask : dirty.end();
    return std::vector<EdgeId>(first, last);
  };
  executor_.run_tasks(
      n_tasks, order, [&](std::int32_t task) { return compute_edges(batch_of(task)); },
      [&](std::int32_t, Bytes&& result) {
        Unpacker u(result);
        while (!u.is_empty()) {
          EdgeId e;
          u.get(e);
          u.get(fresh[e].t);
          u.get(fresh[e].x);
          u.get(fresh[e].h);
        }
      });
  if (executor_.is_root()) {
    EdgeMesh next;
    for (EdgeId e = 0; e < n_edges; ++e) fresh[e].t.empty() ? next.append(edges, e) : next.append(fresh[e]);
    edges = std::move(next);
  }
  broadcast_edges();
  numbering_.emplace(topology_, edges);
}

void ModelMesher::broadcast_edges() {
  share(executor_, edges.edge_offsets, edges.node_t, edges.node_xyz, edges.node_size);
}

Bytes ModelMesher::compute_face(FaceId f) const {
  FaceMesh mesh;
  FacePatch patch;
  FaceBoundary boundary;
  std::string error;
  patch.face = f;
  try {
    const auto surface = model_.surface(f);
    boundary = make_face_boundary(model_, *surface, f, *numbering_);
    const bool is_closed_strip = boundary.nodes.empty() && topology_.strip_of(f);
    FaceMeshOptions options;
    options.enhance_rounds = options_.enhance_rounds;
    const std::vector<Refinement> near = refinements_.near(tables_.face_box[f]);
    if (is_closed_strip) {
      // no triangles: its neighbours share its nodes
    } else if (near.empty()) {
      mesh = mesh_face(*surface, boundary, field_, options);
    } else {
      mesh = mesh_face(*surface, boundary, RefinedField(field_, near), options);
    }
    if (mesh.cause == FailureCause::kNone) patch = make_patch(tables_, f, boundary, mesh, *numbering_);
  } catch (const Error& e) {
    mesh.cause = FailureCause::kError;
    error = e.what();
  }
  Packer packer;
  pack(packer, patch);
  packer.add(mesh.cause);
  packer.add(error);
  packer.add(mesh.refinement);
  packer.add(mesh.n_folds);
  if (mesh.cause != FailureCause::kNone) pack(packer, describe_failure(*numbering_, f, boundary, mesh));
  return packer.take();
}

std::vector<RefinementPoint> ModelMesher::mesh_faces(const std::vector<FaceId>& dirty) {
  std::vector<double> weight;
  for (FaceId f : dirty) weight.push_back(face_weight_[f]);
  std::vector<std::vector<RefinementPoint>> wanted(dirty.size());
  Progress progress("meshing", static_cast<double>(dirty.size()));
  std::size_t n_done = 0;
  executor_.run_tasks(
      static_cast<std::int32_t>(dirty.size()), heaviest_first(weight),
      [&](std::int32_t task) { return compute_face(dirty[task]); },
      [&](std::int32_t task, Bytes&& result) {
        const FaceId f = dirty[task];
        Unpacker u(result);
        unpack(u, patches[f]);
        face_is_fresh_[f] = 1;
        FaceOutcome& o = outcomes_[f];
        u.get(o.cause);
        u.get(o.error);
        u.get(wanted[task]);
        u.get(o.n_folds);
        failed_faces_.erase(f);
        if (o.cause != FailureCause::kNone) unpack(u, failed_faces_[f]);
        o.fold_places = o.n_folds ? wanted[task] : std::vector<RefinementPoint>();
        o.cause_xyz = wanted[task].empty() ? tables_.face_box[f].center() : wanted[task][0].x;
        progress.update(static_cast<double>(++n_done));
      });
  std::vector<RefinementPoint> all;
  for (const auto& w : wanted) all.insert(all.end(), w.begin(), w.end());
  share(executor_, all);
  return all;
}

/// Facets of one part that cross: both are refined. Searched are only pairs with a facet made since the last search.
std::vector<RefinementPoint> ModelMesher::find_crossings() {
  std::vector<RefinementPoint> places;
  if (executor_.is_root()) {
    const JoinedPatches m = join_patches(*numbering_, patches);
    std::erase_if(crossing_pairs_,
                  [&](const FacetPair& p) { return face_is_fresh_[p.face_a] || face_is_fresh_[p.face_b]; });
    std::vector<TrianglePair> pairs =
        find_crossing_patches({m.points, m.triangles, m.face_begin, tables_.face_shell, face_is_fresh_});
    std::erase_if(pairs, [](const TrianglePair& p) { return p.n_shared == 1; });  // two common nodes: folded flat onto
                                                                                  // each other
    const std::vector<TrianglePair> repeated = find_repeated_chords(*numbering_, m, face_is_fresh_);
    pairs.insert(pairs.end(), repeated.begin(), repeated.end());
    for (const TrianglePair& p : pairs) {
      const FaceId a = m.face_of(p.a), b = m.face_of(p.b);
      crossing_pairs_.push_back({a, b, p.a - m.face_begin[a], p.b - m.face_begin[b]});
    }
    std::sort(crossing_pairs_.begin(), crossing_pairs_.end());
    std::fill(face_is_fresh_.begin(), face_is_fresh_.end(), 0);
    n_crossing_pairs = static_cast<int>(crossing_pairs_.size());
    for (const FacetPair& p : crossing_pairs_) {
      if (places.size() >= kMaxCrossingPlaces) break;
      places.push_back(m.refinement_of(m.face_begin[p.face_a] + p.index_a));
      places.push_back(m.refinement_of(m.face_begin[p.face_b] + p.index_b));
    }
  }
  share(executor_, places);
  return places;
}

}  // namespace st
