#include "mesh/checks.h"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/log.h"
#include "base/threads.h"

namespace st {

namespace {

Vec3 corner(const SurfaceMesh& mesh, TriangleId t, int k) { return mesh.node_xyz[mesh.triangles[t].n[k]]; }

/// Twice the area vector.
Vec3 area_vector(const SurfaceMesh& mesh, TriangleId t) {
  const Vec3 a = corner(mesh, t, 0);
  return cross(corner(mesh, t, 1) - a, corner(mesh, t, 2) - a);
}

Vec3 centroid(const SurfaceMesh& mesh, TriangleId t) {
  return (corner(mesh, t, 0) + corner(mesh, t, 1) + corner(mesh, t, 2)) / 3;
}

DefectPlace at_triangle(const SurfaceMesh& mesh, TriangleId t, const OwnTriangles& own) {
  return {centroid(mesh, t), mesh.triangle_face[t], kNone, own.number(t)};
}

/// Finds the CAD edges that a mesh edge lies on, to see what the CAD allows there. Vertices drawn together are one, and
/// where a strip is closed its kept edge stands for the other one as well.
class CadEdgeLookup {
 public:
  CadEdgeLookup(const SurfaceMesh& mesh, const CadEdges& cad) : mesh_(mesh), vertices_(count_vertices(mesh, cad)) {
    const auto vertex = [&](EdgeId e, int end) { return cad.edge_vertices[2 * e + end]; };
    const auto n_edges = static_cast<EdgeId>(cad.edge_vertices.size() / 2);
    if (n_edges == 0) return;
    for (const EdgeId e : mesh.merged.edge) vertices_.join(vertex(e, 0), vertex(e, 1));
    for (EdgeId e = 0; e < n_edges; ++e) edges_between_.emplace(ends(vertex(e, 0), vertex(e, 1)), e);
    for (std::size_t i = 0; i < mesh.merged.strip_kept.size(); ++i)
      also_.emplace(mesh.merged.strip_kept[i], mesh.merged.strip_closed[i]);
  }
  /// Whether `flags` is set for a CAD edge under the mesh edge (a, b).
  bool is_allowed(std::span<const std::uint8_t> flags, NodeId a, NodeId b) {
    if (flags.empty()) return false;
    if (dim(a) < dim(b)) std::swap(a, b);
    if (dim(a) == 1)
      return (dim(b) == 0 || mesh_.node_entity[a] == mesh_.node_entity[b]) && has(flags, mesh_.node_entity[a]);
    if (dim(a) != 0) return false;
    const auto [begin, end] = edges_between_.equal_range(ends(mesh_.node_entity[a], mesh_.node_entity[b]));
    return std::any_of(begin, end, [&](const auto& pair) { return has(flags, pair.second); });
  }

 private:
  static VertexId count_vertices(const SurfaceMesh& mesh, const CadEdges& cad) {
    VertexId n = 0;
    for (const VertexId v : cad.edge_vertices) n = std::max(n, v + 1);
    for (NodeId i = 0; i < mesh.n_nodes(); ++i)
      if (mesh.node_entity_dim[i] == 0) n = std::max(n, mesh.node_entity[i] + 1);
    return n;
  }
  std::pair<VertexId, VertexId> ends(VertexId v, VertexId w) {
    return std::minmax({vertices_.find(v), vertices_.find(w)});
  }
  bool has(std::span<const std::uint8_t> flags, EdgeId e) const {
    const auto [begin, end] = also_.equal_range(e);
    return flags[e] != 0 || std::any_of(begin, end, [&](const auto& pair) { return flags[pair.second] != 0; });
  }

  int dim(NodeId n) const { return mesh_.node_entity_dim[n]; }
  const SurfaceMesh& mesh_;
  DisjointSets vertices_;  // of the CAD, joined where they have one node
  std::multimap<std::pair<VertexId, VertexId>, EdgeId> edges_between_;
  std::multimap<EdgeId, EdgeId> also_;
};

/// The node of a side's triangle that is not on the side.
NodeId opposite(const SurfaceMesh& mesh, SideId side) { return mesh.triangles[side / 3].n[(side % 3 + 2) % 3]; }

/// Duplicates among the triangles on the edge between their two lowest nodes.
void find_duplicates(const SurfaceMesh& mesh, NodeId low, NodeId high, std::span<const SideId> sides,
                     const OwnTriangles& own, Defects& duplicates) {
  if (sides.size() < 2) return;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const NodeId third = opposite(mesh, sides[i]);
    if (third < high) continue;
    const bool is_repeated =
        std::any_of(sides.begin(), sides.begin() + i, [&](SideId s) { return opposite(mesh, s) == third; });
    if (is_repeated)
      duplicates.add({centroid(mesh, sides[i] / 3), mesh.triangle_face[sides[i] / 3], kNone, own.order(low, high)});
  }
}

Defects find_pinched_nodes(const SurfaceMesh& mesh, const EdgeTable& edges, const OwnTriangles& own) {
  Defects pinched;
  const std::vector<SideId> fan = find_fans(mesh.triangles, edges);
  std::vector<std::uint8_t> n_fans(mesh.n_nodes(), 0);
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(fan.size()); ++c) {
    if (fan[c] != c) continue;
    const Triangle& t = mesh.triangles[c / 3];
    if (has_repeated_node(t)) continue;
    if (++n_fans[t.n[c % 3]] == 2 && own.has(c / 3))
      pinched.add(
          {mesh.node_xyz[t.n[c % 3]], mesh.triangle_face[c / 3], kNone, 3 * std::int64_t{own.number(c / 3)} + c % 3});
    n_fans[t.n[c % 3]] = std::min<std::uint8_t>(n_fans[t.n[c % 3]], 3);
  }
  return pinched;
}

}  // namespace

