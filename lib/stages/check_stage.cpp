#include "stages/check_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "base/eigen.h"
#include "base/error.h"
#include "base/length.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/required_unit.h"
#include "base/threads.h"
#include "geometry/model/cad_tolerance.h"
#include "io/file/text_file.h"
#include "io/foreign/triangulation_reader.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "judge/cad_contacts.h"
#include "judge/walls_apart.h"
#include "mesh/pair_match.h"
#include "stages/check_report.h"
#include "stages/fitting_files.h"
#include "stages/foreign_mesh.h"
#include "stages/layers_check.h"
#include "stages/stored_model.h"

namespace st {

namespace {

/// What the user let st-import sew by, model unit; 0: its default, far below what is checked.
double sewing_tolerance(const GeometryArtifact& g) {
  const auto options = nlohmann::json::parse(g.header.options_json, nullptr, false);
  if (!options.is_object() || !options.contains("sew") || !options["sew"].is_string()) return 0;
  return resolve_length(parse_length(options["sew"].get<std::string>(), "--sew"),
                        {g.tables.reference_diagonal(), g.tables.unit_in_m}, "--sew");
}

/// The geometry with what the checks need of it.
struct CadSide {
  double sewing = 0;  // model unit
  Model model;
  std::vector<std::uint8_t> may_be_open, may_be_nonmanifold;

