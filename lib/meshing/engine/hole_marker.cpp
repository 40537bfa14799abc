#include "meshing/engine/hole_marker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.h"
#include "base/log.h"
#include "base/share.h"

namespace st {
namespace {

constexpr double kAnyLength = 1e300;  // along metrics, until sizes are refined

}  // namespace

HoleMarker::HoleMarker(const Model& model, const HoleMesh& mesh, const MeshShare& share, const SizeField& field,
                       HoleMarkOptions options, const Executor& executor)
    : model_(model), mesh_(mesh), share_(share), options_(std::move(options)), executor_(executor) {
  const Timer timer;
  request_lengths(field);
  mark(wanted_);
  n_marked_triangles = marks_.n_triangles();
  n_marked_segments = std::count(marks_.segment.begin(), marks_.segment.end(), 1);
  Hasher hasher;
  hasher.add(std::span<const char>(marks_.triangle));
  hasher.add(std::span<const char>(marks_.segment));
  marks_hash = hasher.hex();
  seconds = timer.seconds();
}

void HoleMarker::mark_again(const Refinements& refinements, std::vector<TriangleId> redo) {
  options_.redo.insert(options_.redo.end(), redo.begin(), redo.end());
  share(executor_, options_.redo);
  mark(refined_sizes(refinements));
}

void HoleMarker::grow_to_face(FaceId face) {
  std::fill(marks_.triangle.begin() + mesh_.face_begin[face], marks_.triangle.begin() + mesh_.face_begin[face + 1], 1);
}

/// Collective. Which segments of curves go is decided by rank 0's lengths: all ranks act on it.
void HoleMarker::request_lengths(const SizeField& field) {
  const NodeId n_nodes = static_cast<NodeId>(mesh_.mesh.node_xyz.size()), n_on_edges = mesh_.inner_begin[0];
  std::vector<char> is_needed(n_nodes, 0);
  std::fill(is_needed.begin(), is_needed.begin() + n_on_edges, 1);
  for (TriangleId t = share_.begin; t < share_.end; ++t)
    for (const NodeId n : mesh_.mesh.triangles[t].n) is_needed[n] = 1;
  wanted_.assign(n_nodes, {});
  is_stretched_ = field.is_stretched();
  char was_stretched = is_stretched_ || (executor_.is_root() && has_long_edges());
  share(executor_, was_stretched);
  options_.was_stretched = was_stretched != 0;
  if (field.has_metrics()) options_.metrics = &request_along_sides(field);
  int hint = 0;
  for (NodeId n = 0; n < n_nodes; ++n) {
    if (!is_needed[n]) continue;
    const Vec3 x = mesh_.mesh.node_xyz[n];
    wanted_[n] = options_.metrics ? LocalSize{field.size(x, hint), kAnyLength, {}} : field.local(x, hint);
  }
  std::vector<LocalSize> on_edges(wanted_.begin(), wanted_.begin() + n_on_edges);
  share(executor_, on_edges);
  std::copy(on_edges.begin(), on_edges.end(), wanted_.begin());
  options_.becomes_stretched = is_stretched_ ? faces_without_stretch() : std::vector<char>();
}

/// Of the sides of the share, and all segments of edges.
const SideRequests& HoleMarker::request_along_sides(const SizeField& metrics) {
  std::vector<std::array<NodeId, 2>> segments;
  for (const CadSegment& s : mesh_.segments) segments.push_back({s.low, s.high});
  return along_sides_.emplace(mesh_.mesh, share_.begin, share_.end, segments, metrics);
}

/// Whether the mesh has more edges far longer than they were made for than a mesh without stretch has.
bool HoleMarker::has_long_edges() const {
  constexpr double kLong = 2.5, kShare = 0.005;
  std::int64_t n_long = 0;
  for (const Triangle& t : mesh_.mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const NodeId a = t.n[k], b = t.n[(k + 1) % 3];
      const double size = 0.5 * (mesh_.mesh.node_size[a] + mesh_.mesh.node_size[b]);
      n_long += distance(mesh_.mesh.node_xyz[a], mesh_.mesh.node_xyz[b]) > kLong * size;
    }
  return static_cast<double>(n_long) > kShare * 3 * static_cast<double>(mesh_.mesh.triangles.size());
}

/// Of a side, times what it is shorter as stretched sizes see it.
double HoleMarker::squeezed_length(NodeId a, NodeId b) const {
  const Vec3 d = mesh_.mesh.node_xyz[b] - mesh_.mesh.node_xyz[a];
  if (options_.metrics)
    return options_.metrics->ratio(a, b, kAnyLength, kAnyLength) * 0.5 * (wanted_[a].length + wanted_[b].length);
  const double of_a = dot(wanted_[a].squeeze(), d), of_b = dot(wanted_[b].squeeze(), d);
  return std::sqrt(norm2(d) - 0.5 * (of_a * of_a + of_b * of_b));
}

/// Collective. Faces whose mesh was made for other stretch, or none: half of their edges that lie along the direction
/// of stretched sizes are too short for these. Fewer are where st-mesh ended the stretch.
std::vector<char> HoleMarker::faces_without_stretch() const {
  const FaceId n_faces = model_.tables().n_faces();
  std::vector<std::int64_t> n_along(n_faces, 0), n_short(n_faces, 0);
  for (TriangleId t = share_.begin; t < share_.end; ++t)
    for (int k = 0; k < 3; ++k) {
      const FaceId f = mesh_.mesh.triangle_face[t];
      const NodeId a = mesh_.mesh.triangles[t].n[k], b = mesh_.mesh.triangles[t].n[(k + 1) % 3];
      const Vec3 d = mesh_.mesh.node_xyz[b] - mesh_.mesh.node_xyz[a];
      const double squeezed = squeezed_length(a, b);
      if (squeezed > options_.too_short * norm(d)) continue;
      ++n_along[f];
      n_short[f] += squeezed < options_.too_short * 0.5 * (wanted_[a].length + wanted_[b].length);
    }
  std::vector<std::int64_t> of_all(n_faces, 0);  // twice those too short, less those along
  for (const Bytes& bytes : executor_.gather(packed(n_along, n_short))) {
    unpack(bytes, n_along, n_short);
    for (FaceId f = 0; f < n_faces; ++f) of_all[f] += 2 * n_short[f] - n_along[f];
  }
  std::vector<char> are_without(n_faces, 0);
  for (FaceId f = 0; f < n_faces; ++f) are_without[f] = of_all[f] > 0;
  share(executor_, are_without);
  return are_without;
}

std::vector<LocalSize> HoleMarker::refined_sizes(const Refinements& refinements) const {
  std::vector<LocalSize> wanted = wanted_;
  const auto refine = [&](NodeId n, const Refinement& r) {
    const double d = distance(mesh_.mesh.node_xyz[n], r.x), limit = r.length + slope_of(r.shortens) * d;
    if (!(d < r.reach)) return;
    if (r.shortens == Shortens::kAll) wanted[n].length = std::min(wanted[n].length, limit);
    wanted[n].along = std::max(wanted[n].length, std::min(wanted[n].along, limit));
  };
  for (const Refinement& r : refinements.all()) {
    for (NodeId n = 0; n < mesh_.inner_begin[0]; ++n) refine(n, r);
    for (FaceId f = 0; f < model_.tables().n_faces(); ++f)
      if (box_distance(model_.tables().face_box[f], r.x) <= r.reach)
        for (NodeId n = mesh_.inner_begin[f]; n < mesh_.inner_begin[f + 1]; ++n) refine(n, r);
  }
  return wanted;
}

void HoleMarker::mark(const std::vector<LocalSize>& wanted) {
  std::vector<double> lengths;
  options_.squeeze.clear();
  options_.most_along.clear();
  for (const LocalSize& size : wanted) {
    lengths.push_back(size.length);
    if (options_.metrics)
      options_.most_along.push_back(size.along);
    else if (is_stretched_)
      options_.squeeze.push_back(size.squeeze());
  }
  NodeExchange exchange;
  if (executor_.size() > 1) exchange = [this](const std::vector<TouchedNode>& own) { return this->exchange(own); };
  marks_ = mark_share(mesh_, share_, lengths, options_, exchange);
  collect_marks();
  if (executor_.is_root()) mark_pairs();
  dirty_faces_.clear();
  for (FaceId f = 0; f < model_.tables().n_faces(); ++f)
    if (has_marks(f)) dirty_faces_.push_back(f);
}

bool HoleMarker::has_marks(FaceId f) const {
  const auto first = marks_.triangle.begin() + mesh_.face_begin[f],
             last = marks_.triangle.begin() + mesh_.face_begin[f + 1];
  return std::find(first, last, 1) != last;
}

/// Faces of a pair are made again as wholes: the second has the image of what the first gets. Local, on rank 0.
void HoleMarker::mark_pairs() {
  if (!options_.pairs) return;
  for (const FacePair& p : options_.pairs->pairs())
    if (has_marks(p.a) || has_marks(p.b))
      for (const FaceId f : {p.a, p.b}) grow_to_face(f);
}

/// Collective.
std::vector<TouchedNode> HoleMarker::exchange(const std::vector<TouchedNode>& own) const {
  std::vector<TouchedNode> touched, part;
  for (const Bytes& bytes : executor_.gather(packed(own))) {
    unpack(bytes, part);
    touched.insert(touched.end(), part.begin(), part.end());
  }
  share(executor_, touched);
  return touched;
}

/// Collective. The marks of all ranks' triangles on rank 0.
void HoleMarker::collect_marks() {
  if (executor_.size() == 1) return;
  TriangleId first = share_.first_triangle + share_.begin;
  std::vector<char> part(marks_.triangle.begin() + share_.begin, marks_.triangle.begin() + share_.end);
  for (const Bytes& bytes : executor_.gather(packed(first, part))) {
    unpack(bytes, first, part);
    std::copy(part.begin(), part.end(), marks_.triangle.begin() + first);
  }
}

}  // namespace st
