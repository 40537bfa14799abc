#include "meshing/engine/remesher.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/share.h"
#include "meshing/hole/hole_crossing.h"
#include "meshing/hole/hole_merger.h"

namespace st {
namespace {

constexpr std::int32_t kRunsPerTask = 64;
constexpr int kGrowth[] = {2, 6};  // layers by which a hole grows when it cannot be filled; then the whole face is done
                                   // again
constexpr double kCrossingFloor = 1.0 / 8;       // of the requested length: refinement of crossing facets ends there
constexpr std::size_t kMaxCrossingPlaces = 500;  // refined in one round

std::vector<std::int32_t> in_order(std::size_t n) {
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

void pack(Packer& p, const HoleRim& rim) {
  p.add(rim.face);
  p.add(rim.is_whole_face);
  p.add(rim.is_turned);
  p.add(rim.nodes);
  p.add(rim.free_sides);
  p.add(rim.cad_sides);
}

void unpack(Unpacker& u, HoleRim& rim) {
  u.get(rim.face);
  u.get(rim.is_whole_face);
  u.get(rim.is_turned);
  u.get(rim.nodes);
  u.get(rim.free_sides);
  u.get(rim.cad_sides);
}

void pack(Packer& p, const HoleFill& fill) {
  p.add(fill.id);
  p.add(fill.uv);
  p.add(fill.inner);
  p.add(fill.triangles);
}

void unpack(Unpacker& u, HoleFill& fill) {
  u.get(fill.id);
  u.get(fill.uv);
  u.get(fill.inner);
  u.get(fill.triangles);
}

}  // namespace

Remesher::Remesher(const Model& model, const HoleMesh& mesh, const MeshShare& share, const SizeField& field,
                   const RemesherOptions& options, const Executor& executor)
    : model_(model),
      old_(mesh),
      share_(share),
      field_(field),
      options_(options),
      executor_(executor),
      refinements_(field) {}

void Remesher::analyse() {
  const Timer timer;
  const NodeId n_nodes = static_cast<NodeId>(old_.mesh.node_xyz.size()), n_on_edges = old_.inner_begin[0];
  std::vector<char> is_needed(n_nodes, 0);
  std::fill(is_needed.begin(), is_needed.begin() + n_on_edges, 1);
  for (TriangleId t = share_.begin; t < share_.end; ++t)
    for (const NodeId n : old_.mesh.triangles[t].n) is_needed[n] = 1;
  wanted_.assign(n_nodes, 0);
  int hint = 0;
  for (NodeId n = 0; n < n_nodes; ++n)
    if (is_needed[n]) wanted_[n] = field_.size(old_.mesh.node_xyz[n], hint);
  share_curve_lengths();
  mark();
  n_marked_triangles = marks.n_triangles();
  n_marked_segments = std::count(marks.segment.begin(), marks.segment.end(), 1);
  Hasher hasher;
  hasher.add(std::span<const char>(marks.triangle));
  hasher.add(std::span<const char>(marks.segment));
  marks_hash = hasher.hex();
  seconds_analysis = timer.seconds();
}

/// Collective. Which segments of curves go is decided by rank 0's lengths: all ranks act on it.
void Remesher::share_curve_lengths() {
  std::vector<double> on_edges(wanted_.begin(), wanted_.begin() + old_.inner_begin[0]);
  share(executor_, on_edges);
  std::copy(on_edges.begin(), on_edges.end(), wanted_.begin());
}

/// The requested lengths with the refinements so far.
std::vector<double> Remesher::refined_lengths() const {
  std::vector<double> wanted = wanted_;
  const auto refine = [&](NodeId n, const Refinement& r) {
    if (const double d = distance(old_.mesh.node_xyz[n], r.x); d < r.reach)
      wanted[n] = std::min(wanted[n], r.length + kRefinementSlope * d);
  };
  for (const Refinement& r : refinements_.all()) {
    for (NodeId n = 0; n < old_.inner_begin[0]; ++n) refine(n, r);
    for (FaceId f = 0; f < model_.tables().n_faces(); ++f)
      if (box_distance(model_.tables().face_box[f], r.x) <= r.reach)
        for (NodeId n = old_.inner_begin[f]; n < old_.inner_begin[f + 1]; ++n) refine(n, r);
  }
  return wanted;
}

/// Collective.
void Remesher::mark() {
  NodeExchange exchange;
  if (executor_.size() > 1) exchange = [this](const std::vector<TouchedNode>& own) { return this->exchange(own); };
  marks = mark_share(old_, share_, refined_lengths(), options_.mark, exchange);
  collect_marks();
  dirty_faces.clear();
  for (FaceId f = 0; f < model_.tables().n_faces(); ++f) {
    const auto first = marks.triangle.begin() + old_.face_begin[f],
               last = marks.triangle.begin() + old_.face_begin[f + 1];
    if (std::find(first, last, 1) != last) dirty_faces.push_back(f);
  }
}

/// Collective.
std::vector<TouchedNode> Remesher::exchange(const std::vector<TouchedNode>& own) const {
  Packer p;
  p.add(own);
  Bytes all;
  for (const Bytes& bytes : executor_.gather(p.take())) all.insert(all.end(), bytes.begin(), bytes.end());
  executor_.broadcast(all);
  std::vector<TouchedNode> touched, part;
  for (Unpacker u(all); !u.is_empty();) {
    u.get(part);
    touched.insert(touched.end(), part.begin(), part.end());
  }
  return touched;
}

/// Collective. The marks of all ranks' triangles on rank 0.
void Remesher::collect_marks() {
  if (executor_.size() == 1) return;
  Packer p;
  p.add(share_.first_triangle + share_.begin);
  p.add(std::vector<char>(marks.triangle.begin() + share_.begin, marks.triangle.begin() + share_.end));
  for (const Bytes& bytes : executor_.gather(p.take())) {
    TriangleId first = 0;
    std::vector<char> part;
    Unpacker u(bytes);
    u.get(first);
    u.get(part);
    std::copy(part.begin(), part.end(), marks.triangle.begin() + first);
  }
}

void Remesher::run() {
  for (;;) {
    ++n_rounds;
    Timer timer;
    redo_curves();
    seconds_edges += timer.seconds();
    timer = Timer();
    redo_holes();
    seconds_faces += timer.seconds();
    edges = update_.edges;
    if (!failed_faces.empty()) return;
    timer = Timer();
    if (executor_.is_root()) {
      renew_surrounded_nodes();
      mesh = insert_fills(*numbering_, marks, fills_);
    }
    seconds_merge += timer.seconds();
    timer = Timer();
    const bool again = refine_crossings();
    seconds_crossing += timer.seconds();
    if (!again) return;
    mark();
  }
}

std::vector<FacePatch> Remesher::all_patches() const {
  std::vector<FacePatch> all;
  for (FaceId f = 0; executor_.is_root() && f < model_.tables().n_faces(); ++f)
    all.push_back(make_hole_patch(f, marks, *numbering_, fills_[f]));
  return all;
}

void Remesher::redo_holes() {
  fills_.assign(model_.tables().n_faces(), {});
  std::vector<FaceId> faces = dirty_faces;
  for (std::size_t step = 0;; ++step) {
    const std::vector<HoleRim> rims = find_rims(faces);
    if (rims.empty()) return;
    faces.clear();
    for (const std::int32_t i : fill(rims)) {
      if (faces.empty() || faces.back() != rims[i].face) faces.push_back(rims[i].face);
      if (step > std::size(kGrowth)) continue;
      ++n_grown;
      if (executor_.is_root()) grow(rims[i], step);
    }
    for (const FaceId f : faces) fills_[f].clear();
    if (step <= std::size(kGrowth)) continue;
    failed_faces = faces;
    return;
  }
}

/// By layers first, then to the whole face.
void Remesher::grow(const HoleRim& rim, std::size_t step) {
  if (step < std::size(kGrowth))
    grow_hole(old_, rim.face, rim.triangles, kGrowth[step], marks);
  else
    std::fill(marks.triangle.begin() + old_.face_begin[rim.face],
              marks.triangle.begin() + old_.face_begin[rim.face + 1], 1);
}

/// Collective. By face; on every rank, their triangles on rank 0.
std::vector<HoleRim> Remesher::find_rims(const std::vector<FaceId>& faces) const {
  std::vector<HoleRim> rims;
  if (executor_.is_root())
    for (const FaceId f : faces)
      for (HoleRim& rim : find_hole_rims(old_, marks, f)) rims.push_back(std::move(rim));
  if (executor_.size() == 1) return rims;
  Packer p;
  for (const HoleRim& rim : rims) pack(p, rim);
  Bytes bytes = p.take();
  executor_.broadcast(bytes);
  if (executor_.is_root()) return rims;
  for (Unpacker u(bytes); !u.is_empty();) unpack(u, rims.emplace_back());
  return rims;
}

void Remesher::redo_curves() {
  const std::vector<SegmentRun> runs = marked_runs(old_, marks);
  const std::vector<int> least = min_segments_per_edge(model_.tables());
  const auto n_runs = static_cast<std::int32_t>(runs.size());
  const std::int32_t n_tasks = (n_runs + kRunsPerTask - 1) / kRunsPerTask;
  std::vector<CurveNodes> fresh(n_runs);
  const auto first = [&](std::int32_t task) { return task * kRunsPerTask; };
  const auto last = [&](std::int32_t task) { return std::min(n_runs, (task + 1) * kRunsPerTask); };
  const auto compute = [&](std::int32_t task) {
    Packer p;
    for (std::int32_t r = first(task); r < last(task); ++r) {
      Box3 box;
      for (std::int32_t i = runs[r].first; i <= runs[r].last; ++i) box.add(old_.edges.node_xyz[i]);
      const RefinedField field(field_, refinements_.near(box));
      const CurveNodes n = discretise_run(old_, runs[r], *model_.curve(runs[r].edge), field,
                                          {options_.max_turning_deg, least[runs[r].edge]});
      p.add(n.t);
      p.add(n.x);
      p.add(n.h);
    }
    return p.take();
  };
  std::vector<Bytes> results(n_tasks);
  executor_.run_tasks(n_tasks, in_order(n_tasks), compute,
                      [&](std::int32_t task, Bytes&& result) { results[task] = std::move(result); });
  for (std::int32_t task = 0; task < n_tasks; ++task) {
    executor_.broadcast(results[task]);
    Unpacker u(results[task]);
    for (std::int32_t r = first(task); r < last(task); ++r) {
      u.get(fresh[r].t);
      u.get(fresh[r].x);
      u.get(fresh[r].h);
    }
  }
  update_ = update_edges(old_, runs, fresh);
  request_curve_lengths();
  numbering_.emplace(old_, update_);
}

/// New nodes were asked for by the field, whatever was refined.
void Remesher::request_curve_lengths() {
  int hint = 0;
  EdgeMesh& e = update_.edges;
  for (std::size_t i = 0; i < e.node_t.size(); ++i)
    if (e.node_previous[i] == kNone) e.node_request[i] = field_.size(e.node_xyz[i], hint);
}

HoleFill Remesher::fill_hole(const HoleRim& rim) const {
  HoleFill fill;
  try {
    const std::vector<Refinement> near = refinements_.near(model_.tables().face_box[rim.face]);
    const RefinedField refined(field_, near);
    const SizeField& field = near.empty() ? field_ : refined;
    const auto surface = model_.surface(rim.face);
    const FaceBoundary boundary = make_hole_boundary(model_, *surface, rim, marks, *numbering_, field);
    FaceMeshOptions options;
    options.enhance_rounds = options_.enhance_rounds;
    FaceMesh filled = mesh_face(*surface, boundary, field, options);
    if (filled.cause == FailureCause::kNone && filled.n_folds == 0)
      fill = make_hole_fill(rim, boundary, std::move(filled));
  } catch (const Error&) {  // no triangles: the hole grows
  }
  int hint = 0;
  for (FaceMesh::InnerNode& n : fill.inner) n.h = field_.size(n.x, hint);
  return fill;
}

/// Collective. Fills the holes; returns those where it failed, ascending.
std::vector<std::int32_t> Remesher::fill(const std::vector<HoleRim>& rims) {
  std::vector<std::int32_t> order = in_order(rims.size()), failed;
  if (executor_.is_root())
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return rims[a].triangles.size() > rims[b].triangles.size();
    });
  share(executor_, order);
  std::vector<HoleFill> fills(rims.size());
  const auto compute = [&](std::int32_t task) {
    Packer p;
    pack(p, fill_hole(rims[task]));
    return p.take();
  };
  executor_.run_tasks(static_cast<std::int32_t>(rims.size()), order, compute, [&](std::int32_t task, Bytes&& result) {
    Unpacker u(result);
    unpack(u, fills[task]);
  });
  for (std::size_t i = 0; executor_.is_root() && i < rims.size(); ++i) {
    if (fills[i].triangles.empty()) failed.push_back(static_cast<std::int32_t>(i));
    fills_[rims[i].face].push_back(std::move(fills[i]));
  }
  share(executor_, failed);
  return failed;
}

