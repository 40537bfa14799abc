#include "meshing/associate/edge_chains.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <queue>
#include <tuple>

#include "base/error.h"
#include "base/nearest_node.h"
#include "geometry/shape/projection.h"
#include "meshing/associate/part_matching.h"
#include "meshing/associate/places.h"
#include "meshing/topology/mesh_topology.h"

namespace st {
namespace {

constexpr double kMergeable = 0.5;   // of the mesh edges at its vertex: a CAD edge shorter than this may have no mesh
                                     // edge
constexpr double kMaxSagitta = 0.6;  // of a mesh edge: how far the curve's middle may lie from its own (a half circle:
                                     // 0.5)
constexpr std::size_t kNamed = 4;    // places named in a message

/// How a chain is sought: of the tolerance this share, so that where the mesh is exact no node beside the edge is taken
/// for one on it.
struct Search {
  double share = 1;
  bool is_thorough = false;  ///< projects without a guess
};
constexpr Search kSearches[] = {{1e-3, false}, {0.03, false}, {1, false}, {1, true}};

/// The nodes on the vertices; merges short edges.
class VertexFinder {
 public:
  VertexFinder(const SurfaceMesh& mesh, const MeshEdges& edges, const ModelTables& tables,
               const NodeTolerance& tolerance)
      : mesh_(mesh), edges_(edges), t_(tables), tolerance_(tolerance) {}

  void run(EdgeChains& result) {
    find_nearest();
    merge_short_edges(result.merged);
    result.tables = MeshTopology(t_, result.merged).tables();
    result.vertex_node.assign(t_.n_vertices(), kNone);
    result.node_vertex.assign(mesh_.node_xyz.size(), kNone);
    take_best(result);
  }

 private:
  void find_nearest() {
    is_used_.assign(t_.n_vertices(), 0);
    for (const EdgeId e : t_.coedge_edge)  // those of joined edges have none
      for (const int k : {0, 1}) is_used_[t_.edge_vertices[2 * e + k]] = 1;
    node_.assign(t_.n_vertices(), kNone);
    const MatchedParts parts = match_parts(mesh_, t_);
    std::vector<std::vector<NodeId>> nodes(parts.n_parts);
    for (NodeId n = 0; n < mesh_.n_nodes(); ++n)
      if (parts.node_part[n] != kNone) nodes[parts.node_part[n]].push_back(n);
    std::vector<NearestNode> nearest;
    for (auto& of_part : nodes) nearest.emplace_back(mesh_.node_xyz, std::move(of_part));
    for (VertexId v = 0; v < t_.n_vertices(); ++v)
      if (is_used_[v]) node_[v] = nearest[parts.vertex_part[v]].find(t_.vertex_xyz[v]);
    is_near_.assign(t_.n_vertices(), 0);
    for (VertexId v = 0; v < t_.n_vertices(); ++v)
      if (node_[v] != kNone) is_near_[v] = off(v) <= tolerance_.at(node_[v], t_.vertex_tolerance[v]);
  }
  double off(VertexId v) const { return distance(t_.vertex_xyz[v], mesh_.node_xyz[node_[v]]); }

  double shortest_edge_at(NodeId n) const {
    double least = 1e300;
    for (const std::int32_t e : edges_.at(n))
      least = std::min(least, distance(mesh_.node_xyz[edges_.low[e]], mesh_.node_xyz[edges_.high[e]]));
    return least;
  }

  void merge_short_edges(MergedFeatures& merged) const {
    for (EdgeId e = 0; e < t_.n_edges(); ++e) {
      const VertexId a = t_.edge_vertices[2 * e], b = t_.edge_vertices[2 * e + 1];
      if (t_.edge_is_degenerate[e] || a == b || node_[a] != node_[b]) continue;
      if (t_.edge_length[e] < kMergeable * shortest_edge_at(node_[a])) merged.edge.push_back(e);
    }
  }

