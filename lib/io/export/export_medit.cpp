// INRIA's Medit, as text (.mesh) and in the binary form of libMeshb (.meshb): the group of each element is its
// reference. On request the association to the CAD: what each node lies on, with t or (u,v).
#include <algorithm>
#include <cstdint>

#include "io/export/export_formats.h"
#include "io/export/medit_writer.h"

namespace st {
namespace {

constexpr MeditKeyword kEdges{"Edges", 5}, kQuadrilaterals{"Quadrilaterals", 7},
    kOnVertices{"VerticesOnGeometricVertices", 40}, kOnEdges{"VerticesOnGeometricEdges", 41},
    kOnFaces{"VerticesOnGeometricTriangles", 42};

void write_elements(MeditWriter& file, const ExportTask& task, const MeditKeyword& keyword, std::int64_t begin,
                    std::int64_t end, std::int64_t n_corners) {
  if (begin == end && n_corners == 4) return;
  file.begin({keyword, end - begin, n_corners + 1});
  for (std::int64_t i = begin; i < end; ++i) {
    MeditEntry e{task.nodes_of(i), {}};
    for (std::int64_t& n : e.integers) ++n;
    e.integers.push_back(group_number(task.mesh, task.triangle_of(i)));
    file.entry(e);
  }
}

/// A node on a face that it touches.
struct NodeOnFace {
  NodeId node;
  FaceId face;
  Vec2 uv;
  auto key() const { return std::pair(node, face); }
};

/// Every node with every face that it touches, once; on a seam with the first (u,v).
std::vector<NodeOnFace> nodes_on_faces(const SurfaceMesh& m) {
  std::vector<NodeOnFace> all;
  for (std::size_t c = 0; c < m.corner_uv.size(); ++c)
    all.push_back({m.triangles[c / 3].n[c % 3], m.triangle_face[c / 3], m.corner_uv[c]});
  std::stable_sort(all.begin(), all.end(), [](const NodeOnFace& a, const NodeOnFace& b) { return a.key() < b.key(); });
  all.erase(
      std::unique(all.begin(), all.end(), [](const NodeOnFace& a, const NodeOnFace& b) { return a.key() == b.key(); }),
      all.end());
  return all;
}

/// As programs of that family read it: node, CAD id, parameters, and the CAD id again as a real number.
void write_association(MeditWriter& file, const SurfaceMesh& m) {
  const auto count = [&](EntityDim dim) {
    return std::count(m.node_entity_dim.begin(), m.node_entity_dim.end(), static_cast<std::uint8_t>(dim));
  };
  const auto for_nodes = [&](EntityDim dim, const auto& write) {
    for (std::size_t n = 0; n < m.node_xyz.size(); ++n)
      if (m.node_entity_dim[n] == static_cast<std::uint8_t>(dim))
        write(static_cast<std::int64_t>(n) + 1, std::int64_t{m.node_entity[n]} + 1, n);
  };
  file.begin({kOnVertices, count(EntityDim::kVertex), 2});
  for_nodes(EntityDim::kVertex, [&](std::int64_t node, std::int64_t id, std::size_t) { file.entry({{node, id}, {}}); });
  file.begin({kOnEdges, count(EntityDim::kEdge), 2, 2});
  for_nodes(EntityDim::kEdge, [&](std::int64_t node, std::int64_t id, std::size_t n) {
    file.entry({{node, id}, {m.node_t[n], static_cast<double>(id)}});
  });
  const std::vector<NodeOnFace> on_faces = nodes_on_faces(m);
  file.begin({kOnFaces, static_cast<std::int64_t>(on_faces.size()), 2, 3});
  for (const NodeOnFace& f : on_faces)
    file.entry({{std::int64_t{f.node} + 1, std::int64_t{f.face} + 1}, {f.uv.x, f.uv.y, double(f.face) + 1}});
}

void write_medit(Output& out, const ExportTask& task, bool is_binary) {
  const SurfaceMesh& m = task.mesh;
  MeditWriter file(out, is_binary);
  for (std::size_t g = 0; g < m.labels.group_name.size(); ++g)
    file.comment("reference " + std::to_string(g + 1) + ": " + clean_name(m.labels.group_name[g], false));
  file.begin({kMeditVertices, m.n_nodes(), 1, 3});
  for (const Vec3& p : m.node_xyz) file.entry({{0}, {p.x, p.y, p.z}}, true);
  if (task.options.has_parameters && !m.segment_edge.empty()) {
    file.begin({kEdges, static_cast<std::int64_t>(m.segment_edge.size()), 3});
    for (std::size_t i = 0; i < m.segment_edge.size(); ++i)
      file.entry({{std::int64_t{m.segment_nodes[2 * i]} + 1, std::int64_t{m.segment_nodes[2 * i + 1]} + 1,
                   std::int64_t{m.segment_edge[i]} + 1},
                  {}});
  }
  write_elements(file, task, kMeditTriangles, 0, task.n_triangles(), 3);
  write_elements(file, task, kQuadrilaterals, task.n_triangles(), task.n_elements(), 4);
  if (task.options.has_parameters) write_association(file, m);
  file.end();
}

}  // namespace

void export_medit(Output& out, const ExportTask& task) { write_medit(out, task, false); }
void export_binary_medit(Output& out, const ExportTask& task) { write_medit(out, task, true); }

}  // namespace st