  CadSide(GeometryArtifact&& g, const std::string& path) : sewing(sewing_tolerance(g)), model(stored_model(g, path)) {
    std::vector<std::int32_t> offsets;
    std::vector<FaceId> faces;
    model.tables().edge_faces(offsets, faces);
    for (EdgeId e = 0; e < model.tables().n_edges(); ++e) {
      may_be_open.push_back(offsets[e + 1] - offsets[e] == 1);
      may_be_nonmanifold.push_back(offsets[e + 1] - offsets[e] > 2);
    }
  }
  CadEdges edges() const { return {model.tables().edge_vertices, may_be_open, may_be_nonmanifold}; }
};

/// Middle of the first triangle of each face.
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

Check check_complete(const MeshArtifact& artifact) {
  Check c{"complete", "faces flagged as not meshed", {}, true, ""};
  if (!artifact.is_complete) c.defects.add({}), c.note = "merged with --allow-incomplete";
  if (artifact.mesh.triangles.empty()) c.defects.add({}), c.note = "no triangles";
  return c;
}

/// Faces of the CAD without a triangle; faces of no area need none.
Check check_faces(const SurfaceMesh& mesh, const ModelTables& tables) {
  constexpr double kNoArea = 1e-12;  // of the model's area
  Check c{"faces", "CAD faces without a triangle", {}, true, ""};
  double total = 0;
  for (const double a : tables.face_area) total += a;
  std::vector<std::uint8_t> has_triangle(tables.n_faces(), 0);
  for (const FaceId f : mesh.triangle_face) has_triangle[f] = 1;
  for (const FaceId f : mesh.merged.strip_face) has_triangle[f] = 1;
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
/// axis, as the mesh has it. So a cylinder is about as wide as its diameter. `origin` [n_faces]: near each face.
/// Returns [n_faces] model unit.
std::vector<double> face_extents(const SurfaceMesh& mesh, std::span<const Vec3> origin) {
  struct Moments {
    double area = 0;
    Vec3 first, squares, products;  // products: y z, z x, x y
  };
  std::vector<Moments> faces(origin.size());
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const FaceId f = mesh.triangle_face[t];
    std::array<Vec3, 3> x;
    for (int k = 0; k < 3; ++k) x[k] = mesh.node_xyz[mesh.triangles[t].n[k]] - origin[f];
    const double area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
    const Vec3 sum = x[0] + x[1] + x[2];
    faces[f].area += area;
    faces[f].first = faces[f].first + area / 3 * sum;
    for (const Vec3& p : {x[0], x[1], x[2], sum}) {
      faces[f].squares += area / 12 * Vec3{p.x * p.x, p.y * p.y, p.z * p.z};
      faces[f].products += area / 12 * Vec3{p.y * p.z, p.z * p.x, p.x * p.y};
    }
  }
  std::vector<double> width;
  for (const Moments& m : faces) {
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

/// Faces that differ in area from the CAD's.
struct AreaChecks {
  Check areas{"areas", "faces whose area differs from the CAD's", {}, true, ""};
  Check below{"below-sizes", "faces too small for the sizes, of another area than the CAD's", {}, false, ""};
};

/// Wrong are faces off by more than the tolerance, what chords explain, and the slack of the CAD. Of a face wider than
/// two requested lengths only chords of the requested length explain anything: no more than kMostOff of its area, or
/// what a hemisphere lacks of a face that is less than six lengths wide and a small part of the whole. Others beyond
/// kMostOff are below the sizes: they look as the sizes make them.
AreaChecks check_areas(const SurfaceMesh& mesh, const MeshMeasure& measure, const ModelTables& tables,
                       const ChordError& chords, double tolerance) {
  constexpr double kWide = 2;  // requested lengths
  AreaChecks c;
  const std::vector<Vec3> place = face_places(mesh, tables.n_faces());
  const std::vector<double> extent = face_extents(mesh, place);
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
    if (is_wide) allowed = std::min(allowed, std::max({kMostOff, tolerance, round}) * cad);
    if (difference > allowed && measure.face_area[f] > 0)
      c.areas.defects.add({place[f], f, kNone});
    else if (difference > kMostOff * cad && measure.face_area[f] > 0)
      c.below.defects.add({place[f], f, kNone});
    if (cad > 0 && difference / cad > largest) largest = difference / cad, worst = f;
  }
  if (worst != kNone)
    c.areas.note = fmt::format("largest difference {:.3g} % ({}; chords of the sizes {:.3g} %)", 100 * largest,
                               face_label(mesh, worst), 100 * chords.area[worst] / tables.face_area[worst]);
  return c;
}

/// Tolerance that the groups of a face give it, 0: none.
double group_tolerance(const std::vector<double>& of_face, FaceId f) { return of_face.empty() ? 0 : of_face[f]; }

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
std::vector<double> given_tolerances(const CadSide& cad) {
  std::vector<double> given = face_tolerances(cad.model.tables().labels);
  given.resize(cad.model.tables().n_faces(), 0);
  for (double& tolerance : given) tolerance = std::max(tolerance, cad.sewing);
  return given;
}

/// The tolerances of a face that may move its nodes: what was given, and the CAD's own up to what no CAD needs.
struct NodeTolerance {
  double of_cad = 0, given = 0;  // model unit; given 0: none
  double most = 0;               // off by more is off, whatever the CAD's tolerance
  double allowed() const { return std::max(std::min(of_cad, most), given); }
};

NodeTolerance node_tolerance(const ModelTables& tables, const ChordError& chords, const std::vector<double>& given,
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
    const NodeTolerance t = node_tolerance(tables, chords, given, f, diagonal);
    if (chords.off_surface[f] > 2 * t.allowed())
      c.defects.add({chords.off_place[f], f, kNone});
    else if (chords.stray[f] > std::max(t.most, 2 * t.given))
      c.defects.add({chords.stray_place[f], f, kNone});
  }
  return c;
}

Check check_volume(const TopologyReport& topology, const MeshMeasure& measure, const std::string& unit) {
  Check c{"volume", "closed meshes of no or negative volume", {}, true, ""};
  const bool has_volume = topology.is_closed() && topology.n_cad_boundary_edges == 0;
  if (has_volume && !(measure.volume > 0)) c.defects.add({});
  c.note = has_volume
               ? fmt::format("{:.9g}{}{}", measure.volume, unit.empty() ? "" : " " + unit, unit.empty() ? "" : "^3")
               : "open: none";
  return c;
}

/// What closed strips may change of the volume: their width times the area of the triangles at their common nodes.
double volume_at_strips(const SurfaceMesh& mesh, const ModelTables& tables) {
  std::vector<double> edge_width(tables.n_edges(), 0), vertex_width(tables.n_vertices(), 0);
  for (std::size_t i = 0; i < mesh.merged.strip_face.size(); ++i)
    for (const EdgeId e : {mesh.merged.strip_kept[i], mesh.merged.strip_closed[i]}) {
      edge_width[e] = tables.face_area[mesh.merged.strip_face[i]] / std::max(tables.edge_length[e], 1e-300);
      for (int k = 0; k < 2; ++k) {
        double& width = vertex_width[tables.edge_vertices[2 * e + k]];
        width = std::max(width, edge_width[e]);
      }
    }
  const auto width_at = [&](NodeId n) {
    const std::int32_t entity = mesh.node_entity[n];
    return mesh.node_entity_dim[n] == 0   ? vertex_width[entity]
           : mesh.node_entity_dim[n] == 1 ? edge_width[entity]
                                          : 0.0;
  };
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    const double width = std::max({width_at(t.n[0]), width_at(t.n[1]), width_at(t.n[2])});
    const Vec3 a = mesh.node_xyz[t.n[0]], b = mesh.node_xyz[t.n[1]], c = mesh.node_xyz[t.n[2]];
    if (width > 0) volume += width * 0.5 * norm(cross(b - a, c - a));
  }
  return volume;
}

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
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  tables.edge_faces(offsets, faces);
  const Vec3 apex = tables.box().center();
  double volume = 0;
  for (EdgeId e = 0; e < tables.n_edges(); ++e) {
    double gap = tables.edge_tolerance[e];
    for (std::int32_t i = offsets[e]; i < offsets[e + 1]; ++i) gap = std::min(gap, given[faces[i]]);
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
  if (area > 0) f.area_difference = f.measure.area / area - 1;
  const bool has_volume =
      f.topology.is_closed() && f.topology.n_cad_boundary_edges == 0 && f.topology.n_cad_nonmanifold_edges == 0;
  if (has_volume && tables.volume && *tables.volume != 0) f.volume_difference = f.measure.volume / *tables.volume - 1;
}

/// The area of all faces together: small ones may be below the sizes, the whole may not. Faces that are missing have a
/// check of their own.
Check check_cad_area(const Findings& f, bool has_all_faces, double tolerance) {
  Check c{"cad-area", "meshes whose area differs from the CAD's", {}, true, ""};
  if (!f.area_difference) return c;
  if (has_all_faces && std::fabs(*f.area_difference) > std::max(kMostOff, tolerance)) c.defects.add({});
  c.note = fmt::format("mesh area / CAD area {:.6f}", 1 + *f.area_difference);
  return c;
}

/// The volume enclosed against the CAD's: beyond the tolerance there is what chords of the requested length cut off,
/// what tolerances move, and what gaps that were sewn leave open.
Check check_cad_volume(const SurfaceMesh& mesh, const ModelTables& tables, const std::vector<double>& given,
                       const Findings& f) {
  constexpr double kTolerance = 0.005;  // relative
  Check c{"cad-volume", "closed meshes whose volume differs from the CAD's", {}, true, ""};
  if (!f.volume_difference) {
    c.note = tables.volume ? "open or non-manifold: none" : "open, or faces between solids: none";
    return c;
  }
  const ChordError& chords = *f.chords;
  double explained =
      volume_at_strips(mesh, tables) + volume_of_tolerances(tables, chords, given) + volume_of_gaps(tables, given);
  for (const double volume : chords.volume) explained += volume;
  explained /= std::fabs(*tables.volume);
  if (std::fabs(*f.volume_difference) > kTolerance + explained) c.defects.add({});
  c.note =
      fmt::format("mesh volume / CAD volume {:.6f} (chords of the sizes, closed strips, tolerances, gaps: {:.3g} %)",
                  1 + *f.volume_difference, 100 * explained);
  return c;
}

/// Whether a group is named as far field: the outside is to be filled.
bool has_flow_domain(const SurfaceMesh& mesh) {
  const FaceLabels& labels = mesh.labels;
  for (std::size_t g = 0; g < labels.group_name.size(); ++g)
    if (role_of(labels, g) == "farfield") return true;
  return false;
}

/// Crossings, those apart where the CAD touches itself; how many of the others are the CAD's own. The fluid in a flow
/// domain is one body of the CAD, but the parts of its boundary are bodies that may touch.
void check_crossings_and_contacts(const SurfaceMesh& mesh, const CadSide* cad, Findings& f) {
  if (!cad) {
    f.crossings = check_crossings(mesh);
    return;
  }
  CadContacts contacts(cad->model, mesh);
  WallsApart walls(cad->model, mesh);
  std::int64_t n_cad = 0;
  const auto touches_itself = [&](const TrianglePair& pair) {
    if (contacts.touches(pair)) return true;
    n_cad += contacts.crosses(pair);
    return false;
  };
  CadOfPairs pairs{touches_itself, [&](const TrianglePair& pair) { return walls.are_apart(pair); }};
  pairs.is_of_sheet = [&](const TrianglePair& pair) { return walls.are_of_body_and_sheet(pair); };
  if (!has_flow_domain(mesh)) pairs.is_one_body = [&](const TrianglePair& pair) { return walls.are_of_one_body(pair); };
  f.crossings = check_crossings(mesh, pairs);
  if (n_cad > 0) f.crossing_note = fmt::format("{} crossing or overlapping where the CAD crosses itself", n_cad);
}

std::vector<Check> list_mesh_checks(const MeshArtifact& artifact, const CheckThresholds& allow, bool is_filled_outside,
                                    const Findings& f) {
  const std::string open = f.topology.n_cad_boundary_edges
                               ? fmt::format("{} more where the CAD is open", f.topology.n_cad_boundary_edges)
                               : "";
  const std::string nonmanifold =
      f.topology.n_cad_nonmanifold_edges
          ? fmt::format("{} more where the CAD is non-manifold", f.topology.n_cad_nonmanifold_edges)
          : "";
  const auto left_of = [&](std::int64_t n) { return std::max<std::int64_t>(0, allow.max_crossings - n); };
  return {
      check_complete(artifact),
      {"closed", "open edges", f.topology.boundary_edges, true, open},
      {"manifold", "edges with more than two triangles (non-manifold)", f.topology.nonmanifold_edges, true,
       nonmanifold},
      {"oriented", "edges whose two triangles face opposite ways", f.topology.misoriented_edges, true, ""},
      {"repeated-nodes", "triangles with the same node twice", f.topology.repeated_nodes, true, ""},
      {"zero-area", "triangles without area", f.shape.zero_area, true, ""},
      {"duplicate-triangles", "triangles that occur twice", f.topology.duplicate_triangles, true, ""},
      {"duplicate-nodes", "nodes at the same place as another node", f.shape.duplicate_nodes, true, ""},
      {"folds", "folds: neighbouring triangles turned back on each other", f.shape.folds, true, "", allow.max_folds},
      {"crossings", "crossing pairs of triangles", f.crossings.crossings, true, f.crossing_note, allow.max_crossings},
      {"overlaps", "neighbouring triangles that overlap or cross", f.crossings.overlapping_neighbours, true, "",
       left_of(f.crossings.crossings.count)},
      {"cad-contacts", "crossing or overlapping pairs of triangles where the CAD touches itself",
       f.crossings.cad_contacts, true, "",
       left_of(f.crossings.crossings.count + f.crossings.overlapping_neighbours.count)},
      {"walls", "crossing pairs of triangles of parts that the CAD keeps apart", f.crossings.walls, is_filled_outside,
       ""},
      {"pinched", "nodes where parts touch", f.topology.pinched_nodes, false, ""},
      {"contacts", "pairs of triangles where parts touch or cross", f.crossings.contacts, is_filled_outside,
       is_filled_outside ? "no volume mesh fills the flow domain around them (st-import --unite or --join)" : ""},
      check_volume(f.topology, f.measure, f.unit)};
}

/// Everything that is measured: jobs that do not depend on each other, the longest first. `cad`, `field`: may be null.
void measure(const SurfaceMesh& mesh, const TriangleCorners& corners, const CadSide* cad, const SizeField* field,
             Progress& progress, Findings& f) {
  const EdgeTable edges = edges_of(mesh);
  std::vector<std::function<void()>> jobs;
  jobs.emplace_back([&] { check_crossings_and_contacts(mesh, cad, f); });
  if (cad)
    jobs.emplace_back([&] {
      DeviationSum deviation(cad->model, mesh);
      f.chords = estimate_chord_error(cad->model, mesh, &deviation);
      f.deviation = deviation.deviation();
    });
  jobs.emplace_back([&] { f.quality = measure_quality(mesh, edges, corners); });
  if (field)
    jobs.emplace_back([&] {
      f.conformity = measure_conformity(mesh, edges, [&](Vec3 p, int& hint) { return field->local(p, hint); });
    });
  jobs.emplace_back([&] { f.shape = check_shape(mesh, edges); });
  jobs.emplace_back([&] { f.topology = check_topology(mesh, edges, cad ? cad->edges() : CadEdges{}); });
  jobs.emplace_back([&] { f.measure = measure_mesh(mesh); });
  constexpr double kShare = 0.8;  // of the whole check
  for (auto& job : jobs)
    job = [&progress, work = std::move(job), part = kShare / static_cast<double>(jobs.size())] {
      work();
      progress.advance(part);
    };
  run_jobs(jobs);
  f.is_stretched = corners.is_stretched();
}

void run_cad_checks(const SurfaceMesh& mesh, const CadSide& cad, double area_tolerance, Findings& f) {
  f.measure.face_area.resize(cad.model.tables().n_faces(), 0);
  f.cad_area = cad.model.tables().face_area;
  f.face_group = cad.model.tables().labels.face_group;
  f.checks.push_back(check_faces(mesh, cad.model.tables()));
  const bool has_all_faces = !f.checks.back().fails();
  const AreaChecks areas = check_areas(mesh, f.measure, cad.model.tables(), *f.chords, area_tolerance);
  f.checks.push_back(areas.areas);
  f.checks.push_back(areas.below);
  compare_wholes(cad.model.tables(), f);
  f.checks.push_back(check_cad_area(f, has_all_faces, area_tolerance));
  const std::vector<double> given = given_tolerances(cad);
  f.checks.push_back(check_cad_volume(mesh, cad.model.tables(), given, f));
  const std::vector<double> of_group = face_tolerances(cad.model.tables().labels);
  f.checks.push_back(check_on_surface(cad.model.tables(), *f.chords, of_group, f.unit));
  if (!of_group.empty()) f.checks.push_back(check_group_tolerance(cad.model.tables(), *f.chords, of_group, f.unit));
  f.checks.push_back(check_off_surface(cad.model.tables(), *f.chords, given));
}

// --- thresholds ---

/// One value of the whole mesh against its bound: one defect without a place, or none.
Check check_value(const std::string& name, const std::string& what, bool is_good, const std::string& note) {
  Check c{name, what, {}, true, note};
  if (!is_good) c.defects.add({});
  return c;
}

/// Nodes and triangles of periodic faces that are no images of each other.
Check check_pairs(const SurfaceMesh& mesh) {
  Check c{"pairs", "nodes and triangles of periodic faces without a partner", {}, true, ""};
  const double tolerance = pair_tolerance(mesh);
  for (const FacePair& p : mesh.merged.pairs) {
    const PairMatch match = match_pair(mesh, p, tolerance);
    for (const NodeId n : match.alone) c.defects.add({mesh.node_xyz[n], p.a, kNone});
    for (const TriangleId t : match.triangles_alone)
      c.defects.add({mesh.node_xyz[mesh.triangles[t].n[0]], mesh.triangle_face[t], kNone});
  }
  return c;
}

/// Triangles for which `is_bad(corner, corner, corner)`.
template <class IsBad>
Check check_triangles(const SurfaceMesh& mesh, const TriangleCorners& corners, const std::string& name,
                      const std::string& what, const IsBad& is_bad) {
  Check c{name, what, {}, true, ""};
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const auto& n = mesh.triangles[t].n;
    const auto [p, q, r] = corners(t);
    if (is_bad(p, q, r))
      c.defects.add(
          {(mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3, mesh.triangle_face[t], kNone});
  }
  return c;
}

void check_quality(const SurfaceMesh& mesh, const TriangleCorners& corners, const CheckThresholds& asked, Findings& f) {
  const QualityReport& q = f.quality;
  if (asked.min_quality)
    f.checks.push_back(
        check_triangles(mesh, corners, "min-quality", fmt::format("triangles of quality below {}", *asked.min_quality),
                        [&](Vec3 a, Vec3 b, Vec3 c) { return triangle_quality(a, b, c) < *asked.min_quality; }));
  if (asked.min_angle_deg)
    f.checks.push_back(check_triangles(mesh, corners, "min-angle",
                                       fmt::format("triangles with an angle below {} deg", *asked.min_angle_deg),
                                       [&](Vec3 a, Vec3 b, Vec3 c) {
                                         const auto angles = triangle_angles_deg(a, b, c);
                                         return *std::min_element(angles.begin(), angles.end()) < *asked.min_angle_deg;
                                       }));
  if (asked.min_mean_quality)
    f.checks.push_back(check_value("min-mean-quality", fmt::format("mean quality below {}", *asked.min_mean_quality),
                                   q.model.mean >= *asked.min_mean_quality, fmt::format("{:.4f}", q.model.mean)));
  if (asked.min_p1_quality)
    f.checks.push_back(check_value("min-p1-quality",
                                   fmt::format("first percentile of quality below {}", *asked.min_p1_quality),
                                   q.model.p1 >= *asked.min_p1_quality, fmt::format("{:.4f}", q.model.p1)));
  if (asked.max_jump)
    f.checks.push_back(check_value("max-jump", fmt::format("growth (99.9 %) above {}", *asked.max_jump),
                                   q.jump_p999 <= *asked.max_jump, fmt::format("{:.3f}", q.jump_p999)));
}

void check_causes(const CheckThresholds& asked, Findings& f) {
  if (!asked.max_free_sharp || !f.causes) return;
  Check c{"max-free-sharp",
          fmt::format("triangles with an angle below {:g} deg that the CAD does not force", f.causes->angle_deg),
          {},
          true,
          ""};
  for (const CausePlace& p : f.causes->sharp.worst[static_cast<std::size_t>(ShapeCause::kFree)])
    c.defects.add({p.xyz, p.face, kNone});
  c.defects.count = f.causes->sharp.free();
  c.allowed = *asked.max_free_sharp;
  f.checks.push_back(c);
}

void check_sizes(const CheckThresholds& asked, Findings& f) {
  if (!asked.min_size_share || !f.conformity) return;
  const double share = f.conformity->free.share();
  f.checks.push_back(check_value("min-size-share",
                                 fmt::format("share of edges of the requested length below {}", *asked.min_size_share),
                                 share >= *asked.min_size_share, fmt::format("{:.4f}", share)));
}

void check_deviation(const CheckThresholds& asked, const ModelTables& tables, Findings& f) {
  const std::vector<DeviationStats>& faces = f.deviation->faces;
  if (!asked.max_deviation.empty()) {
    const double bound = resolve_length(parse_length(asked.max_deviation, "--max-deviation"),
                                        {tables.reference_diagonal(), tables.unit_in_m}, "--max-deviation");
    const std::vector<double> of_group = face_tolerances(tables.labels);
    const std::string own = of_group.empty() ? "" : ", or the tolerance of their group,";
    Check c{"max-deviation",
            fmt::format("faces with a triangle centroid off the surface by more than {:.6g}{}{}", bound,
                        f.unit.empty() ? "" : " " + f.unit, own),
            {},
            true,
            ""};
    for (FaceId i = 0; i < static_cast<FaceId>(faces.size()); ++i) {
      const double tolerance = group_tolerance(of_group, i);
      if (faces[i].max_distance > (tolerance > 0 ? tolerance : bound))
        c.defects.add({faces[i].distance_place, i, kNone});
    }
    f.checks.push_back(c);
  }
  if (!asked.max_normal_deviation_deg) return;
  Check c{
      "max-normal-deviation",
      fmt::format("faces with a triangle turned from the surface by more than {} deg", *asked.max_normal_deviation_deg),
      {},
      true,
      ""};
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (faces[i].max_angle_deg > *asked.max_normal_deviation_deg)
      c.defects.add({faces[i].angle_place, static_cast<FaceId>(i), kNone});
  f.checks.push_back(c);
}

std::unique_ptr<CadSide> read_cad(const CheckStageOptions& options, const ArtifactHeader& mesh_header) {
  if (options.geometry.empty()) return nullptr;
  GeometryArtifact geometry = read_geometry(options.geometry);
  require_same_geometry(options.mesh, mesh_header, options.geometry, geometry.header);
  return std::make_unique<CadSide>(std::move(geometry), options.geometry);
}

/// Nodes lie on entities that the geometry has. Throws Error(kInput).
void require_entities(const std::string& path, const SurfaceMesh& mesh, const ModelTables& t) {
  const std::int32_t n_entities[] = {t.n_vertices(), t.n_edges(), t.n_faces()};
  for (std::size_t n = 0; n < mesh.node_entity.size(); ++n) {
    const std::size_t dim = mesh.node_entity_dim[n];
    if (dim > 2 || mesh.node_entity[n] < 0 || mesh.node_entity[n] >= n_entities[dim])
      throw Error(ExitCode::kInput,
                  fmt::format("{}: node {} lies on an entity that the geometry does not have; the file "
                              "is damaged: make it again with st-merge",
                              path, n + 1));
  }
}

/// The mesh as it is checked, and what its file had that it has no more.
struct CheckedMesh {
  MeshArtifact artifact;
  Defects turned;  ///< edges of a foreign mesh whose triangles face opposite ways: association turns them
};

/// The face of the triangle whose middle is nearest.
FaceId nearest_face(const SurfaceMesh& mesh, Vec3 p) {
  FaceId face = kNone;
  double least = 0;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const auto& n = mesh.triangles[t].n;
    const double d = distance(p, (mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3);
    if (face == kNone || d < least) face = mesh.triangle_face[t], least = d;
  }
  return face;
}

/// Edges of the file's triangles that face opposite ways; faces are those of the associated mesh.
Defects misoriented_edges(const std::string& path, const SurfaceMesh& associated) {
  const SurfaceMesh mesh = read_triangulation(path);
  Defects found = check_topology(mesh, edges_of(mesh)).misoriented_edges;
  for (DefectPlace& p : found.first) p.face_a = nearest_face(associated, p.xyz), p.face_b = kNone;
  return found;
}

/// The mesh and its geometry (null: not given); a mesh of another program is associated to it first.
CheckedMesh read_checked_mesh(const CheckStageOptions& o, std::unique_ptr<CadSide>& cad) {
  CheckedMesh result;
  MeshArtifact& artifact = result.artifact;
  if (!is_foreign_mesh(o.mesh)) {
    artifact = read_mesh(o.mesh);
    cad = read_cad(o, artifact.header);
    if (cad) require_entities(o.mesh, artifact.mesh, cad->model.tables());
  } else if (o.geometry.empty()) {
    if (!o.sizing.empty())
      throw Error(ExitCode::kUsage,
                  fmt::format("--sizing: {} is a mesh of another program, which also needs --geometry", o.mesh));
    artifact.mesh = read_triangulation(o.mesh);
  } else {
    GeometryArtifact geometry = read_geometry(o.geometry);
    const std::string hash = geometry.header.content_hash;
    cad = std::make_unique<CadSide>(std::move(geometry), o.geometry);
    ForeignMesh foreign = read_foreign_mesh(o.mesh, cad->model, {});
    log_info(association_text(o.mesh, foreign.artifact.mesh, foreign.report));
    if (foreign.report.n_turned > 0) result.turned = misoriented_edges(o.mesh, foreign.artifact.mesh);
    artifact = std::move(foreign.artifact);
    artifact.header.geometry_hash = hash;
  }
  return result;
}

std::unique_ptr<SizeField> read_sizes(const CheckStageOptions& options, const ArtifactHeader& mesh_header) {
  if (options.sizing.empty()) return nullptr;
  ArtifactHeader header;
  std::unique_ptr<SizeField> field = open_sizing(options.sizing, &header);
  require_same_geometry(options.mesh, mesh_header, options.sizing, header);
  return field;
}

/// [n_nodes]; empty where sizes are the same length in all directions, or unknown.
std::vector<Vec3> squeeze_of_nodes(const SurfaceMesh& mesh, const SizeField* field) {
  if (!field || !field->is_stretched()) return {};
  constexpr std::size_t kPerPiece = 16'384;
  std::vector<Vec3> squeeze(mesh.node_xyz.size());
  parallel_for(squeeze.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    int hint = 0;
    for (std::size_t n = begin; n < end; ++n) squeeze[n] = field->local(mesh.node_xyz[n], hint).squeeze();
  });
  return squeeze;
}

