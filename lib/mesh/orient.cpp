#include "mesh/orient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/boxes.h"
#include "base/predicates.h"
#include "base/threads.h"
#include "mesh/adjacency.h"

namespace st {

namespace {

FaceId count_faces(const SurfaceMesh& mesh) {
  FaceId n = 0;
  for (const FaceId f : mesh.triangle_face) n = std::max(n, f + 1);
  return n;
}

constexpr std::size_t kNodesPerPiece = 2'048;

std::vector<FaceLink> find_links(const SurfaceMesh& mesh, const EdgeTable& edges) {
  const auto n = static_cast<std::size_t>(edges.n_nodes());
  std::vector<std::vector<FaceLink>> pieces((n + kNodesPerPiece - 1) / kNodesPerPiece);
  parallel_for(n, kNodesPerPiece, [&](std::size_t begin, std::size_t end) {
    edges.for_each_edge(
        static_cast<NodeId>(begin), static_cast<NodeId>(end), [&](NodeId, NodeId, std::span<const SideId> sides) {
          if (sides.size() != 2) return;
          const auto [a, b] = std::minmax(mesh.triangle_face[sides[0] / 3], mesh.triangle_face[sides[1] / 3]);
          if (a == b) return;
          const int agreement = run_alike(mesh.triangles, sides[0], sides[1]) ? -1 : 1;
          pieces[begin / kNodesPerPiece].push_back({a, b, agreement});
        });
  });
  std::vector<FaceLink> links;
  for (std::vector<FaceLink>& piece : pieces) {
    unite_links(piece);
    links.insert(links.end(), piece.begin(), piece.end());
  }
  unite_links(links);
  return links;
}

std::vector<double> face_areas(const SurfaceMesh& mesh, FaceId n_faces) {
  std::vector<double> area(n_faces, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& n = mesh.triangles[t].n;
    area[mesh.triangle_face[t]] +=
        0.5 * norm(cross(mesh.node_xyz[n[1]] - mesh.node_xyz[n[0]], mesh.node_xyz[n[2]] - mesh.node_xyz[n[0]]));
  }
  return area;
}

/// Components by flooding over the links; `is_turned[f]`: face f must turn to agree with the lowest face of its
/// component.
std::vector<FaceComponent> flood(std::span<const FaceLink> links, std::span<const double> area,
                                 std::vector<std::uint8_t>& is_turned) {
  const auto n_faces = static_cast<FaceId>(area.size());
  std::vector<std::vector<std::pair<FaceId, bool>>> neighbours(n_faces);
  for (const FaceLink& l : links) {
    neighbours[l.a].emplace_back(l.b, l.agreement < 0);
    neighbours[l.b].emplace_back(l.a, l.agreement < 0);
  }
  std::vector<FaceComponent> components;
  std::vector<std::uint8_t> is_seen(n_faces, 0);
  is_turned.assign(n_faces, 0);
  for (FaceId seed = 0; seed < n_faces; ++seed) {
    if (is_seen[seed] || area[seed] == 0) continue;
    FaceComponent c;
    c.faces = {seed};
    is_seen[seed] = 1;
    for (std::size_t i = 0; i < c.faces.size(); ++i)
      for (const auto& [g, disagrees] : neighbours[c.faces[i]]) {
        const std::uint8_t turned = is_turned[c.faces[i]] ^ static_cast<std::uint8_t>(disagrees);
        if (is_seen[g]) {
          c.is_one_sided = c.is_one_sided || is_turned[g] != turned;
          continue;
        }
        is_seen[g] = 1;
        is_turned[g] = turned;
        c.faces.push_back(g);
      }
    std::sort(c.faces.begin(), c.faces.end());
    components.push_back(std::move(c));
  }
  return components;
}

/// The larger area keeps its orientation; one-sided components are left alone.
void settle_majority(std::span<const FaceComponent> components, std::span<const double> area,
                     std::vector<std::uint8_t>& is_turned) {
  for (const FaceComponent& c : components) {
    double kept = 0, turned = 0;
    for (const FaceId f : c.faces) (is_turned[f] ? turned : kept) += area[f];
    for (const FaceId f : c.faces)
      is_turned[f] = c.is_one_sided ? 0 : is_turned[f] ^ static_cast<std::uint8_t>(turned > kept);
  }
}

void turn_faces(SurfaceMesh& mesh, std::span<const std::uint8_t> is_turned) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_turned[mesh.triangle_face[t]]) continue;
    std::swap(mesh.triangles[t].n[1], mesh.triangles[t].n[2]);
    if (!mesh.corner_uv.empty()) std::swap(mesh.corner_uv[3 * t + 1], mesh.corner_uv[3 * t + 2]);
  }
}

