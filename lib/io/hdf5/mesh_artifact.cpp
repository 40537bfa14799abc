// mesh.hdf: docs/artifacts.md. The mesh itself is a VTKHDF UnstructuredGrid; ids there are 1-based, as users see them.
#include <algorithm>

#include "base/error.h"
#include "base/limits.h"
#include "base/threads.h"
#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/face_labels_io.h"
#include "io/hdf5/face_numbers.h"
#include "io/hdf5/merged_features.h"
#include "io/hdf5/node_values.h"
#include "mesh/edge_segments.h"

namespace st {
namespace {

constexpr std::uint8_t kVtkTriangle = 5;

constexpr std::size_t kRowsAtOnce = 65'536;

/// Calls f(begin, end) for pieces of [0, n).
template <class Function>
void in_pieces(std::size_t n, const Function& f) {
  for (std::size_t begin = 0; begin < n; begin += kRowsAtOnce) f(begin, std::min(n, begin + kRowsAtOnce));
}

/// Arrays of rows that are written side by side, each from the beginning.
class ColumnWriter {
 public:
  explicit ColumnWriter(Hdf5Writer& writer) : writer_(writer) {}

  template <class T>
  void add(const std::string& name, const Column<T>& column) {
    const std::size_t dataset = writer_.begin_rows<T>(name, column.n_rows);
    jobs_.emplace_back(
        [this, dataset, &column] { column.give([&](std::span<const T> rows) { writer_.append(dataset, rows); }); });
  }
  /// `make`: from a row of the column to `n_each` rows of the dataset, which it appends.
  template <class To, class From, class Make>
  void add(const std::string& name, const Column<From>& column, const Make& make, std::size_t n_each = 1) {
    const std::size_t dataset = writer_.begin_rows<To>(name, n_each * column.n_rows);
    jobs_.emplace_back([this, dataset, &column, make] {
      std::vector<To> made;
      column.give([&](std::span<const From> rows) {
        in_pieces(rows.size(), [&](std::size_t begin, std::size_t end) {
          made.clear();
          for (std::size_t i = begin; i < end; ++i) make(rows[i], made);
          writer_.append(dataset, std::span<const To>(made));
        });
      });
    });
  }
  /// The values of row after row.
  template <class T, class ValueOf>
  void add_values(const std::string& name, std::size_t n_rows, const ValueOf& value_of) {
    const std::size_t dataset = writer_.begin_rows<T>(name, n_rows);
    jobs_.emplace_back([this, dataset, n_rows, value_of] {
      std::vector<T> values;
      in_pieces(n_rows, [&](std::size_t begin, std::size_t end) {
        values.clear();
        for (std::size_t i = begin; i < end; ++i) values.push_back(value_of(i));
        writer_.append(dataset, std::span<const T>(values));
      });
    });
  }
  void write() { run_jobs(jobs_); }