/// Lifting surfaces that the sizes know; their distance from the CAD, where that was measured.
std::vector<WingMeasure> measured_wings(const std::string& sizing, const SurfaceMesh& mesh, const Findings& f) {
  const std::vector<WingRecord> records = read_asked_wings(sizing);
  std::vector<WingMeasure> wings = measure_wings(mesh, records);
  for (std::size_t w = 0; f.deviation && w < wings.size(); ++w) {
    double chord = 0, most = 0;
    for (const WingRecord::Station& s : records[w].stations) chord = std::max(chord, s.chord);
    for (const FaceId face : records[w].faces)
      if (static_cast<std::size_t>(face) < f.deviation->faces.size())
        most = std::max(most, f.deviation->faces[face].max_distance);
    if (chord > 0 && !records[w].faces.empty()) wings[w].deviation = most / chord;
  }
  return wings;
}

/// Says where a mesh is coarser at lifting surfaces than was asked for.
void check_wings(Findings& f) {
  if (f.wings.empty()) return;
  Check c{"wing-sizes", "places on lifting surfaces coarser than 1.5 times what was asked for", {}, false, ""};
  for (const WingMiss& miss : find_misses(f.wings)) {
    if (c.defects.count == 0)
      c.note = fmt::format("the {} of the surface at edge {} has {} at {:.0f} % of the span, {} asked for", miss.what,
                           f.wings[miss.wing].first_edge + 1, length_text(miss.has, f.unit), 100 * miss.share,
                           length_text(miss.asked, f.unit));
    c.defects.add({miss.place, kNone, kNone});
  }
  f.checks.push_back(std::move(c));
}