void Defects::merge(const Defects& other) {
  count += other.count;
  first.insert(first.end(), other.first.begin(), other.first.end());
  std::stable_sort(first.begin(), first.end(),
                   [](const DefectPlace& a, const DefectPlace& b) { return a.order < b.order; });
  if (first.size() > kMaxPlaces) first.resize(kMaxPlaces);
}

MeshParts count_parts(std::span<const Triangle> triangles, std::int64_t n_nodes) {
  MeshParts parts;
  const std::vector<std::int32_t> component = node_components(triangles, n_nodes, parts.n_components);
  parts.n_used_nodes = n_nodes - std::count(component.begin(), component.end(), kNone);
  return parts;
}

void TopologyReport::add(const TopologyReport& other) {
  n_edges += other.n_edges;
  n_cad_boundary_edges += other.n_cad_boundary_edges;
  n_cad_nonmanifold_edges += other.n_cad_nonmanifold_edges;
  for (Defects TopologyReport::*list :
       {&TopologyReport::boundary_edges, &TopologyReport::nonmanifold_edges, &TopologyReport::misoriented_edges,
        &TopologyReport::repeated_nodes, &TopologyReport::duplicate_triangles, &TopologyReport::pinched_nodes})
    (this->*list).merge(other.*list);
}

void TopologyReport::set_parts(const MeshParts& parts, std::int64_t n_triangles) {
  n_components = parts.n_components;
  n_used_nodes = parts.n_used_nodes;
  euler = n_used_nodes - n_edges + n_triangles - repeated_nodes.count;
  genus = n_components - euler / 2;
}

namespace {

/// What is at edges alone.
void check_edges(const SurfaceMesh& mesh, const EdgeTable& edges, const CadEdges& cad, const OwnTriangles& own,
                 TopologyReport& r) {
  CadEdgeLookup lookup(mesh, cad);
  const auto at_edge = [&](NodeId a, NodeId b, std::span<const SideId> sides) {
    return DefectPlace{0.5 * (mesh.node_xyz[a] + mesh.node_xyz[b]), mesh.triangle_face[sides[0] / 3],
                       sides.size() > 1 ? mesh.triangle_face[sides[1] / 3] : kNone, own.order(a, b)};
  };
  edges.for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> sides) {
    if (!own.has_side(sides[0])) return;
    ++r.n_edges;
    if (sides.size() == 1) {
      if (lookup.is_allowed(cad.may_be_open, a, b))
        ++r.n_cad_boundary_edges;
      else
        r.boundary_edges.add(at_edge(a, b, sides));
    } else if (sides.size() > 2) {
      if (lookup.is_allowed(cad.may_be_nonmanifold, a, b))
        ++r.n_cad_nonmanifold_edges;
      else
        r.nonmanifold_edges.add(at_edge(a, b, sides));
    } else if (run_alike(mesh.triangles, sides[0], sides[1])) {
      r.misoriented_edges.add(at_edge(a, b, sides));
    }
    find_duplicates(mesh, a, b, sides, own, r.duplicate_triangles);
  });
}

}  // namespace

TopologyReport check_topology(const SurfaceMesh& mesh, const EdgeTable& edges, const CadEdges& cad) {
  return check_topology(mesh, edges, cad, OwnTriangles::all(mesh));
}

TopologyReport check_topology(const SurfaceMesh& mesh, const EdgeTable& edges, const CadEdges& cad,
                              const OwnTriangles& own) {
  TopologyReport r;
  MeshParts parts;
  run_jobs({[&] { check_edges(mesh, edges, cad, own, r); },
            [&] { r.pinched_nodes = find_pinched_nodes(mesh, edges, own); },
            [&] {
              for (TriangleId t = own.begin; t < own.end; ++t)
                if (has_repeated_node(mesh.triangles[t])) r.repeated_nodes.add(at_triangle(mesh, t, own));
              if (own.is_all(mesh)) parts = count_parts(mesh.triangles, mesh.n_nodes());
            }});
  if (own.is_all(mesh)) r.set_parts(parts, mesh.n_triangles());
  return r;
}