/// Nodes that stay although all their triangles are new were asked for by the new sizes as well.
void Remesher::renew_surrounded_nodes() {
  std::vector<char> is_held(old_.inner_begin[0], 0);
  const auto hold = [&](TriangleId t) {
    for (NodeId n : old_.mesh.triangles[t].n)
      if (n < old_.inner_begin[0]) is_held[n] = 1;
  };
  for (TriangleId t = 0; t < static_cast<TriangleId>(marks.triangle.size()); ++t)
    if (!marks.triangle[t]) hold(t);
  int hint = 0;
  for (std::size_t i = 0; i < edges.node_t.size(); ++i)
    if (const NodeId n = edges.node_previous[i]; n != kNone && !is_held[n])
      edges.node_request[i] = field_.size(edges.node_xyz[i], hint);
  update_.edges.node_request = edges.node_request;
}

/// Collective. False when all places are as fine already, or cannot become finer. Rank 0 decides.
bool Remesher::accept(const std::vector<RefinementPoint>& places) {
  const std::size_t n_before = refinements_.all().size();
  for (const RefinementPoint& p : places) refinements_.add(p, kCrossingFloor);
  std::vector<Refinement> all = refinements_.all();
  share(executor_, all);
  n_refinements += static_cast<int>(all.size() - n_before);
  const bool any = all.size() > n_before;
  refinements_.assign(std::move(all));
  return any;
}

