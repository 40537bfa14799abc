#include "meshing/hole_filler.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>

#include "base/error.h"

namespace st {
namespace {

constexpr double kShortSides = 0.6;  // of the requested length: where the sides around a node are shorter the mesh grows from them
constexpr double kGrowFrom = 1.25;   // times their length

/// A marked segment as one triangle of the hole uses it.
struct ChainLink {
  CoedgeId coedge;
  std::int32_t segment;
  std::int32_t start, end;  // corners' local nodes at the segment's lower and upper end
};

class HoleBoundaryMaker {
 public:
  HoleBoundaryMaker(const Model& model, const Surface& surface, FaceId face, const HoleMarks& marks, const HoleNumbering& numbering,
                    const SizeField& field)
      : model_(model),
        t_(model.tables()),
        surface_(surface),
        face_(face),
        marks_(marks),
        numbering_(numbering),
        cad_(numbering.mesh),
        mesh_(cad_.mesh),
        field_(field) {}

  FaceBoundary run() {
    number_corners();
    find_coedges();
    collect_sides();
    cancel_inner_sides();
    close_poles();
    for (const auto& [a, b] : free_) emit(a, b);
    replace_runs();
    limit_sizes();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const char* what) const { throw Error(ExitCode::kInternal, t_.face_label(face_) + ": " + what); }

  /// Local numbers of the corners of marked triangles: a node with another (u,v) is another one.
  void number_corners() {
    for (TriangleId i = cad_.face_begin[face_]; i < cad_.face_begin[face_ + 1]; ++i)
      if (marks_.triangle[i])
        for (int k = 0; k < 3; ++k) corners_.push_back(3 * i + k);
    const auto key = [&](std::int32_t c) {
      return std::tuple(mesh_.triangles[c / 3].n[c % 3], mesh_.corner_uv[c].x, mesh_.corner_uv[c].y);
    };
    std::vector<std::int32_t> order(corners_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      const auto ka = key(corners_[a]), kb = key(corners_[b]);
      return ka < kb || (ka == kb && a < b);
    });
    local_.resize(corners_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || key(corners_[order[i]]) != key(corners_[order[i - 1]])) first_corner_.push_back(corners_[order[i]]);
      local_[order[i]] = static_cast<std::int32_t>(first_corner_.size()) - 1;
    }
    number_.assign(first_corner_.size(), kNone);
  }

  NodeId node_of(std::int32_t local) const { return mesh_.triangles[first_corner_[local] / 3].n[first_corner_[local] % 3]; }
  Vec2 uv_of(std::int32_t local) const { return mesh_.corner_uv[first_corner_[local]]; }

  void find_coedges() {
    for (CoedgeId c = t_.loop_coedge_offsets[t_.face_loop_offsets[face_]]; c < t_.loop_coedge_offsets[t_.face_loop_offsets[face_ + 1]]; ++c)
      coedges_[t_.coedge_edge[c]].push_back(c);
  }

