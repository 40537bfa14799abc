// Small artifacts with every field filled, for the tests of io: a tetrahedron-like mesh of four faces.
#pragma once

#include "io/hdf5/artifact.h"
#include "io/hdf5/failure_artifact.h"
#include "mesh/corner_uv.h"

namespace st {

inline ArtifactHeader sample_header() {
  ArtifactHeader header;
  header.tool = "st-test";
  header.tool_version = "1.2.3";
  header.options_json = R"({"slope":0.2})";
  header.unit = "mm";
  header.unit_in_m = 0.001;
  header.geometry_hash = "0123";
  header.inputs = {{"raster", "ra ster.hdf", "4567"}};
  return header;
}

/// Labels of two main groups and `n_faces` faces: two parts of one name, one further table, two groups of edges, one of
/// vertices.
inline FaceLabels sample_labels(std::int32_t n_faces) {
  FaceLabels labels;
  labels.group_attributes = {R"({"tolerance":0.1})", "{}"};
  labels.part_name = {"bolt", "bolt"};
  labels.part_path = {"Träger/bolt#1", "Träger/bolt#2"};
  labels.tables = {{"table", {"hot", "cold", "Öl"}, {"wall", "inlet", "wall"}, {"{}", R"({"t":300})", "{}"}, {}}};
  for (std::int32_t f = 0; f < n_faces; ++f) {
    labels.face_part.push_back(f % 3 - 1);
    labels.tables[0].face_group.push_back((f + 2) % 4 - 1);
  }
  labels.edge_groups = {{"te", "", "{}", {1, 3}}, {"root", "table", R"({"a":1})", {0}}};
  labels.vertex_groups = {{"tip", "", "{}", {1}}};
  return labels;
}

inline GeometryArtifact sample_geometry() {
  GeometryArtifact g;
  g.header = sample_header();
  g.header.geometry_hash.clear();
  ModelTables& t = g.tables;
  t.vertex_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  t.vertex_tolerance = {1e-7, 1e-6, 1e-5};
  t.edge_vertices = {0, 1, 1, 2, 2, 0, 0, 0};
  t.edge_range = {0, 1, 0, 2, -1, 1, 0, 6.28};
  t.edge_length = {1, 1.4142135623730951, 1, 0};
  t.edge_tolerance = {1e-7, 1e-7, 1e-7, 1e-3};
  t.edge_is_degenerate = {0, 0, 0, 1};
  t.edge_name = {"", "TE", "", "Pol, Süd"};
  t.face_loop_offsets = {0, 1, 2};
  t.loop_coedge_offsets = {0, 3, 7};
  t.coedge_edge = {0, 1, 2, 2, 1, 0, 3};
  t.coedge_is_reversed = {0, 0, 0, 1, 1, 1, 0};
  t.face_is_reversed = {0, 1};
  t.face_type = {SurfaceType::kPlane, SurfaceType::kBspline};
  t.face_uv_bounds = {0, 1, 0, 1, -1, 1, -2, 2};
  t.face_tolerance = {1e-7, 2e-7};
  t.face_area = {0.5, 0.75};
  t.face_width = {0.5, 0.25};
  t.face_box = {{{0, 0, 0}, {1, 1, 0}}, {{0, 0, -1}, {1, 1, 1}}};
  t.labels = sample_labels(2);
  t.labels.face_name = {"WING_UPPER", "Flügel unten"};
  t.face_color = {0xff8000, kNone};
  t.face_layer = {"", "7"};
  t.labels.face_group = {0, 1};
  t.face_shell = {0, 0};
  t.face_solid = {0, kNone};
  t.labels.group_name = {"WING", "far field"};
  t.labels.group_role = {"wall", "farfield"};
  t.n_shells = 1;
  t.n_solids = 1;
  t.volume = 0.125;
  t.unit = "mm";
  t.unit_in_m = 0.001;
  for (int i = 0; i < 3000; ++i) g.brep.push_back(static_cast<std::byte>(i * 7));
  g.findings = {{FindingKind::kShortEdge, "edge 3 \"TE\"", {1, 2, 3}, 1e-4, false},
                {FindingKind::kSewn, "", {}, 0, true, "4 free edges before, 0 after"}};
  g.is_closed = true;
  g.previous_faces = {4, 0, 0, 0};
  g.previous_edges = {5, 0, 6, 0, 7, 0, 9, 0};
  g.previous_vertices = {2, 0, 1, 0, 0, 0};
  return g;
}

inline PatchesArtifact sample_patches() {
  PatchesArtifact p;
  p.header = sample_header();
  p.vertex_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  p.edge_vertices = {0, 1, 1, 2, 2, 0};
  p.edges.edge_offsets = {0, 3, 6, 8};
  p.edges.node_t = {0, 0.5, 1, 0, 0.4, 1, 0, 1};
  p.edges.node_xyz = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0.6, 0.4, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  p.edges.node_size = {0.5, 0.5, 0.5, 0.5, 0.6, 0.5, 1, 1};
  p.edges.node_request = {0.5, 0.5, 0.5, 0.5, 0.7, 0.5, 1, 1};
  p.edges.node_previous = {0, 3, 1, 1, kNone, 2, 2, 0};
  FacePatch patch;
  patch.face = 0;
  patch.n_boundary = 5;
  patch.boundary_dim = {0, 1, 0, 1, 0};
  patch.boundary_entity = {0, 0, 1, 1, 2};
  patch.boundary_index = {0, 1, 0, 1, 0};
  patch.inner_xyz = {{0.3, 0.3, 0}};
  patch.inner_uv = {{0.3, 0.3}};
  patch.inner_size = {0.4};
  patch.triangles = {{{0, 1, 5}}, {{1, 2, 5}}, {{2, 3, 5}}, {{3, 4, 5}}, {{4, 0, 5}}};
  patch.inner_previous = {kNone};
  patch.triangle_previous = {4, 7, kNone, kNone, kNone};
  std::vector<Vec2> uv;
  for (const Triangle& t : patch.triangles)
    for (const NodeId n : t.n) uv.push_back({0.1 * n, 0.2 * n});
  set_corner_uvs(uv, patch);
  FacePatch empty;
  empty.face = 1;
  p.patches = {patch, empty};
  p.failures = {{1, "the boundary crosses itself", "use a smaller lmin", {0.5, 0.5, 0}, true, false, 0.25}};
  p.merged = {{2}, {1}, {0}, {1}, {1}, {{0, 1, {.translation = {0, 0, 1}}}, {1, 0, {}}}};
  p.labels = sample_labels(2);
  p.labels.face_name = {"top", ""};
  p.labels.group_name = {"default"};
  p.labels.group_role = {"farfield"};
  p.labels.group_attributes.pop_back();
  p.labels.face_group = {0, 0};
  p.face_shell = {0, kNone};
  p.face_area = {0.5, 0.6};
  p.is_complete = false;
  return p;
}

inline MeshArtifact sample_mesh() {
  MeshArtifact artifact;
  artifact.header = sample_header();
  SurfaceMesh& m = artifact.mesh;
  m.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 1}};
  m.node_entity_dim = {0, 0, 1, 2};
  m.node_entity = {0, 1, 4, 3};
  m.node_t = {0, 0, 0.7, 0};
  m.node_size = {1, 1.5, 1, 2};
  m.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}};
  m.triangle_face = {0, 1, 2, 3};
  m.triangle_group = {0, 0, 1, 1};
  for (int i = 0; i < 12; ++i) m.corner_uv.push_back({0.1 * i, -0.1 * i});
  m.node_previous = {0, 2, kNone, 3};
  m.triangle_previous = {kNone, 5, 6, kNone};
  m.merged = {{5, 7}, {1}, {0}, {1}, {0}, {{1, 0, {.translation = {0, 2, 1}}}}};
  m.labels = sample_labels(4);
  m.labels.face_name = {"bottom", "", "Flügel", "a b"};
  m.labels.group_name = {"body", "wing"};
  m.labels.group_role = {"wall", "symmetry"};
  m.segment_nodes = {0, 2, 2, 1, 1, 0};
  m.segment_edge = {1, 1, 3};
  return artifact;
}

/// A bow tie of four segments with two triangles so far, and the place where it crosses itself.
inline FailureArtifact sample_failures() {
  FailureArtifact a;
  a.header = sample_header();
  FaceAttempt f;
  f.patch.face = 1;
  f.patch.inner_xyz = {{0, 0, 3}, {2, 0, 3}, {0, 2, 3}, {2, 2, 3}, {1, 0.5, 3}};
  for (const Vec3 x : f.patch.inner_xyz)
    f.patch.inner_uv.push_back({10 * x.x, 10 * x.y}), f.patch.inner_size.push_back(0.5);
  f.segment_nodes = {0, 1, 1, 2, 2, 3, 3, 0};
  f.segment_loop = {0, 0, 0, 0};
  f.segment_edge = {4, 5, 6, 7};
  f.patch.triangles = {{{0, 1, 4}}, {{2, 4, 3}}};
  f.places = {{1, 1, 3}};
  a.failures = {{1, "its loops cross", "repair it", {1, 1, 3}}};
  a.attempts = {f};
  a.face_name = {"top", "Flügel"};
  return a;
}

}  // namespace st