 private:
  Hdf5Writer& writer_;
  std::vector<std::function<void()>> jobs_;
};

void add_one_based(std::int32_t id, std::vector<std::int32_t>& ids) { ids.push_back(id + 1); }

/// Of ids in the file, 0: none.
std::vector<std::int32_t> read_ids(const Hdf5Reader& r, const std::string& name, std::size_t n_rows) {
  std::vector<std::int32_t> ids = r.read_rows<std::int32_t>(name, n_rows);
  require_rows_to_be(r, name, std::span<const std::int32_t>(ids), "an id", [](std::int32_t id) { return id >= 0; });
  for (std::int32_t& id : ids) --id;
  return ids;
}

void write_cells(ColumnWriter& c, const MeshColumns& m) {
  const auto n = m.triangles.n_rows;
  c.add<std::int64_t>(
      "/VTKHDF/Connectivity", m.triangles,
      [](const Triangle& t, std::vector<std::int64_t>& ids) { ids.insert(ids.end(), std::begin(t.n), std::end(t.n)); },
      3);
  c.add_values<std::int64_t>("/VTKHDF/Offsets", n + 1, [](std::size_t i) { return static_cast<std::int64_t>(3 * i); });
  c.add_values<std::uint8_t>("/VTKHDF/Types", n, [](std::size_t) { return kVtkTriangle; });
}

/// Divisions of the faces beside the groups, and groups of edges and vertices.
void write_numbers(Hdf5Writer& w, ColumnWriter& c, const SurfaceMesh& head, const MeshColumns& m,
                   const std::vector<FaceNumbers>& numbers) {
  for (const FaceNumbers& n : numbers)
    c.add<std::int32_t>("/VTKHDF/CellData/" + n.name, m.triangle_face,
                        [of_face = n.of_face](FaceId f, std::vector<std::int32_t>& of_triangle) {
                          of_triangle.push_back(static_cast<std::size_t>(f) < of_face->size() ? (*of_face)[f] + 1 : 0);
                        });
  for (NodeGroups& n : node_groups(head)) {
    c.add_values<std::int32_t>(
        "/VTKHDF/PointData/" + n.name, m.node_xyz.n_rows,
        [of_node = std::move(n.of_node)](std::size_t i) { return i < of_node.size() ? of_node[i] : 0; });
    w.write_vtk_strings("/VTKHDF/FieldData/" + n.name + "_name", n.group_name);
  }
}

void write_vtk(Hdf5Writer& w, ColumnWriter& c, const SurfaceMesh& head, const MeshColumns& m) {
  w.set_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  w.set_attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
  w.write("/VTKHDF/NumberOfPoints", std::vector<std::int64_t>{m.n_nodes()});
  w.write("/VTKHDF/NumberOfCells", std::vector<std::int64_t>{m.n_triangles()});
  w.write("/VTKHDF/NumberOfConnectivityIds", std::vector<std::int64_t>{3 * m.n_triangles()});
  c.add("/VTKHDF/Points", m.node_xyz);
  write_cells(c, m);
  c.add<std::int32_t>("/VTKHDF/CellData/face", m.triangle_face, add_one_based);
  c.add<std::int32_t>("/VTKHDF/CellData/group", m.triangle_group, add_one_based);
  c.add("/VTKHDF/PointData/entity_dim", m.node_entity_dim);
  c.add<std::int32_t>("/VTKHDF/PointData/entity_id", m.node_entity, add_one_based);
  c.add("/VTKHDF/PointData/size", m.node_size);
  if (m.node_previous) {
    c.add("/VTKHDF/CellData/previous_id", *m.triangle_previous);
    c.add("/VTKHDF/PointData/previous_id", *m.node_previous);
  }
  if (m.triangle_cad_face) {
    c.add<std::int32_t>("/VTKHDF/CellData/cad_face", *m.triangle_cad_face, add_one_based);
    c.add<std::int32_t>("/VTKHDF/PointData/cad_face", *m.node_cad_face, add_one_based);
    c.add("/st/node/cad_uv", *m.node_cad_uv);
  }
  const std::vector<FaceNumbers> numbers = face_numbers(head);
  write_numbers(w, c, head, m, numbers);
  if (!head.labels.face_name.empty())
    w.write_vtk_strings("/VTKHDF/FieldData/face_name", head.labels.face_name);  // VTK complains of empty ones
  if (!head.labels.group_name.empty()) w.write_vtk_strings("/VTKHDF/FieldData/group_name", head.labels.group_name);
  for (const FaceNumbers& n : numbers) w.write_vtk_strings("/VTKHDF/FieldData/" + n.name + "_name", *n.names);
}

/// Makes columns of what is in memory.
template <class T>
Column<T> column_of(const std::vector<T>& rows) {
  return {rows.size(), [&rows](const typename Column<T>::Take& take) { take(rows); }};
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
  parallel_for(n, kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (types[t] != kVtkTriangle || offsets[t] != static_cast<std::int64_t>(3 * t))
        r.fail("/VTKHDF/Types", "cell " + std::to_string(t) + " is no triangle");
      for (int k = 0; k < 3; ++k) {
        const std::int64_t node = connectivity[3 * t + k];
        if (node < 0 || static_cast<std::size_t>(node) >= n_nodes)
          r.fail("/VTKHDF/Connectivity", "cell " + std::to_string(t) + " names node " + std::to_string(node) + " of " +
                                             std::to_string(n_nodes));
        triangles[t].n[k] = static_cast<NodeId>(node);
      }
    }
  });
  return triangles;
}