  /// Each vertex that is left takes the nearest of its vertices' nodes.
  void take_best(EdgeChains& result) {
    std::vector<VertexId> best(t_.n_vertices(), kNone);
    for (std::size_t i = 0; i < t_.edge_vertices.size(); ++i) {
      const VertexId v = t_.edge_vertices[i], root = result.tables.edge_vertices[i];
      if (!is_used_[v]) continue;
      if (best[root] == kNone || std::pair(off(v), v) < std::pair(off(best[root]), best[root])) best[root] = v;
    }
    std::vector<VertexId> without;
    for (VertexId v = 0; v < t_.n_vertices(); ++v) {
      if (best[v] == kNone) continue;
      const NodeId n = node_[best[v]];
      if (!is_near_[best[v]]) {
        without.push_back(best[v]);
        continue;
      }
      if (result.node_vertex[n] != kNone)
        throw Error(ExitCode::kMismatch,
                    "vertices " + std::to_string(result.node_vertex[n] + 1) + " and " + std::to_string(v + 1) +
                        " of the geometry have the same nearest node, at " + place(mesh_.node_xyz[n]) +
                        "; the mesh is too coarse there: mesh the geometry with st-mesh");
      result.vertex_node[v] = n;
      result.node_vertex[n] = v;
      if (off(best[v]) > result.max_distance) result.max_distance = off(best[v]), result.max_place = mesh_.node_xyz[n];
    }
    if (!without.empty()) fail(without);
  }

  [[noreturn]] void fail(const std::vector<VertexId>& without) const {
    double farthest = 0;
    for (const VertexId v : without) farthest = std::max(farthest, off(v));
    std::string text = std::to_string(without.size()) + " of " +
                       std::to_string(std::count(is_used_.begin(), is_used_.end(), 1)) +
                       " CAD vertices have no node of the mesh, at ";
    for (std::size_t i = 0; i < std::min(without.size(), kNamed); ++i)
      text += (i ? ", " : "") + place(t_.vertex_xyz[without[i]]);
    char number[32];
    std::snprintf(number, sizeof number, "%.4g", farthest);
    throw Error(ExitCode::kMismatch, text + (without.size() > kNamed ? ", ..." : "") + " (up to " + number +
                                         " away); the mesh is of another geometry, or --tolerance is too small");
  }

  const SurfaceMesh& mesh_;
  const MeshEdges& edges_;
  const ModelTables& t_;
  const NodeTolerance& tolerance_;
  std::vector<char> is_used_, is_near_;
  std::vector<NodeId> node_;  // [n_vertices] nearest
};

/// Follows one edge after the other.
class ChainFinder {
 public:
  ChainFinder(const SurfaceMesh& mesh, const MeshEdges& edges, const Model& model, const NodeTolerance& tolerance,
              EdgeChains& result)
      : mesh_(mesh),
        edges_(edges),
        model_(model),
        tolerance_(tolerance),
        r_(result),
        label_of_(mesh.node_xyz.size(), kNone) {}

  void run() {
    const ModelTables& t = r_.tables;
    r_.chain.resize(t.n_edges());
    r_.node_edge.assign(mesh_.node_xyz.size(), kNone);
    std::vector<EdgeId> unfollowed;
    for (EdgeId e = 0; e < t.n_edges(); ++e) {
      if (t.edge_is_degenerate[e]) continue;
      if (std::none_of(std::begin(kSearches), std::end(kSearches), [&](const Search& how) { return follow(e, how); }))
        unfollowed.push_back(e);
    }
    if (!unfollowed.empty()) fail(unfollowed);
  }

 private:
  /// A node reached: from which label by which mesh edge, and how good the way is.
  struct Label {
    NodeId node;
    double t, off, cost;
    std::int32_t from, by;
    bool is_done;
  };

