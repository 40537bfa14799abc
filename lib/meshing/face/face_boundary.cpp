#include "meshing/face/face_boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/merge.h"

namespace st {
namespace {

constexpr double kPoleTurning = 60.0 * kPi / 180.0;  // of the transverse tangent between the nodes of a pole
constexpr double kJunctionGap = 0.02;  // of the requested length: larger gaps in (u,v) between coedges get a segment
constexpr double kInexactGap = 0.3;    // likewise, of gaps within the tolerance of their vertex: such a segment may run
                                       // back along its neighbour

struct End {
  Vec2 uv;
  std::int32_t id;
};

class BoundaryMaker {
 public:
  BoundaryMaker(const Model& model, const Surface& surface, FaceId face, const BoundaryNumbering& numbering)
      : model_(model), t_(numbering.tables), surface_(surface), face_(face), numbering_(numbering) {}

  FaceBoundary run() {
    if (const auto* strip = numbering_.topology.strip_of(face_); strip && add_strip(*strip)) return std::move(result_);
    for (const LoopId l : t_.loops(face_)) add_loop(l);
    return std::move(result_);
  }

 private:
  void add_loop(LoopId l) {
    const std::int32_t first = static_cast<std::int32_t>(result_.nodes.size());
    for (const CoedgeId c : t_.loop_coedges(l)) {
      add_whole(c, static_cast<std::int32_t>(result_.nodes.size()) == first);
    }
    close_loop(first);
  }

  /// A loop for each part of a strip that is not closed; false when no node of it is.
  bool add_strip(const MeshTopology::Strip& strip) {
    std::vector<CoedgeId> coedges;
    for (const CoedgeId c : t_.loop_coedges(t_.loops(face_).first())) coedges.push_back(c);
    const auto coedge_on = [&](EdgeId e) {
      return std::find_if(coedges.begin(), coedges.end(), [&](CoedgeId c) { return t_.coedge_edge[c] == e; });
    };
    std::rotate(coedges.begin(), coedge_on(strip.kept), coedges.end());
    const auto other = coedge_on(strip.closed);
    const std::int32_t n = numbering_.edges.n_nodes(strip.kept);
    std::vector<char> is_closed(n);  // in the direction of the loop
    for (std::int32_t i = 0; i < n; ++i)
      is_closed[t_.coedge_is_reversed[coedges[0]] ? n - 1 - i : i] = numbering_.is_closed(strip, i);
    if (std::count(is_closed.begin(), is_closed.end(), 1) == 0) return false;
    if (other == coedges.end()) return true;  // a ring of two loops, which is closed all around
    for (std::int32_t first = 0, last; first < n; first = last + 1) {
      last = first;
      if (is_closed[first]) continue;
      while (last + 1 < n && !is_closed[last + 1]) ++last;
      const std::int32_t from = std::max(first - 1, 0), to = std::min(last + 1, n - 1);
      const std::int32_t begin = static_cast<std::int32_t>(result_.nodes.size());
      add_nodes(coedges[0], from, to, false);
      if (last == n - 1)
        for (auto c = coedges.begin() + 1; c != other; ++c) add_whole(*c, false);
      add_nodes(*other, n - 1 - to, n - 1 - from, true);
      if (first == 0)
        for (auto c = other + 1; c != coedges.end(); ++c) add_whole(*c, false);
      close_loop(begin);
    }
    return true;
  }

  void add_whole(CoedgeId c, bool is_first) {
    if (t_.edge_is_degenerate[t_.coedge_edge[c]])
      add_pole(c, is_first);
    else
      add_coedge(c, is_first);
  }

  void add_node(Vec2 uv, std::int32_t id, Vec3 x, double h, bool is_pole, bool joins_previous) {
    auto& nodes = result_.nodes;
    if (joins_previous && !nodes.empty() && nodes.back().id == id && is_junction(nodes.back().uv, uv, id, h)) {
      nodes.back().is_pole |= is_pole;
      nodes.back().uv = 0.5 * (nodes.back().uv + uv);
      return;
    }
    nodes.push_back({uv, x, h, id, is_pole});
  }

  /// Whether two places of a node are one.
  bool is_junction(Vec2 a, Vec2 b, std::int32_t id, double h) const {
    const double tolerance = id < t_.n_vertices() ? t_.vertex_tolerance[id] : 0;
    return gap(a, b) < std::max(kJunctionGap * h, std::min(tolerance, kInexactGap * h));
  }

  /// Distance in space that a step in (u,v) is worth.
  double gap(Vec2 a, Vec2 b) const {
    const SurfacePoint s = surface_.evaluate(0.5 * (a + b));
    const Vec2 d = b - a;
    const double range_u = surface_.u_max() - surface_.u_min(), range_v = surface_.v_max() - surface_.v_min();
    // where the surface is singular a large step in (u,v) is a step all the same
    if (std::abs(d.x) > 0.05 * range_u || std::abs(d.y) > 0.05 * range_v) return 1e300;
    return norm(d.x * s.du) + norm(d.y * s.dv);
  }

