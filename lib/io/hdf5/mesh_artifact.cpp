// mesh.hdf: docs/artifacts.md. The mesh itself is a VTKHDF UnstructuredGrid; ids there are 1-based, as users see them.
#include <algorithm>

#include "base/error.h"
#include "base/limits.h"
#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/face_labels_io.h"
#include "io/hdf5/face_numbers.h"
#include "io/hdf5/merged_features.h"
#include "mesh/edge_segments.h"

namespace st {
namespace {

constexpr std::uint8_t kVtkTriangle = 5;

std::vector<std::int32_t> one_based(const std::vector<std::int32_t>& ids) {
  std::vector<std::int32_t> shifted(ids);
  for (std::int32_t& id : shifted) ++id;
  return shifted;
}

/// Of ids in the file, 0: none.
std::vector<std::int32_t> read_ids(const Hdf5Reader& r, const std::string& name, std::size_t n_rows) {
  std::vector<std::int32_t> ids = r.read_rows<std::int32_t>(name, n_rows);
  require_rows_to_be(r, name, std::span<const std::int32_t>(ids), "an id", [](std::int32_t id) { return id >= 0; });
  for (std::int32_t& id : ids) --id;
  return ids;
}

void write_cells(Hdf5Writer& w, const std::vector<Triangle>& triangles) {
  std::vector<std::int64_t> connectivity(3 * triangles.size()), offsets(triangles.size() + 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::copy(triangles[t].n, triangles[t].n + 3, connectivity.begin() + static_cast<std::ptrdiff_t>(3 * t));
    offsets[t + 1] = static_cast<std::int64_t>(3 * (t + 1));
  }
  w.write("/VTKHDF/Connectivity", connectivity);
  w.write("/VTKHDF/Offsets", offsets);
  w.write("/VTKHDF/Types", std::vector<std::uint8_t>(triangles.size(), kVtkTriangle));
}

void write_vtk(Hdf5Writer& w, const SurfaceMesh& m) {
  w.set_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  w.set_attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
  w.write("/VTKHDF/NumberOfPoints", std::vector<std::int64_t>{m.n_nodes()});
  w.write("/VTKHDF/NumberOfCells", std::vector<std::int64_t>{m.n_triangles()});
  w.write("/VTKHDF/NumberOfConnectivityIds", std::vector<std::int64_t>{3 * m.n_triangles()});
  w.write("/VTKHDF/Points", m.node_xyz);
  write_cells(w, m.triangles);
  w.write("/VTKHDF/CellData/face", one_based(m.triangle_face));
  w.write("/VTKHDF/CellData/group", one_based(m.triangle_group));
  w.write("/VTKHDF/PointData/entity_dim", m.node_entity_dim);
  w.write("/VTKHDF/PointData/entity_id", one_based(m.node_entity));
  w.write("/VTKHDF/PointData/size", m.node_size);
  if (!m.node_previous.empty()) {
    w.write("/VTKHDF/CellData/previous_id", m.triangle_previous);
    w.write("/VTKHDF/PointData/previous_id", m.node_previous);
  }
  for (const FaceNumbers& n : face_numbers(m)) w.write("/VTKHDF/CellData/" + n.name, triangle_numbers(m, n));
  for (const NodeGroups& n : node_groups(m)) {
    w.write("/VTKHDF/PointData/" + n.name, n.of_node);
    w.write_vtk_strings("/VTKHDF/FieldData/" + n.name + "_name", n.group_name);
  }
  if (!m.labels.face_name.empty())
    w.write_vtk_strings("/VTKHDF/FieldData/face_name", m.labels.face_name);  // VTK complains of empty ones
  if (!m.labels.group_name.empty()) w.write_vtk_strings("/VTKHDF/FieldData/group_name", m.labels.group_name);
  for (const FaceNumbers& n : face_numbers(m)) w.write_vtk_strings("/VTKHDF/FieldData/" + n.name + "_name", *n.names);
}

std::vector<Triangle> read_triangles(const Hdf5Reader& r, std::size_t n_nodes) {
  const std::vector<std::int64_t> connectivity = r.read<std::int64_t>("/VTKHDF/Connectivity");
  if (connectivity.size() % 3 != 0) r.fail("/VTKHDF/Connectivity", "is not made of triangles");
  const std::size_t n = connectivity.size() / 3;
  require_countable(n, "triangles of one mesh", kMaxTriangles);
  require_countable(n_nodes, "nodes of one mesh");
  const std::vector<std::int64_t> offsets = r.read_rows<std::int64_t>("/VTKHDF/Offsets", n + 1);
  const std::vector<std::uint8_t> types = r.read_rows<std::uint8_t>("/VTKHDF/Types", n);
  std::vector<Triangle> triangles(n);
  for (std::size_t t = 0; t < n; ++t) {
    if (types[t] != kVtkTriangle || offsets[t] != static_cast<std::int64_t>(3 * t))
      r.fail("/VTKHDF/Types", "cell " + std::to_string(t) + " is no triangle");
    for (int k = 0; k < 3; ++k) {
      const std::int64_t node = connectivity[3 * t + k];
      if (node < 0 || static_cast<std::size_t>(node) >= n_nodes)
        r.fail("/VTKHDF/Connectivity",
               "cell " + std::to_string(t) + " names node " + std::to_string(node) + " of " + std::to_string(n_nodes));
      triangles[t].n[k] = static_cast<NodeId>(node);
    }
  }
  return triangles;
}

}  // namespace

std::string write_mesh(const std::string& path, const MeshArtifact& artifact) {
  const SurfaceMesh& m = artifact.mesh;
  ArtifactHeader header = artifact.header;
  header.schema = "mesh";
  header.schema_version = kMeshVersion;
  Hdf5Writer w(path, header);
  write_vtk(w, m);
  w.write_strings("/st/face/name", m.labels.face_name);
  w.write_strings("/st/group/name", m.labels.group_name);
  if (!m.labels.group_role.empty()) w.write_strings("/st/group/role", m.labels.group_role);
  write_labels(w, m.labels);
  w.write("/st/node/t", m.node_t);
  if (!m.segment_edge.empty()) {
    w.write("/st/segment/nodes", m.segment_nodes, 2);
    w.write("/st/segment/edge", m.segment_edge);
  }
  w.write("/st/triangle/corner_uv", m.corner_uv);
  write_merged(w, m.merged);
  w.set_attribute("/st", "is_complete", std::int64_t{artifact.is_complete});
  return w.commit();
}

MeshArtifact read_mesh(const std::string& path) {
  const Hdf5Reader r(path, "mesh", kMeshVersion);
  MeshArtifact artifact;
  artifact.header = r.header();
  artifact.is_complete = r.int_attribute("/st", "is_complete") != 0;
  SurfaceMesh& m = artifact.mesh;
  for (const char* count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    r.verify(std::string("/VTKHDF/") + count);  // for other programs
  m.node_xyz = r.read<Vec3>("/VTKHDF/Points");
  const std::size_t n_nodes = m.node_xyz.size();
  m.node_entity_dim = r.read_rows<std::uint8_t>("/VTKHDF/PointData/entity_dim", n_nodes);
  m.node_entity = read_ids(r, "/VTKHDF/PointData/entity_id", n_nodes);
  m.node_size = r.read_rows<double>("/VTKHDF/PointData/size", n_nodes);
  require_finite(r, "/VTKHDF/Points", m.node_xyz);
  require_lengths(r, "/VTKHDF/PointData/size", m.node_size);
  m.node_t = r.read_rows<double>("/st/node/t", n_nodes);
  m.triangles = read_triangles(r, n_nodes);
  m.labels = read_labels(r, r.read_strings("/st/face/name").size());
  for (const FaceNumbers& n : face_numbers(m)) r.verify("/VTKHDF/CellData/" + n.name);  // made again from the labels
  m.triangle_face = read_ids(r, "/VTKHDF/CellData/face", m.triangles.size());
  require_ids(r, "/VTKHDF/CellData/face", m.triangle_face, m.labels.face_name.size());
  for (std::size_t n = 0; n < n_nodes; ++n)
    if (m.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace) &&
        m.node_entity[n] >= static_cast<std::int64_t>(m.labels.face_name.size()))
      r.fail("/VTKHDF/PointData/entity_id", "row " + std::to_string(n) + " names no face");
  m.triangle_group = read_ids(r, "/VTKHDF/CellData/group", m.triangles.size());
  require_ids(r, "/VTKHDF/CellData/group", m.triangle_group, m.labels.group_name.size());
  if (r.has("/st/segment/edge")) {
    m.segment_edge = r.read<std::int32_t>("/st/segment/edge");
    m.segment_nodes = r.read_rows<std::int32_t>("/st/segment/nodes", m.segment_edge.size(), 2);
    require_ids(r, "/st/segment/nodes", m.segment_nodes, n_nodes);
    require_ids(r, "/st/segment/edge", m.segment_edge, kAnyEdge);
  }
  for (const NodeGroups& n : node_groups(m)) r.verify("/VTKHDF/PointData/" + n.name);
  m.corner_uv = r.read_rows<Vec2>("/st/triangle/corner_uv", 3 * m.triangles.size());
  m.merged = read_merged(r, kAnyEdge, m.labels.face_name.size());
  if (r.has("/VTKHDF/PointData/previous_id")) {
    m.node_previous = r.read_rows<std::int32_t>("/VTKHDF/PointData/previous_id", n_nodes);
    m.triangle_previous = r.read_rows<std::int32_t>("/VTKHDF/CellData/previous_id", m.triangles.size());
  }
  return artifact;
}

}  // namespace st
