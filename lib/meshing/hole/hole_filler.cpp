#include "meshing/hole/hole_filler.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "base/error.h"

namespace st {
namespace {

/// A marked segment as one triangle of the hole uses it.
struct ChainLink {
  CoedgeId coedge;
  std::int32_t segment;
  std::int32_t start, end;  // corners' local nodes at the segment's lower and upper end
  bool is_along;            // the triangle's side runs from start to end
};

class HoleBoundaryMaker {
 public:
  HoleBoundaryMaker(const Model& model, const Surface& surface, const HoleRim& rim, const HoleMarks& marks,
                    const HoleNumbering& numbering, const SizeField& field)
      : model_(model),
        t_(model.tables()),
        surface_(surface),
        rim_(rim),
        marks_(marks),
        numbering_(numbering),
        cad_(numbering.mesh),
        field_(field),
        number_(rim.nodes.size(), kNone),
        free_(rim.free_sides) {}

  FaceBoundary run() {
    find_coedges();
    sort_cad_sides();
    close_poles();
    for (const auto& [a, b] : free_) emit(a, b);
    replace_runs();
    if (rim_.is_turned)
      for (auto& [a, b] : result_.segments) std::swap(a, b);
    limit_sizes();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw Error(ExitCode::kInternal, t_.face_label(rim_.face) + ": " + what);
  }

  NodeId node_of(std::int32_t local) const { return rim_.nodes[local].id; }
  Vec2 uv_of(std::int32_t local) const { return rim_.nodes[local].uv; }

  void find_coedges() {
    for (const CoedgeId c : t_.coedges(rim_.face)) coedges_[t_.coedge_edge[c]].push_back(c);
  }

  const Curve2d& pcurve(CoedgeId c) {
    auto& p = pcurves_[c];
    if (!p) p = model_.pcurve(rim_.face, c);
    return *p;
  }

  /// Distance in (u,v), as parts of the range, between a side and a segment as a coedge has it.
  double mismatch(CoedgeId c, const CadSegment& s, std::int32_t start, std::int32_t end) {
    const double ru = surface_.u_max() - surface_.u_min(), rv = surface_.v_max() - surface_.v_min();
    const auto gap = [&](std::int32_t local, std::int32_t index) {
      const Vec2 d = pcurve(c).point(cad_.edges.node_t[index]) - uv_of(local);
      return std::abs(d.x) / ru + std::abs(d.y) / rv;
    };
    return gap(start, s.index) + gap(end, s.index + 1);
  }

  /// The CAD segment on which a side lies; a seam's two uses are told apart by (u,v), the two sides of a slit by
  /// direction.
  bool find_link(std::int32_t a, std::int32_t b, ChainLink& link) {
    const NodeId na = node_of(a), nb = node_of(b);
    const std::int32_t ccw_a = rim_.is_turned ? b : a;
    double best = 1e300;
    bool found = false;
    for (const CadSegment& s : cad_.segments_between(na, nb)) {
      const auto uses = coedges_.find(s.edge);
      if (uses == coedges_.end()) continue;
      const std::int32_t start = cad_.edge_node[s.index] == na ? a : b, end = start == a ? b : a;
      for (CoedgeId c : uses->second) {
        const bool runs_along = (ccw_a == start) == !t_.coedge_is_reversed[c];
        const double cost = mismatch(c, s, start, end) + (runs_along ? 0 : 1e-6);
        if (cost >= best) continue;
        best = cost;
        link = {c, s.index, start, end, start == a};
        found = true;
      }
    }
    return found;
  }

  void sort_cad_sides() {
    for (const auto& [a, b] : rim_.cad_sides) {
      ChainLink link;
      if (!find_link(a, b, link)) fail("a side of a hole is on none of its edges");
      if (marks_.segment[link.segment])
        links_.push_back(link);
      else
        emit(a, b);
    }
  }

