#include "stages/raster_tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <mutex>
#include <new>
#include <numeric>
#include <utility>

#include "base/current_work.h"
#include "base/limits.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/share.h"
#include "features/cut_strips.h"
#include "sizing/cell_limit.h"
#include "sizing/common_edges.h"
#include "sizing/end_stretch.h"
#include "sizing/raster_curve.h"
#include "sizing/raster_face.h"
#include "sizing/raster_neck.h"
#include "sizing/raster_strip.h"
#include "sizing/raster_tip.h"

namespace st {
namespace {

constexpr std::int32_t kEdgesPerTask = 32;
constexpr std::size_t kPatchesPerTask = 256;

/// The work cut into tasks: first batches of edges, then one task per face.
class RasterTasks {
 public:
  explicit RasterTasks(const SampledModel& sampled)
      : model_(sampled.model),
        limits_(sampled.limits),
        strips_(sampled.strips),
        cut_strips_(find_cut_strips(model_, limits_.edge_is_smooth)),
        seconds_(sampled.seconds),
        loops_(sampled.loops),
        vertex_edge_(first_edges(model_.tables())),
        n_batches_((model_.tables().n_edges() + kEdgesPerTask - 1) / kEdgesPerTask) {}

  std::int32_t count() const { return n_batches_ + model_.tables().n_faces(); }

  /// [count()] of a face by the number of largest lengths that fit on it.
  std::vector<double> work() const {
    std::vector<double> work(static_cast<std::size_t>(count()), 0.0);
    for (std::int32_t f = 0; f < model_.tables().n_faces(); ++f)
      work[n_batches_ + f] = face_work(static_cast<std::size_t>(f));
    return work;
  }

  /// Local. The boxes of one task; returns, packed, their number, what went wrong (empty: nothing) and the patches.
  /// `on_share` gets what is done of the task meanwhile, 0 to 1 in sum.
  Bytes compute(std::int32_t task, std::vector<RasterBox>& boxes, const std::function<void(double)>& on_share) const {
    std::vector<GapPatch> patches;
    std::string failure;
    try {
      if (task < n_batches_)
        raster_edges(task, boxes);
      else
        raster_one_face(task - n_batches_, boxes, patches, on_share);
    } catch (const TooManyCells&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      boxes.clear();
      patches.clear();
      failure = task < n_batches_ ? fmt::format("edges from {} on", task * kEdgesPerTask + 1)
                                  : model_.tables().face_label(task - n_batches_);
      failure += std::string(": not sampled, ") + e.what();
    }
    Packer packer;
    packer.add(static_cast<std::uint64_t>(boxes.size()));
    packer.add(failure);
    packer.add(patches);
    return packer.take();
  }

 private:
  double face_work(std::size_t f) const {
    const ModelTables& t = model_.tables();
    if (!limits_.face[f]) return 0;
    const double flat = t.face_type[f] == SurfaceType::kPlane ? 1 : 10;
    return flat * t.face_area[f] / (limits_.face[f]->max_length * limits_.face[f]->max_length);
  }

  void raster_edges(std::int32_t batch, std::vector<RasterBox>& boxes) const {
    const EdgeId end = std::min((batch + 1) * kEdgesPerTask, model_.tables().n_edges());
    for (EdgeId e = batch * kEdgesPerTask; e < end; ++e) {
      const std::optional<SamplingLimits>& limits = limits_.edge[e];
      if (limits && !limits_.is_mere_split(e))
        raster_curve(*model_.curve(e), *limits, pack_cause(CauseKind::kEdge, e), boxes);
      raster_ends(e, boxes);
    }
  }

  /// Vertices that rules name, with the first edge that ends there as their cause.
  void raster_ends(EdgeId e, std::vector<RasterBox>& boxes) const {
    const ModelTables& t = model_.tables();
    const VertexId ends[2] = {t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]};
    for (int k = 0; k < (ends[0] == ends[1] ? 1 : 2); ++k) {
      const std::optional<SamplingLimits>& limits = limits_.vertex[ends[k]];
      if (!limits || vertex_edge_[ends[k]] != e) continue;
      const auto length = static_cast<float>(limits->max_length);
      const auto half = static_cast<float>(0.5 * limits->cell_per_length * limits->max_length);
      boxes.push_back({t.vertex_xyz[ends[k]], half, length, pack_cause(CauseKind::kEdge, e)});
    }
  }

