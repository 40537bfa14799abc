// patches.hdf: docs/artifacts.md
#include "base/threads.h"
#include "geometry/model/cad_places.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/composites_io.h"
#include "io/hdf5/face_labels_io.h"
#include "io/hdf5/merged_features.h"
#include "io/hdf5/patches_file.h"
#include "io/hdf5/patches_writer.h"
#include "mesh/corner_uv.h"

namespace st {
namespace {

/// Offsets of one kind of rows of the patches; `array` is one that they point into.
std::vector<std::int64_t> read_offsets(const Hdf5Reader& r, const std::string& name, std::size_t n_patches,
                                       const std::string& array) {
  std::vector<std::int64_t> offsets = r.read_rows<std::int64_t>(name, n_patches + 1);
  require_offsets(r, name, offsets, r.info(array).shape[0]);
  return offsets;
}

std::string label_of(const FacePatch& p) { return "patch of face " + std::to_string(p.face + 1); }

void require_nodes(const Hdf5Reader& r, const FacePatch& p, std::int64_t n_inner) {
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n)
      if (n < 0 || n >= p.n_boundary + n_inner)
        r.fail("/st/triangle/nodes", label_of(p) + " has no node " + std::to_string(n));
}

/// Triangles name nodes of their patch, boundary nodes entities of the model.
void require_consistent(const Hdf5Reader& r, const FacePatch& p, const PatchesArtifact& a) {
  const std::string label = label_of(p);
  require_nodes(r, p, static_cast<std::int64_t>(p.inner_xyz.size()));
  for (std::int32_t i = 0; i < p.n_boundary; ++i) {
    const std::int64_t entity = p.boundary_entity[i], index = p.boundary_index[i];
    if (p.boundary_dim[i] == 0) {
      if (entity < 0 || entity >= static_cast<std::int64_t>(a.vertex_xyz.size()))
        r.fail("/st/boundary/entity", label + ": no vertex " + std::to_string(entity + 1));
    } else {
      if (entity < 0 || static_cast<std::size_t>(entity) >= a.edges.edge_offsets.size() - 1)
        r.fail("/st/boundary/entity", label + ": no edge " + std::to_string(entity + 1));
      if (index < 0 || index >= a.edges.edge_offsets[entity + 1] - a.edges.edge_offsets[entity])
        r.fail("/st/boundary/index",
               label + ": no node " + std::to_string(index) + " on edge " + std::to_string(entity + 1));
    }
  }
}

void require_corners(const Hdf5Reader& r, const FacePatch& p) {
  if (!has_all_uv(p))
    r.fail("/st/corner/number", label_of(p) + ": these are not the corners on its boundary, in order");
}

void read_closed(const Hdf5Reader& r, std::vector<FaceFailure>& failures) {
  if (!r.has("/st/failure/is_closed")) return;
  const auto is_closed = r.read_rows<std::uint8_t>("/st/failure/is_closed", failures.size());
  const auto is_near = r.read_rows<std::uint8_t>("/st/failure/is_near", failures.size());
  const auto deviation = r.read_rows<double>("/st/failure/deviation", failures.size());
  require_finite(r, "/st/failure/deviation", deviation);
  for (std::size_t i = 0; i < failures.size(); ++i) {
    failures[i].is_closed = is_closed[i] != 0;
    failures[i].is_near = is_near[i] != 0;
    failures[i].deviation = deviation[i];
  }
}

std::vector<FaceFailure> read_failures(const Hdf5Reader& r, std::size_t n_faces) {
  const std::vector<std::int32_t> face = r.read<std::int32_t>("/st/failure/face");
  const std::vector<std::string> cause = r.read_string_rows("/st/failure/cause", face.size());
  const std::vector<std::string> remedy = r.read_string_rows("/st/failure/remedy", face.size());
  const std::vector<Vec3> xyz = r.read_rows<Vec3>("/st/failure/xyz", face.size());
  require_ids(r, "/st/failure/face", face, n_faces);
  std::vector<FaceFailure> failures;
  for (std::size_t i = 0; i < face.size(); ++i) failures.push_back({face[i], cause[i], remedy[i], xyz[i]});
  read_closed(r, failures);
  return failures;
}

void read_edges(const Hdf5Reader& r, PatchesArtifact& a) {
  const ReadColumns read{r};
  read("/st/vertex/xyz", a.vertex_xyz, {}, kFinite);
  read("/st/edge/vertices", a.edge_vertices, {Rows::kAny, 2}, ids_below(a.vertex_xyz.size()));
  EdgeMesh& e = a.edges;
  read("/st/edge_node/t", e.node_t, {}, kFinite);
  const std::size_t n = e.node_t.size();
  read("/st/edge_node/xyz", e.node_xyz, {n}, kFinite);
  read("/st/edge_node/size", e.node_size, {n}, kLengths);
  if (r.has("/st/edge_node/request")) read("/st/edge_node/request", e.node_request, {n}, kLengths);
  if (r.has("/st/edge_node/previous_id")) read("/st/edge_node/previous_id", e.node_previous, {n});
  read("/st/edge/node_offsets", e.edge_offsets, {a.edge_vertices.size() / 2 + 1}, offsets_into(n));
}

void read_faces(const Hdf5Reader& r, PatchesArtifact& a) {
  a.face_shell = r.read<std::int32_t>("/st/face/shell");
  a.face_area = r.read_rows<double>("/st/face/area", a.face_shell.size());
  a.labels = read_labels(r, a.face_shell.size());
  if (!has_composites(r)) return;
  a.composites = read_composites(r);
  if (!has_sound_charts(a.composites, static_cast<FaceId>(a.face_shell.size())))
    r.fail("/st/composites", "these faces contradict the patches");
}

void read_rest(const Hdf5Reader& r, PatchesArtifact& a) {
  a.header = r.header();
  read_edges(r, a);
  read_faces(r, a);
  a.failures = read_failures(r, a.face_shell.size());
  a.merged = read_merged(r, a.edges.edge_offsets.size() - 1, a.labels.face_group.size());
  a.is_complete = r.int_attribute("/st", "is_complete") != 0;
}

}  // namespace

