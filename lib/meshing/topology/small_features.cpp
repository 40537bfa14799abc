#include "meshing/topology/small_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/threads.h"
#include "features/arc_table.h"
#include "features/strip.h"
#include "geometry/model/cad_tolerance.h"
#include "geometry/model/edge_faces.h"
#include "meshing/topology/ledges.h"

namespace st {
namespace {

constexpr double kLargestMerge = 0.5;  // of the requested length: what the mesh can show stays, whatever the tolerance

/// Limits of merging for each face, by its group's tolerance.
std::vector<MergeLimit> face_limits(const ModelTables& t, double below) {
  const std::vector<double> tolerances = face_tolerances(t.labels);
  std::vector<MergeLimit> limits(t.n_faces(), {below, 0});
  for (std::size_t f = 0; f < tolerances.size(); ++f) limits[f].tolerance = tolerances[f];
  return limits;
}

/// Draws short edges together, the shortest first.
class EdgeMerger {
 public:
  EdgeMerger(const ModelTables& t, const SizeField& field, const std::vector<MergeLimit>& face_limit, double below)
      : t_(t), field_(field), face_limit_(face_limit), below_(below), faces_at_(t_), sets_(t_.n_vertices()) {
    is_merged_.assign(t_.n_edges(), 0);
    cluster_.resize(t_.n_vertices());
    for (VertexId v = 0; v < t_.n_vertices(); ++v) cluster_[v].add(t_.vertex_xyz[v]);
    edge_loops();
  }

  std::vector<EdgeId> run() {
    constexpr std::size_t kPerPiece = 256;
    std::vector<char> is_short(t_.n_edges(), 0);
    parallel_for(is_short.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      int hint = 0;
      for (std::size_t e = begin; e < end; ++e)
        is_short[e] = !t_.edge_is_degenerate[e] &&
                      t_.edge_length[e] <
                          limit_of(static_cast<EdgeId>(e), field_.size(t_.vertex_xyz[t_.edge_vertices[2 * e]], hint));
    });
    std::vector<EdgeId> candidates;
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      if (is_short[e]) candidates.push_back(e);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](EdgeId a, EdgeId b) { return t_.edge_length[a] < t_.edge_length[b]; });
    for (const EdgeId e : candidates)
      if (!is_merged_[e]) merge(e);
    std::vector<EdgeId> merged;
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      if (is_merged_[e]) merged.push_back(e);
    return merged;
  }

 private:
  /// The smallest of its faces.
  double limit_of(EdgeId e, double size) const {
    if (faces_at_[e].empty()) return below_ * size;
    double limit = std::numeric_limits<double>::infinity();
    for (const FaceId f : faces_at_[e]) limit = std::min(limit, face_limit_[f].at(size));
    return limit;
  }

  void edge_loops() {
    loops_.resize(t_.n_edges());
    n_long_.assign(t_.n_loops(), 0);
    at_vertex_.resize(t_.n_vertices());
    for (LoopId l = 0; l < t_.n_loops(); ++l)
      for (const CoedgeId c : t_.loop_coedges(l)) {
        if (t_.edge_is_degenerate[t_.coedge_edge[c]]) continue;
        ++n_long_[l];
        loops_[t_.coedge_edge[c]].push_back(l);
      }
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      for (int k = 0; k < 2; ++k)
        if (!t_.edge_is_degenerate[e]) at_vertex_[t_.edge_vertices[2 * e + k]].push_back(e);
  }

  void merge(EdgeId e) {
    const VertexId a = sets_.find(t_.edge_vertices[2 * e]), b = sets_.find(t_.edge_vertices[2 * e + 1]);
    if (a == b) {
      if (is_point(e)) leave_out({e});
      return;
    }
    Box3 both = cluster_[a];
    both.add(cluster_[b]);
    const double limit = limit_of(e, field_.size(both.center(), hint_));
    const std::vector<EdgeId> edges = short_edges_between(a, b, e, 3 * limit);
    const bool are_one = std::all_of(edges.begin() + 1, edges.end(), [&](EdgeId k) { return are_points(e, k); });
    if (both.diagonal() > limit || !are_one || !leave_out(edges)) return;
    sets_.join(a, b);
    cluster_[std::min(a, b)] = both;
    auto &to = at_vertex_[std::min(a, b)], &from = at_vertex_[std::max(a, b)];
    to.insert(to.end(), from.begin(), from.end());
  }

  /// No longer than its vertices are exact.
  bool is_point(EdgeId e) const {
    const auto tolerance = [&](int k) { return t_.vertex_tolerance[t_.edge_vertices[2 * e + k]]; };
    return t_.edge_length[e] <= std::max(tolerance(0), tolerance(1));
  }

  bool are_points(EdgeId a, EdgeId b) const { return is_point(a) && is_point(b); }

  /// Merges the edges if none is a seam and each of their loops keeps two others.
  bool leave_out(const std::vector<EdgeId>& edges) {
    std::vector<LoopId> loops;
    for (const EdgeId e : edges) {
      std::vector<LoopId> own = loops_[e];
      std::sort(own.begin(), own.end());
      if (std::adjacent_find(own.begin(), own.end()) != own.end()) return false;
      loops.insert(loops.end(), own.begin(), own.end());
    }
    for (const LoopId l : loops)
      if (n_long_[l] < 2 + std::count(loops.begin(), loops.end(), l)) return false;
    for (const LoopId l : loops) --n_long_[l];
    for (const EdgeId e : edges) is_merged_[e] = 1;
    return true;
  }

  /// `e` and the others between the two that are too short to be a loop of their own with it.
  std::vector<EdgeId> short_edges_between(VertexId a, VertexId b, EdgeId e, double limit) {
    std::vector<EdgeId> edges = {e};
    for (const EdgeId k : at_vertex_[a]) {
      const VertexId p = sets_.find(t_.edge_vertices[2 * k]), q = sets_.find(t_.edge_vertices[2 * k + 1]);
      if (k != e && ((p == a && q == b) || (p == b && q == a)) && t_.edge_length[k] < limit) edges.push_back(k);
    }
    return edges;
  }

  const ModelTables& t_;
  const SizeField& field_;
  const std::vector<MergeLimit>& face_limit_;
  double below_;
  EdgeFaces faces_at_;
  int hint_ = 0;
  DisjointSets sets_;
  std::vector<Box3> cluster_;               // of each set, at its root
  std::vector<std::vector<LoopId>> loops_;  // of each edge
  std::vector<int> n_long_;                 // edges left in each loop
  std::vector<char> is_merged_;
  std::vector<std::vector<EdgeId>> at_vertex_;
};