/// Triangles that cross a new one: both are asked to be half as large and done again. False when there are none, or no
/// help.
bool Remesher::refine_crossings() {
  std::vector<RefinementPoint> places;
  if (executor_.is_root()) {
    n_crossing_pairs = 0;
    for (const TrianglePair& pair : find_new_crossings(mesh, model_.tables().face_shell)) {
      ++n_crossing_pairs;
      for (TriangleId t : {pair.a, pair.b}) {
        if (places.size() >= kMaxCrossingPlaces) break;
        Vec3 x[3];
        for (int k = 0; k < 3; ++k) x[k] = mesh.node_xyz[mesh.triangles[t].n[k]];
        places.push_back({(x[0] + x[1] + x[2]) / 3,
                          0.5 * std::sqrt(std::max({norm2(x[0] - x[1]), norm2(x[1] - x[2]), norm2(x[2] - x[0])}))});
        if (mesh.triangle_previous[t] != kNone) options_.mark.redo.push_back(mesh.triangle_previous[t]);
      }
    }
  }
  char crosses = !places.empty();
  share(executor_, crosses, options_.mark.redo);
  if (!crosses || n_rounds > options_.max_crossing_rounds) return false;
  const bool any = accept(places);
  if (any && executor_.is_root()) log_info("refining where new triangles cross others");
  return any;
}

}  // namespace st
