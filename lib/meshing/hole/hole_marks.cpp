#include "meshing/hole/hole_marks.h"

#include <algorithm>
#include <cmath>

#include "base/sort_once.h"

namespace st {
namespace {

/// 4 sqrt(3) area / sum of squares, by Heron's formula; 0 where the sides make no triangle.
double quality_of_sides(double a, double b, double c) {
  const double sum = a * a + b * b + c * c,
               squared = sum * sum - 2 * (a * a * a * a + b * b * b * b + c * c * c * c);  // (4 area)^2
  return squared > 0 ? std::sqrt(3 * squared) / sum : 0;
}

bool by_face(const TouchedNode& a, const TouchedNode& b) { return a.face < b.face; }

class Marker {
 public:
  Marker(const HoleMesh& mesh, const MeshShare& share, std::span<const double> wanted, const HoleMarkOptions& options,
         const NodeExchange& exchange)
      : cad_(mesh), mesh_(mesh.mesh), share_(share), wanted_(wanted), options_(options), exchange_(exchange) {
    marks_.triangle.assign(mesh_.triangles.size(), 0);
    marks_.segment.assign(mesh.edges.node_t.size(), 0);
    on_run_.assign(mesh_.node_xyz.size(), 0);
    face_at_.assign(mesh_.node_xyz.size(), kNone);
  }

  HoleMarks run() {
    mark_segments();
    join_segments();
    mark_triangles();
    for (int i = 0; i < options_.layers; ++i) {
      const std::vector<TouchedNode> elsewhere = exchange_touched();
      for_each_face([&](FaceId f) { add_layer(f, elsewhere); });
    }
    const std::vector<TouchedNode> elsewhere = exchange_touched();
    for_each_face([&](FaceId f) { close_gaps(f, elsewhere); });
    return std::move(marks_);
  }

 private:
  bool keeps(FaceId f) const { return !options_.keep_face.empty() && options_.keep_face[f]; }

  bool becomes_stretched(FaceId f) const {
    return !options_.becomes_stretched.empty() && options_.becomes_stretched[f];
  }

  bool has_moved(NodeId a, NodeId b, double length) const {
    if (options_.earlier_xyz.empty()) return false;
    const double earlier = distance(options_.earlier_xyz[a], options_.earlier_xyz[b]);
    return std::abs(length - earlier) > options_.change * earlier;
  }

  /// As stretched sizes see it.
  double squeezed_length(NodeId a, NodeId b) const {
    const Vec3 d = mesh_.node_xyz[b] - mesh_.node_xyz[a];
    const double along_a = dot(options_.squeeze[a], d), along_b = dot(options_.squeeze[b], d);
    return std::sqrt(norm2(d) - 0.5 * (along_a * along_a + along_b * along_b));
  }

  /// Length over the request, as sizes see it.
  double ratio(NodeId a, NodeId b) const {
    if (options_.metrics) return options_.metrics->ratio(a, b, options_.most_along[a], options_.most_along[b]);
    const double length =
        options_.squeeze.empty() ? distance(mesh_.node_xyz[a], mesh_.node_xyz[b]) : squeezed_length(a, b);
    return length / (0.5 * (wanted_[a] + wanted_[b]));
  }

  /// Whether the request at an edge is another one than that which the mesh was made for.
  bool has_other_request(NodeId a, NodeId b, double ratio, bool becomes_stretched) const {
    const double size = 0.5 * (wanted_[a] + wanted_[b]), before = 0.5 * (mesh_.node_size[a] + mesh_.node_size[b]);
    const double length = distance(mesh_.node_xyz[a], mesh_.node_xyz[b]);
    const bool is_squeezed = becomes_stretched && ratio * size < (1 - options_.change) * length;
    return std::abs(size - before) > options_.change * before || has_moved(a, b, length) || is_squeezed;
  }

  /// Of metrics: sides may all fit where the triangle does not, as half of a flat rhombus.
  bool is_misshapen(const NodeId* n, bool becomes_stretched) const {
    constexpr double kMisshapen = 0.6;
    if (!options_.metrics) return false;
    const double a = ratio(n[0], n[1]), b = ratio(n[1], n[2]), c = ratio(n[2], n[0]);
    if (quality_of_sides(a, b, c) >= kMisshapen) return false;
    return has_other_request(n[0], n[1], a, becomes_stretched) || has_other_request(n[1], n[2], b, becomes_stretched) ||
           has_other_request(n[2], n[0], c, becomes_stretched);
  }

  /// Edges far too long for their direction are of more stretch. Shorter ones stay: there st-mesh ended the stretch.
  bool violates(NodeId a, NodeId b, bool becomes_stretched) const {
    return violates(a, b, becomes_stretched, options_.too_long, options_.too_short);
  }
  bool violates(NodeId a, NodeId b, bool becomes_stretched, double too_long, double too_short) const {
    constexpr double kFarTooLong = 2.5;
    const double ratio = this->ratio(a, b);
    if (!has_other_request(a, b, ratio, becomes_stretched)) return options_.was_stretched && ratio > kFarTooLong;
    return ratio > too_long || ratio < too_short;
  }

