// geometry.hdf: docs/artifacts.md
#include <cmath>
#include <utility>

#include "geometry/model/joined_tables.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/composites_io.h"
#include "io/hdf5/face_labels_io.h"

namespace st {
namespace {

constexpr int kFacetsVersion = 1;         // of the group /st/facets
constexpr int kPlainGeometryVersion = 1;  // without composites, which older tools would take for faces of the CAD

/// `Tables`: ModelTables, constant where `io` writes.
template <class Io, class Tables>
void visit_vertices_and_edges(const Io& io, Tables& t) {
  io("/st/vertex/xyz", t.vertex_xyz, {}, kFinite);
  io("/st/vertex/tolerance", t.vertex_tolerance, {t.vertex_xyz.size()}, kLengths);
  io("/st/edge/length", t.edge_length, {}, kLengths);
  const std::size_t n = t.edge_length.size();
  io("/st/edge/vertices", t.edge_vertices, {n, 2}, ids_below(t.vertex_xyz.size()));
  io("/st/edge/range", t.edge_range, {n, 2}, kRanges);
  io("/st/edge/tolerance", t.edge_tolerance, {n}, kLengths);
  io("/st/edge/is_degenerate", t.edge_is_degenerate, {n});
  io("/st/edge/name", t.edge_name, {n});
}

template <class Io, class Tables>
void visit_faces(const Io& io, Tables& t) {
  io("/st/face/is_reversed", t.face_is_reversed);
  const std::size_t n = t.face_is_reversed.size();
  io("/st/coedge/edge", t.coedge_edge, {}, ids_below(t.edge_length.size()));
  io("/st/coedge/is_reversed", t.coedge_is_reversed, {t.coedge_edge.size()});
  io("/st/loop/coedge_offsets", t.loop_coedge_offsets, {}, offsets_into(t.coedge_edge.size()));
  io("/st/face/loop_offsets", t.face_loop_offsets, {n + 1}, offsets_into(t.loop_coedge_offsets.size() - 1));
  io("/st/face/type", t.face_type, {n});
  io("/st/face/uv_bounds", t.face_uv_bounds, {n, 4}, kRanges);
  io("/st/face/tolerance", t.face_tolerance, {n}, kLengths);
  io("/st/face/area", t.face_area, {n}, kFinite);
  io("/st/face/box", t.face_box, {n}, kFinite);
  io("/st/face/color", t.face_color, {n});
  io("/st/face/layer", t.face_layer, {n});
  io("/st/face/shell", t.face_shell, {n}, ids_below(t.n_shells, kNone));
  io("/st/face/solid", t.face_solid, {n}, ids_below(t.n_solids, kNone));
}

/// A number of shells or solids. Each has a face, which may be that of another, too: a ball in a ball has three shells.
std::int32_t read_count(const Hdf5Reader& r, const std::string& name) {
  const std::int64_t n = r.int_attribute("/st", name);
  const std::size_t n_faces = r.info("/st/face/is_reversed").shape[0];
  if (n < 0 || static_cast<std::uint64_t>(n) > 2 * n_faces)
    r.fail("/st@" + name, std::to_string(n) + " is not possible with " + std::to_string(n_faces) + " faces");
  return static_cast<std::int32_t>(n);
}

void read_faces(const Hdf5Reader& r, ModelTables& t) {
  t.n_shells = read_count(r, "n_shells");
  t.n_solids = read_count(r, "n_solids");
  visit_faces(ReadColumns{r}, t);
  const std::size_t n = t.face_area.size();
  if (r.has("/st/face/width"))
    ReadColumns{r}("/st/face/width", t.face_width, {n}, kLengths);
  else  // written before widths were: as wide as long
    for (double area : t.face_area) t.face_width.push_back(std::sqrt(area));
  t.labels = read_labels(r, n);
  for (const EntityGroup& g : t.labels.edge_groups) require_ids(r, "/st/edge_group/ids", g.ids, t.edge_length.size());
  for (const EntityGroup& g : t.labels.vertex_groups)
    require_ids(r, "/st/vertex_group/ids", g.ids, t.vertex_xyz.size());
}

void write_faces(Hdf5Writer& w, const ModelTables& t) {
  visit_faces(WrittenColumns{w}, t);
  w.write("/st/face/width", t.face_width);
  w.write_strings("/st/face/name", t.labels.face_name);
  w.write("/st/face/group", t.labels.face_group);
  w.write_strings("/st/group/name", t.labels.group_name);
  w.write_strings("/st/group/role", t.labels.group_role);
  write_labels(w, t.labels);
  w.set_attribute("/st", "n_shells", std::int64_t{t.n_shells});
  w.set_attribute("/st", "n_solids", std::int64_t{t.n_solids});
}

/// Findings by column.
struct FindingColumns {
  std::vector<std::string> what, detail, entity;
  std::vector<Vec3> xyz;
  std::vector<double> size;
  std::vector<std::uint8_t> kind, is_repair;