  /// Triangles with two nodes on one pole were dropped when the face was meshed; they belong to the hole: their pole
  /// side bounds it.
  void close_poles() {
    std::vector<std::tuple<NodeId, NodeId, std::size_t>> by_nodes;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const auto [low, high] = std::minmax({node_of(free_[i].first), node_of(free_[i].second)});
      by_nodes.push_back({low, high, i});
    }
    std::sort(by_nodes.begin(), by_nodes.end());
    std::vector<HoleRim::Side> open;
    for (std::size_t k = 0; k < by_nodes.size(); ++k) {
      const auto [low, high, i] = by_nodes[k];
      const bool twice =
          k + 1 < by_nodes.size() && std::get<0>(by_nodes[k + 1]) == low && std::get<1>(by_nodes[k + 1]) == high;
      if (!twice || !close_pole(free_[i], free_[std::get<2>(by_nodes[k + 1])]))
        open.push_back(free_[i]);
      else
        ++k;
    }
    free_ = std::move(open);
  }

  bool close_pole(HoleRim::Side x, HoleRim::Side y) {
    std::int32_t p = kNone, q = kNone;  // the hole's side along the pole runs from p to q
    if (x.first == y.second) p = y.first, q = x.second;
    if (x.second == y.first) p = x.first, q = y.second;
    if (p == kNone || p == q || node_of(p) != node_of(q)) return false;
    emit(p, q);
    result_.nodes[number_[p]].is_pole = result_.nodes[number_[q]].is_pole = true;
    return true;
  }

  std::int32_t boundary_node(std::int32_t local) {
    std::int32_t& number = number_[local];
    if (number == kNone) {
      const NodeId n = node_of(local);
      if (numbering_.number(n) == kNone) fail("a node that goes bounds a hole");
      number = static_cast<std::int32_t>(result_.nodes.size());
      const Vec3 x = rim_.nodes[local].x;
      result_.nodes.push_back({uv_of(local), x, field_.size(x, hint_), numbering_.number(n), false});
    }
    return number;
  }

  void emit(std::int32_t a, std::int32_t b) {
    const std::int32_t first = boundary_node(a);
    result_.segments.push_back({first, boundary_node(b)});
  }

  /// Runs of marked segments, each once per use of its edge, with the new nodes.
  void replace_runs() {
    std::sort(links_.begin(), links_.end(), [](const ChainLink& x, const ChainLink& y) {
      return std::tie(x.coedge, x.segment) < std::tie(y.coedge, y.segment);
    });
    for (std::size_t i = 0, end; i < links_.size(); i = end) {
      for (end = i + 1; end < links_.size() && links_[end].coedge == links_[i].coedge &&
                        links_[end].segment == links_[end - 1].segment + 1;)
        ++end;
      replace_run(links_[i], links_[end - 1]);
    }
  }

  void replace_run(const ChainLink& first, const ChainLink& last) {
    const EdgeId e = t_.coedge_edge[first.coedge];
    const std::int32_t begin = numbering_.update.edges.first_node(e);
    const std::int32_t from = numbering_.update.old_to_new[first.segment],
                       to = numbering_.update.old_to_new[last.segment + 1];
    if (from == kNone || to == kNone) fail("a run of segments is not complete");
    const EdgeMesh& m = numbering_.update.edges;
    const auto add_segment = [&](std::int32_t lower, std::int32_t upper) {
      result_.segments.push_back({first.is_along ? lower : upper, first.is_along ? upper : lower});
    };
    std::int32_t previous = boundary_node(first.start);
    for (std::int32_t k = from + 1; k < to; ++k) {
      result_.nodes.push_back({pcurve(first.coedge).point(m.node_t[k]), m.node_xyz[k], m.node_size[k],
                               numbering_.boundary.edge_node(e, k - begin), false});
      const auto next = static_cast<std::int32_t>(result_.nodes.size()) - 1;
      add_segment(previous, next);
      previous = next;
    }
    add_segment(previous, boundary_node(last.end));
  }

  /// Where the sides around a node are much shorter than the size, the mesh grows from them.
  void limit_sizes() {
    struct Sides {
      double length = 0, n = 0;
    };
    std::vector<Sides> sides(result_.nodes.size());
    for (const auto& [a, b] : result_.segments) {
      const double length = distance(result_.nodes[a].x, result_.nodes[b].x);
      if (!(length > 0)) continue;
      for (std::int32_t k : {a, b}) {
        sides[k].length += length;
        ++sides[k].n;
      }
    }
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (sides[i].length < kShortSides * sides[i].n * result_.nodes[i].h)
        result_.nodes[i].h = kGrowFrom * sides[i].length / sides[i].n;
  }

