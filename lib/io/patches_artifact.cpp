// patches.hdf: docs/artifacts.md
#include <limits>

#include "io/artifact_checks.h"

namespace st {
namespace {

template <class T>
void append(std::vector<T>& all, const std::vector<T>& part) {
  all.insert(all.end(), part.begin(), part.end());
}

template <class T>
std::vector<T> slice(const std::vector<T>& all, std::int64_t begin, std::int64_t end) {
  return {all.begin() + begin, all.begin() + end};
}

/// All patches behind one another, with offsets.
struct FlatPatches {
  std::vector<std::int32_t> face;
  std::vector<std::int64_t> boundary_offsets = {0}, inner_offsets = {0}, triangle_offsets = {0};  ///< [n_patches+1]
  FacePatch all;                                                                                  ///< arrays of all patches concatenated
};

FlatPatches flatten(const std::vector<FacePatch>& patches) {
  FlatPatches flat;
  for (const FacePatch& p : patches) {
    flat.face.push_back(p.face);
    append(flat.all.boundary_dim, p.boundary_dim);
    append(flat.all.boundary_entity, p.boundary_entity);
    append(flat.all.boundary_index, p.boundary_index);
    append(flat.all.inner_xyz, p.inner_xyz);
    append(flat.all.inner_uv, p.inner_uv);
    append(flat.all.inner_size, p.inner_size);
    append(flat.all.triangles, p.triangles);
    append(flat.all.corner_uv, p.corner_uv);
    flat.boundary_offsets.push_back(static_cast<std::int64_t>(flat.all.boundary_dim.size()));
    flat.inner_offsets.push_back(static_cast<std::int64_t>(flat.all.inner_xyz.size()));
    flat.triangle_offsets.push_back(static_cast<std::int64_t>(flat.all.triangles.size()));
  }
  return flat;
}

void write_patch_arrays(Hdf5Writer& w, const std::vector<FacePatch>& patches) {
  const FlatPatches flat = flatten(patches);
  w.write("/st/patch/face", flat.face);
  w.write("/st/patch/boundary_offsets", flat.boundary_offsets);
  w.write("/st/patch/inner_offsets", flat.inner_offsets);
  w.write("/st/patch/triangle_offsets", flat.triangle_offsets);
  w.write("/st/boundary/dim", flat.all.boundary_dim);
  w.write("/st/boundary/entity", flat.all.boundary_entity);
  w.write("/st/boundary/index", flat.all.boundary_index);
  w.write("/st/inner/xyz", flat.all.inner_xyz);
  w.write("/st/inner/uv", flat.all.inner_uv);
  w.write("/st/inner/size", flat.all.inner_size);
  w.write("/st/triangle/nodes", flat.all.triangles);
  w.write("/st/triangle/corner_uv", flat.all.corner_uv);
}

FlatPatches read_flat(const Hdf5Reader& r) {
  FlatPatches flat;
  flat.face = r.read<std::int32_t>("/st/patch/face");
  const std::size_t n = flat.face.size();
  flat.boundary_offsets = r.read_rows<std::int64_t>("/st/patch/boundary_offsets", n + 1);
  flat.inner_offsets = r.read_rows<std::int64_t>("/st/patch/inner_offsets", n + 1);
  flat.triangle_offsets = r.read_rows<std::int64_t>("/st/patch/triangle_offsets", n + 1);
  FacePatch& all = flat.all;
  all.boundary_dim = r.read<std::uint8_t>("/st/boundary/dim");
  all.boundary_entity = r.read_rows<std::int32_t>("/st/boundary/entity", all.boundary_dim.size());
  all.boundary_index = r.read_rows<std::int32_t>("/st/boundary/index", all.boundary_dim.size());
  all.inner_xyz = r.read<Vec3>("/st/inner/xyz");
  all.inner_uv = r.read_rows<Vec2>("/st/inner/uv", all.inner_xyz.size());
  all.inner_size = r.read_rows<double>("/st/inner/size", all.inner_xyz.size());
  all.triangles = r.read<Triangle>("/st/triangle/nodes");
  all.corner_uv = r.read_rows<Vec2>("/st/triangle/corner_uv", 3 * all.triangles.size());
  require_offsets(r, "/st/patch/boundary_offsets", flat.boundary_offsets, all.boundary_dim.size());
  require_offsets(r, "/st/patch/inner_offsets", flat.inner_offsets, all.inner_xyz.size());
  require_offsets(r, "/st/patch/triangle_offsets", flat.triangle_offsets, all.triangles.size());
  return flat;
}

/// Triangles name nodes of their patch, boundary nodes entities of the model.
void require_consistent(const Hdf5Reader& r, const FacePatch& p, const PatchesArtifact& a) {
  const std::int64_t n_nodes = p.n_boundary + static_cast<std::int64_t>(p.inner_xyz.size());
  const std::string label = "patch of face " + std::to_string(p.face + 1);
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n)
      if (n < 0 || n >= n_nodes) r.fail("/st/triangle/nodes", label + " has no node " + std::to_string(n));
  for (std::int32_t i = 0; i < p.n_boundary; ++i) {
    const std::int32_t entity = p.boundary_entity[i], index = p.boundary_index[i];
    if (p.boundary_dim[i] == 0) {
      if (entity < 0 || entity >= static_cast<std::int64_t>(a.vertex_xyz.size()))
        r.fail("/st/boundary/entity", label + ": no vertex " + std::to_string(entity + 1));
    } else {
      if (entity < 0 || entity + 1 >= static_cast<std::int64_t>(a.edges.edge_offsets.size()))
        r.fail("/st/boundary/entity", label + ": no edge " + std::to_string(entity + 1));
      if (index < 0 || index >= a.edges.edge_offsets[entity + 1] - a.edges.edge_offsets[entity])
        r.fail("/st/boundary/index", label + ": no node " + std::to_string(index) + " on edge " + std::to_string(entity + 1));
    }
  }
}

std::vector<FacePatch> read_patch_arrays(const Hdf5Reader& r, const PatchesArtifact& a) {
  const FlatPatches flat = read_flat(r);
  require_ids(r, "/st/patch/face", flat.face, a.face_group.size());
  std::vector<FacePatch> patches(flat.face.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    FacePatch& p = patches[i];
    const std::int64_t b0 = flat.boundary_offsets[i], b1 = flat.boundary_offsets[i + 1], n0 = flat.inner_offsets[i],
                       n1 = flat.inner_offsets[i + 1], t0 = flat.triangle_offsets[i], t1 = flat.triangle_offsets[i + 1];
    p.face = flat.face[i];
    p.n_boundary = static_cast<std::int32_t>(b1 - b0);
    p.boundary_dim = slice(flat.all.boundary_dim, b0, b1);
    p.boundary_entity = slice(flat.all.boundary_entity, b0, b1);
    p.boundary_index = slice(flat.all.boundary_index, b0, b1);
    p.inner_xyz = slice(flat.all.inner_xyz, n0, n1);
    p.inner_uv = slice(flat.all.inner_uv, n0, n1);
    p.inner_size = slice(flat.all.inner_size, n0, n1);
    p.triangles = slice(flat.all.triangles, t0, t1);
    p.corner_uv = slice(flat.all.corner_uv, 3 * t0, 3 * t1);
    require_consistent(r, p, a);
  }
  return patches;
}

void write_failures(Hdf5Writer& w, const std::vector<FaceFailure>& failures) {
  std::vector<std::int32_t> face;
  std::vector<std::string> cause, remedy;
  std::vector<Vec3> xyz;
  for (const FaceFailure& f : failures) {
    face.push_back(f.face);
    cause.push_back(f.cause);
    remedy.push_back(f.remedy);
    xyz.push_back(f.xyz);
  }
  w.write("/st/failure/face", face);
  w.write_strings("/st/failure/cause", cause);
  w.write_strings("/st/failure/remedy", remedy);
  w.write("/st/failure/xyz", xyz);
}

std::vector<FaceFailure> read_failures(const Hdf5Reader& r) {
  const std::vector<std::int32_t> face = r.read<std::int32_t>("/st/failure/face");
  const std::vector<std::string> cause = r.read_string_rows("/st/failure/cause", face.size());
  const std::vector<std::string> remedy = r.read_string_rows("/st/failure/remedy", face.size());
  const std::vector<Vec3> xyz = r.read_rows<Vec3>("/st/failure/xyz", face.size());
  std::vector<FaceFailure> failures;
  for (std::size_t i = 0; i < face.size(); ++i) failures.push_back({face[i], cause[i], remedy[i], xyz[i]});
  return failures;
}

void read_edges(const Hdf5Reader& r, PatchesArtifact& a) {
  a.vertex_xyz = r.read<Vec3>("/st/vertex/xyz");
  a.edge_vertices = r.read<std::int32_t>("/st/edge/vertices", 2);
  require_ids(r, "/st/edge/vertices", a.edge_vertices, a.vertex_xyz.size());
  EdgeMesh& e = a.edges;
  e.node_t = r.read<double>("/st/edge_node/t");
  e.node_xyz = r.read_rows<Vec3>("/st/edge_node/xyz", e.node_t.size());
  e.node_size = r.read_rows<double>("/st/edge_node/size", e.node_t.size());
  e.edge_offsets = r.read_rows<std::int32_t>("/st/edge/node_offsets", a.edge_vertices.size() / 2 + 1);
  require_offsets(r, "/st/edge/node_offsets", e.edge_offsets, e.node_t.size());
}

void read_faces(const Hdf5Reader& r, PatchesArtifact& a) {
  a.face_group = r.read<std::int32_t>("/st/face/group");
  a.face_shell = r.read_rows<std::int32_t>("/st/face/shell", a.face_group.size());
  a.face_area = r.read_rows<double>("/st/face/area", a.face_group.size());
  a.face_name = r.read_string_rows("/st/face/name", a.face_group.size());
  a.group_name = r.read_strings("/st/group/name");
  require_ids(r, "/st/face/group", a.face_group, a.group_name.size());
}

}  // namespace