/// What the measures mean.
void judge(const CheckStageOptions& o, const MeshArtifact& artifact, const TriangleCorners& corners, const CadSide* cad,
           Findings& f) {
  f.checks = list_mesh_checks(artifact, o.thresholds, has_flow_domain(artifact.mesh), f);
  if (!artifact.mesh.merged.pairs.empty()) f.checks.push_back(check_pairs(artifact.mesh));
  if (cad) {
    run_cad_checks(artifact.mesh, *cad, o.area_tolerance, f);
    f.causes = find_shape_causes(cad->model, artifact.mesh, corners, f.quality, f.conformity ? &*f.conformity : nullptr,
                                 o.list_below_deg);
  }
  check_quality(artifact.mesh, corners, o.thresholds, f);
  check_causes(o.thresholds, f);
  check_sizes(o.thresholds, f);
  check_wings(f);
  if (cad) check_deviation(o.thresholds, cad->model.tables(), f);
  if (o.layers.empty()) return;
  const SurfaceMesh& mesh = artifact.mesh;
  for (Check& c : layers_checks(mesh, has_flow_domain(mesh), artifact.header.unit_in_m, parse_layers(o.layers)))
    f.checks.push_back(std::move(c));
}

}  // namespace

void CheckStageOptions::validate() const {
  const auto needs = [](bool is_asked, const std::string& given, const char* option, const char* input) {
    if (is_asked && given.empty())
      throw Error(ExitCode::kUsage, fmt::format("{}: needs {} FILE; give it, or leave the option out", option, input));
  };
  needs(thresholds.min_size_share.has_value(), sizing, "--min-size-share", "--sizing");
  needs(thresholds.max_free_sharp.has_value(), geometry, "--max-free-sharp", "--geometry");
  needs(!thresholds.max_deviation.empty(), geometry, "--max-deviation", "--geometry");
  needs(thresholds.max_normal_deviation_deg.has_value(), geometry, "--max-normal-deviation", "--geometry");
  if (!layers.empty()) parse_layers(layers);
}