/// Chooses strips that may be closed: no edge belongs to two of them, no neighbour is a strip itself (the part is a
/// needle), and the faces on both sides are two that do not already share an edge at its ends, or triangles in that
/// corner would be the same in both.
class StripMerger {
 public:
  StripMerger(const ModelTables& t, const std::vector<EdgeId>& merged_edges)
      : t_(t), sets_(t.n_vertices()), taken_(t.n_edges(), 0), faces_at_(t) {
    for (const EdgeId e : merged_edges) sets_.join(t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]);
    for (EdgeId e = 0; e < t.n_edges(); ++e)
      if (!t.edge_is_degenerate[e] && faces_at_[e].size() == 2)
        for (int k = 0; k < 2; ++k) contacts_.push_back(contact(e, k, {faces_at_[e][0], faces_at_[e][1]}));
    std::sort(contacts_.begin(), contacts_.end());
  }

  /// Those of one face, all of them or none. `narrow` [by face] all strips that might be closed.
  bool may_close(std::span<const Strip> strips, const std::vector<Strip>& narrow) {
    Sides last = {kNone, kNone};
    for (const Strip& strip : strips) {
      const Sides own = sides(strip);
      if (own == last || !is_free(strip, narrow)) return false;
      last = own;
    }
    for (const Strip& strip : strips) take(strip);
    return true;
  }

 private:
  using Sides = std::pair<FaceId, FaceId>;     // the faces along both edges of a strip
  using Contact = std::pair<VertexId, Sides>;  // two faces that share an edge that ends here

  Sides sides(const Strip& strip) const {
    return {faces_at_.beyond(strip.edges[0], strip.face), faces_at_.beyond(strip.edges[1], strip.face)};
  }

  bool is_free(const Strip& strip, const std::vector<Strip>& narrow) {
    const auto is_narrow = [&](FaceId f) {
      return std::any_of(narrow.begin(), narrow.end(), [&](const Strip& s) { return s.face == f; });
    };
    const auto [a, b] = sides(strip);
    if (a == b || taken_[strip.edges[0]] || taken_[strip.edges[1]] || is_narrow(a) || is_narrow(b)) return false;
    for (const EdgeId e : strip.edges)
      for (int k = 0; k < 2; ++k)
        if (std::binary_search(contacts_.begin(), contacts_.end(), contact(e, k, {a, b}))) return false;
    return true;
  }

  void take(const Strip& strip) {
    for (const EdgeId e : strip.edges) {
      taken_[e] = 1;
      for (int k = 0; k < 2; ++k) {
        const Contact added = contact(e, k, sides(strip));
        contacts_.insert(std::upper_bound(contacts_.begin(), contacts_.end(), added), added);
      }
    }
  }

  Contact contact(EdgeId e, int k, Sides f) {
    return {sets_.find(t_.edge_vertices[2 * e + k]), {std::min(f.first, f.second), std::max(f.first, f.second)}};
  }

  const ModelTables& t_;
  DisjointSets sets_;
  std::vector<char> taken_;
  EdgeFaces faces_at_;
  std::vector<Contact> contacts_;  // sorted
};