  bool follow(EdgeId e, const Search& how) {
    const ModelTables& t = r_.tables;
    curve_ = model_.curve(e);
    edge_ = e;
    search_ = how;
    start_ = r_.vertex_node[t.edge_vertices[2 * e]];
    end_ = r_.vertex_node[t.edge_vertices[2 * e + 1]];
    labels_.clear();
    queue_ = {};
    labels_.push_back({start_, curve_->t_min(), 0, 0, kNone, kNone, false});
    labels_.push_back({end_, curve_->t_max(), 0, 1e300, kNone, kNone, false});
    queue_.push({curve_->t_min(), 0});
    while (!queue_.empty()) {
      const std::int32_t l = queue_.top().second;
      queue_.pop();
      if (!labels_[l].is_done) expand(l);
    }
    for (const Label& l : labels_) label_of_[l.node] = kNone;
    if (labels_[1].from == kNone) return false;
    store();
    return true;
  }

  void expand(std::int32_t l) {
    labels_[l].is_done = true;
    const NodeId n = labels_[l].node;
    for (const std::int32_t by : edges_.at(n)) {
      const NodeId m = edges_.other(by, n);
      if (m == end_ && l != 1) relax(l, 1, by);
      if (m == start_ || m == end_ || r_.node_vertex[m] != kNone || r_.node_edge[m] != kNone) continue;
      if (label_of_[m] == kNone && !add_label(l, m)) continue;
      relax(l, label_of_[m], by);
    }
  }

  double tolerance(NodeId n) const { return search_.share * tolerance_.at(n, r_.tables.edge_tolerance[edge_]); }

  /// False when the node is not on the edge, seen from here.
  bool add_label(std::int32_t from, NodeId m) {
    const std::optional<double> t = parameter(labels_[from], mesh_.node_xyz[m]);
    if (!t || !(*t > curve_->t_min() && *t < curve_->t_max())) return false;
    const double off = distance(curve_->point(*t), mesh_.node_xyz[m]);
    if (off > tolerance(m)) return false;
    label_of_[m] = static_cast<std::int32_t>(labels_.size());
    labels_.push_back({m, *t, off, 1e300, kNone, kNone, false});
    return true;
  }

  std::optional<double> parameter(const Label& from, Vec3 x) const {
    if (search_.is_thorough) return closest_point(*curve_, x).t;
    const CurvePoint p = curve_->evaluate(from.t);
    const double speed2 = norm2(p.d1), along = dot(x - p.x, p.d1);
    if (!(speed2 > 0)) return closest_point(*curve_, x).t;
    if (along < -0.3 * std::sqrt(speed2) * distance(x, p.x)) return std::nullopt;
    return project_near(*curve_, x, std::clamp(from.t + along / speed2, curve_->t_min(), curve_->t_max()));
  }

  /// Squared lengths, so that no node on the way is left out.
  void relax(std::int32_t from, std::int32_t to, std::int32_t by) {
    const Label& a = labels_[from];
    Label& b = labels_[to];
    if (!(b.t > a.t) || b.is_done) return;
    const Vec3 xa = mesh_.node_xyz[a.node], xb = mesh_.node_xyz[b.node], middle = curve_->point(0.5 * (a.t + b.t));
    if (distance(middle, 0.5 * (xa + xb)) > kMaxSagitta * distance(xa, xb)) return;
    const double length = distance(xa, middle) + distance(middle, xb), cost = a.cost + length * length;
    if (!(cost < b.cost)) return;
    if (b.from == kNone && to != 1) queue_.push({b.t, to});
    b.cost = cost;
    b.from = from;
    b.by = by;
  }

  void store() {
    EdgeChain& chain = r_.chain[edge_];
    for (std::int32_t l = 1; l != kNone; l = labels_[l].from) {
      chain.node.push_back(labels_[l].node);
      chain.t.push_back(labels_[l].t);
      if (labels_[l].by != kNone) chain.edge.push_back(labels_[l].by);
      if (labels_[l].off > r_.max_distance)
        r_.max_distance = labels_[l].off, r_.max_place = mesh_.node_xyz[labels_[l].node];
      if (l > 1) r_.node_edge[labels_[l].node] = edge_;
    }
    std::reverse(chain.node.begin(), chain.node.end());
    std::reverse(chain.t.begin(), chain.t.end());
    std::reverse(chain.edge.begin(), chain.edge.end());
  }