std::string write_patches(const std::string& path, const PatchesArtifact& a) {
  std::vector<PatchCounts> counts;
  for (const FacePatch& p : a.patches) counts.push_back(counts_of(p));
  PatchesWriter writer(path, a, counts);
  PatchRowsFile rows(writer.target());
  parallel_for(a.patches.size(), 1, [&](std::size_t i, std::size_t) { rows.write(i, a.patches[i]); });
  rows.close();
  return writer.commit();
}

PatchesArtifact read_patches(const std::string& path) {
  PatchesFile file(path);
  std::vector<FacePatch> patches;
  for (std::size_t i = 0; i < file.n_patches(); ++i) patches.push_back(file.whole(i));
  PatchesArtifact a = std::move(file.rest());
  a.patches = std::move(patches);
  return a;
}

PatchesFile::PatchesFile(const std::string& path)
    : reader_(path, "patches", kPatchesVersion), row_reader_(path, reader_) {
  const Hdf5Reader& r = reader_;
  require_version(r, kPatchesVersion, "st-mesh");
  read_rest(r, rest_);
  face_ = r.read<std::int32_t>("/st/patch/face");
  require_ids(r, "/st/patch/face", face_, rest_.labels.face_group.size());
  boundary_ = read_offsets(r, "/st/patch/boundary_offsets", face_.size(), "/st/boundary/dim");
  inner_ = read_offsets(r, "/st/patch/inner_offsets", face_.size(), "/st/inner/xyz");
  triangle_ = read_offsets(r, "/st/patch/triangle_offsets", face_.size(), "/st/triangle/nodes");
  own_uv_ = read_offsets(r, "/st/patch/corner_offsets", face_.size(), "/st/corner/number");
  find_rows();
}