/// Strips narrower than their face's limit somewhere; by face.
std::vector<Strip> narrow_strips(std::vector<Strip> strips, const SizeField& field,
                                 const std::vector<MergeLimit>& face_limit) {
  int hint = 0;
  std::erase_if(strips, [&](const Strip& strip) {
    MergeLimit limit = face_limit[strip.face];
    limit.exact = strip.exact;
    return std::ranges::none_of(strip.stations,
                                [&](const Strip::Station& s) { return s.width() < limit.at(field.size(s.x, hint)); });
  });
  return strips;
}

/// A face between two closed edges, with or without a seam.
struct Ring {
  Strip strip;
  EdgeId seam = kNone;
};

std::optional<Ring> ring_of(const ModelTables& t, FaceId f, const std::vector<int>& uses) {
  Ring ring;
  std::vector<EdgeId> closed;
  for (const EdgeId e : t.edges_of(f)) {
    if (t.edge_is_degenerate[e]) return std::nullopt;
    if (t.edge_vertices[2 * e] == t.edge_vertices[2 * e + 1])
      closed.push_back(e);
    else if (ring.seam == kNone || ring.seam == e)
      ring.seam = e;
    else
      return std::nullopt;
  }
  if (closed.size() != 2 || closed[0] == closed[1] || uses[closed[0]] != 2 || uses[closed[1]] != 2 ||
      (ring.seam == kNone ? t.edges_of(f).size() != 2 : t.edges_of(f).size() != 4 || uses[ring.seam] != 2))
    return std::nullopt;
  std::sort(closed.begin(), closed.end());
  ring.strip.face = f;
  std::copy(closed.begin(), closed.end(), ring.strip.edges);
  ring.strip.length = t.edge_length[closed[0]];
  return ring;
}

/// All around, from points at equal shares of the lengths, which start at vertices that face each other.
bool is_narrow(const Model& model, const SizeField& field, const MergeLimit& limit, Ring& ring) {
  constexpr int kStations = 256;
  constexpr double kClearly = 0.8;  // between the stations it may be wider
  const ModelTables& t = model.tables();
  const double length = std::min(t.edge_length[ring.strip.edges[0]], t.edge_length[ring.strip.edges[1]]);
  int hint = 0;
  if (t.face_area[ring.strip.face] > length * limit.at(field.size(t.face_box[ring.strip.face].hi, hint)) &&
      t.face_area[ring.strip.face] > length * limit.at(field.size(t.face_box[ring.strip.face].lo, hint)))
    return false;  // cheap, and enough for most
  const auto kept = model.curve(ring.strip.edges[0]), closed = model.curve(ring.strip.edges[1]);
  const ArcTable a(*kept), b(*closed);
  const auto across = [&](double share, bool is_opposed) {
    return closed->point(b.parameter_at(is_opposed ? 1 - share : share));
  };
  const Vec3 quarter = kept->point(a.parameter_at(0.25));
  ring.strip.is_opposed = distance(quarter, across(0.25, true)) < distance(quarter, across(0.25, false));
  for (int i = 0; i < kStations; ++i) {
    const double share = static_cast<double>(i) / kStations;
    const Vec3 x = kept->point(a.parameter_at(share));
    if (distance(x, across(share, ring.strip.is_opposed)) > kClearly * limit.at(field.size(x, hint))) return false;
  }
  return true;
}