  static std::vector<EdgeId> first_edges(const ModelTables& t) {
    std::vector<EdgeId> first(t.n_vertices(), kNone);
    for (EdgeId e = t.n_edges() - 1; e >= 0; --e) first[t.edge_vertices[2 * e]] = first[t.edge_vertices[2 * e + 1]] = e;
    return first;
  }

  void raster_one_face(FaceId f, std::vector<RasterBox>& boxes, std::vector<GapPatch>& patches,
                       const std::function<void(double)>& on_share) const {
    const CurrentWork at_face("face", f + 1, {seconds_, WhenLate::kThrow});
    const std::optional<SamplingLimits>& limits = limits_.face[f];
    if (!limits) return;
    const bool is_reversed = model_.tables().face_is_reversed[f] != 0;
    const std::size_t n_before = boxes.size();
    std::optional<ChordLimit> chord;
    if (limits_.face_wing[f] != kNone) chord.emplace(limits_.chords, limits_.face_wing[f], *limits->chord_cells);
    const Strip* strip = strip_of(f);
    SamplingLimits own = *limits;
    if (strip && strip->is_one_edge()) own.min_length = own.max_length;  // how it bends across tells nothing either
    const auto surface = model_.surface(f);
    const bool has_joined_faces = &model_.cad() != &model_;  // so cuts of others say nothing either
    const auto whole = has_joined_faces ? whole_spline(*surface) : nullptr;
    raster_face(whole ? *whole : *surface, loops_[f].emplace(loop_polygons(model_, f, limits_)), own,
                pack_cause(CauseKind::kFace, f), boxes, limits_.wants_gaps ? &patches : nullptr,
                chord ? &*chord : nullptr,
                [&](double area) { on_share(area / std::max(model_.tables().face_area[f], 1e-300)); });
    if (is_reversed)
      for (std::size_t i = n_before; i < boxes.size(); ++i) boxes[i].normal = boxes[i].normal.reversed();
    for (GapPatch& patch : patches) {
      patch.solid = model_.tables().face_solid[f];
      patch.keeps_floor = limits->has_own_min;
      if (is_reversed != limits_.is_material_ahead) patch.shape.flip();
    }
    const std::vector<SpaceSide> sides = sides_in_space(*surface, *loops_[f]);
    raster_narrow_parts(f, sides, strip, boxes);
    drop_tips(sides, *limits, n_before, boxes);
    const auto ends = [&](CoedgeId c) { return !limits_.edge_is_smooth[model_.tables().coedge_edge[c]]; };
    if (limits->max_aspect > 1) bound_stretch_at_ends(sides, ends, n_before, boxes, patches);
    if (limits->max_aspect > 1) bound_stretch_by_widths(sides, n_before, boxes);
  }

  void raster_narrow_parts(FaceId f, std::span<const SpaceSide> sides, const Strip* strip,
                           std::vector<RasterBox>& boxes) const {
    const auto counts = [&](EdgeId a, EdgeId b) {
      return !limits_.edge_is_ruled[a] && !limits_.edge_is_ruled[b] &&
             !(limits_.is_mere_split(a) && limits_.is_mere_split(b));
    };
    const std::vector<EdgeId>& edge = model_.tables().coedge_edge;
    const std::int32_t cause = pack_cause(CauseKind::kFace, f);
    if (!strip)
      raster_necks(
          sides, *limits_.face[f], cause,
          [&](CoedgeId a, CoedgeId b) { return counts(edge[a], edge[b]) && !meet_in_corner(edge[a], edge[b]); }, boxes);
    else if (counts(strip->edges[0], strip->edges[1]))
      raster_strip(*strip, *limits_.face[f], cause, boxes);
  }

  /// Two edges with a common vertex: towards it triangles are as flat at any size.
  bool meet_in_corner(EdgeId a, EdgeId b) const {
    const VertexId* v = &model_.tables().edge_vertices[2 * static_cast<std::size_t>(a)];
    const VertexId* w = &model_.tables().edge_vertices[2 * static_cast<std::size_t>(b)];
    return a != b && (v[0] == w[0] || v[0] == w[1] || v[1] == w[0] || v[1] == w[1]);
  }