void PatchesFile::find_rows() {
  std::vector<std::string> names;
  const auto find = [&]<class T>(const char* name, std::int64_t n_rows, T) {
    RowPlace place = row_reader_.find<T>(name);
    if (place.n_rows != static_cast<std::size_t>(n_rows))
      reader_.fail(name, "has " + std::to_string(place.n_rows) + " rows, not " + std::to_string(n_rows));
    names.emplace_back(name);
    return place;
  };
  const std::int64_t n_boundary = boundary_.back(), n_inner = inner_.back(), n_triangles = triangle_.back();
  rows_.boundary_dim = find("/st/boundary/dim", n_boundary, std::uint8_t());
  rows_.boundary_entity = find("/st/boundary/entity", n_boundary, std::int32_t());
  rows_.boundary_index = find("/st/boundary/index", n_boundary, std::int32_t());
  rows_.inner_xyz = find("/st/inner/xyz", n_inner, Vec3());
  rows_.inner_uv = find("/st/inner/uv", n_inner, Vec2());
  rows_.inner_size = find("/st/inner/size", n_inner, double());
  rows_.nodes = find("/st/triangle/nodes", n_triangles, Triangle());
  rows_.uv_corner = find("/st/corner/number", own_uv_.back(), std::int32_t());
  rows_.own_uv = find("/st/corner/uv", own_uv_.back(), Vec2());
  if (!rest_.edges.node_previous.empty()) {
    rows_.inner_previous = find("/st/inner/previous_id", n_inner, NodeId());
    rows_.triangle_previous = find("/st/triangle/previous_id", n_triangles, TriangleId());
  }
  row_reader_.verify(names);
}

FacePatch PatchesFile::boundary(std::size_t patch) const {
  const std::int64_t begin = boundary_[patch], n = boundary_[patch + 1] - begin;
  FacePatch p;
  p.face = face_[patch];
  p.n_boundary = static_cast<std::int32_t>(n);
  p.boundary_dim = row_reader_.read<std::uint8_t>(rows_.boundary_dim, begin, n);
  p.boundary_entity = row_reader_.read<std::int32_t>(rows_.boundary_entity, begin, n);
  p.boundary_index = row_reader_.read<std::int32_t>(rows_.boundary_index, begin, n);
  return p;
}

FacePatch PatchesFile::shape(std::size_t patch) const {
  FacePatch p = boundary(patch);
  p.inner_xyz = row_reader_.read<Vec3>(rows_.inner_xyz, inner_begin(patch), n_inner(patch));
  p.triangles = row_reader_.read<Triangle>(rows_.nodes, triangle_begin(patch), n_triangles(patch));
  require_finite(reader_, rows_.inner_xyz.name, p.inner_xyz);
  require_consistent(reader_, p, rest_);
  return p;
}

FacePatch PatchesFile::corners(std::size_t patch) const {
  const std::int64_t begin = own_uv_[patch], n = own_uv_[patch + 1] - begin, n_inside = n_inner(patch);
  FacePatch p;
  p.face = face_[patch];
  p.n_boundary = static_cast<std::int32_t>(boundary_[patch + 1] - boundary_[patch]);
  p.inner_uv = row_reader_.read<Vec2>(rows_.inner_uv, inner_begin(patch), n_inside);
  p.triangles = row_reader_.read<Triangle>(rows_.nodes, triangle_begin(patch), n_triangles(patch));
  p.uv_corner = row_reader_.read<std::int32_t>(rows_.uv_corner, begin, n);
  p.own_uv = row_reader_.read<Vec2>(rows_.own_uv, begin, n);
  require_finite(reader_, rows_.inner_uv.name, p.inner_uv);
  require_finite(reader_, rows_.own_uv.name, p.own_uv);
  require_nodes(reader_, p, n_inside);
  require_corners(reader_, p);
  return p;
}

FacePatch PatchesFile::whole(std::size_t patch) const {
  FacePatch p = shape(patch), with_corners = corners(patch);
  p.inner_uv = std::move(with_corners.inner_uv);
  p.uv_corner = std::move(with_corners.uv_corner);
  p.own_uv = std::move(with_corners.own_uv);
  p.inner_size = row_reader_.read<double>(rows_.inner_size, inner_begin(patch), n_inner(patch));
  require_finite(reader_, rows_.inner_size.name, p.inner_size);
  if (rest_.edges.node_previous.empty()) return p;  // nothing was remeshed
  p.inner_previous = row_reader_.read<NodeId>(rows_.inner_previous, inner_begin(patch), n_inner(patch));
  p.triangle_previous =
      row_reader_.read<TriangleId>(rows_.triangle_previous, triangle_begin(patch), n_triangles(patch));
  return p;
}

}  // namespace st