  /// Segments of kept faces and edges stay, and those of merged strips, which share nodes.
  std::vector<char> free_edges() const {
    const ModelTables& t = cad_.tables;
    std::vector<char> is_free(t.n_edges(), 1);
    for (std::size_t e = 0; e < options_.keep_edge.size(); ++e) is_free[e] = !options_.keep_edge[e];
    for (const MeshTopology::Strip& strip : cad_.topology.strips()) is_free[strip.kept] = is_free[strip.closed] = 0;
    for (FaceId f = 0; f < t.n_faces(); ++f)
      if (keeps(f))
        for (const EdgeId e : t.edges_of(f)) is_free[e] = 0;
    for_each_follower([&](EdgeId e, const PairFollower& f) { is_free[f.leader] &= is_free[e]; });
    for_each_follower([&](EdgeId e, const PairFollower& f) { is_free[e] = is_free[f.leader]; });
    return is_free;
  }

  template <class Work>
  void for_each_follower(const Work& work) const {
    if (!options_.pairs) return;
    const std::vector<PairFollower>& edges = options_.pairs->edges();
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges[e].leader != kNone) work(static_cast<EdgeId>(e), edges[e]);
  }

  /// Edges that are images of one another have as many segments, marked alike.
  void mark_images() {
    const EdgeMesh& m = cad_.edges;
    const auto join = [&](bool to_leader) {
      for_each_follower([&](EdgeId e, const PairFollower& f) {
        const std::int32_t n = m.n_nodes(e) - 1;
        for (std::int32_t i = 0; i < n && m.n_nodes(f.leader) == n + 1; ++i) {
          char& own = marks_.segment[m.first_node(e) + i];
          char& other = marks_.segment[m.first_node(f.leader) + (f.is_opposed ? n - 1 - i : i)];
          (to_leader ? other : own) |= to_leader ? own : other;
        }
      });
    };
    join(true);
    join(false);
  }

  void mark_segments() {
    if (options_.only_redo) return;
    const std::vector<char> is_free = free_edges();
    const ModelTables& t = cad_.tables;
    std::vector<char> becomes_stretched(t.n_edges(), 0);
    for (FaceId f = 0; f < t.n_faces(); ++f)
      for (const EdgeId e : t.edges_of(f)) becomes_stretched[e] |= this->becomes_stretched(f);
    // rows that begin at segments are as far apart as these, which stretched triangles have to be for their shape
    constexpr double kRowsApart = 1.15;
    const double longest = options_.metrics ? std::min(options_.too_long, kRowsApart) : options_.too_long,
                 shortest = options_.metrics ? std::max(options_.too_short, 1 / kRowsApart) : options_.too_short;
    for (const CadSegment& s : cad_.segments)
      marks_.segment[s.index] =
          is_free[s.edge] && violates(s.low, s.high, becomes_stretched[s.edge], longest, shortest);
    mark_images();
  }

  /// A segment between two marked ones goes with them.
  void join_segments() {
    const EdgeMesh& m = cad_.edges;
    for (EdgeId e = 0; e < m.n_edges(); ++e)
      for (std::int32_t i = m.first_node(e) + 1; i + 2 < m.first_node(e) + m.n_nodes(e); ++i)
        if (marks_.segment[i - 1] && marks_.segment[i + 1]) marks_.segment[i] = 1;
    for (std::size_t i = 0; i < marks_.segment.size(); ++i)
      if (marks_.segment[i]) on_run_[cad_.edge_node[i]] = on_run_[cad_.edge_node[i + 1]] = 1;
  }

  void mark_triangles() {
    for (const TriangleId t : options_.redo)
      if (const TriangleId i = t - share_.first_triangle; share_.begin <= i && i < share_.end)
        marks_.triangle[i] = !keeps(mesh_.triangle_face[i]);
    if (options_.only_redo) return;
    for (TriangleId i = share_.begin; i < share_.end; ++i) {
      const NodeId* n = mesh_.triangles[i].n;
      if (marks_.triangle[i] || keeps(mesh_.triangle_face[i])) continue;
      const bool becomes = becomes_stretched(mesh_.triangle_face[i]);
      marks_.triangle[i] = violates(n[0], n[1], becomes) || violates(n[1], n[2], becomes) ||
                           violates(n[2], n[0], becomes) || is_misshapen(n, becomes);
    }
  }

  TriangleId begin(FaceId f) const { return std::max(share_.begin, cad_.face_begin[f]); }
  TriangleId end(FaceId f) const { return std::min(share_.end, cad_.face_begin[f + 1]); }

  template <class Work>
  void for_each_face(const Work& work) {
    for (FaceId f = 0; f < cad_.tables.n_faces(); ++f)
      if (begin(f) < end(f) && !keeps(f)) work(f);
  }