  const Model& model_;
  const ModelTables& t_;
  const Surface& surface_;
  const HoleRim& rim_;
  const HoleMarks& marks_;
  const HoleNumbering& numbering_;
  const HoleMesh& cad_;
  const SizeField& field_;
  int hint_ = 0;
  std::vector<std::int32_t> number_;  // [rim nodes] in the result
  std::map<EdgeId, std::vector<CoedgeId>> coedges_;
  std::map<CoedgeId, std::unique_ptr<Curve2d>> pcurves_;
  std::vector<HoleRim::Side> free_;
  std::vector<ChainLink> links_;
  FaceBoundary result_;
};

}  // namespace

HoleNumbering::HoleNumbering(const HoleMesh& m, const EdgeUpdate& u)
    : mesh(m), update(u), boundary(m.topology, u.edges), first_inner(boundary.end()) {
  of_node.assign(m.inner_begin[0], kNone);
  for (VertexId v = 0; v < m.tables.n_vertices(); ++v)
    if (m.vertex_node[v] != kNone) of_node[m.vertex_node[v]] = boundary.vertex(v);
  for (NodeId n = 0; n < m.inner_begin[0]; ++n) {
    if (m.node_on_edge[n] == kNone || u.old_to_new[m.node_on_edge[n]] == kNone) continue;
    const EdgeId e = m.mesh.node_entity[n];
    of_node[n] = boundary.edge_node(e, u.old_to_new[m.node_on_edge[n]] - u.edges.first_node(e));
  }
}

FaceBoundary make_hole_boundary(const Model& model, const Surface& surface, const HoleRim& rim, const HoleMarks& marks,
                                const HoleNumbering& numbering, const SizeField& field) {
  if (rim.is_whole_face) return make_face_boundary(model, surface, rim.face, numbering.boundary);
  return HoleBoundaryMaker(model, surface, rim, marks, numbering, field).run();
}

std::vector<BoundaryPlace> hole_places(const FaceBoundary& boundary, const HoleNumbering& numbering) {
  const std::size_t n_nodes = boundary.nodes.size();
  std::vector<BoundaryPlace> places(n_nodes);
  std::vector<std::int32_t> next(n_nodes, kNone);
  std::vector<char> is_inner(n_nodes);
  for (const auto& [a, b] : boundary.segments) next[a] = b;
  for (std::size_t i = 0; i < n_nodes; ++i) {
    is_inner[i] = numbering.is_inner(boundary.nodes[i].id);
    if (!is_inner[i]) places[i] = place_on_edge(boundary.nodes[i].id, numbering.boundary);
  }
  std::vector<char> is_open = is_inner;
  const auto number_run = [&](std::int32_t first) {
    std::vector<std::int32_t> run;
    std::int32_t i = first;
    for (; i != kNone && is_open[i]; i = next[i]) {
      is_open[i] = 0;
      run.push_back(i);
    }
    if (i != kNone && !is_inner[i]) places[i] = {};
    const auto n = static_cast<std::int32_t>(run.size());
    for (std::int32_t k = 0; k < n; ++k) places[run[k]] = {k, std::max(1, std::min(k, n - k)), true};
  };
  for (std::size_t i = 0; i < n_nodes; ++i) {
    if (is_inner[i] || next[i] == kNone || !is_inner[next[i]]) continue;
    places[i] = {};
    number_run(next[i]);
  }
  for (std::size_t i = 0; i < n_nodes; ++i) number_run(static_cast<std::int32_t>(i));  // loops inside the face
  return places;
}

Piece make_hole_fill(const HoleRim& rim, const FaceBoundary& boundary, FaceMesh mesh) {
  for (std::size_t i = 0; rim.is_turned && i < mesh.corners.size(); i += 3)
    std::swap(mesh.corners[i + 1], mesh.corners[i + 2]);
  Piece fill;
  fill.mesh = std::move(mesh);
  fill.boundary = boundary.nodes;
  return fill;
}

}  // namespace st
