#include "judge/chord_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "base/threads.h"
#include "geometry/shape/projection.h"
#include "judge/corner_points.h"
#include "judge/face_surface.h"
#include "judge/squared_angle.h"

namespace st {

namespace {

/// A parabola's segment has 2/3 of the box around it; an arc of up to 120 degrees (three sides per circle) has up to 10
/// % more.
constexpr double kArcSegment = 2.0 / 3.0 * 1.1;

/// How much of what a side of this length explains one of the requested length would: errors grow with its square.
/// All, where no length is known.
double asked_share(double length, double size) {
  const double longest = kLongestSide * size;
  return size > 0 && length > longest ? (longest / length) * (longest / length) : 1;
}

/// A node of an edge.
struct EdgeNode {
  double t = 0;     // parameter
  double size = 0;  // requested length, 0: not known
};

struct AreaBeside {
  double asked = 0, found = 0;  // see ChordError::area, found_area
};

/// The surface's point closest to the middle of the chord between two of its points, found from the middle in (u,v),
/// which may lie far beside it. `normal`: about that of the surface, of any length.
Vec3 foot_of_middle(const Surface& surface, Vec2 uv_a, Vec2 uv_b, Vec3 a, Vec3 b, Vec3 normal) {
  constexpr double kAside = 0.02;  // of the chord: along the normal from the middle is near enough
  const Vec2 uv = 0.5 * (uv_a + uv_b);
  const Vec3 middle = 0.5 * (a + b), x = surface.point(uv), beside = x - middle;
  const Vec3 above = dot(beside, normal) / std::max(norm2(normal), 1e-300) * normal;
  if (norm2(beside - above) < kAside * kAside * norm2(b - a)) return middle + above;
  if (const auto near = point_above(surface, middle, uv, kAside * distance(a, b)))
    if (near->distance < norm(beside)) return near->foot;
  if (const auto foot = project_near(surface, middle, uv))
    if (const Vec3 y = surface.point(*foot); distance(y, middle) < norm(beside)) return y;
  return descend_from(surface, middle, uv).x;
}

/// Area on the surface between a trimming curve and its chords at the nodes.
AreaBeside area_beside_chords(const Surface& surface, const Curve2d& pcurve, const std::vector<EdgeNode>& nodes) {
  AreaBeside area;
  Vec2 to = pcurve.point(nodes.front().t);
  Vec3 b = surface.point(to);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const double t0 = nodes[i - 1].t, t1 = nodes[i].t;
    const Vec2 from = std::exchange(to, pcurve.point(t1));
    const Vec3 a = std::exchange(b, surface.point(to)), m = surface.point(pcurve.point(0.5 * (t0 + t1)));
    const Vec3 normal = surface_normal(surface, 0.5 * (from + to));
    const double chord = distance(a, b), sagitta = distance(m, foot_of_middle(surface, from, to, a, b, normal));
    const bool is_loop = chord < 1e-3 * sagitta;  // a closed edge of one segment: all that it encloses is missing
    const double beside = is_loop ? sagitta * sagitta : kArcSegment * sagitta * chord;
    area.found += beside;
    area.asked += beside * asked_share(std::max(chord, 2 * sagitta), std::max(nodes[i - 1].size, nodes[i].size));
  }
  return area;
}

/// Nodes of each edge, from end to end.
std::vector<std::vector<EdgeNode>> edge_nodes(const ModelTables& tables, const SurfaceMesh& mesh) {
  std::vector<double> vertex_size(tables.n_vertices(), 0);
  std::vector<std::vector<EdgeNode>> nodes(tables.n_edges());
  for (std::int64_t n = 0; n < mesh.n_nodes(); ++n)
    if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex))
      vertex_size[mesh.node_entity[n]] = mesh.node_size[n];
  const auto add_end = [&](EdgeId e, int end) {
    nodes[e].push_back({tables.edge_range[2 * e + end], vertex_size[tables.edge_vertices[2 * e + end]]});
  };
  for (EdgeId e = 0; e < tables.n_edges(); ++e) add_end(e, 0);
  for (std::int64_t n = 0; n < mesh.n_nodes(); ++n)
    if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kEdge))
      nodes[mesh.node_entity[n]].push_back({mesh.node_t[n], mesh.node_size[n]});
  for (EdgeId e = 0; e < tables.n_edges(); ++e) add_end(e, 1);
  return nodes;
}

/// Beside an edge drawn together to one node, what lies between it and the next nodes: no more than its length times
/// theirs.
double area_beside_merged(const ModelTables& tables, const SurfaceMesh& mesh, EdgeId e,
                          const std::vector<double>& face_size, FaceId f) {
  return std::binary_search(mesh.merged.edge.begin(), mesh.merged.edge.end(), e) ? tables.edge_length[e] * face_size[f]
                                                                                 : 0.0;
}