StageSummary run_check(const CheckStageOptions& options, std::string* report) {
  options.validate();
  const Timer timer;
  Progress progress("checking", 1);
  progress.step("reading", 0);
  require_fitting({{options.mesh, "mesh"}, {options.geometry, "geometry"}, {options.sizing, "sizing"}});
  if (const std::string& bound = options.thresholds.max_deviation; !bound.empty())
    require_unit(parse_length(bound, "--max-deviation"), read_header(options.geometry).unit_in_m, "--max-deviation");
  std::unique_ptr<CadSide> cad;
  const CheckedMesh checked = read_checked_mesh(options, cad);
  const MeshArtifact& artifact = checked.artifact;
  const std::unique_ptr<SizeField> field = read_sizes(options, artifact.header);
  const std::vector<Vec3> squeeze = squeeze_of_nodes(artifact.mesh, field.get());
  const TriangleCorners corners(artifact.mesh, squeeze);
  Findings f;
  f.unit = artifact.header.unit;
  progress.step("measuring", 0.1);
  measure(artifact.mesh, corners, cad.get(), field.get(), progress, f);
  if (checked.turned.count > 0) f.topology.misoriented_edges = checked.turned;
  progress.step("causes", 0.9);
  if (!options.sizing.empty()) f.wings = measured_wings(options.sizing, artifact.mesh, f);
  judge(options, artifact, corners, cad.get(), f);
  const double seconds = timer.seconds();
  std::string full;
  if (report || !options.reports.empty())
    full = check_report_json(options.mesh, artifact.mesh, f, seconds, ReportDetail::kFull) + "\n";
  for (const std::string& path : options.reports) write_text_file(path, full);
  if (report) *report = std::move(full);
  return {options.text == CheckText::kWhole ? check_report_text(options.mesh, artifact.mesh, f, seconds)
                                            : check_brief_text(options.mesh, artifact.mesh, f, seconds, options.text),
          check_report_json(options.mesh, artifact.mesh, f, seconds, ReportDetail::kSummary),
          f.passes() ? ExitCode::kOk : ExitCode::kIncomplete};
}

}  // namespace st