  [[noreturn]] void fail(const std::vector<EdgeId>& unfollowed) const {
    std::string text = "no chain of mesh edges follows " + std::to_string(unfollowed.size()) + " of " +
                       std::to_string(r_.tables.n_edges()) + " CAD edges: ";
    for (std::size_t i = 0; i < std::min(unfollowed.size(), kNamed); ++i) {
      const auto curve = model_.curve(unfollowed[i]);
      text += (i ? ", " : "") + r_.tables.edge_label(unfollowed[i]) + " at " +
              place(curve->point(0.5 * (curve->t_min() + curve->t_max())));
    }
    throw Error(ExitCode::kMismatch, text + (unfollowed.size() > kNamed ? ", ..." : "") +
                                         "; the mesh is of another geometry, or crosses these edges: give a larger "
                                         "--tolerance, or mesh with st-mesh");
  }

  const SurfaceMesh& mesh_;
  const MeshEdges& edges_;
  const Model& model_;
  const NodeTolerance& tolerance_;
  EdgeChains& r_;
  std::unique_ptr<Curve> curve_;
  EdgeId edge_ = kNone;
  Search search_;
  NodeId start_ = kNone, end_ = kNone;
  std::vector<Label> labels_;           // 0: start, 1: end
  std::vector<std::int32_t> label_of_;  // [n_nodes] kNone: not reached
  std::priority_queue<std::pair<double, std::int32_t>, std::vector<std::pair<double, std::int32_t>>, std::greater<>>
      queue_;
};

}  // namespace

MeshEdges::MeshEdges(const std::vector<Triangle>& triangles, std::int64_t n_nodes) {
  edge_of_side.assign(3 * triangles.size(), kNone);
  side_offsets.push_back(0);
  EdgeTable(triangles, n_nodes).for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> on_it) {
    for (const SideId s : on_it) edge_of_side[s] = n_edges();
    low.push_back(a);
    high.push_back(b);
    sides.insert(sides.end(), on_it.begin(), on_it.end());
    side_offsets.push_back(static_cast<std::int32_t>(sides.size()));
  });
  at_node = {static_cast<std::size_t>(n_nodes), [&](const auto& visit) {
               for (std::int32_t e = 0; e < n_edges(); ++e) {
                 visit(low[e], e);
                 visit(high[e], e);
               }
             }};
}

ChainSegments::ChainSegments(const MeshEdges& edges, const EdgeChains& chains)
    : edge(edges.n_edges(), kNone), index(edges.n_edges(), kNone) {
  for (EdgeId e = 0; e < static_cast<EdgeId>(chains.chain.size()); ++e)
    for (std::size_t i = 0; i < chains.chain[e].edge.size(); ++i) {
      const std::int32_t m = chains.chain[e].edge[i];
      if (edge[m] != kNone)
        throw Error(ExitCode::kMismatch, "the mesh has one edge where the geometry has two, " +
                                             chains.tables.edge_label(edge[m]) + " and " + chains.tables.edge_label(e) +
                                             "; mesh the geometry with st-mesh");
      edge[m] = e;
      index[m] = static_cast<std::int32_t>(i);
    }
}

EdgeChains find_edge_chains(const SurfaceMesh& mesh, const MeshEdges& edges, const Model& model,
                            const NodeTolerance& tolerance) {
  EdgeChains result;
  VertexFinder(mesh, edges, model.tables(), tolerance).run(result);
  ChainFinder(mesh, edges, model, tolerance, result).run();
  return result;
}

}  // namespace st