/// The large arrays of a mesh with labels, one each: for several threads. The first failure is that of the first job.
std::vector<std::function<void()>> read_jobs(const Hdf5Reader& r, std::size_t n_nodes, std::size_t n_triangles,
                                             SurfaceMesh& m) {
  const auto ids_of = [&r, n_triangles](const char* name, std::vector<std::int32_t>& ids, std::size_t n) {
    ids = read_ids(r, name, n_triangles);
    require_ids(r, name, ids, n);
  };
  std::vector<std::function<void()>> jobs = {
      [&r, &m] {
        m.node_xyz = r.read<Vec3>("/VTKHDF/Points");
        require_finite(r, "/VTKHDF/Points", m.node_xyz);
      },
      [&r, &m, n_nodes] { m.triangles = read_triangles(r, n_nodes); },
      [&r, &m, n_triangles] { m.corner_uv = r.read_rows<Vec2>("/st/triangle/corner_uv", 3 * n_triangles); },
      [&r, &m, n_nodes] {
        m.node_entity_dim = r.read_rows<std::uint8_t>("/VTKHDF/PointData/entity_dim", n_nodes);
        m.node_entity = read_ids(r, "/VTKHDF/PointData/entity_id", n_nodes);
      },
      [&r, &m, n_nodes] {
        m.node_size = r.read_rows<double>("/VTKHDF/PointData/size", n_nodes);
        require_lengths(r, "/VTKHDF/PointData/size", m.node_size);
      },
      [&r, &m, n_nodes] { m.node_t = r.read_rows<double>("/st/node/t", n_nodes); },
      [ids_of, &m] { ids_of("/VTKHDF/CellData/face", m.triangle_face, m.labels.face_name.size()); },
      [ids_of, &m] { ids_of("/VTKHDF/CellData/group", m.triangle_group, m.labels.group_name.size()); }};
  for (const FaceNumbers& n : face_numbers(m))  // made again from the labels
    jobs.emplace_back([&r, name = "/VTKHDF/CellData/" + n.name] { r.verify(name); });
  return jobs;
}

void require_entities(const Hdf5Reader& r, const SurfaceMesh& m) {
  for (std::size_t n = 0; n < m.node_xyz.size(); ++n)
    if (m.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace) &&
        m.node_entity[n] >= static_cast<std::int64_t>(m.labels.face_name.size()))
      r.fail("/VTKHDF/PointData/entity_id", "row " + std::to_string(n) + " names no face");
}

MeshColumns columns_of(const MeshArtifact& artifact) {
  const SurfaceMesh& m = artifact.mesh;
  MeshColumns c{column_of(m.node_xyz),
                column_of(m.node_entity_dim),
                column_of(m.node_entity),
                column_of(m.node_t),
                column_of(m.node_size),
                column_of(m.triangles),
                column_of(m.triangle_face),
                column_of(m.triangle_group),
                column_of(m.corner_uv),
                {},
                {},
                {},
                {},
                {}};
  if (!artifact.triangle_cad_face.empty()) {
    c.triangle_cad_face = column_of(artifact.triangle_cad_face);
    c.node_cad_face = column_of(artifact.node_cad_face);
    c.node_cad_uv = column_of(artifact.node_cad_uv);
  }
  if (!m.node_previous.empty()) {
    c.node_previous = column_of(m.node_previous);
    c.triangle_previous = column_of(m.triangle_previous);
  }
  return c;
}

constexpr std::string_view kPointData = "/VTKHDF/PointData/";

/// Names of point data that meshes have without carried values.
bool is_own_name(const std::string& name) {
  constexpr std::string_view own[] = {"entity_dim", "entity_id", "size", "previous_id", "cad_face"};
  return name.empty() || std::find(std::begin(own), std::end(own), name) != std::end(own) ||
         name.starts_with("edge_group") || name.starts_with("vertex_group");
}