std::vector<MeasurePart> measure_mesh(const SurfaceMesh& mesh, Vec3 origin, const OwnTriangles& own) {
  std::vector<MeasurePart> parts;
  for (TriangleId t = own.begin; t < own.end; ++t) {
    const bool is_new = static_cast<std::size_t>(t - own.begin) % kTrianglesPerPiece == 0;
    if (is_new || parts.back().face != mesh.triangle_face[t]) parts.push_back({mesh.triangle_face[t]});
    const Vec3 v = area_vector(mesh, t);
    parts.back().area += 0.5 * norm(v);
    parts.back().volume += dot(corner(mesh, t, 0) - origin, v) / 6;
  }
  return parts;
}

MeshMeasure measure_of(std::span<const MeasurePart> parts, std::size_t n_faces) {
  MeshMeasure r;
  r.face_area.assign(n_faces, 0);
  for (const MeasurePart& part : parts) {
    const auto face = static_cast<std::size_t>(part.face);
    if (face >= r.face_area.size()) r.face_area.resize(face + 1, 0);
    r.face_area[face] += part.area;
    r.volume += part.volume;
  }
  for (const double a : r.face_area) r.area += a;
  return r;
}

MeshMeasure measure_mesh(const SurfaceMesh& mesh) {
  Box3 box;
  for (const Vec3 p : mesh.node_xyz) box.add(p);
  return measure_of(measure_mesh(mesh, box.center(), OwnTriangles::all(mesh)), mesh.labels.face_name.size());
}

namespace {

/// An edge between boundary nodes that lies at two places of (u,v): a seam, where the surface may end in a sharp edge
/// like any CAD edge.
bool is_seam(const SurfaceMesh& mesh, NodeId a, NodeId b, TriangleId s, TriangleId t) {
  constexpr auto kInner = static_cast<std::uint8_t>(EntityDim::kFace);
  if (mesh.corner_uv.empty() || mesh.node_entity_dim[a] == kInner || mesh.node_entity_dim[b] == kInner) return false;
  const auto uv = [&](TriangleId i, NodeId n) {
    const auto& corners = mesh.triangles[i].n;
    return mesh.corner_uv[3 * i + (corners[0] == n ? 0 : corners[1] == n ? 1 : 2)];
  };
  const Vec2 da = uv(s, a) - uv(t, a), db = uv(s, b) - uv(t, b);
  return norm(da) > 0 || norm(db) > 0;
}

void find_folds(const SurfaceMesh& mesh, const EdgeTable& edges, const OwnTriangles& own, Defects& folds) {
  edges.for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> sides) {
    if (!own.has_side(sides[0])) return;
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const TriangleId s = sides[0] / 3, t = sides[i] / 3;
      if (mesh.triangle_face[s] != mesh.triangle_face[t] || is_seam(mesh, a, b, s, t)) continue;
      const Vec3 ns = area_vector(mesh, s), nt = area_vector(mesh, t);
      const bool is_misoriented = sides.size() == 2 && run_alike(mesh.triangles, sides[0], sides[1]);  // a defect of
                                                                                                       // its own, no
                                                                                                       // fold
      const double cosine = is_misoriented ? -dot(ns, nt) : dot(ns, nt);
      if (cosine < 0 && cosine < kFoldCosine * norm(ns) * norm(nt))
        folds.add({0.5 * (mesh.node_xyz[a] + mesh.node_xyz[b]), mesh.triangle_face[s], kNone, own.order(a, b)});
    }
  });
}

/// Any face that uses each node, for places.
FaceId face_of(const SurfaceMesh& mesh, NodeId n) {
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t)
    for (const NodeId m : mesh.triangles[t].n)
      if (m == n) return mesh.triangle_face[t];
  return kNone;
}

/// The last node that was seen at each place of a component.
class LastAtPlace {
 public:
  LastAtPlace(std::span<const Vec3> xyz, std::span<const std::int32_t> component)
      : xyz_(xyz), component_(component), slots_(std::bit_ceil(2 * xyz.size() + 1), kNone) {}