  const Curve2d& pcurve(CoedgeId c) {
    auto& p = pcurves_[c];
    if (!p) p = model_.pcurve(face_, c);
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

  /// The CAD segment on which a side lies; a seam's two uses are told apart by (u,v), the two sides of a slit by direction.
  bool find_link(std::int32_t a, std::int32_t b, ChainLink& link) {
    const NodeId na = node_of(a), nb = node_of(b);
    if (cad_.inner_begin[0] <= std::max(na, nb)) return false;
    const std::int32_t ccw_a = cad_.face_is_turned[face_] ? b : a;
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
        link = {c, s.index, start, end};
        found = true;
      }
    }
    return found;
  }

  void collect_sides() {
    for (std::size_t i = 0; i < corners_.size(); i += 3)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = local_[i + k], b = local_[i + (k + 1) % 3];
        ChainLink link;
        if (!find_link(a, b, link))
          free_.push_back({a, b});
        else if (marks_.segment[link.segment])
          links_.push_back(link);
        else
          emit(a, b);
      }
  }

  /// Sides used by two marked triangles are inside the hole.
  void cancel_inner_sides() {
    using Side = std::pair<std::int32_t, std::int32_t>;
    std::sort(free_.begin(), free_.end(), [](const Side& x, const Side& y) {
      return std::tuple(std::min(x.first, x.second), std::max(x.first, x.second), x.first) <
             std::tuple(std::min(y.first, y.second), std::max(y.first, y.second), y.first);
    });
    std::vector<Side> odd;
    for (std::size_t i = 0, end; i < free_.size(); i = end) {
      for (end = i + 1; end < free_.size() && std::min(free_[i].first, free_[i].second) == std::min(free_[end].first, free_[end].second) &&
                        std::max(free_[i].first, free_[i].second) == std::max(free_[end].first, free_[end].second);)
        ++end;
      if ((end - i) % 2) odd.push_back(free_[i]);
    }
    free_ = std::move(odd);
  }

  /// Triangles with two nodes on one pole were dropped when the face was meshed; they belong to the hole: their pole side bounds it.
  void close_poles() {
    std::vector<std::tuple<NodeId, NodeId, std::size_t>> by_nodes;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const auto [low, high] = std::minmax(node_of(free_[i].first), node_of(free_[i].second));
      by_nodes.push_back({low, high, i});
    }
    std::sort(by_nodes.begin(), by_nodes.end());
    std::vector<std::pair<std::int32_t, std::int32_t>> open;
    for (std::size_t k = 0; k < by_nodes.size(); ++k) {
      const auto [low, high, i] = by_nodes[k];
      const bool twice = k + 1 < by_nodes.size() && std::get<0>(by_nodes[k + 1]) == low && std::get<1>(by_nodes[k + 1]) == high;
      if (!twice || !close_pole(free_[i], free_[std::get<2>(by_nodes[k + 1])]))
        open.push_back(free_[i]);
      else
        ++k;
    }
    free_ = std::move(open);
  }

  bool close_pole(std::pair<std::int32_t, std::int32_t> x, std::pair<std::int32_t, std::int32_t> y) {
    std::int32_t p = kNone, q = kNone;
    if (x.first == y.second) p = x.second, q = y.first;
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
      if (numbering_.of_node[n] == kNone) fail("a node that goes bounds a hole");
      number = static_cast<std::int32_t>(result_.nodes.size());
      result_.nodes.push_back({uv_of(local), mesh_.node_xyz[n], field_.size(mesh_.node_xyz[n], hint_), numbering_.of_node[n], false});
    }
    return number;
  }

  void emit(std::int32_t a, std::int32_t b) {
    const std::int32_t first = boundary_node(a);
    result_.segments.push_back({first, boundary_node(b)});
  }

  /// Runs of marked segments, each once per use of its edge, with the new nodes.
  void replace_runs() {
    std::sort(links_.begin(), links_.end(),
              [](const ChainLink& x, const ChainLink& y) { return std::tie(x.coedge, x.segment) < std::tie(y.coedge, y.segment); });
    for (std::size_t i = 0, end; i < links_.size(); i = end) {
      for (end = i + 1;
           end < links_.size() && links_[end].coedge == links_[i].coedge && links_[end].segment == links_[end - 1].segment + 1;)
        ++end;
      replace_run(links_[i], links_[end - 1]);
    }
  }

  void replace_run(const ChainLink& first, const ChainLink& last) {
    const EdgeId e = t_.coedge_edge[first.coedge];
    const std::int32_t begin = numbering_.update.edges.edge_offsets[e];
    const std::int32_t from = numbering_.update.old_to_new[first.segment], to = numbering_.update.old_to_new[last.segment + 1];
    if (from == kNone || to == kNone) fail("a run of segments is not complete");
    const EdgeMesh& m = numbering_.update.edges;
    std::int32_t previous = boundary_node(first.start);
    for (std::int32_t k = from + 1; k < to; ++k) {
      result_.nodes.push_back(
          {pcurve(first.coedge).point(m.node_t[k]), m.node_xyz[k], m.node_size[k], numbering_.boundary.edge_node(e, k - begin), false});
      const auto next = static_cast<std::int32_t>(result_.nodes.size()) - 1;
      result_.segments.push_back({previous, next});
      previous = next;
    }
    result_.segments.push_back({previous, boundary_node(last.end)});
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
      if (sides[i].length < kShortSides * sides[i].n * result_.nodes[i].h) result_.nodes[i].h = kGrowFrom * sides[i].length / sides[i].n;
  }

  const Model& model_;
  const ModelTables& t_;
  const Surface& surface_;
  FaceId face_;
  const HoleMarks& marks_;
  const HoleNumbering& numbering_;
  const HoleMesh& cad_;
  const SurfaceMesh& mesh_;
  const SizeField& field_;
  int hint_ = 0;
  std::vector<std::int32_t> corners_, local_, first_corner_, number_;
  std::map<EdgeId, std::vector<CoedgeId>> coedges_;
  std::map<CoedgeId, std::unique_ptr<Curve2d>> pcurves_;
  std::vector<std::pair<std::int32_t, std::int32_t>> free_;
  std::vector<ChainLink> links_;
  FaceBoundary result_;
};

