#include "stages/check_cad.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "base/eigen.h"
#include "geometry/model/cad_tolerance.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

/// Faces of the CAD without a triangle; faces of no area need none.
Check check_faces(const FacesOfMesh& mesh, const ModelTables& tables) {
  constexpr double kNoArea = 1e-12;  // of the model's area
  Check c{"faces", "CAD faces without a triangle", {}, true, ""};
  double total = 0;
  for (const double a : tables.face_area) total += a;
  std::vector<std::uint8_t> has_triangle(tables.n_faces(), 0);
  for (std::size_t f = 0; f < std::min(has_triangle.size(), mesh.n_triangles.size()); ++f)
    has_triangle[f] = mesh.n_triangles[f] > 0;
  for (const FaceId f : mesh.labels.merged.strip_face) has_triangle[f] = 1;
  for (FaceId f = 0; f < tables.n_faces(); ++f)
    if (!has_triangle[f] && tables.face_area[f] > kNoArea * total)
      c.defects.add({tables.face_box[f].center(), f, kNone});
  return c;
}

/// Area that a face has or lacks where its edges lie off its trimming curves by their tolerances in the CAD; of a tiny
/// face of a coarse CAD that is much.
double slack_area(const ModelTables& tables, FaceId f) {
  constexpr double kMost = 0.1;  // of the face
  double area = 0;
  for (const EdgeId e : tables.edges_of(f)) area += tables.edge_tolerance[e] * tables.edge_length[e];
  return std::min(area, kMost * tables.face_area[f]);
}

/// Width of each face however it is turned: of the rectangle with the same area and moment of inertia about its long
/// axis, as the mesh has it. So a cylinder is about as wide as its diameter. Returns [n_faces] model unit.
std::vector<double> face_extents(std::span<const FaceMoments> parts, std::size_t n_faces) {
  std::vector<FaceMoments> faces(n_faces);
  for (const FaceMoments& part : parts) {
    FaceMoments& face = faces[part.face];
    face.area += part.area;
    face.first += part.first;
    face.squares += part.squares;
    face.products += part.products;
  }
  std::vector<double> width;
  for (const FaceMoments& m : faces) {
    const double area = std::max(m.area, 1e-300);
    const Eigen::Vector3d middle = to_eigen(m.first) / area;
    Eigen::Matrix3d second = to_eigen(m.squares).asDiagonal();
    second(1, 2) = second(2, 1) = m.products.x;
    second(0, 2) = second(2, 0) = m.products.y;
    second(0, 1) = second(1, 0) = m.products.z;
    const PrincipalAxes axes = principal_axes(second / area - middle * middle.transpose());
    width.push_back(std::sqrt(12 * std::max(0.0, axes.value[1])));
  }
  return width;
}

/// Of an area: a larger difference is wrong, whatever explains it, unless the face is small.
constexpr double kMostOff = 0.03;
/// Chords of one length take 0.5 (length / width)^2 of the area of a disc, whose width is that of face_extents(), and
/// twice as much of a hemisphere: with 20 % more for chords that are not all alike.
constexpr double kRound = 1.2;
/// Of the area of the whole CAD: of a small face no more is missing.
constexpr double kLittle = 2e-3;
/// Likewise of a face that is not wide, where the ends of its sides were moved by more than it measures.
constexpr double kNothing = 1e-6;

/// Faces that differ in area from the CAD's.
struct AreaChecks {
  Check areas{"areas", "faces whose area differs from the CAD's", {}, true, ""};
  Check below{"below-sizes", "faces too small for the sizes, of another area than the CAD's", {}, false, ""};
};