  template <class Io, class Columns>
  static void visit(const Io& io, Columns& c) {
    io("/st/finding/what", c.what);
    io("/st/finding/entity", c.entity, {c.what.size()});
    io("/st/finding/xyz", c.xyz, {c.what.size()});
    io("/st/finding/size", c.size, {c.what.size()});
    io("/st/finding/is_repair", c.is_repair, {c.what.size()});
  }
  /// Absent in older files.
  template <class Io, class Columns>
  static void visit_kinds(const Io& io, Columns& c) {
    io("/st/finding/kind", c.kind, {c.what.size()});
    io("/st/finding/detail", c.detail, {c.what.size()});
  }
};

void write_findings(Hdf5Writer& w, const std::vector<ImportFinding>& findings) {
  FindingColumns c;
  for (const ImportFinding& f : findings) {
    c.what.push_back(f.what());
    c.kind.push_back(static_cast<std::uint8_t>(f.kind));
    c.detail.push_back(f.detail);
    c.entity.push_back(f.entity);
    c.xyz.push_back(f.xyz);
    c.size.push_back(f.size);
    c.is_repair.push_back(f.is_repair);
  }
  FindingColumns::visit(WrittenColumns{w}, c);
  FindingColumns::visit_kinds(WrittenColumns{w}, c);
}

std::vector<ImportFinding> read_findings(const Hdf5Reader& r) {
  FindingColumns c;
  FindingColumns::visit(ReadColumns{r}, c);
  c.kind.assign(c.what.size(), static_cast<std::uint8_t>(FindingKind::kOther));
  c.detail.resize(c.what.size());
  if (r.has("/st/finding/kind")) FindingColumns::visit_kinds(ReadColumns{r}, c);
  std::vector<ImportFinding> findings;
  for (std::size_t i = 0; i < c.what.size(); ++i) {
    findings.push_back({FindingKind::kOther, c.entity[i], c.xyz[i], c.size[i], c.is_repair[i] != 0});
    restore_kind(findings.back(), c.kind[i], c.detail[i], c.what[i]);
  }
  return findings;
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

template <class Io, class Facets>
void visit_facets(const Io& io, Facets& f) {
  io("/st/facets/node_xyz", f.node_xyz, {}, kFinite);
  io("/st/facets/node_normal", f.node_normal, {f.node_xyz.size()}, kFinite);
  io("/st/facets/node_uv", f.node_uv, {f.node_xyz.size()}, kFinite);
  io("/st/facets/triangle_nodes", f.triangle_nodes);
  io("/st/facets/face_node_offsets", f.face_node_offsets);
  io("/st/facets/face_triangle_offsets", f.face_triangle_offsets);
  io("/st/facets/edge_xyz", f.edge_xyz, {}, kFinite);
  io("/st/facets/edge_point_offsets", f.edge_point_offsets);
  io("/st/facets/coedge_nodes", f.coedge_nodes);
  io("/st/facets/coedge_node_offsets", f.coedge_node_offsets);
}

void write_facets(Hdf5Writer& w, const FacetShape& f) {
  visit_facets(WrittenColumns{w}, f);
  w.set_attribute("/st/facets", "version", std::int64_t{kFacetsVersion});
}

FacetShape read_facets(const Hdf5Reader& r) {
  if (const std::int64_t version = r.int_attribute("/st/facets", "version"); version > kFacetsVersion)
    r.fail("/st/facets@version", std::to_string(version) + " is newer than this version of ST reads");
  FacetShape f;
  visit_facets(ReadColumns{r}, f);
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
  visit_vertices_and_edges(WrittenColumns{w}, t);
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
  if (t.volume) w.write("/st/volume", std::vector<double>{*t.volume});
  w.set_attribute("/st", "is_closed", std::int64_t{geometry.is_closed});
  return w.commit();
}

GeometryArtifact read_geometry(const std::string& path) {
  const Hdf5Reader r(path, "geometry", kGeometryVersion);
  GeometryArtifact geometry;
  geometry.header = r.header();
  visit_vertices_and_edges(ReadColumns{r}, geometry.tables);
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