  /// Puts the node in the place of the last one there, and returns that, or kNone.
  NodeId exchange(NodeId n) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hash(n) & mask;
    while (slots_[i] != kNone && !are_together(slots_[i], n)) i = (i + 1) & mask;
    return std::exchange(slots_[i], n);
  }

 private:
  bool are_together(NodeId a, NodeId b) const { return component_[a] == component_[b] && xyz_[a] == xyz_[b]; }
  std::size_t hash(NodeId n) const {
    auto h = static_cast<std::uint64_t>(component_[n]);
    for (const double x : {xyz_[n].x, xyz_[n].y, xyz_[n].z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15u;  // + 0.0: -0 and 0 are one place
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }

  std::span<const Vec3> xyz_;
  std::span<const std::int32_t> component_;
  std::vector<NodeId> slots_;
};

/// Whether any two nodes are at one place.
bool has_equal_places(std::span<const Vec3> xyz) {
  const std::vector<std::int32_t> one_component(xyz.size(), 0);
  LastAtPlace last(xyz, one_component);
  for (std::size_t n = 0; n < xyz.size(); ++n)
    if (last.exchange(static_cast<NodeId>(n)) != kNone) return true;
  return false;
}

}  // namespace

Defects find_duplicate_nodes(const SurfaceMesh& mesh) {
  Defects duplicates;
  if (!has_equal_places(mesh.node_xyz)) return duplicates;
  std::int32_t n_components = 0;
  const std::vector<std::int32_t> component = node_components(mesh.triangles, mesh.n_nodes(), n_components);
  const auto is_vertex = [&](NodeId n) {
    return !mesh.node_entity_dim.empty() && mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex);
  };
  LastAtPlace last(mesh.node_xyz, component);
  std::vector<NodeId> found;
  for (NodeId n = 0; n < mesh.n_nodes(); ++n) {
    if (component[n] == kNone) continue;
    const NodeId before = last.exchange(n);
    if (before != kNone && !(is_vertex(n) && is_vertex(before))) found.push_back(n);
  }
  for (std::size_t i = 0; i < found.size(); ++i)
    duplicates.add({mesh.node_xyz[found[i]], i < Defects::kMaxPlaces ? face_of(mesh, found[i]) : kNone, kNone});
  return duplicates;
}

void ShapeReport::add(const ShapeReport& other) {
  zero_area.merge(other.zero_area);
  duplicate_nodes.merge(other.duplicate_nodes);
  folds.merge(other.folds);
}

ShapeReport check_shape(const SurfaceMesh& mesh, const EdgeTable& edges) {
  return check_shape(mesh, edges, OwnTriangles::all(mesh));
}

ShapeReport check_shape(const SurfaceMesh& mesh, const EdgeTable& edges, const OwnTriangles& own) {
  ShapeReport r;
  run_jobs({[&] { find_folds(mesh, edges, own, r.folds); },
            [&] {
              for (TriangleId t = own.begin; t < own.end; ++t)
                if (!has_repeated_node(mesh.triangles[t]) && is_degenerate(mesh.node_xyz, mesh.triangles[t]))
                  r.zero_area.add(at_triangle(mesh, t, own));
            },
            [&] {
              if (own.is_all(mesh)) r.duplicate_nodes = find_duplicate_nodes(mesh);
            }});
  return r;
}

CrossingReport check_crossings(const SurfaceMesh& mesh, const CadOfPairs& cad) {
  bool was_ended = false;
  const std::vector<TrianglePair> pairs = find_crossing_triangles(mesh.node_xyz, mesh.triangles, was_ended);
  std::int32_t n_components = 0;
  std::vector<std::int32_t> component;
  if (!pairs.empty()) component = node_components(mesh.triangles, mesh.n_nodes(), n_components);
  return check_crossings(mesh, pairs, component, was_ended, cad);
}

CrossingReport check_crossings(const SurfaceMesh& mesh, std::span<const TrianglePair> pairs,
                               std::span<const std::int32_t> component, bool was_ended, const CadOfPairs& cad) {
  CrossingReport r;
  for (const TrianglePair& p : pairs) {
    const bool is_between = component[mesh.triangles[p.a].n[0]] != component[mesh.triangles[p.b].n[0]];
    const bool is_contact = is_between && !(cad.is_one_body && cad.is_one_body(p));
    const bool is_own = !is_contact && cad.touches_itself && cad.touches_itself(p);
    const bool is_sheet = is_own && cad.is_of_sheet && cad.is_of_sheet(p);
    const bool is_gap = is_contact && cad.keeps_apart && cad.keeps_apart(p);
    Defects& kind = is_gap       ? r.walls
                    : is_contact ? r.contacts
                    : is_sheet   ? r.contacts
                    : is_own     ? r.cad_contacts
                    : p.n_shared ? r.overlapping_neighbours
                                 : r.crossings;
    kind.add({centroid(mesh, p.a), mesh.triangle_face[p.a], mesh.triangle_face[p.b]});
  }
  if (was_ended) {
    log_warning("too many triangles lie in others: the search for crossings was ended, there are more");
    r.crossings.add({});
  }
  return r;
}

}  // namespace st