std::string write(const std::string& path, const MeshArtifact& artifact, const MeshColumns& columns,
                  std::span<const NodeValues> arrays) {
  const SurfaceMesh& m = artifact.mesh;
  ArtifactHeader header = artifact.header;
  header.schema = "mesh";
  header.schema_version = kMeshVersion;
  Hdf5Writer w(path, header);
  ColumnWriter c(w);
  write_vtk(w, c, m, columns);
  w.write_strings("/st/face/name", m.labels.face_name);
  w.write_strings("/st/group/name", m.labels.group_name);
  if (!m.labels.group_role.empty()) w.write_strings("/st/group/role", m.labels.group_role);
  write_labels(w, m.labels);
  c.add("/st/node/t", columns.node_t);
  if (!m.segment_edge.empty()) {
    w.write("/st/segment/nodes", m.segment_nodes, 2);
    w.write("/st/segment/edge", m.segment_edge);
  }
  c.add("/st/triangle/corner_uv", columns.corner_uv);
  for (const NodeValues& a : arrays) w.write(std::string(kPointData) + a.name, a.values, a.n_components);
  write_merged(w, m.merged);
  w.set_attribute("/st", "is_complete", std::int64_t{artifact.is_complete});
  c.write();
  return w.commit();
}

}  // namespace

std::string write_mesh(const std::string& path, const MeshArtifact& artifact) {
  return write(path, artifact, columns_of(artifact), {});
}

std::string write_mesh(const std::string& path, const MeshArtifact& artifact, const MeshColumns& columns) {
  return write(path, artifact, columns, {});
}

void require_free_name(const std::string& name) {
  if (is_own_name(name))
    throw Error(ExitCode::kUsage, "array '" + name + "': meshes have one of this name; give it another");
}

std::string write_mesh_with(const std::string& path, const MeshArtifact& artifact, std::span<const NodeValues> arrays) {
  return write(path, artifact, columns_of(artifact), arrays);
}

std::vector<NodeValues> read_stored_values(const std::string& path) {
  const Hdf5Reader r(path, "mesh", kMeshVersion);
  const std::size_t n_nodes = r.info("/VTKHDF/Points").shape[0];
  std::vector<NodeValues> arrays;
  for (const DatasetInfo& set : r.datasets()) {
    if (!set.name.starts_with(kPointData)) continue;
    std::string name = set.name.substr(kPointData.size());
    if (is_own_name(name)) continue;
    const std::size_t n_components = set.shape.size() > 1 ? set.shape[1] : 1;
    arrays.push_back({std::move(name), n_components, r.read_rows<double>(set.name, n_nodes, n_components)});
  }
  return arrays;
}

MeshArtifact read_mesh(const std::string& path) {
  const Hdf5Reader r(path, "mesh", kMeshVersion);
  MeshArtifact artifact;
  artifact.header = r.header();
  artifact.is_complete = r.int_attribute("/st", "is_complete") != 0;
  SurfaceMesh& m = artifact.mesh;
  for (const char* count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    r.verify(std::string("/VTKHDF/") + count);  // for other programs
  const std::size_t n_nodes = r.info("/VTKHDF/Points").shape[0],
                    n_triangles = r.info("/VTKHDF/Connectivity").shape[0] / 3;
  m.labels = read_labels(r, r.read_strings("/st/face/name").size());
  run_jobs(read_jobs(r, n_nodes, n_triangles, m));
  require_entities(r, m);
  if (r.has("/st/segment/edge")) {
    m.segment_edge = r.read<std::int32_t>("/st/segment/edge");
    m.segment_nodes = r.read_rows<std::int32_t>("/st/segment/nodes", m.segment_edge.size(), 2);
    require_ids(r, "/st/segment/nodes", m.segment_nodes, n_nodes);
    require_ids(r, "/st/segment/edge", m.segment_edge, kAnyEdge);
  }
  for (const NodeGroups& n : node_groups(m)) r.verify("/VTKHDF/PointData/" + n.name);
  m.merged = read_merged(r, kAnyEdge, m.labels.face_name.size());
  if (r.has("/VTKHDF/PointData/previous_id")) {
    m.node_previous = r.read_rows<std::int32_t>("/VTKHDF/PointData/previous_id", n_nodes);
    m.triangle_previous = r.read_rows<std::int32_t>("/VTKHDF/CellData/previous_id", n_triangles);
  }
  if (r.has("/VTKHDF/CellData/cad_face")) {
    artifact.triangle_cad_face = read_ids(r, "/VTKHDF/CellData/cad_face", n_triangles);
    artifact.node_cad_face = read_ids(r, "/VTKHDF/PointData/cad_face", n_nodes);
    artifact.node_cad_uv = r.read_rows<Vec2>("/st/node/cad_uv", n_nodes);
  }
  return artifact;
}

}  // namespace st
