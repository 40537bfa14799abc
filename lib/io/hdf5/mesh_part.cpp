#include "io/hdf5/mesh_part.h"

#include <algorithm>

#include "base/limits.h"
#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/merged_features.h"
#include "io/hdf5/row_reader.h"

namespace st {
namespace {

/// Nodes on vertices and edges come first.
std::size_t count_edge_nodes(const RowReader& rows, std::size_t n_nodes) {
  std::size_t low = 0, high = n_nodes;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const bool is_inner = rows.read<std::uint8_t>("/VTKHDF/PointData/entity_dim", middle, 1)[0] >=
                          static_cast<std::uint8_t>(EntityDim::kFace);
    (is_inner ? high : low) = is_inner ? middle : middle + 1;
  }
  return low;
}

/// Which nodes of the whole mesh a part has: [0, n_edge_nodes) and [inner_begin, inner_end).
struct NodeRange {
  std::size_t n_edge_nodes, inner_begin, inner_end;
};

std::vector<std::int32_t> zero_based(std::vector<std::int32_t> ids) {
  for (std::int32_t& id : ids) --id;
  return ids;
}

template <class T>
std::vector<T> read_nodes(const RowReader& rows, const std::string& name, const NodeRange& range) {
  std::vector<T> values = rows.read<T>(name, 0, range.n_edge_nodes);
  const std::vector<T> inner = rows.read<T>(name, range.inner_begin, range.inner_end - range.inner_begin);
  values.insert(values.end(), inner.begin(), inner.end());
  return values;
}

/// The triangles' nodes as in the file, checked, and the range of those inside faces.
NodeRange find_range(const Hdf5Reader& r, const std::vector<std::int64_t>& nodes, std::size_t n_edge_nodes,
                     std::size_t n_nodes) {
  NodeRange range{n_edge_nodes, n_nodes, n_edge_nodes};
  for (const std::int64_t n : nodes) {
    if (n < 0 || static_cast<std::size_t>(n) >= n_nodes)
      r.fail("/VTKHDF/Connectivity", "names node " + std::to_string(n));
    const auto node = static_cast<std::size_t>(n);
    if (node < n_edge_nodes) continue;
    range.inner_begin = std::min(range.inner_begin, node);
    range.inner_end = std::max(range.inner_end, node + 1);
  }
  range.inner_begin = std::min(range.inner_begin, range.inner_end);
  return range;
}

}  // namespace

MeshPart read_mesh_part(const std::string& path, int part, int n_parts) {
  const Hdf5Reader r(path, "mesh", kMeshVersion);
  const RowReader rows(path, r);
  MeshPart result;
  result.artifact.header = r.header();
  result.artifact.is_complete = r.int_attribute("/st", "is_complete") != 0;
  SurfaceMesh& m = result.artifact.mesh;
  const std::size_t n_triangles = rows.n_rows("/VTKHDF/CellData/face"),
                    n_nodes = rows.n_rows("/VTKHDF/PointData/entity_dim");
  require_countable(n_triangles, "triangles of one mesh", kMaxTriangles);
  require_countable(n_nodes, "nodes of one mesh");
  const std::size_t begin = n_triangles * part / n_parts, n = n_triangles * (part + 1) / n_parts - begin;
  const std::vector<std::int64_t> nodes = rows.read<std::int64_t>("/VTKHDF/Connectivity", 3 * begin, 3 * n);
  const NodeRange range = find_range(r, nodes, count_edge_nodes(rows, n_nodes), n_nodes);
  result.first_triangle = static_cast<TriangleId>(begin);
  result.inner_shift = static_cast<NodeId>(range.inner_begin - range.n_edge_nodes);
  m.triangles.resize(n);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool is_inner = static_cast<std::size_t>(nodes[i]) >= range.n_edge_nodes;
    m.triangles[i / 3].n[i % 3] = static_cast<NodeId>(nodes[i]) - (is_inner ? result.inner_shift : 0);
  }
  m.triangle_face = zero_based(rows.read<std::int32_t>("/VTKHDF/CellData/face", begin, n));
  if (r.has("/VTKHDF/CellData/cad_face"))
    result.artifact.triangle_cad_face = zero_based(rows.read<std::int32_t>("/VTKHDF/CellData/cad_face", begin, n));
  m.node_xyz = read_nodes<Vec3>(rows, "/VTKHDF/Points", range);
  m.node_entity_dim = read_nodes<std::uint8_t>(rows, "/VTKHDF/PointData/entity_dim", range);
  m.node_entity = zero_based(read_nodes<std::int32_t>(rows, "/VTKHDF/PointData/entity_id", range));
  m.node_size = read_nodes<double>(rows, "/VTKHDF/PointData/size", range);
  m.node_t = read_nodes<double>(rows, "/st/node/t", range);
  m.corner_uv.resize(3 * n);
  m.merged = read_merged(r, kAnyEdge, rows.n_rows("/st/face/name"));
  return result;
}

}  // namespace st