void add_edges(const Model& model, const SurfaceMesh& mesh, const std::vector<double>& face_size, ChordError& error) {
  const ModelTables& tables = model.tables();
  const std::vector<std::vector<EdgeNode>> nodes = edge_nodes(tables, mesh);
  parallel_for(face_size.size(), 1, [&](std::size_t i, std::size_t) {
    const auto f = static_cast<FaceId>(i);
    const std::unique_ptr<Surface> surface = model.surface(f);
    for (const CoedgeId c : tables.coedges(f)) {
      const EdgeId e = tables.coedge_edge[c];
      const double merged = area_beside_merged(tables, mesh, e, face_size, f);
      const AreaBeside beside = area_beside_chords(*surface, *model.pcurve(f, c), nodes[e]);
      error.area[f] += beside.asked + merged;
      error.found_area[f] += beside.found + merged;
    }
  });
}

double area_of(Vec3 a, Vec3 b, Vec3 c) { return 0.5 * norm(cross(b - a, c - a)); }

using FacePart = ChordParts::Part;

/// Distance of a node from the surface: `d`, at its (u,v), or less where the projection from there ends.
double distance_to_surface(const Surface& surface, Vec2 uv, double d, Vec3 node, double size) {
  constexpr double kNear = 1e-3;  // of its requested length: not worth a projection
  if (d <= kNear * size) return d;
  const auto foot = project_near(surface, node, uv);
  return foot ? std::min(d, distance(surface.point(*foot), node)) : d;
}

/// `d`: from the surface's point at the corner's (u,v); `stray`: from the surface.
void add_corner(double d, double stray, Vec3 node, double size, FacePart& part) {
  const double off = d - kOffSurface * size;
  if (d > part.node_distance) part.node_distance = d, part.node_place = node;
  if (off > part.off_surface) part.off_surface = off, part.off_place = node;
  if (stray > part.stray) part.stray = stray, part.stray_place = node;
}

/// Sum of the squared angles between the normals at the corners, rad^2; poles have none.
double turning(const std::array<Vec3, 3>& normal) {
  return squared_angle(normal[0], normal[1]) + squared_angle(normal[1], normal[2]) +
         squared_angle(normal[2], normal[0]);
}

/// One triangle, and the surface at its corners.
struct TriangleOnSurface {
  std::array<Vec2, 3> uv;
  std::array<Vec3, 3> x;       // on the surface
  std::array<Vec3, 3> normal;  // du x dv there
  std::array<Vec3, 3> middle;  // of the surface, above the middle of each side
  std::array<Vec3, 3> node;    // of the mesh
  std::array<double, 3> size;
  double area;  // between the surface's points
};

/// The triangle of the surface's points at its corners, against its four parts with corners on the surface; and against
/// a sphere that turns as the normals do, where (u,v) near a pole makes poor parts.
void add_chords(const TriangleOnSurface& t, FacePart& part) {
  constexpr double kRichardson = 4.0 / 3.0 * 1.1;  // terms of higher order: 10 % for nine triangles on an octant of a
                                                   // sphere
  constexpr double kSphere = 5.0 / 72.0 * 1.5;     // of the area, per rad^2 of turning
  const auto &x = t.x, &m = t.middle;
  std::array<double, 3> length2, height2;  // of the sides, and of the middles above them, squared
  for (int k = 0; k < 3; ++k) {
    const Vec3 side = x[(k + 1) % 3] - x[k], to_middle = m[k] - x[k];
    length2[k] = norm2(side);
    height2[k] = length2[k] > 0 ? norm2(cross(to_middle, side)) / length2[k] : norm2(to_middle);
  }
  const double largest2 = std::max({height2[0], height2[1], height2[2]}), height = std::sqrt(largest2);
  double curved2 = std::numeric_limits<double>::infinity();  // the shortest side: along the others less is curved
  for (int k = 0; k < 3; ++k)
    if (height2[k] >= 0.25 * largest2) curved2 = std::min(curved2, length2[k]);
  const double size = (t.size[0] + t.size[1] + t.size[2]) / 3, share = asked_share(std::sqrt(curved2), size);
  const double flat = t.area;
  const double curved =
      area_of(x[0], m[0], m[2]) + area_of(m[0], x[1], m[1]) + area_of(m[2], m[1], x[2]) + area_of(m[0], m[1], m[2]);
  const double found = std::max(kRichardson * std::fabs(curved - flat), kSphere * turning(t.normal) * flat);
  part.distance = std::max(part.distance, height);
  part.found_area += found;
  part.area += found * share;
  part.volume += height * flat * share;
  part.flat += flat;
  part.size += size * flat;
}

/// How far the nodes lie from the surface, and what that changes.
void add_nodes(const Surface& surface, const TriangleOnSurface& t, bool has_merged, FacePart& part) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = distance(t.x[k], t.node[k]);
    const double stray = distance_to_surface(surface, t.uv[k], d, t.node[k], t.size[k]);
    add_corner(d, stray, t.node[k], t.size[k], part);
    sum += stray;
  }
  const double area = area_of(t.node[0], t.node[1], t.node[2]);
  part.moved_volume += sum / 3 * std::max(t.area, area);
  if (!has_merged) return;  // nodes drawn together
  part.area += std::fabs(area - t.area);
  part.found_area += std::fabs(area - t.area);
}