/// Numbers the nodes that a patch takes over: boundary nodes by id, then inner nodes by id. The inner ids of a face are consecutive.
class PatchNodes {
 public:
  PatchNodes(std::int32_t first_inner, std::int32_t n_inner) : first_inner_(first_inner), inner_(n_inner, kNone) {}
  void add(std::int32_t id) {
    if (id < first_inner_)
      boundary_.push_back(id);
    else
      inner_[id - first_inner_] = 0;
  }
  void number_all() {
    std::sort(boundary_.begin(), boundary_.end());
    boundary_.erase(std::unique(boundary_.begin(), boundary_.end()), boundary_.end());
    ids_ = boundary_;
    for (std::size_t i = 0; i < inner_.size(); ++i) {
      if (inner_[i] == kNone) continue;
      inner_[i] = static_cast<std::int32_t>(ids_.size());
      ids_.push_back(first_inner_ + static_cast<std::int32_t>(i));
    }
  }
  std::int32_t number(std::int32_t id) const {
    if (id >= first_inner_) return inner_[id - first_inner_];
    return static_cast<std::int32_t>(std::lower_bound(boundary_.begin(), boundary_.end(), id) - boundary_.begin());
  }
  const std::vector<std::int32_t>& ids() const { return ids_; }

 private:
  std::int32_t first_inner_;
  std::vector<std::int32_t> boundary_, inner_, ids_;
};

void add_known_nodes(const PatchNodes& nodes, const HoleNumbering& numbering, FacePatch& p) {
  const HoleMesh& cad = numbering.mesh;
  for (std::int32_t id : nodes.ids()) {
    if (numbering.is_inner(id)) {
      const NodeId n = numbering.mesh_node(id);
      p.inner_xyz.push_back(cad.mesh.node_xyz[n]);
      p.inner_size.push_back(cad.mesh.node_size[n]);
      p.inner_previous.push_back(n);
      continue;
    }
    const auto entity = numbering.boundary.entity(id);
    p.boundary_dim.push_back(static_cast<std::uint8_t>(entity.dim));
    p.boundary_entity.push_back(entity.entity);
    p.boundary_index.push_back(entity.index);
    ++p.n_boundary;
  }
  p.inner_uv.resize(p.inner_xyz.size());
}

}  // namespace