std::string write_patches(const std::string& path, const PatchesArtifact& a) {
  ArtifactHeader header = a.header;
  header.schema = "patches";
  header.schema_version = kPatchesVersion;
  Hdf5Writer w(path, header);
  w.write("/st/vertex/xyz", a.vertex_xyz);
  w.write("/st/edge/vertices", a.edge_vertices, 2);
  w.write("/st/edge/node_offsets", a.edges.edge_offsets);
  w.write("/st/edge_node/t", a.edges.node_t);
  w.write("/st/edge_node/xyz", a.edges.node_xyz);
  w.write("/st/edge_node/size", a.edges.node_size);
  w.write_strings("/st/face/name", a.face_name);
  w.write("/st/face/group", a.face_group);
  w.write("/st/face/shell", a.face_shell);
  w.write("/st/face/area", a.face_area);
  w.write_strings("/st/group/name", a.group_name);
  write_patch_arrays(w, a.patches);
  write_failures(w, a.failures);
  w.set_attribute("/st", "is_complete", std::int64_t{a.is_complete});
  return w.commit();
}

PatchesArtifact read_patches(const std::string& path) {
  const Hdf5Reader r(path, "patches", kPatchesVersion);
  PatchesArtifact a;
  a.header = r.header();
  read_edges(r, a);
  read_faces(r, a);
  a.patches = read_patch_arrays(r, a);
  a.failures = read_failures(r);
  a.is_complete = r.int_attribute("/st", "is_complete") != 0;
  return a;
}

}  // namespace st
