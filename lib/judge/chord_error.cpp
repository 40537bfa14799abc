#include "judge/chord_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "base/threads.h"
#include "judge/face_surface.h"

namespace st {

namespace {

/// A parabola's segment has 2/3 of the box around it; an arc of up to 120 degrees (three sides per circle) has up to 10
/// % more.
constexpr double kArcSegment = 2.0 / 3.0 * 1.1;

double distance_to_line(Vec3 p, Vec3 a, Vec3 b) {
  const double length = distance(a, b);
  return length > 0 ? norm(cross(p - a, b - a)) / length : distance(p, a);
}

/// Area on the surface between a trimming curve and the straight lines in (u,v) through its points at the parameters t.
double area_beside_chords(const Surface& surface, const Curve2d& pcurve, const std::vector<double>& t) {
  double area = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    const Vec2 from = pcurve.point(t[i - 1]), to = pcurve.point(t[i]), middle = pcurve.point(0.5 * (t[i - 1] + t[i]));
    const Vec3 a = surface.point(from), b = surface.point(to), m = surface.point(middle);
    const double chord = distance(a, b), sagitta = distance(m, surface.point(0.5 * (from + to)));
    const bool is_loop = chord < 1e-3 * sagitta;  // a closed edge of one segment: all that it encloses is missing
    area += is_loop ? sagitta * sagitta : kArcSegment * sagitta * chord;
  }
  return area;
}

/// Parameters of each edge's nodes, from end to end.
std::vector<std::vector<double>> edge_parameters(const ModelTables& tables, const SurfaceMesh& mesh) {
  std::vector<std::vector<double>> t(tables.n_edges());
  for (EdgeId e = 0; e < tables.n_edges(); ++e) t[e].push_back(tables.edge_range[2 * e]);
  for (std::int64_t n = 0; n < mesh.n_nodes(); ++n)
    if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kEdge))
      t[mesh.node_entity[n]].push_back(mesh.node_t[n]);
  for (EdgeId e = 0; e < tables.n_edges(); ++e) t[e].push_back(tables.edge_range[2 * e + 1]);
  return t;
}

/// Beside an edge drawn together to one node, what lies between it and the next nodes: no more than its length times
/// theirs.
double area_beside_merged(const ModelTables& tables, const SurfaceMesh& mesh, EdgeId e,
                          const std::vector<double>& face_size, FaceId f) {
  return std::binary_search(mesh.merged.edge.begin(), mesh.merged.edge.end(), e) ? tables.edge_length[e] * face_size[f]
                                                                                 : 0.0;
}

void add_edges(const Model& model, const SurfaceMesh& mesh, ChordError& error) {
  const ModelTables& tables = model.tables();
  std::vector<double> face_size(tables.n_faces(), 0);  // largest of its nodes
  for (TriangleId i = 0; i < mesh.n_triangles(); ++i)
    for (const NodeId n : mesh.triangles[i].n)
      face_size[mesh.triangle_face[i]] = std::max(face_size[mesh.triangle_face[i]], mesh.node_size[n]);
  const std::vector<std::vector<double>> t = edge_parameters(tables, mesh);
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    const std::unique_ptr<Surface> surface = model.surface(f);
    for (const LoopId l : tables.loops(f))
      for (const CoedgeId c : tables.loop_coedges(l))
        error.area[f] += area_beside_chords(*surface, *model.pcurve(f, c), t[tables.coedge_edge[c]]) +
                         area_beside_merged(tables, mesh, tables.coedge_edge[c], face_size, f);
  }
}

double area_of(Vec3 a, Vec3 b, Vec3 c) { return 0.5 * norm(cross(b - a, c - a)); }

/// What some triangles of one face add, see ChordError.
struct FacePart {
  double area = 0, distance = 0, node_distance = 0, off_surface = 0;
  Vec3 node_place, off_place;
};

void add_corner(Vec3 on_surface, Vec3 node, double size, FacePart& part) {
  const double d = distance(on_surface, node), off = d - kOffSurface * size;
  if (d > part.node_distance) part.node_distance = d, part.node_place = node;
  if (off > part.off_surface) part.off_surface = off, part.off_place = node;
}