/// By face.
std::vector<Ring> narrow_rings(const Model& model, const SizeField& field) {
  const ModelTables& t = model.tables();
  std::vector<int> uses(t.n_edges(), 0);
  for (const EdgeId e : t.coedge_edge) ++uses[e];
  std::vector<Ring> rings;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const MergeLimit limit{0, 0, cad_tolerance(t, f)};  // the end of a thin pipe stays, however large the sizes are
    if (auto ring = ring_of(t, f, uses); ring && is_narrow(model, field, limit, *ring)) rings.push_back(*ring);
  }
  return rings;
}

void add(const Strip& strip, MergedFeatures& merged) {
  merged.strip_face.push_back(strip.face);
  merged.strip_kept.push_back(strip.edges[0]);
  merged.strip_closed.push_back(strip.edges[1]);
  merged.strip_is_opposed.push_back(strip.is_opposed);
}

}  // namespace

double MergeLimit::at(double size) const {
  const double limit = tolerance > 0 ? std::min(tolerance, kLargestMerge * size) : below * size;
  return std::max(limit, std::min(exact, kLargestMerge * size));
}

MergedFeatures find_merged_features(const Model& model, const SizeField& field, double below,
                                    const std::vector<Strip>* known_strips) {
  MergedFeatures merged;
  if (!(below > 0)) return merged;
  const ModelTables& t = model.tables();
  const std::vector<MergeLimit> face_limit = face_limits(t, below);
  merged.edge = EdgeMerger(t, field, face_limit, below).run();
  StripMerger merger(t, merged.edge);
  std::vector<Strip> strips = narrow_strips(known_strips ? *known_strips : find_strips(model), field, face_limit);
  const std::vector<Ring> rings = narrow_rings(model, field);
  for (const Ring& ring : rings) strips.push_back(ring.strip);
  const auto is_merged = [&](EdgeId e) { return std::ranges::binary_search(merged.edge, e); };
  for (Strip& ledge : find_ledges(model, field, face_limit))
    if (std::ranges::none_of(t.edges_of(ledge.face), is_merged)) strips.push_back(std::move(ledge));
  std::stable_sort(strips.begin(), strips.end(), [](const Strip& a, const Strip& b) { return a.face < b.face; });
  for (auto first = strips.begin(), end = first; first != strips.end(); first = end) {
    end = std::find_if(first, strips.end(), [&](const Strip& s) { return s.face != first->face; });
    if (!merger.may_close(std::span(first, end), strips)) continue;
    for (const Ring& ring : rings)
      if (ring.strip.face == first->face && ring.seam != kNone) merged.edge.push_back(ring.seam);
    for (auto strip = first; strip != end; ++strip) add(*strip, merged);
  }
  std::sort(merged.edge.begin(), merged.edge.end());
  return merged;
}

EdgeMesh mirror_nodes(const Curve& kept, const EdgeMesh& nodes, const Curve& closed, bool is_opposed,
                      const MergeLimit& limit) {
  const ArcTable a(kept), b(closed);
  const std::size_t n = nodes.node_t.size();
  std::vector<double> t, h;
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = is_opposed ? n - 1 - k : k;
    const double share = k == 0 ? 0 : k + 1 == n ? 1 : a.share_at(nodes.node_t[i]);
    const double own = is_opposed && k > 0 && k + 1 < n ? 1 - share : share;
    t.push_back(k == 0 ? closed.t_min() : k + 1 == n ? closed.t_max() : b.parameter_at(own));
    h.push_back(nodes.node_size[i]);
    const Vec3 at = closed.point(t.back());
    x.push_back(distance(at, nodes.node_xyz[i]) < limit.at(h.back()) ? nodes.node_xyz[i] : at);
  }
  return EdgeMesh::of_curve(std::move(t), std::move(x), std::move(h));
}

EdgeMesh mirror_nodes(const Curve& kept, std::span<const double> inner_t, const Curve& closed, bool is_opposed) {
  std::vector<double> t{kept.t_min()};
  t.insert(t.end(), inner_t.begin(), inner_t.end());
  t.push_back(kept.t_max());
  const std::size_t n = t.size();
  return mirror_nodes(kept, EdgeMesh::of_curve(std::move(t), std::vector<Vec3>(n), std::vector<double>(n)), closed,
                      is_opposed, {});
}

}  // namespace st
