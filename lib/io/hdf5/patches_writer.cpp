#include "io/hdf5/patches_writer.h"

#include <algorithm>
#include <functional>
#include <span>

#include "base/assert.h"
#include "base/threads.h"
#include "io/hdf5/composites_io.h"
#include "io/hdf5/face_labels_io.h"
#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/merged_features.h"

namespace st {
namespace {

void write_rest(Hdf5Writer& w, const PatchesArtifact& a) {
  w.write("/st/vertex/xyz", a.vertex_xyz);
  w.write("/st/edge/vertices", a.edge_vertices, 2);
  w.write("/st/edge/node_offsets", a.edges.edge_offsets);
  w.write("/st/edge_node/t", a.edges.node_t);
  w.write("/st/edge_node/xyz", a.edges.node_xyz);
  w.write("/st/edge_node/size", a.edges.node_size);
  if (!a.edges.node_request.empty()) w.write("/st/edge_node/request", a.edges.node_request);
  w.write_strings("/st/face/name", a.labels.face_name);
  w.write("/st/face/group", a.labels.face_group);
  w.write("/st/face/shell", a.face_shell);
  w.write("/st/face/area", a.face_area);
  w.write_strings("/st/group/name", a.labels.group_name);
  if (!a.labels.group_role.empty()) w.write_strings("/st/group/role", a.labels.group_role);
  write_labels(w, a.labels);
  write_composites(w, a.composites);
}

/// One value of each failure.
template <class T, class Field>
std::vector<T> column(const std::vector<FaceFailure>& failures, Field FaceFailure::*field) {
  std::vector<T> values;
  for (const FaceFailure& f : failures) values.push_back(f.*field);
  return values;
}

void write_failures(Hdf5Writer& w, const std::vector<FaceFailure>& failures) {
  w.write("/st/failure/face", column<std::int32_t>(failures, &FaceFailure::face));
  w.write_strings("/st/failure/cause", column<std::string>(failures, &FaceFailure::cause));
  w.write_strings("/st/failure/remedy", column<std::string>(failures, &FaceFailure::remedy));
  w.write("/st/failure/xyz", column<Vec3>(failures, &FaceFailure::xyz));
  // of faces that were closed from their loops; absent when none was
  const auto is_closed = column<std::uint8_t>(failures, &FaceFailure::is_closed);
  if (std::find(is_closed.begin(), is_closed.end(), 1) == is_closed.end()) return;
  w.write("/st/failure/is_closed", is_closed);
  w.write("/st/failure/is_near", column<std::uint8_t>(failures, &FaceFailure::is_near));
  w.write("/st/failure/deviation", column<double>(failures, &FaceFailure::deviation));
}

PatchTarget target_of(const std::vector<PatchCounts>& counts) {
  PatchTarget t;
  t.boundary = t.inner = t.triangle = t.own_uv = {0};
  for (const PatchCounts& c : counts) {
    t.face.push_back(c.face);
    t.boundary.push_back(t.boundary.back() + c.n_boundary);
    t.inner.push_back(t.inner.back() + c.n_inner);
    t.triangle.push_back(t.triangle.back() + c.n_triangles);
    t.own_uv.push_back(t.own_uv.back() + c.n_own_uv);
  }
  return t;
}

/// Room for one array of all patches; where it begins goes to the target.
template <class T>
void make_room(Hdf5Writer& w, const std::string& name, const std::vector<std::int64_t>& offsets, PatchTarget& t) {
  t.begin.push_back(w.rows_elsewhere(w.begin_rows<T>(name, static_cast<std::size_t>(offsets.back()))));
}

void make_room(Hdf5Writer& w, const EdgeMesh& edges, PatchTarget& t) {
  w.write("/st/patch/face", t.face);
  w.write("/st/patch/boundary_offsets", t.boundary);
  w.write("/st/patch/inner_offsets", t.inner);
  w.write("/st/patch/triangle_offsets", t.triangle);
  w.write("/st/patch/corner_offsets", t.own_uv);
  make_room<std::uint8_t>(w, "/st/boundary/dim", t.boundary, t);
  make_room<std::int32_t>(w, "/st/boundary/entity", t.boundary, t);
  make_room<std::int32_t>(w, "/st/boundary/index", t.boundary, t);
  make_room<Vec3>(w, "/st/inner/xyz", t.inner, t);
  make_room<Vec2>(w, "/st/inner/uv", t.inner, t);
  make_room<double>(w, "/st/inner/size", t.inner, t);
  make_room<Triangle>(w, "/st/triangle/nodes", t.triangle, t);
  make_room<std::int32_t>(w, "/st/corner/number", t.own_uv, t);
  make_room<Vec2>(w, "/st/corner/uv", t.own_uv, t);
  if (edges.node_previous.empty()) return;
  w.write("/st/edge_node/previous_id", edges.node_previous);
  make_room<NodeId>(w, "/st/inner/previous_id", t.inner, t);
  make_room<TriangleId>(w, "/st/triangle/previous_id", t.triangle, t);
}

}  // namespace

PatchCounts counts_of(const FacePatch& p) {
  const auto count = [](const auto& rows) { return static_cast<std::int64_t>(rows.size()); };
  return {p.face, count(p.boundary_dim), count(p.inner_xyz), count(p.triangles), count(p.uv_corner)};
}

PatchesWriter::PatchesWriter(const std::string& path, const PatchesArtifact& a, const std::vector<PatchCounts>& counts)
    : target_(target_of(counts)) {
  ArtifactHeader header = a.header;
  header.schema = "patches";
  header.schema_version = kPatchesVersion;
  writer_ = std::make_unique<Hdf5Writer>(path, header);
  target_.file = writer_->temporary_name();
  target_.label = path;
  write_rest(*writer_, a);
  make_room(*writer_, a.edges, target_);
  write_failures(*writer_, a.failures);
  write_merged(*writer_, a.merged);
  writer_->set_attribute("/st", "is_complete", std::int64_t{a.is_complete});
}

PatchesWriter::~PatchesWriter() = default;

std::string PatchesWriter::commit() { return writer_->commit(); }

void PatchRowsFile::write(std::size_t i, const FacePatch& p, const PatchPlace& place) const {
  constexpr std::size_t kPerJob = std::size_t{4} << 20;
  ST_ASSERT(target_.face.at(i) == p.face);
  std::vector<std::function<void()>> jobs;
  std::size_t array = 0;
  const auto rows = [&]<class T>(const std::vector<T>& values, const std::vector<std::int64_t>& offsets,
                                 std::int64_t first) {
    ST_ASSERT(first + static_cast<std::int64_t>(values.size()) <= offsets[i + 1] - offsets[i]);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    const std::uint64_t begin = target_.begin[array++] + static_cast<std::uint64_t>(offsets[i] + first) * sizeof(T);
    for (std::size_t at = 0; at < bytes.size(); at += kPerJob)
      jobs.emplace_back(
          [this, face = p.face, to = begin + at, some = bytes.subspan(at, std::min(kPerJob, bytes.size() - at))] {
            file_.write(to, some, "the patch of face " + std::to_string(face + 1));
          });
  };
  rows(p.boundary_dim, target_.boundary, 0);
  rows(p.boundary_entity, target_.boundary, 0);
  rows(p.boundary_index, target_.boundary, 0);
  rows(p.inner_xyz, target_.inner, place.inner_begin);
  rows(p.inner_uv, target_.inner, place.inner_begin);
  rows(p.inner_size, target_.inner, place.inner_begin);
  rows(p.triangles, target_.triangle, place.triangle_begin);
  rows(p.uv_corner, target_.own_uv, place.own_uv_begin);
  rows(p.own_uv, target_.own_uv, place.own_uv_begin);
  if (target_.begin.size() == PatchTarget::kArrays) {
    rows(p.inner_previous, target_.inner, place.inner_begin);
    rows(p.triangle_previous, target_.triangle, place.triangle_begin);
  }
  run_jobs(jobs);
}

}  // namespace st