/// Wrong are faces off by more than the tolerance, what chords explain, and the slack of the CAD. Of a face wider than
/// two requested lengths only chords of the requested length explain anything: no more than kMostOff of its area, or
/// what a hemisphere lacks of a face that is less than six lengths wide and a small part of the whole. Others beyond
/// kMostOff are below the sizes: they look as the sizes make them, and a negligible part of the whole may be missing.
AreaChecks check_areas(const FacesOfMesh& faces, const MeshMeasure& measure, const ModelTables& tables,
                       const ChordError& chords, double tolerance) {
  constexpr double kWide = 2;  // requested lengths
  AreaChecks c;
  const SurfaceMesh& mesh = faces.labels;
  const std::vector<double> extent = face_extents(faces.moments, tables.n_faces());
  const double whole = std::accumulate(tables.face_area.begin(), tables.face_area.end(), 0.0);
  double largest = 0;
  FaceId worst = kNone;
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    const double cad = tables.face_area[f], difference = std::fabs(measure.face_area[f] - cad);
    if (std::binary_search(mesh.merged.strip_face.begin(), mesh.merged.strip_face.end(), f))
      continue;  // partly or wholly closed
    const double width = std::min(tables.face_width[f], extent[f]), size = chords.size[f];
    const bool is_wide = width > kWide * size;
    const double explained = is_wide ? chords.area[f] : chords.found_area[f];
    double allowed = tolerance * cad + explained + slack_area(tables, f);
    const double round = difference < kLittle * whole ? kRound * (size / width) * (size / width) : 0;
    allowed =
        is_wide ? std::min(allowed, std::max({kMostOff, tolerance, round}) * cad) : std::max(allowed, kNothing * whole);
    if (difference > allowed && measure.face_area[f] > 0)
      c.areas.defects.add({faces.place[f], f, kNone});
    else if (difference > kMostOff * cad && measure.face_area[f] > 0)
      c.below.defects.add({faces.place[f], f, kNone});
    if (cad > 0 && difference / cad > largest) largest = difference / cad, worst = f;
  }
  if (worst != kNone)
    c.areas.note = fmt::format("largest difference {:.3g} % ({}; chords of the sizes {:.3g} %)", 100 * largest,
                               face_label(mesh, worst), 100 * chords.area[worst] / tables.face_area[worst]);
  return c;
}

/// Faces with a node off the surface by more than the CAD's own tolerances there explain; those with a tolerance of
/// their own are judged by it instead.
Check check_on_surface(const ModelTables& tables, const ChordError& chords, const std::vector<double>& of_group,
                       const std::string& unit) {
  Check c{"on-surface", "faces with nodes off the surface by more than twice the CAD's tolerance", {}, false, ""};
  const double rounding = 1e-9 * tables.box().diagonal();
  FaceId worst = kNone;
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    if (group_tolerance(of_group, f) > 0) continue;
    if (chords.node_distance[f] > 2 * cad_tolerance(tables, f) + rounding)
      c.defects.add({chords.node_place[f], f, kNone});
    if (worst == kNone || chords.node_distance[f] > chords.node_distance[worst]) worst = f;
  }
  if (worst != kNone)
    c.note = fmt::format("largest distance {} (CAD tolerance there {})", length_text(chords.node_distance[worst], unit),
                         length_text(cad_tolerance(tables, worst), unit));
  return c;
}

/// Likewise the faces whose groups have a tolerance: sewing and merging may each take it once.
Check check_group_tolerance(const ModelTables& tables, const ChordError& chords, const std::vector<double>& of_group,
                            const std::string& unit) {
  Check c{"group-tolerance",
          "faces with nodes off the surface by more than twice the tolerance of their group",
          {},
          true,
          ""};
  const double rounding = 1e-9 * tables.box().diagonal();
  FaceId worst = kNone;
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    const double tolerance = group_tolerance(of_group, f);
    if (!(tolerance > 0)) continue;
    if (chords.node_distance[f] > 2 * tolerance + rounding) c.defects.add({chords.node_place[f], f, kNone});
    if (worst == kNone || chords.node_distance[f] / tolerance > chords.node_distance[worst] / of_group[worst])
      worst = f;
  }
  if (worst != kNone)
    c.note = fmt::format("largest distance {} (tolerance of its group {})",
                         length_text(chords.node_distance[worst], unit), length_text(of_group[worst], unit));
  return c;
}

/// Tolerances that the user gave: that of sewing, or a larger one of the face's group. [n_faces] model unit, 0: none.
std::vector<double> given_tolerances(const ModelTables& tables, double sewing) {
  std::vector<double> given = face_tolerances(tables.labels);
  given.resize(tables.n_faces(), 0);
  for (double& tolerance : given) tolerance = std::max(tolerance, sewing);
  return given;
}

/// The tolerances of a face that may move its nodes: what was given, and the CAD's own up to what no CAD needs.
struct FaceTolerance {
  double of_cad = 0, given = 0;  // model unit; given 0: none
  double most = 0;               // off by more is off, whatever the CAD's tolerance
  double allowed() const { return std::max(std::min(of_cad, most), given); }
};

FaceTolerance node_tolerance(const ModelTables& tables, const ChordError& chords, const std::vector<double>& given,
                             FaceId f, double diagonal) {
  constexpr double kOfDiagonal = 1e-3;
  constexpr double kOfSize = 0.05;
  return {cad_tolerance(tables, f), given[f], std::max(kOfDiagonal * diagonal, kOfSize * chords.size[f])};
}

