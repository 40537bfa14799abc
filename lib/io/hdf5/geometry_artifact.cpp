// geometry.hdf: docs/artifacts.md
#include <cmath>
#include <type_traits>
#include <utility>

#include "geometry/model/joined_tables.h"
#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/composites_io.h"
#include "io/hdf5/face_labels_io.h"

namespace st {
namespace {

constexpr int kFacetsVersion = 1;         // of the group /st/facets
constexpr int kPlainGeometryVersion = 1;  // without composites, which older tools would take for faces of the CAD

void write_vertices_and_edges(Hdf5Writer& w, const ModelTables& t) {
  w.write("/st/vertex/xyz", t.vertex_xyz);
  w.write("/st/vertex/tolerance", t.vertex_tolerance);
  w.write("/st/edge/vertices", t.edge_vertices, 2);
  w.write("/st/edge/range", t.edge_range, 2);
  w.write("/st/edge/length", t.edge_length);
  w.write("/st/edge/tolerance", t.edge_tolerance);
  w.write("/st/edge/is_degenerate", t.edge_is_degenerate);
  w.write_strings("/st/edge/name", t.edge_name);
}

void write_faces(Hdf5Writer& w, const ModelTables& t) {
  w.write("/st/face/loop_offsets", t.face_loop_offsets);
  w.write("/st/loop/coedge_offsets", t.loop_coedge_offsets);
  w.write("/st/coedge/edge", t.coedge_edge);
  w.write("/st/coedge/is_reversed", t.coedge_is_reversed);
  w.write("/st/face/is_reversed", t.face_is_reversed);
  w.write("/st/face/type", t.face_type);
  w.write("/st/face/uv_bounds", t.face_uv_bounds, 4);
  w.write("/st/face/tolerance", t.face_tolerance);
  w.write("/st/face/area", t.face_area);
  w.write("/st/face/width", t.face_width);
  w.write("/st/face/box", t.face_box);
  w.write_strings("/st/face/name", t.labels.face_name);
  w.write("/st/face/color", t.face_color);
  w.write_strings("/st/face/layer", t.face_layer);
  w.write("/st/face/group", t.labels.face_group);
  w.write("/st/face/shell", t.face_shell);
  w.write("/st/face/solid", t.face_solid);
  w.write_strings("/st/group/name", t.labels.group_name);
  w.write_strings("/st/group/role", t.labels.group_role);
  write_labels(w, t.labels);
}

void write_findings(Hdf5Writer& w, const std::vector<ImportFinding>& findings) {
  std::vector<std::string> what, detail, entity;
  std::vector<Vec3> xyz;
  std::vector<double> size;
  std::vector<std::uint8_t> kind, is_repair;
  for (const ImportFinding& f : findings) {
    what.push_back(f.what());
    kind.push_back(static_cast<std::uint8_t>(f.kind));
    detail.push_back(f.detail);
    entity.push_back(f.entity);
    xyz.push_back(f.xyz);
    size.push_back(f.size);
    is_repair.push_back(f.is_repair);
  }
  w.write_strings("/st/finding/what", what);
  w.write("/st/finding/kind", kind);
  w.write_strings("/st/finding/detail", detail);
  w.write_strings("/st/finding/entity", entity);
  w.write("/st/finding/xyz", xyz);
  w.write("/st/finding/size", size);
  w.write("/st/finding/is_repair", is_repair);
}

constexpr const char *kPreviousFaces = "/st/face/previous_id", *kPreviousEdges = "/st/edge/previous_id",
                     *kPreviousVertices = "/st/vertex/previous_id";

/// `may_be_new`: some may have been nothing before.
std::vector<std::int32_t> read_previous(const Hdf5Reader& r, const std::string& name, std::size_t n,
                                        bool may_be_new = false) {
  std::vector<std::int32_t> previous = r.read_rows<std::int32_t>(name, n, 2);
  for (std::size_t i = 0; i < n; ++i)
    if (previous[2 * i] < (may_be_new ? kNone : 0) || previous[2 * i + 1] < 0 ||
        static_cast<std::size_t>(previous[2 * i + 1]) >= r.header().inputs.size())
      r.fail(name, "row " + std::to_string(i) + " is of no input");
  return previous;
}

void read_vertices_and_edges(const Hdf5Reader& r, ModelTables& t) {
  t.vertex_xyz = r.read<Vec3>("/st/vertex/xyz");
  t.vertex_tolerance = r.read_rows<double>("/st/vertex/tolerance", t.vertex_xyz.size());
  t.edge_length = r.read<double>("/st/edge/length");
  const std::size_t n = t.edge_length.size();
  t.edge_vertices = r.read_rows<std::int32_t>("/st/edge/vertices", n, 2);
  require_ids(r, "/st/edge/vertices", t.edge_vertices, t.vertex_xyz.size());
  t.edge_range = r.read_rows<double>("/st/edge/range", n, 2);
  t.edge_tolerance = r.read_rows<double>("/st/edge/tolerance", n);
  t.edge_is_degenerate = r.read_rows<std::uint8_t>("/st/edge/is_degenerate", n);
  t.edge_name = r.read_string_rows("/st/edge/name", n);
  require_finite(r, "/st/vertex/xyz", t.vertex_xyz);
  require_lengths(r, "/st/vertex/tolerance", t.vertex_tolerance);
  require_lengths(r, "/st/edge/length", t.edge_length);
  require_lengths(r, "/st/edge/tolerance", t.edge_tolerance);
  require_ranges(r, "/st/edge/range", t.edge_range);
}

void read_loops(const Hdf5Reader& r, ModelTables& t, std::size_t n_faces) {
  t.coedge_edge = r.read<std::int32_t>("/st/coedge/edge");
  require_ids(r, "/st/coedge/edge", t.coedge_edge, t.edge_length.size());
  t.coedge_is_reversed = r.read_rows<std::uint8_t>("/st/coedge/is_reversed", t.coedge_edge.size());
  t.loop_coedge_offsets = r.read<std::int32_t>("/st/loop/coedge_offsets");
  require_offsets(r, "/st/loop/coedge_offsets", t.loop_coedge_offsets, t.coedge_edge.size());
  t.face_loop_offsets = r.read_rows<std::int32_t>("/st/face/loop_offsets", n_faces + 1);
  require_offsets(r, "/st/face/loop_offsets", t.face_loop_offsets, t.loop_coedge_offsets.size() - 1);
}

/// A number of shells or solids, each of which has a face.
std::int32_t read_count(const Hdf5Reader& r, const std::string& name, std::size_t n_faces) {
  const std::int64_t n = r.int_attribute("/st", name);
  if (n < 0 || static_cast<std::uint64_t>(n) > n_faces)
    r.fail("/st@" + name, std::to_string(n) + " is not possible with " + std::to_string(n_faces) + " faces");
  return static_cast<std::int32_t>(n);
}

void read_faces(const Hdf5Reader& r, ModelTables& t) {
  t.face_is_reversed = r.read<std::uint8_t>("/st/face/is_reversed");
  const std::size_t n = t.face_is_reversed.size();
  read_loops(r, t, n);
  t.face_type = r.read_rows<SurfaceType>("/st/face/type", n);
  t.face_uv_bounds = r.read_rows<double>("/st/face/uv_bounds", n, 4);
  t.face_tolerance = r.read_rows<double>("/st/face/tolerance", n);
  t.face_area = r.read_rows<double>("/st/face/area", n);
  if (r.has("/st/face/width")) {
    t.face_width = r.read_rows<double>("/st/face/width", n);
  } else {  // written before widths were: as wide as long
    for (double area : t.face_area) t.face_width.push_back(std::sqrt(area));
  }
  t.face_box = r.read_rows<Box3>("/st/face/box", n);
  require_ranges(r, "/st/face/uv_bounds", t.face_uv_bounds);
  require_lengths(r, "/st/face/tolerance", t.face_tolerance);
  require_finite(r, "/st/face/area", t.face_area);
  require_lengths(r, "/st/face/width", t.face_width);
  require_finite(r, "/st/face/box", t.face_box);
  t.face_color = r.read_rows<std::int32_t>("/st/face/color", n);
  t.face_layer = r.read_string_rows("/st/face/layer", n);
  t.labels = read_labels(r, n);
  for (const EntityGroup& g : t.labels.edge_groups) require_ids(r, "/st/edge_group/ids", g.ids, t.edge_length.size());
  for (const EntityGroup& g : t.labels.vertex_groups)
    require_ids(r, "/st/vertex_group/ids", g.ids, t.vertex_xyz.size());
  t.n_shells = read_count(r, "n_shells", n);
  t.n_solids = read_count(r, "n_solids", n);
  t.face_shell = r.read_rows<std::int32_t>("/st/face/shell", n);
  require_ids(r, "/st/face/shell", t.face_shell, t.n_shells, kNone);
  t.face_solid = r.read_rows<std::int32_t>("/st/face/solid", n);
  require_ids(r, "/st/face/solid", t.face_solid, t.n_solids, kNone);
}

std::vector<ImportFinding> read_findings(const Hdf5Reader& r) {
  const std::vector<std::string> what = r.read_strings("/st/finding/what");
  const std::size_t n = what.size();
  const std::vector<std::string> entity = r.read_string_rows("/st/finding/entity", n);
  const std::vector<Vec3> xyz = r.read_rows<Vec3>("/st/finding/xyz", n);
  const std::vector<double> size = r.read_rows<double>("/st/finding/size", n);
  const std::vector<std::uint8_t> is_repair = r.read_rows<std::uint8_t>("/st/finding/is_repair", n);
  std::vector<std::uint8_t> kind(n, static_cast<std::uint8_t>(FindingKind::kOther));
  std::vector<std::string> detail(n);
  if (r.has("/st/finding/kind")) {  // absent in older files
    kind = r.read_rows<std::uint8_t>("/st/finding/kind", n);
    detail = r.read_string_rows("/st/finding/detail", n);
  }
  std::vector<ImportFinding> findings;
  for (std::size_t i = 0; i < n; ++i) {
    findings.push_back({FindingKind::kOther, entity[i], xyz[i], size[i], is_repair[i] != 0});
    restore_kind(findings.back(), kind[i], detail[i], what[i]);
  }
  return findings;
}

void write_facets(Hdf5Writer& w, const FacetShape& f) {
  w.write("/st/facets/node_xyz", f.node_xyz);
  w.write("/st/facets/node_normal", f.node_normal);
  w.write("/st/facets/node_uv", f.node_uv);
  w.write("/st/facets/triangle_nodes", f.triangle_nodes);
  w.write("/st/facets/face_node_offsets", f.face_node_offsets);
  w.write("/st/facets/face_triangle_offsets", f.face_triangle_offsets);
  w.write("/st/facets/edge_xyz", f.edge_xyz);
  w.write("/st/facets/edge_point_offsets", f.edge_point_offsets);
  w.write("/st/facets/coedge_nodes", f.coedge_nodes);
  w.write("/st/facets/coedge_node_offsets", f.coedge_node_offsets);
  w.set_attribute("/st/facets", "version", std::int64_t{kFacetsVersion});
}

FacetShape read_facets(const Hdf5Reader& r) {
  if (const std::int64_t version = r.int_attribute("/st/facets", "version"); version > kFacetsVersion)
    r.fail("/st/facets@version", std::to_string(version) + " is newer than this version of ST reads");
  FacetShape f;
  f.node_xyz = r.read<Vec3>("/st/facets/node_xyz");
  const std::size_t n = f.node_xyz.size();
  f.node_normal = r.read_rows<Vec3>("/st/facets/node_normal", n);
  f.node_uv = r.read_rows<Vec2>("/st/facets/node_uv", n);
  f.triangle_nodes = r.read<Corners>("/st/facets/triangle_nodes");
  f.face_node_offsets = r.read<std::int32_t>("/st/facets/face_node_offsets");
  f.face_triangle_offsets = r.read<std::int32_t>("/st/facets/face_triangle_offsets");
  f.edge_xyz = r.read<Vec3>("/st/facets/edge_xyz");
  f.edge_point_offsets = r.read<std::int32_t>("/st/facets/edge_point_offsets");
  f.coedge_nodes = r.read<std::int32_t>("/st/facets/coedge_nodes");
  f.coedge_node_offsets = r.read<std::int32_t>("/st/facets/coedge_node_offsets");
  require_finite(r, "/st/facets/node_xyz", f.node_xyz);
  require_finite(r, "/st/facets/node_normal", f.node_normal);
  require_finite(r, "/st/facets/node_uv", f.node_uv);
  require_finite(r, "/st/facets/edge_xyz", f.edge_xyz);
  return f;
}

void write_mirror(Hdf5Writer& w, const Mirror& mirror) {
  if (mirror.empty()) return;
  w.write("/st/mirror/plane", std::vector<double>{static_cast<double>(mirror.axis), mirror.value});
  w.write("/st/mirror/vertex", mirror.vertex);
  w.write("/st/mirror/edge", mirror.edge);
  w.write("/st/mirror/face", mirror.face);
  w.write("/st/mirror/face_is_image", mirror.face_is_image);
}

/// An image's image is what it is the image of.
std::vector<std::int32_t> read_images(const Hdf5Reader& r, const std::string& name, std::size_t n) {
  const std::vector<std::int32_t> image = r.read_rows<std::int32_t>(name, n);
  require_ids(r, name, image, n);
  for (std::size_t i = 0; i < n; ++i)
    if (static_cast<std::size_t>(image[image[i]]) != i) r.fail(name, "row " + std::to_string(i) + " has no partner");
  return image;
}

Mirror read_mirror(const Hdf5Reader& r, const ModelTables& t) {
  const std::vector<double> plane = r.read_rows<double>("/st/mirror/plane", 2);
  if (plane[0] != 0 && plane[0] != 1 && plane[0] != 2) r.fail("/st/mirror/plane", "the axis is none of 0, 1, 2");
  require_finite(r, "/st/mirror/plane", plane);
  const auto n = [](std::int32_t number) { return static_cast<std::size_t>(number); };
  Mirror mirror{static_cast<int>(plane[0]),
                plane[1],
                read_images(r, "/st/mirror/vertex", n(t.n_vertices())),
                read_images(r, "/st/mirror/edge", n(t.n_edges())),
                read_images(r, "/st/mirror/face", n(t.n_faces())),
                r.read_rows<std::uint8_t>("/st/mirror/face_is_image", n(t.n_faces()))};
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (mirror.face_is_image[f] + mirror.face_is_image[mirror.face[f]] != (mirror.face[f] == f ? 0 : 1))
      r.fail("/st/mirror/face_is_image", "row " + std::to_string(f) + " contradicts its partner's");
  return mirror;
}

/// Tables become those in which the composites are faces.
void join_faces(const Hdf5Reader& r, GeometryArtifact& geometry) {
  const Composites& c = geometry.composites = read_composites(r);
  if (const std::string what = c.contradiction(geometry.tables); !what.empty())
    r.fail("/st/composites", "the " + what + " contradict the tables");
  geometry.cad = std::exchange(geometry.tables, join_tables(geometry.tables, c).tables);
}

}  // namespace

std::string write_geometry(const std::string& path, const GeometryArtifact& geometry) {
  const ModelTables& t = geometry.composites.empty() ? geometry.tables : geometry.cad;
  ArtifactHeader header = geometry.header;
  header.schema = "geometry";
  header.schema_version = geometry.composites.empty() ? kPlainGeometryVersion : kGeometryVersion;
  header.unit = t.unit;
  header.unit_in_m = t.unit_in_m;
  Hdf5Writer w(path, header);
  write_vertices_and_edges(w, t);
  write_faces(w, t);
  write_findings(w, geometry.findings);
  if (!geometry.previous_faces.empty()) w.write(kPreviousFaces, geometry.previous_faces, 2);
  if (!geometry.previous_edges.empty()) {
    w.write(kPreviousEdges, geometry.previous_edges, 2);
    w.write(kPreviousVertices, geometry.previous_vertices, 2);
  }
  write_composites(w, geometry.composites);
  write_mirror(w, geometry.mirror);
  if (geometry.facets.empty())
    w.write("/st/brep", geometry.brep);
  else
    write_facets(w, geometry.facets);
  w.set_attribute("/st", "n_shells", std::int64_t{t.n_shells});
  w.set_attribute("/st", "n_solids", std::int64_t{t.n_solids});
  if (t.volume) w.write("/st/volume", std::vector<double>{*t.volume});
  w.set_attribute("/st", "is_closed", std::int64_t{geometry.is_closed});
  return w.commit();
}

GeometryArtifact read_geometry(const std::string& path) {
  const Hdf5Reader r(path, "geometry", kGeometryVersion);
  GeometryArtifact geometry;
  geometry.header = r.header();
  read_vertices_and_edges(r, geometry.tables);
  read_faces(r, geometry.tables);
  geometry.tables.unit = r.header().unit;
  geometry.tables.unit_in_m = r.header().unit_in_m;
  if (r.has("/st/volume")) geometry.tables.volume = r.read_rows<double>("/st/volume", 1)[0];
  geometry.findings = read_findings(r);
  const bool is_imported = !r.header().inputs.empty() && r.header().inputs[0].role == "cad";
  if (r.has(kPreviousFaces))
    geometry.previous_faces = read_previous(r, kPreviousFaces, geometry.tables.face_type.size(), is_imported);
  if (r.has(kPreviousFaces) && !is_imported) {
    geometry.previous_edges = read_previous(r, kPreviousEdges, geometry.tables.edge_length.size());
    geometry.previous_vertices = read_previous(r, kPreviousVertices, geometry.tables.vertex_xyz.size());
  }
  if (r.has("/st/facets/node_xyz"))
    geometry.facets = read_facets(r);
  else
    geometry.brep = r.read<std::byte>("/st/brep");
  if (r.has("/st/mirror/plane")) geometry.mirror = read_mirror(r, geometry.tables);
  geometry.is_closed = r.int_attribute("/st", "is_closed") != 0;
  if (has_composites(r)) join_faces(r, geometry);
  return geometry;
}

}  // namespace st