  void add_coedge(CoedgeId c, bool is_first) {
    const EdgeId e = t_.coedge_edge[c];
    const std::int32_t n = numbering_.edges.n_nodes(e);
    if (n >= 2) add_nodes(c, 0, n - 1, !is_first);
  }

  /// Nodes [from, to] of a coedge, in its direction.
  void add_nodes(CoedgeId c, std::int32_t from, std::int32_t to, bool joins_previous) {
    const EdgeId e = t_.coedge_edge[c];
    const EdgeMesh& m = numbering_.edges;
    const std::int32_t begin = m.first_node(e), n = m.n_nodes(e);
    const auto pcurve = model_.pcurve(face_, c);
    for (std::int32_t i = from; i <= to; ++i) {
      const std::int32_t k = t_.coedge_is_reversed[c] ? n - 1 - i : i;
      add_node(pcurve->point(m.node_t[begin + k]), numbering_.edge_node(e, k), m.node_xyz[begin + k],
               m.node_size[begin + k], false, i == from && joins_previous);
    }
  }

  void add_pole(CoedgeId c, bool is_first) {
    const EdgeId e = t_.coedge_edge[c];
    const VertexId v = t_.edge_vertices[2 * e];
    const auto pcurve = model_.pcurve(face_, c);
    const double t0 = t_.edge_range[2 * e], t1 = t_.edge_range[2 * e + 1];
    const int n = std::max(1, static_cast<int>(std::ceil(pole_turning(*pcurve, t0, t1) / kPoleTurning)));
    const Vec3 x = t_.vertex_xyz[v];
    for (int i = 0; i <= n; ++i) {
      const double s = static_cast<double>(t_.coedge_is_reversed[c] ? n - i : i) / n;
      add_node(pcurve->point(t0 + s * (t1 - t0)), numbering_.vertex(v), x, pole_size(v), true, i == 0 && !is_first);
    }
  }

  /// Turning of the tangent that leaves the pole, summed along the degenerate edge.
  double pole_turning(const Curve2d& pcurve, double t0, double t1) const {
    constexpr int kSteps = 24;
    const Vec2 d = pcurve.point(t1) - pcurve.point(t0);
    const double range_u = surface_.u_max() - surface_.u_min(), range_v = surface_.v_max() - surface_.v_min();
    const bool along_u = std::abs(d.x) * range_v >= std::abs(d.y) * range_u;
    double turning = 0;
    Vec3 last{};
    for (int i = 0; i <= kSteps; ++i) {
      const SurfacePoint s = surface_.evaluate(pcurve.point(t0 + (t1 - t0) * i / kSteps));
      const Vec3 across = along_u ? s.dv : s.du;
      if (norm(last) > 0 && norm(across) > 0) turning += angle_between(last, across);
      last = across;
    }
    return turning;
  }

  double pole_size(VertexId v) const {
    // the size at the vertex, from any edge node there; found among the nodes already made, else left to the closing of
    // the loop
    for (const auto& n : result_.nodes)
      if (n.id == numbering_.vertex(v) && n.h > 0) return n.h;
    return 0;
  }

  void close_loop(std::int32_t first) {
    auto& nodes = result_.nodes;
    const std::int32_t n = static_cast<std::int32_t>(nodes.size());
    if (n - first < 2) {
      nodes.resize(first);
      return;
    }
    double h = 0;
    for (std::int32_t i = first; i < n; ++i) h = nodes[i].h > 0 ? (h > 0 ? std::min(h, nodes[i].h) : nodes[i].h) : h;
    for (std::int32_t i = first; i < n; ++i)
      if (!(nodes[i].h > 0)) nodes[i].h = same_id_size(first, n, nodes[i].id, h);
    std::int32_t last = n;
    if (nodes[n - 1].id == nodes[first].id &&
        is_junction(nodes[n - 1].uv, nodes[first].uv, nodes[first].id, nodes[first].h)) {
      nodes[first].is_pole |= nodes[n - 1].is_pole;
      nodes.pop_back();
      last = n - 1;
    }
    // a gap in (u,v) between two uses of one vertex without a degenerate edge: a pole all the same
    for (std::int32_t i = first; i < last; ++i) {
      const std::int32_t j = i + 1 < last ? i + 1 : first;
      if (nodes[i].id == nodes[j].id) nodes[i].is_pole = nodes[j].is_pole = true;
      result_.segments.push_back({i, j});
    }
    limit_sizes_by_segments(first, last);
  }

  double same_id_size(std::int32_t first, std::int32_t n, std::int32_t id, double otherwise) const {
    for (std::int32_t i = first; i < n; ++i)
      if (result_.nodes[i].id == id && result_.nodes[i].h > 0) return result_.nodes[i].h;
    return otherwise;
  }