HoleNumbering::HoleNumbering(const HoleMesh& m, const EdgeUpdate& u)
    : mesh(m), update(u), boundary(m.tables, u.edges, m.mesh.merged), first_inner(boundary.first_inner.back()) {
  const auto n_nodes = static_cast<NodeId>(m.mesh.node_xyz.size());
  of_node.assign(n_nodes, kNone);
  for (VertexId v = 0; v < m.tables.n_vertices(); ++v)
    if (m.vertex_node[v] != kNone) of_node[m.vertex_node[v]] = boundary.vertex(v);
  for (NodeId n = 0; n < m.inner_begin[0]; ++n) {
    if (m.node_on_edge[n] == kNone || u.old_to_new[m.node_on_edge[n]] == kNone) continue;
    const EdgeId e = m.mesh.node_entity[n];
    of_node[n] = boundary.edge_node(e, u.old_to_new[m.node_on_edge[n]] - u.edges.edge_offsets[e]);
  }
  for (NodeId n = m.inner_begin[0]; n < n_nodes; ++n) of_node[n] = inner(n);
}

FaceBoundary make_hole_boundary(const Model& model, const Surface& surface, FaceId face, const HoleMarks& marks,
                                const HoleNumbering& numbering, const SizeField& field) {
  const auto begin = marks.triangle.begin() + numbering.mesh.face_begin[face],
             end = marks.triangle.begin() + numbering.mesh.face_begin[face + 1];
  if (std::find(begin, end, 0) == end) return make_face_boundary(model, surface, face, numbering.boundary);
  return HoleBoundaryMaker(model, surface, face, marks, numbering, field).run();
}

FacePatch make_hole_patch(FaceId face, const HoleMarks& marks, const HoleNumbering& numbering, const FaceBoundary* boundary,
                          const FaceMesh* fill) {
  const HoleMesh& cad = numbering.mesh;
  const SurfaceMesh& m = cad.mesh;
  PatchNodes nodes(numbering.inner(cad.inner_begin[face]), cad.inner_begin[face + 1] - cad.inner_begin[face]);
  const auto kept = [&](TriangleId i) { return fill == nullptr || !marks.triangle[i]; };
  for (TriangleId i = cad.face_begin[face]; i < cad.face_begin[face + 1]; ++i)
    for (int k = 0; k < 3 && kept(i); ++k) nodes.add(numbering.of_node[m.triangles[i].n[k]]);
  const std::int32_t n_local = boundary ? static_cast<std::int32_t>(boundary->nodes.size()) : 0;
  if (boundary)
    for (const auto& n : boundary->nodes) nodes.add(n.id);
  nodes.number_all();
  FacePatch p;
  p.face = face;
  add_known_nodes(nodes, numbering, p);
  for (TriangleId i = cad.face_begin[face]; i < cad.face_begin[face + 1]; ++i) {
    if (!kept(i)) continue;
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      t.n[k] = nodes.number(numbering.of_node[m.triangles[i].n[k]]);
      p.corner_uv.push_back(m.corner_uv[3 * i + k]);
      if (t.n[k] >= p.n_boundary) p.inner_uv[t.n[k] - p.n_boundary] = p.corner_uv.back();
    }
    p.triangles.push_back(t);
    p.triangle_previous.push_back(i);
  }
  if (!fill) return p;
  const auto n_known = static_cast<std::int32_t>(nodes.ids().size());
  for (const FaceMesh::InnerNode& n : fill->inner) {
    p.inner_xyz.push_back(n.x);
    p.inner_uv.push_back(n.uv);
    p.inner_size.push_back(n.h);
    p.inner_previous.push_back(kNone);
  }
  for (std::size_t i = 0; i < fill->corners.size(); i += 3) {
    std::int32_t c[3] = {fill->corners[i], fill->corners[i + 1], fill->corners[i + 2]};
    if (cad.face_is_turned[face]) std::swap(c[1], c[2]);
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      const bool is_known = c[k] < n_local;
      t.n[k] = is_known ? nodes.number(boundary->nodes[c[k]].id) : n_known + c[k] - n_local;
      p.corner_uv.push_back(is_known ? boundary->nodes[c[k]].uv : fill->inner[c[k] - n_local].uv);
    }
    p.triangles.push_back(t);
    p.triangle_previous.push_back(kNone);
  }
  return p;
}

}  // namespace st