/// Sum of the squared angles between the normals at the corners, rad^2; poles have none.
double turning(const std::array<SurfacePoint, 3>& corner) {
  double sum = 0;
  std::array<Vec3, 3> normal;
  for (int k = 0; k < 3; ++k) normal[k] = cross(corner[k].du, corner[k].dv);
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = normal[k], b = normal[(k + 1) % 3];
    const double angle = std::atan2(norm(cross(a, b)), dot(a, b));
    if (norm(a) > 0 && norm(b) > 0) sum += angle * angle;
  }
  return sum;
}

/// The triangle of the surface's points at its corners, against its four parts with corners on the surface; and against
/// a sphere that turns as the normals do, where (u,v) near a pole makes poor parts.
void add_triangle(const Surface& surface, const std::array<Vec2, 3>& uv, std::array<Vec3, 3>& x, FacePart& part) {
  constexpr double kRichardson = 4.0 / 3.0 * 1.1;  // terms of higher order: 10 % for nine triangles on an octant of a
                                                   // sphere
  constexpr double kSphere = 5.0 / 72.0 * 1.5;     // of the area, per rad^2 of turning
  std::array<Vec3, 3> m;
  std::array<SurfacePoint, 3> corner;
  for (int k = 0; k < 3; ++k) {
    corner[k] = surface.evaluate(uv[k]);
    x[k] = corner[k].x;
    m[k] = surface.point(0.5 * (uv[k] + uv[(k + 1) % 3]));
  }
  for (int k = 0; k < 3; ++k) part.distance = std::max(part.distance, distance_to_line(m[k], x[k], x[(k + 1) % 3]));
  const double flat = area_of(x[0], x[1], x[2]);
  const double curved =
      area_of(x[0], m[0], m[2]) + area_of(m[0], x[1], m[1]) + area_of(m[2], m[1], x[2]) + area_of(m[0], m[1], m[2]);
  part.area += std::max(kRichardson * std::fabs(curved - flat), kSphere * turning(corner) * flat);
}

void add_part(const FacePart& part, FaceId f, ChordError& error) {
  error.area[f] += part.area;
  error.distance[f] = std::max(error.distance[f], part.distance);
  if (part.node_distance > error.node_distance[f])
    error.node_distance[f] = part.node_distance, error.node_place[f] = part.node_place;
  if (part.off_surface > error.off_surface[f])
    error.off_surface[f] = part.off_surface, error.off_place[f] = part.off_place;
}

void add_triangles(const Model& model, const SurfaceMesh& mesh, ChordError& error) {
  constexpr std::size_t kPerPiece = 16'384;
  using Parts = std::map<FaceId, FacePart>;
  const auto n_triangles = static_cast<std::size_t>(mesh.n_triangles());
  std::vector<Parts> pieces((n_triangles + kPerPiece - 1) / kPerPiece);
  parallel_for(n_triangles, kPerPiece, [&](std::size_t begin, std::size_t end) {
    FaceSurface surface(model);
    for (std::size_t t = begin; t < end; ++t) {
      const FaceId f = mesh.triangle_face[t];
      FacePart& part = pieces[begin / kPerPiece][f];
      const auto& n = mesh.triangles[t].n;
      std::array<Vec3, 3> x;
      add_triangle(surface.of(f), {mesh.corner_uv[3 * t], mesh.corner_uv[3 * t + 1], mesh.corner_uv[3 * t + 2]}, x,
                   part);
      for (int k = 0; k < 3; ++k) add_corner(x[k], mesh.node_xyz[n[k]], mesh.node_size[n[k]], part);
      if (!mesh.merged.empty())  // nodes drawn together
        part.area += std::fabs(area_of(mesh.node_xyz[n[0]], mesh.node_xyz[n[1]], mesh.node_xyz[n[2]]) -
                               area_of(x[0], x[1], x[2]));
    }
  });
  for (const Parts& parts : pieces)
    for (const auto& [f, part] : parts) add_part(part, f, error);
}

}  // namespace

ChordError estimate_chord_error(const Model& model, const SurfaceMesh& mesh) {
  ChordError error;
  error.area.assign(model.tables().n_faces(), 0);
  error.distance.assign(model.tables().n_faces(), 0);
  error.node_distance.assign(model.tables().n_faces(), 0);
  error.node_place.resize(model.tables().n_faces());
  error.off_surface.assign(model.tables().n_faces(), 0);
  error.off_place.resize(model.tables().n_faces());
  add_edges(model, mesh, error);
  add_triangles(model, mesh, error);
  return error;
}

}  // namespace st