  /// Segments that the CAD makes much shorter than the size let the mesh grow from them.
  void limit_sizes_by_segments(std::int32_t first, std::int32_t last) {
    auto& nodes = result_.nodes;
    const std::int32_t n = last - first;
    for (std::int32_t i = 0; i < n; ++i) {
      const auto &a = nodes[first + i], &b = nodes[first + (i + 1) % n], &p = nodes[first + (i + n - 1) % n];
      const double next = distance(a.x, b.x), previous = distance(a.x, p.x);
      const double mean = next > 0 && previous > 0 ? 0.5 * (next + previous) : std::max(next, previous);
      if (mean > 0 && mean < kShortSides * a.h) nodes[first + i].h = kGrowFrom * mean;
    }
  }

  const Model& model_;
  const ModelTables& t_;
  const Surface& surface_;
  FaceId face_;
  const BoundaryNumbering& numbering_;
  FaceBoundary result_;
};

}  // namespace

std::int32_t BoundaryNumbering::edge_node(EdgeId e, std::int32_t index) const {
  const std::int32_t n = edges.n_nodes(e);
  if (index == 0) return tables.edge_vertices[2 * e];
  if (index == n - 1) return tables.edge_vertices[2 * e + 1];
  if (const auto* strip = topology.strip_closed_at(e)) {
    const std::int32_t twin = strip->mirrored(index, n);
    if (is_closed(*strip, twin)) return edge_node(strip->kept, twin);
  }
  return boundary_id(tables.n_vertices(), edges, e, index);
}

bool BoundaryNumbering::is_closed(const MeshTopology::Strip& strip, std::int32_t index) const {
  const std::int32_t n = edges.n_nodes(strip.kept);
  if (edges.n_nodes(strip.closed) != n) return false;
  if (index == 0 || index == n - 1)
    return tables.edge_vertices[2 * strip.kept + (index != 0)] ==
           tables.edge_vertices[2 * strip.closed + ((index != 0) != strip.is_opposed)];
  return edges.node_xyz[edges.first_node(strip.kept) + index] ==
         edges.node_xyz[edges.first_node(strip.closed) + strip.mirrored(index, n)];
}

BoundaryNumbering::Entity BoundaryNumbering::entity(std::int32_t id) const {
  if (id < tables.n_vertices()) return {EntityDim::kVertex, id, 0};
  const std::vector<std::int32_t>& first = edges.edge_offsets;
  const std::int32_t node = id - tables.n_vertices();
  const auto after = std::upper_bound(first.begin(), first.end(), node);
  return {EntityDim::kEdge, static_cast<EdgeId>(after - first.begin()) - 1, node - *(after - 1)};
}

FaceBoundary make_face_boundary(const Model& model, const Surface& surface, FaceId face,
                                const BoundaryNumbering& numbering) {
  return BoundaryMaker(model, surface, face, numbering).run();
}

FaceBoundary make_boundary_in_space(FaceId face, const BoundaryNumbering& numbering) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const ModelTables& t = numbering.tables;
  const EdgeMesh& m = numbering.edges;
  FaceBoundary result;
  for (const LoopId l : t.loops(face)) {
    const auto first = static_cast<std::int32_t>(result.nodes.size());
    for (const CoedgeId c : t.loop_coedges(l)) {
      const EdgeId e = t.coedge_edge[c];
      const std::int32_t n = m.n_nodes(e);
      for (std::int32_t i = 0; i + 1 < n; ++i) {  // the last one is the first of the next coedge
        const std::int32_t k = t.coedge_is_reversed[c] ? n - 1 - i : i, node = m.first_node(e) + k;
        result.nodes.push_back(
            {{kUnknown, kUnknown}, m.node_xyz[node], m.node_size[node], numbering.edge_node(e, k), false});
      }
    }
    const auto end = static_cast<std::int32_t>(result.nodes.size());
    for (std::int32_t i = first; i < end; ++i) result.segments.push_back({i, i + 1 < end ? i + 1 : first});
  }
  return result;
}

std::vector<int> min_segments_per_edge(const ModelTables& t) {
  std::vector<int> result(t.n_edges(), 1);
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (t.edge_vertices[2 * e] == t.edge_vertices[2 * e + 1]) result[e] = 3;
  for (LoopId l = 0; l < t.n_loops(); ++l) {
    std::vector<EdgeId> edges;
    for (const CoedgeId c : t.loop_coedges(l))
      if (!t.edge_is_degenerate[t.coedge_edge[c]]) edges.push_back(t.coedge_edge[c]);
    if (edges.size() == 2)
      for (EdgeId e : edges) result[e] = std::max(result[e], 2);
  }
  return result;
}

}  // namespace st