/// Faces with a node so far off that it cannot belong there: a wrong face id, a misplaced node, a CAD whose tolerances
/// hide a wrong edge.
Check check_off_surface(const ModelTables& tables, const ChordError& chords, const std::vector<double>& given) {
  Check c{"off-surface", "faces with nodes off the surface by more than their lengths allow", {}, true, ""};
  const double diagonal = tables.reference_diagonal();
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    const FaceTolerance t = node_tolerance(tables, chords, given, f, diagonal);
    if (chords.off_surface[f] > 2 * t.allowed())
      c.defects.add({chords.off_place[f], f, kNone});
    else if (chords.stray[f] > std::max(t.most, 2 * t.given))
      c.defects.add({chords.stray_place[f], f, kNone});
  }
  return c;
}

/// How wide closed strips are at nodes.
class StripWidths {
 public:
  StripWidths(const SurfaceMesh& mesh, const ModelTables& tables)
      : mesh_(mesh), edge_width_(tables.n_edges(), 0), vertex_width_(tables.n_vertices(), 0) {
    for (std::size_t i = 0; i < mesh.merged.strip_face.size(); ++i)
      for (const EdgeId e : {mesh.merged.strip_kept[i], mesh.merged.strip_closed[i]}) {
        edge_width_[e] = tables.face_area[mesh.merged.strip_face[i]] / std::max(tables.edge_length[e], 1e-300);
        for (int k = 0; k < 2; ++k) {
          double& width = vertex_width_[tables.edge_vertices[2 * e + k]];
          width = std::max(width, edge_width_[e]);
        }
      }
  }
  double at(NodeId n) const {
    const std::int32_t entity = mesh_.node_entity[n];
    return mesh_.node_entity_dim[n] == 0   ? vertex_width_[entity]
           : mesh_.node_entity_dim[n] == 1 ? edge_width_[entity]
                                           : 0.0;
  }

 private:
  const SurfaceMesh& mesh_;
  std::vector<double> edge_width_, vertex_width_;
};

/// What nodes off their surfaces change of the volume, as far as tolerances allow them to be there: sewing and merging
/// may each take them once.
double volume_of_tolerances(const ModelTables& tables, const ChordError& chords, const std::vector<double>& given) {
  const double diagonal = tables.reference_diagonal();
  double volume = 0;
  for (FaceId f = 0; f < tables.n_faces(); ++f)
    volume += std::min(chords.moved_volume[f],
                       2 * node_tolerance(tables, chords, given, f, diagonal).allowed() * chords.flat[f]);
  return volume;
}

/// What sewn edges leave open of the CAD's own volume, the sum of its faces' cones from one point: a strip along each
/// edge, as wide as its faces are apart there and as given tolerances allow.
double volume_of_gaps(const ModelTables& tables, const std::vector<double>& given) {
  const EdgeFaces faces_at(tables);
  const Vec3 apex = tables.box().center();
  double volume = 0;
  for (EdgeId e = 0; e < tables.n_edges(); ++e) {
    double gap = tables.edge_tolerance[e];
    for (const FaceId f : faces_at[e]) gap = std::min(gap, given[f]);
    const double height = std::max(distance(tables.vertex_xyz[tables.edge_vertices[2 * e]], apex),
                                   distance(tables.vertex_xyz[tables.edge_vertices[2 * e + 1]], apex));
    volume += gap * tables.edge_length[e] * height / 3;
  }
  return volume;
}

/// Difference of area and volume of the whole mesh from the CAD's. Volumes only where both have one.
void compare_wholes(const ModelTables& tables, Findings& f) {
  double area = 0;
  for (const double a : tables.face_area) area += a;
  if (area > 0) f.cad->area_difference = f.measure.area / area - 1;
  const bool has_volume =
      f.topology.is_closed() && f.topology.n_cad_boundary_edges == 0 && f.topology.n_cad_nonmanifold_edges == 0;
  if (has_volume && tables.volume && *tables.volume != 0)
    f.cad->volume_difference = f.measure.volume / *tables.volume - 1;
}

/// The area of all faces together: small ones may be below the sizes, the whole may not. Faces that are missing have a
/// check of their own.
Check check_cad_area(const Findings& f, bool has_all_faces, double tolerance) {
  Check c{"cad-area", "meshes whose area differs from the CAD's", {}, true, ""};
  const std::optional<double>& difference = f.cad->area_difference;
  if (!difference) return c;
  if (has_all_faces && std::fabs(*difference) > std::max(kMostOff, tolerance)) c.defects.add({});
  c.note = fmt::format("mesh area / CAD area {:.6f}", 1 + *difference);
  return c;
}