/// Whether as many sides of the component run one way as the other along an edge, once the faces are turned.
bool is_balanced(const SurfaceMesh& mesh, std::span<const SideId> sides, NodeId low, std::int32_t component,
                 std::span<const std::uint8_t> is_turned, std::span<const std::int32_t> face_component) {
  std::int32_t balance = 0;
  for (const SideId s : sides) {
    const FaceId f = mesh.triangle_face[s / 3];
    if (face_component[f] == component)
      balance += (side_start(mesh.triangles, s) == low) != (is_turned[f] != 0) ? 1 : -1;
  }
  return balance == 0;
}

/// Components are closed where all their edges are balanced.
void find_open(const SurfaceMesh& mesh, const EdgeTable& edges, std::span<const std::uint8_t> is_turned,
               std::span<const std::int32_t> face_component, std::vector<FaceComponent>& components) {
  const auto n = static_cast<std::size_t>(edges.n_nodes());
  std::vector<std::vector<std::uint8_t>> is_open((n + kNodesPerPiece - 1) / kNodesPerPiece);
  parallel_for(n, kNodesPerPiece, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint8_t>& own = is_open[begin / kNodesPerPiece];
    own.assign(components.size(), 0);
    edges.for_each_edge(static_cast<NodeId>(begin), static_cast<NodeId>(end),
                        [&](NodeId low, NodeId, std::span<const SideId> sides) {
                          for (const SideId s : sides) {
                            const std::int32_t c = face_component[mesh.triangle_face[s / 3]];
                            if (c != kNone && !own[c])
                              own[c] = !is_balanced(mesh, sides, low, c, is_turned, face_component);
                          }
                        });
  });
  for (std::size_t c = 0; c < components.size(); ++c)
    if (std::ranges::any_of(is_open, [c](const auto& own) { return own[c] != 0; })) components[c].is_closed = false;
}

/// Signed volumes about the centre of the model's box (less cancellation), and boxes.
void measure(const SurfaceMesh& mesh, std::span<const std::int32_t> face_component,
             std::vector<FaceComponent>& components) {
  Box3 all;
  for (const Vec3 p : mesh.node_xyz) all.add(p);
  const Vec3 origin = all.center();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::int32_t c = face_component[mesh.triangle_face[t]];
    if (c == kNone) continue;
    const auto& n = mesh.triangles[t].n;
    components[c].volume += volume_of(mesh.node_xyz[n[0]], mesh.node_xyz[n[1]], mesh.node_xyz[n[2]], origin);
    for (const NodeId i : n) components[c].box.add(mesh.node_xyz[i]);
  }
}

// --- nesting ---

int sign(double x) { return (x > 0) - (x < 0); }

/// Whether the closed component holds `p`, by the parity of the crossings of the segment (p, q), q outside; nullopt
/// when the segment meets an edge, a node or a plane it lies in.
std::optional<bool> is_inside(const SurfaceMesh& mesh, const FaceComponent& component, Vec3 p, Vec3 q) {
  bool inside = false;
  for (const TriangleId t : component.triangles) {
    const auto& n = mesh.triangles[t].n;
    const Vec3 a = mesh.node_xyz[n[0]], b = mesh.node_xyz[n[1]], c = mesh.node_xyz[n[2]];
    const int sp = sign(orient3d(a, b, c, p)), sq = sign(orient3d(a, b, c, q));
    if (sp == sq && sp != 0) continue;
    const int s0 = sign(orient3d(p, q, a, b)), s1 = sign(orient3d(p, q, b, c)), s2 = sign(orient3d(p, q, c, a));
    if (s0 * s1 < 0 || s1 * s2 < 0 || s0 * s2 < 0) continue;
    if (sp == 0 || sq == 0 || s0 == 0 || s1 == 0 || s2 == 0) return std::nullopt;
    inside = !inside;
  }
  return inside;
}

/// Whether `outer` encloses `inner` (they may touch): asked from several nodes in several directions until the answer
/// is clear.
bool encloses(const SurfaceMesh& mesh, const FaceComponent& outer, const FaceComponent& inner) {
  if (!contains(outer.box, inner.box)) return false;
  static constexpr std::array<Vec3, 3> kDirections{Vec3{0.8017, 0.4211, 0.4243}, Vec3{-0.3701, 0.7369, -0.5657},
                                                   Vec3{0.1361, -0.5039, 0.8531}};
  constexpr std::size_t kTries = 32;
  const std::size_t step = std::max<std::size_t>(1, inner.triangles.size() / kTries);
  for (std::size_t i = 0; i < inner.triangles.size(); i += step)
    for (const Vec3 direction : kDirections) {
      const Vec3 p = mesh.node_xyz[mesh.triangles[inner.triangles[i]].n[0]];
      const auto answer = is_inside(mesh, outer, p, p + 2 * outer.box.diagonal() * direction);
      if (answer) return *answer;
    }
  return false;
}