void add_part(const FacePart& part, FaceId f, ChordError& error) {
  error.area[f] += part.area;
  error.found_area[f] += part.found_area;
  error.volume[f] += part.volume;
  error.moved_volume[f] += part.moved_volume;
  error.flat[f] += part.flat;
  error.size[f] += part.size;
  error.distance[f] = std::max(error.distance[f], part.distance);
  if (part.node_distance > error.node_distance[f])
    error.node_distance[f] = part.node_distance, error.node_place[f] = part.node_place;
  if (part.off_surface > error.off_surface[f])
    error.off_surface[f] = part.off_surface, error.off_place[f] = part.off_place;
  if (part.stray > error.stray[f]) error.stray[f] = part.stray, error.stray_place[f] = part.stray_place;
}

TriangleOnSurface triangle_of(const SurfaceMesh& mesh, std::size_t t, const Surface& surface, CornerPoints& points) {
  TriangleOnSurface r;
  const auto& nodes = mesh.triangles[t].n;
  const FaceId face = mesh.triangle_face[t];
  for (int k = 0; k < 3; ++k) {
    const NodeId n = nodes[k];
    r.uv[k] = mesh.corner_uv[3 * t + k];
    r.node[k] = mesh.node_xyz[n];
    r.size[k] = mesh.node_size[n];
    const SurfacePoint& p = points.corner(surface, face, n, r.uv[k]);
    r.x[k] = p.x;
    r.normal[k] = cross(p.du, p.dv);
  }
  r.area = area_of(r.x[0], r.x[1], r.x[2]);
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    r.middle[k] = points.side(face, nodes[k], nodes[l], r.uv[k], r.uv[l], [&] {
      return foot_of_middle(surface, r.uv[k], r.uv[l], r.x[k], r.x[l], r.normal[k] + r.normal[l]);
    });
  }
  return r;
}

/// Sums of each piece by face.
std::vector<FacePart> measure_triangles(const Model& model, const SurfaceMesh& mesh, const OwnTriangles& own,
                                        DeviationSum* deviation) {
  using Parts = std::map<FaceId, FacePart>;
  std::vector<Parts> pieces(own.n_pieces());
  parallel_for(own.size(), kTrianglesPerPiece, [&](std::size_t begin, std::size_t end) {
    FaceSurface faces(model);
    CornerPoints points;
    Parts& parts = pieces[begin / kTrianglesPerPiece];
    auto at = parts.end();
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t t = static_cast<std::size_t>(own.begin) + i;
      const FaceId f = mesh.triangle_face[t];
      const Surface& surface = faces.of(f);
      if (at == parts.end() || at->first != f) at = parts.try_emplace(f).first;  // triangles come face by face
      FacePart& part = at->second;
      const TriangleOnSurface triangle = triangle_of(mesh, t, surface, points);
      add_chords(triangle, part);
      add_nodes(surface, triangle, !mesh.merged.empty(), part);
      if (deviation) deviation->add(static_cast<TriangleId>(t), surface);
    }
  });
  std::vector<FacePart> all;
  for (Parts& parts : pieces)
    for (auto& [f, part] : parts) part.face = f, all.push_back(part);
  return all;
}

}  // namespace

void ChordParts::add(const ChordParts& next) {
  parts.insert(parts.end(), next.parts.begin(), next.parts.end());
  face_size.resize(std::max(face_size.size(), next.face_size.size()), 0);
  for (std::size_t f = 0; f < next.face_size.size(); ++f) face_size[f] = std::max(face_size[f], next.face_size[f]);
}

ChordParts estimate_chord_error(const Model& model, const SurfaceMesh& mesh, const OwnTriangles& own,
                                DeviationSum* deviation) {
  ChordParts result;
  result.face_size.assign(model.tables().n_faces(), 0);
  for (TriangleId i = own.begin; i < own.end; ++i)
    for (const NodeId n : mesh.triangles[i].n) {
      double& largest = result.face_size[mesh.triangle_face[i]];
      largest = std::max(largest, mesh.node_size[n]);
    }
  result.parts = measure_triangles(model, mesh, own, deviation);
  return result;
}

ChordError report_chords(const Model& model, const SurfaceMesh& mesh, const ChordParts& parts) {
  ChordError error;
  const auto n_faces = static_cast<std::size_t>(model.tables().n_faces());
  for (auto* values : {&error.area, &error.found_area, &error.volume, &error.moved_volume, &error.flat, &error.size,
                       &error.distance, &error.node_distance, &error.off_surface, &error.stray})
    values->assign(n_faces, 0);
  error.node_place.resize(n_faces);
  error.off_place.resize(n_faces);
  error.stray_place.resize(n_faces);
  add_edges(model, mesh, parts.face_size, error);
  for (const FacePart& part : parts.parts) add_part(part, part.face, error);
  for (std::size_t f = 0; f < n_faces; ++f)
    if (error.flat[f] > 0) error.size[f] /= error.flat[f];
  return error;
}

ChordError estimate_chord_error(const Model& model, const SurfaceMesh& mesh, DeviationSum* deviation) {
  return report_chords(model, mesh, estimate_chord_error(model, mesh, OwnTriangles::all(mesh), deviation));
}

}  // namespace st