  NodeId in_whole_mesh(NodeId n) const { return share_.node_number.empty() ? n : share_.node_number[n]; }
  /// kNone: not in this rank's mesh.
  NodeId in_own_mesh(NodeId n) const {
    const std::vector<NodeId>& number = share_.node_number;
    if (number.empty()) return n;
    const auto at = std::lower_bound(number.begin(), number.end(), n);
    return at != number.end() && *at == n ? static_cast<NodeId>(at - number.begin()) : kNone;
  }

  /// What marked triangles of other ranks touch; only the first and the last face can lie there, too.
  std::vector<TouchedNode> exchange_touched() {
    if (!exchange_) return {};
    std::vector<TouchedNode> own;
    if (share_.begin < share_.end) {
      const FaceId first = mesh_.triangle_face[share_.begin], last = mesh_.triangle_face[share_.end - 1];
      add_touched(first, own);
      if (last != first) add_touched(last, own);
    }
    std::vector<TouchedNode> all = exchange_(own);
    std::sort(all.begin(), all.end(), by_face);
    return all;
  }

  void add_touched(FaceId f, std::vector<TouchedNode>& own) {
    face_at_.assign(face_at_.size(), kNone);
    for (TriangleId i = begin(f); i < end(f); ++i)
      for (const NodeId n : mesh_.triangles[i].n)
        if (marks_.triangle[i] && face_at_[n] != f) {
          face_at_[n] = f;
          own.push_back({f, in_whole_mesh(n)});
        }
  }

  /// Marks spread within a face; over CAD edges only where the edge itself changes.
  void note_nodes(FaceId f, std::span<const TouchedNode> elsewhere) {
    for (TriangleId i = begin(f); i < end(f); ++i)
      if (marks_.triangle[i])
        for (NodeId n : mesh_.triangles[i].n) face_at_[n] = f;
    const auto [first, last] = std::equal_range(elsewhere.begin(), elsewhere.end(), TouchedNode{f, kNone}, by_face);
    for (auto touched = first; touched != last; ++touched)
      if (const NodeId n = in_own_mesh(touched->node); n != kNone) face_at_[n] = f;
  }
  bool is_marked(NodeId n, FaceId f) const { return on_run_[n] || face_at_[n] == f; }

  void add_layer(FaceId f, std::span<const TouchedNode> elsewhere) {
    note_nodes(f, elsewhere);
    for (TriangleId i = begin(f); i < end(f); ++i) {
      const NodeId* n = mesh_.triangles[i].n;
      if (is_marked(n[0], f) || is_marked(n[1], f) || is_marked(n[2], f)) marks_.triangle[i] = 1;
    }
  }

  /// No triangle with marked ones at all its corners stays; one pass finds all, as no further node is touched.
  void close_gaps(FaceId f, std::span<const TouchedNode> elsewhere) {
    note_nodes(f, elsewhere);
    for (TriangleId i = begin(f); i < end(f); ++i) {
      const NodeId* n = mesh_.triangles[i].n;
      if (is_marked(n[0], f) && is_marked(n[1], f) && is_marked(n[2], f)) marks_.triangle[i] = 1;
    }
  }

  const HoleMesh& cad_;
  const SurfaceMesh& mesh_;
  const MeshShare& share_;
  std::span<const double> wanted_;
  const HoleMarkOptions& options_;
  const NodeExchange& exchange_;  // empty: there is one rank
  HoleMarks marks_;
  std::vector<char> on_run_;     // nodes of marked segments
  std::vector<FaceId> face_at_;  // last face in which a marked triangle was seen at the node
};

}  // namespace

std::int64_t HoleMarks::n_triangles() const { return std::count(triangle.begin(), triangle.end(), 1); }

HoleMarks mark_share(const HoleMesh& mesh, const MeshShare& share, std::span<const double> wanted,
                     const HoleMarkOptions& options, const NodeExchange& exchange) {
  return Marker(mesh, share, wanted, options, exchange).run();
}

void grow_hole(const HoleMesh& cad, FaceId face, std::span<const TriangleId> hole, int layers, HoleMarks& marks) {
  std::vector<TriangleId> fresh(hole.begin(), hole.end());
  std::vector<NodeId> touched;
  for (int l = 0; l < layers; ++l) {
    for (const TriangleId i : fresh)
      touched.insert(touched.end(), cad.mesh.triangles[i].n, cad.mesh.triangles[i].n + 3);
    sort_once(touched);
    fresh.clear();
    for (TriangleId i = cad.face_begin[face]; i < cad.face_begin[face + 1]; ++i) {
      if (marks.triangle[i]) continue;
      for (const NodeId n : cad.mesh.triangles[i].n)
        if (std::binary_search(touched.begin(), touched.end(), n)) marks.triangle[i] = 1;
      if (marks.triangle[i]) fresh.push_back(i);
    }
  }
}

}  // namespace st