/// Closed components by nesting depth; `parent[c]`: the innermost one around c.
void find_nesting(const SurfaceMesh& mesh, std::span<const FaceComponent> components, std::vector<std::int32_t>& depth,
                  std::vector<std::int32_t>& parent) {
  const auto n = components.size();
  depth.assign(n, 0);
  parent.assign(n, kNone);
  std::vector<std::vector<std::int32_t>> around(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t o = 0; o < n; ++o)
      if (i != o && components[i].is_closed && components[o].is_closed && encloses(mesh, components[o], components[i]))
        around[i].push_back(static_cast<std::int32_t>(o));
  for (std::size_t i = 0; i < n; ++i) depth[i] = static_cast<std::int32_t>(around[i].size());
  for (std::size_t i = 0; i < n; ++i)
    for (const std::int32_t o : around[i])
      if (parent[i] == kNone || depth[o] > depth[parent[i]]) parent[i] = o;
}

}  // namespace

void unite_links(std::vector<FaceLink>& links) {
  std::sort(links.begin(), links.end(),
            [](const FaceLink& x, const FaceLink& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  std::size_t n = 0;
  for (const FaceLink& l : links)
    if (n && links[n - 1].a == l.a && links[n - 1].b == l.b)
      links[n - 1].agreement += l.agreement;
    else
      links[n++] = l;
  links.resize(n);
}

std::vector<FaceComponent> agree(std::span<const FaceLink> links, std::span<const double> area,
                                 std::vector<std::uint8_t>& is_turned) {
  std::vector<FaceComponent> components = flood(links, area, is_turned);
  settle_majority(components, area, is_turned);
  return components;
}

std::vector<std::int32_t> component_of_face(std::span<const FaceComponent> components, FaceId n_faces) {
  std::vector<std::int32_t> component(n_faces, kNone);
  for (std::size_t c = 0; c < components.size(); ++c)
    for (const FaceId f : components[c].faces) component[f] = static_cast<std::int32_t>(c);
  return component;
}

std::vector<std::uint8_t> find_inside_out(const SurfaceMesh& mesh, std::vector<FaceComponent>& components,
                                          std::span<const std::int32_t> face_component) {
  std::vector<std::uint8_t> is_turned(components.size(), 0);
  if (std::none_of(components.begin(), components.end(), is_negative)) return is_turned;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (const std::int32_t c = face_component[mesh.triangle_face[t]]; c != kNone)
      components[c].triangles.push_back(static_cast<TriangleId>(t));
  std::vector<std::int32_t> depth, parent;
  find_nesting(mesh, components, depth, parent);
  for (std::size_t c = 0; c < components.size(); ++c) is_turned[c] = is_negative(components[c]) && depth[c] % 2 == 0;
  const std::vector<std::uint8_t> is_body_turned = is_turned;
  for (std::size_t c = 0; c < components.size(); ++c)
    if (depth[c] % 2 == 1 && components[c].volume > 0 && is_body_turned[parent[c]]) is_turned[c] = 1;
  return is_turned;
}

OrientationReport report_orientation(std::span<const std::uint8_t> is_turned, std::span<const FaceComponent> components,
                                     std::span<const std::uint8_t> is_inside_out) {
  OrientationReport report;
  for (std::size_t f = 0; f < is_turned.size(); ++f)
    if (is_turned[f]) report.turned_faces.push_back(static_cast<FaceId>(f));
  for (std::size_t c = 0; c < components.size(); ++c) {
    report.n_one_sided += components[c].is_one_sided;
    report.turned_components += is_inside_out[c];
    if (is_inside_out[c])
      report.inside_out_faces.insert(report.inside_out_faces.end(), components[c].faces.begin(),
                                     components[c].faces.end());
  }
  std::sort(report.inside_out_faces.begin(), report.inside_out_faces.end());
  return report;
}

OrientationReport orient_outward(SurfaceMesh& mesh) {
  const FaceId n_faces = count_faces(mesh);
  const std::vector<double> area = face_areas(mesh, n_faces);
  std::vector<FaceComponent> components;
  std::vector<std::uint8_t> is_turned;
  std::vector<std::int32_t> face_component;
  {
    const EdgeTable edges(mesh.triangles, mesh.n_nodes());
    components = agree(find_links(mesh, edges), area, is_turned);
    face_component = component_of_face(components, n_faces);
    find_open(mesh, edges, is_turned, face_component, components);
  }
  turn_faces(mesh, is_turned);
  measure(mesh, face_component, components);
  const std::vector<std::uint8_t> is_inside_out = find_inside_out(mesh, components, face_component);
  const OrientationReport report = report_orientation(is_turned, components, is_inside_out);
  is_turned.assign(n_faces, 0);
  for (const FaceId f : report.inside_out_faces) is_turned[f] = 1;
  turn_faces(mesh, is_turned);
  return report;
}

}  // namespace st