  /// Null where the face is none.
  const Strip* strip_of(FaceId f) const {
    const bool is_of_wing = limits_.face_wing[f] != kNone;  // bases in pieces are narrow parts, of CAD, too
    const std::span<const Strip> cut = is_of_wing ? std::span<const Strip>() : cut_strips_;
    for (const std::span<const Strip> strips : {strips_, cut})
      if (const auto at = std::ranges::lower_bound(strips, f, {}, &Strip::face); at != strips.end() && at->face == f)
        return &*at;
    return nullptr;
  }

  const Model& model_;
  const ModelLimits& limits_;
  std::span<const Strip> strips_;
  std::vector<Strip> cut_strips_;
  double seconds_;
  FaceLoops& loops_;
  std::vector<EdgeId> vertex_edge_;  // first edge at each vertex
  std::int32_t n_batches_;
};

/// How far sampling has come: tasks by their work, large faces while they are sampled.
class SharesDone {
 public:
  explicit SharesDone(const std::vector<double>& work)
      : work_(work), told_(work.size(), 0), progress_("sampling", total(work)) {}

  /// While a task runs; any thread, one for each task.
  void add(std::int32_t task, double share) {
    const double part = std::clamp(share, 0.0, 1 - told_[task]);
    told_[task] += part;
    progress_.advance(part * (work_[task] + kLeast));
  }
  /// It has ended, here or on another rank.
  void end(std::int32_t task) { progress_.advance((1 - told_[task]) * (work_[task] + kLeast)); }

