#include "stages/remesher.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/log.h"
#include "comm/packer.h"

namespace st {
namespace {

constexpr std::int32_t kNodesPerTask = 1 << 16;
constexpr std::int32_t kRunsPerTask = 64;
constexpr int kGrowth[] = {2, 6};        // layers by which a hole grows when it cannot be filled; then the whole face is done again

std::vector<std::int32_t> in_order(std::size_t n) {
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

template <class T>
void share(const Communicator& comm, std::vector<T>& values) {
  if (comm.size() == 1) return;
  Bytes bytes;
  if (comm.is_root()) {
    Packer p;
    p.add(values);
    bytes = p.take();
  }
  comm.broadcast(bytes);
  Unpacker(bytes).get(values);
}

void pack(Packer& p, const FacePatch& f) {
  p.add(f.face);
  p.add(f.n_boundary);
  p.add(f.boundary_dim);
  p.add(f.boundary_entity);
  p.add(f.boundary_index);
  p.add(f.inner_xyz);
  p.add(f.inner_uv);
  p.add(f.inner_size);
  p.add(f.inner_previous);
  p.add(f.triangles);
  p.add(f.corner_uv);
  p.add(f.triangle_previous);
}

void unpack(Unpacker& u, FacePatch& f) {
  u.get(f.face);
  u.get(f.n_boundary);
  u.get(f.boundary_dim);
  u.get(f.boundary_entity);
  u.get(f.boundary_index);
  u.get(f.inner_xyz);
  u.get(f.inner_uv);
  u.get(f.inner_size);
  u.get(f.inner_previous);
  u.get(f.triangles);
  u.get(f.corner_uv);
  u.get(f.triangle_previous);
}

}  // namespace

Remesher::Remesher(const Model& model, const HoleMesh& mesh, const SizeField& field, const RemesherOptions& options, const Communicator& comm)
    : model_(model), mesh_(mesh), field_(field), options_(options), comm_(comm) {}

void Remesher::analyse() {
  const auto n_nodes = static_cast<std::int32_t>(mesh_.mesh.node_xyz.size());
  const std::int32_t n_tasks = (n_nodes + kNodesPerTask - 1) / kNodesPerTask;
  std::vector<double> wanted(n_nodes);
  const auto begin = [&](std::int32_t task) { return task * kNodesPerTask; };
  const auto end = [&](std::int32_t task) { return std::min(n_nodes, (task + 1) * kNodesPerTask); };
  comm_.run_tasks(
      n_tasks, in_order(n_tasks),
      [&](std::int32_t task) {
        std::vector<double> sizes;
        int hint = 0;
        for (std::int32_t n = begin(task); n < end(task); ++n) sizes.push_back(field_.size(mesh_.mesh.node_xyz[n], hint));
        Packer p;
        p.add(sizes);
        return p.take();
      },
      [&](std::int32_t task, Bytes&& result) {
        std::vector<double> sizes;
        Unpacker(result).get(sizes);
        std::copy(sizes.begin(), sizes.end(), wanted.begin() + begin(task));
      });
  share(comm_, wanted);
  marks = mark_holes(mesh_, wanted, options_.mark);
  n_marked_triangles = marks.n_triangles();
  n_marked_segments = std::count(marks.segment.begin(), marks.segment.end(), 1);
  for (FaceId f = 0; f < model_.tables().n_faces(); ++f)
    if (std::find(marks.triangle.begin() + mesh_.face_begin[f], marks.triangle.begin() + mesh_.face_begin[f + 1], 1) !=
        marks.triangle.begin() + mesh_.face_begin[f + 1])
      dirty_faces.push_back(f);
}

void Remesher::run() {
  Timer timer;
  redo_curves();
  seconds_edges = timer.seconds();
  timer = Timer();
  patches.resize(model_.tables().n_faces());
  std::vector<FaceId> faces = dirty_faces;
  for (int layers : kGrowth) {
    faces = fill(faces);
    for (FaceId f : faces) grow_hole(mesh_, f, layers, marks);
    n_grown += static_cast<int>(faces.size());
  }
  faces = fill(faces);
  for (FaceId f : faces) std::fill(marks.triangle.begin() + mesh_.face_begin[f], marks.triangle.begin() + mesh_.face_begin[f + 1], 1);
  failed_faces = fill(faces);
  seconds_faces = timer.seconds();
  edges = update_.edges;
  if (!comm_.is_root()) return;
  const HoleNumbering numbering(mesh_, update_);
  std::vector<char> is_dirty(patches.size(), 0);
  for (FaceId f : dirty_faces) is_dirty[f] = 1;
  for (FaceId f = 0; f < model_.tables().n_faces(); ++f)
    if (!is_dirty[f]) patches[f] = make_hole_patch(f, marks, numbering, nullptr, nullptr);
}

void Remesher::redo_curves() {
  runs_ = marked_runs(mesh_, marks);
  const std::vector<int> least = min_segments_per_edge(model_.tables());
  const auto n_runs = static_cast<std::int32_t>(runs_.size());
  const std::int32_t n_tasks = (n_runs + kRunsPerTask - 1) / kRunsPerTask;
  std::vector<CurveNodes> fresh(n_runs);
  const auto first = [&](std::int32_t task) { return task * kRunsPerTask; };
  const auto last = [&](std::int32_t task) { return std::min(n_runs, (task + 1) * kRunsPerTask); };
  const auto compute = [&](std::int32_t task) {
    Packer p;
    for (std::int32_t r = first(task); r < last(task); ++r) {
      const CurveNodes n =
          discretise_run(mesh_, runs_[r], *model_.curve(runs_[r].edge), field_, {options_.max_turning_deg, least[runs_[r].edge]});
      p.add(n.t);
      p.add(n.x);
      p.add(n.h);
    }
    return p.take();
  };
  std::vector<Bytes> results(n_tasks);
  comm_.run_tasks(n_tasks, in_order(n_tasks), compute, [&](std::int32_t task, Bytes&& result) { results[task] = std::move(result); });
  for (std::int32_t task = 0; task < n_tasks; ++task) {
    comm_.broadcast(results[task]);
    Unpacker u(results[task]);
    for (std::int32_t r = first(task); r < last(task); ++r) {
      u.get(fresh[r].t);
      u.get(fresh[r].x);
      u.get(fresh[r].h);
    }
  }
  update_ = update_edges(mesh_, runs_, fresh);
}

Bytes Remesher::compute_face(FaceId f) const {
  FacePatch patch;
  patch.face = f;
  try {
    const HoleNumbering numbering(mesh_, update_);
    const auto surface = model_.surface(f);
    const FaceBoundary boundary = make_hole_boundary(model_, *surface, f, marks, numbering, field_);
    FaceMeshOptions options;
    options.enhance_rounds = options_.enhance_rounds;
    const FaceMesh mesh = mesh_face(*surface, boundary, field_, options);
    if (mesh.cause.empty() && mesh.n_folds == 0) patch = make_hole_patch(f, marks, numbering, &boundary, &mesh);
  } catch (const Error&) {  // no triangles: the hole grows
  }
  Packer packer;
  pack(packer, patch);
  return packer.take();
}

/// Fills the holes of these faces; returns those where it failed (no triangles), ascending.
std::vector<FaceId> Remesher::fill(const std::vector<FaceId>& faces) {
  if (faces.empty()) return {};
  std::vector<std::int64_t> weight;
  for (FaceId f : faces)
    weight.push_back(std::count(marks.triangle.begin() + mesh_.face_begin[f], marks.triangle.begin() + mesh_.face_begin[f + 1], 1));
  std::vector<std::int32_t> order = in_order(faces.size());
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return weight[a] > weight[b]; });
  std::vector<FaceId> failed;
  comm_.run_tasks(
      static_cast<std::int32_t>(faces.size()), order, [&](std::int32_t task) { return compute_face(faces[task]); },
      [&](std::int32_t task, Bytes&& result) {
        Unpacker u(result);
        unpack(u, patches[faces[task]]);
        if (patches[faces[task]].triangles.empty()) failed.push_back(faces[task]);
      });
  std::sort(failed.begin(), failed.end());
  share(comm_, failed);
  return failed;
}

}  // namespace st