/// The volume enclosed against the CAD's: beyond the tolerance there is what chords of the requested length cut off,
/// what tolerances move, and what gaps that were sewn leave open.
Check check_cad_volume(const FacesOfMesh& mesh, const ModelTables& tables, const std::vector<double>& given,
                       const Findings& f) {
  constexpr double kTolerance = 0.005;  // relative
  Check c{"cad-volume", "closed meshes whose volume differs from the CAD's", {}, true, ""};
  const std::optional<double>& difference = f.cad->volume_difference;
  if (!difference) {
    c.note = tables.volume ? "open or non-manifold: none" : "open, or faces between solids: none";
    return c;
  }
  const ChordError& chords = f.cad->chords;
  double explained = volume_of_tolerances(tables, chords, given) + volume_of_gaps(tables, given);
  for (const FaceMoments& part : mesh.moments) explained += part.strip_volume;
  for (const double volume : chords.volume) explained += volume;
  explained /= std::fabs(*tables.volume);
  if (std::fabs(*difference) > kTolerance + explained) c.defects.add({});
  c.note =
      fmt::format("mesh volume / CAD volume {:.6f} (chords of the sizes, closed strips, tolerances, gaps: {:.3g} %)",
                  1 + *difference, 100 * explained);
  return c;
}

}  // namespace

double group_tolerance(const std::vector<double>& of_face, FaceId f) { return of_face.empty() ? 0 : of_face[f]; }

std::vector<Vec3> face_places(const SurfaceMesh& mesh, std::size_t n_faces) {
  std::vector<Vec3> place(n_faces);
  for (TriangleId t = static_cast<TriangleId>(mesh.n_triangles()) - 1; t >= 0; --t) {
    if (t > 0 && mesh.triangle_face[t - 1] == mesh.triangle_face[t]) continue;
    const auto& n = mesh.triangles[t].n;
    if (static_cast<std::size_t>(mesh.triangle_face[t]) < n_faces)
      place[mesh.triangle_face[t]] = (mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3;
  }
  return place;
}

std::vector<FaceMoments> measure_faces(const SurfaceMesh& mesh, const OwnTriangles& own, std::span<const Vec3> place,
                                       const ModelTables& tables) {
  std::vector<FaceMoments> parts;
  const bool has_strips = !mesh.merged.strip_face.empty();
  const StripWidths width(mesh, tables);
  for (TriangleId t = own.begin; t < own.end; ++t) {
    const FaceId f = mesh.triangle_face[t];
    const auto& n = mesh.triangles[t].n;
    if (static_cast<std::size_t>(t - own.begin) % kTrianglesPerPiece == 0 || parts.back().face != f)
      parts.emplace_back().face = f;
    FaceMoments& m = parts.back();
    std::array<Vec3, 3> x;
    for (int k = 0; k < 3; ++k) x[k] = mesh.node_xyz[n[k]] - place[f];
    const double area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
    const Vec3 sum = x[0] + x[1] + x[2];
    m.area += area;
    m.first = m.first + area / 3 * sum;
    for (const Vec3& p : {x[0], x[1], x[2], sum}) {
      m.squares += area / 12 * Vec3{p.x * p.x, p.y * p.y, p.z * p.z};
      m.products += area / 12 * Vec3{p.y * p.z, p.z * p.x, p.x * p.y};
    }
    if (has_strips) m.strip_volume += std::max({width.at(n[0]), width.at(n[1]), width.at(n[2])}) * area;
  }
  return parts;
}

void check_against_cad(const FacesOfMesh& mesh, const ModelTables& tables, double sewing, double area_tolerance,
                       Findings& f) {
  f.measure.face_area.resize(tables.n_faces(), 0);
  f.cad->face_area = tables.face_area;
  f.cad->face_group = tables.labels.face_group;
  f.checks.push_back(check_faces(mesh, tables));
  const bool has_all_faces = !f.checks.back().fails();
  const AreaChecks areas = check_areas(mesh, f.measure, tables, f.cad->chords, area_tolerance);
  f.checks.push_back(areas.areas);
  f.checks.push_back(areas.below);
  compare_wholes(tables, f);
  f.checks.push_back(check_cad_area(f, has_all_faces, area_tolerance));
  const std::vector<double> given = given_tolerances(tables, sewing);
  f.checks.push_back(check_cad_volume(mesh, tables, given, f));
  const std::vector<double> of_group = face_tolerances(tables.labels);
  f.checks.push_back(check_on_surface(tables, f.cad->chords, of_group, f.unit));
  if (!of_group.empty()) f.checks.push_back(check_group_tolerance(tables, f.cad->chords, of_group, f.unit));
  f.checks.push_back(check_off_surface(tables, f.cad->chords, given));
}

}  // namespace st