 private:
  static constexpr double kLeast = 1;  // work of any task
  static double total(const std::vector<double>& work) {
    return std::accumulate(work.begin(), work.end(), kLeast * static_cast<double>(work.size()));
  }
  const std::vector<double>& work_;
  std::vector<double> told_;  // share of each task
  Progress progress_;
};

/// Tasks of one rank run on several threads.
void append_locked(const std::vector<RasterBox>& boxes, std::mutex& mutex, std::vector<RasterBox>& all) {
  const std::lock_guard lock(mutex);
  all.insert(all.end(), boxes.begin(), boxes.end());
}

/// Collective. The patches of all faces on every rank, by task.
std::vector<GapPatch> share_patches(const Samples& samples, const Executor& comm) {
  std::vector<GapPatch> all;
  for (const std::vector<GapPatch>& p : samples.patches) all.insert(all.end(), p.begin(), p.end());
  share(comm, all);
  return all;
}

/// Packed: the cells of a face, and why there are none.
Bytes locate(const SampledModel& sampled, const OctreeShape& shape, Vec3 origin, FaceId f) {
  const auto& [model, limits, strips, seconds, loops] = sampled;
  const ModelTables& t = model.tables();
  if (t.is_joined(f)) return packed(std::vector<CellArea>(), std::string());
  const CurrentWork at_face("face", f + 1, {seconds, WhenLate::kThrow});
  std::vector<CellArea> cells;
  std::string failure;
  try {
    cells = locate_face(*model.surface(f), loops[f] ? *loops[f] : loop_polygons(model, f, limits), shape.view(),
                        t.face_area[f], origin);
  } catch (const LateWork& e) {
    failure = fmt::format("{}: its cells were not found, {}", t.face_label(f), e.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // reported when it was sampled
    cells.clear();
  }
  return packed(cells, failure);
}

}  // namespace

Samples sample_model(const SampledModel& sampled, std::uint64_t max_samples, const Executor& comm) {
  const RasterTasks tasks(sampled);
  Samples samples;
  const auto n = static_cast<std::size_t>(tasks.count());
  samples.n_boxes.resize(n);
  samples.failures.resize(n);
  samples.patches.resize(n);
  const std::vector<double> work = tasks.work();
  SharesDone shares(work);
  std::uint64_t n_samples = 0;
  std::mutex mutex;
  comm.run_tasks(
      tasks.count(), heaviest_first(work),
      [&](std::int32_t task) {
        std::vector<RasterBox> boxes;
        Bytes result = tasks.compute(task, boxes, [&](double share) { shares.add(task, share); });
        append_locked(boxes, mutex, samples.own_boxes);
        return result;
      },
      [&](std::int32_t task, Bytes&& result) {
        Unpacker unpacker(result);
        unpacker.get(samples.n_boxes[task]);
        require_samples(n_samples += samples.n_boxes[task], max_samples);
        unpacker.get(samples.failures[task]);
        unpacker.get(samples.patches[task]);
        shares.end(task);
      });
  return samples;
}

void limit_samples(const ModelTables& tables, std::uint64_t max_samples, ModelLimits& limits) {
  require_room_for(least_samples(tables, limits), max_samples);
  limits.far.max_samples = max_samples;
  for (auto* all : {&limits.face, &limits.edge})
    for (std::optional<SamplingLimits>& own : *all)
      if (own) own->max_samples = max_samples;
}

std::size_t sample_gaps(const Model& model, Samples& samples, double cell_per_length, std::uint64_t max_samples,
                        const Executor& comm) {
  const std::vector<GapPatch> patches = share_patches(samples, comm);
  const CommonEdges edges(model);
  const auto meeting_place = [&](std::int32_t a, std::int32_t b, Vec3 x) {
    return edges.nearest(cause_id(a), cause_id(b), x);
  };
  const GapFinder finder(patches, cell_per_length, meeting_place);
  require_countable(patches.size(), "samples that look for gaps");
  const auto n_tasks = static_cast<std::int32_t>((patches.size() + kPatchesPerTask - 1) / kPatchesPerTask);
  std::size_t n_boxes = 0;
  std::mutex mutex;
  Progress progress("looking for gaps", n_tasks);
  std::int32_t n_done = 0;
  comm.run_tasks(
      n_tasks, heaviest_first(std::vector<double>(static_cast<std::size_t>(n_tasks), 1.0)),
      [&](std::int32_t task) {
        std::vector<RasterBox> boxes;
        const std::size_t first = static_cast<std::size_t>(task) * kPatchesPerTask;
        for (std::size_t i = first; i < std::min(first + kPatchesPerTask, patches.size()); ++i)
          finder.add_boxes(i, boxes);
        append_locked(boxes, mutex, samples.own_boxes);
        Packer packer;
        packer.add(static_cast<std::uint64_t>(boxes.size()));
        return packer.take();
      },
      [&](std::int32_t, Bytes&& result) {
        std::uint64_t n = 0;
        Unpacker(result).get(n);
        require_samples(n_boxes += n, max_samples);
        progress.update(++n_done);
      });
  return n_boxes;
}

SampleCounts report_samples(const Samples& samples) {
  SampleCounts counts;
  counts.n_boxes = std::accumulate(samples.n_boxes.begin(), samples.n_boxes.end(), std::uint64_t{0});
  for (const std::string& failure : samples.failures) {
    if (failure.empty()) continue;
    log_warning(failure);
    ++counts.n_failures;
  }
  return counts;
}

FaceCells locate_faces(const SampledModel& sampled, const OctreeShape& shape, const std::function<void()>& meanwhile,
                       const Executor& comm, std::size_t& n_failures) {
  const ModelTables& t = sampled.model.tables();
  FaceCells faces;
  faces.origin = origin_of_places(t.box());
  std::vector<std::vector<CellArea>> by_face(static_cast<std::size_t>(t.n_faces()));
  Progress progress("locating faces", t.n_faces());
  std::int32_t n_done = 0;
  const std::int32_t other = t.n_faces();  // task
  std::vector<double> work = t.face_area;
  work.push_back(std::numeric_limits<double>::infinity());
  NamedTasks tasks{.order = heaviest_first(work), .label = {}, .made_from = "", .home = {}};
  tasks.label = [](std::int32_t task) { return TaskLabel{"task", task}; };
  tasks.home.assign(work.size(), kNone);
  tasks.home[other] = 0;
  comm.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        if (task < other) return locate(sampled, shape, faces.origin, task);
        meanwhile();
        return Bytes();
      },
      [&](std::int32_t f, Bytes&& result) {
        if (f == other) return;
        Unpacker unpacker(result);
        unpacker.get(by_face[f]);
        std::string failure;
        unpacker.get(failure);
        if (!failure.empty()) log_warning(failure);
        n_failures += !failure.empty();
        progress.update(++n_done);
      });
  for (const std::vector<CellArea>& cells : by_face) faces.append_face(cells);
  return faces;
}

}  // namespace st
