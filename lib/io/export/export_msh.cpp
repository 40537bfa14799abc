// Gmsh's .msh, version 4.1, text: each CAD face is a surface, groups of all tables and parts are physical surfaces,
// groups of edges physical curves of lines, groups of vertices physical points.
#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "io/export/export_formats.h"
#include "io/hdf5/face_numbers.h"

namespace st {
namespace {

constexpr int kLine = 1, kTriangle = 2, kQuadrilateral = 3, kPoint = 15;  // Gmsh's element types

/// Nodes of one entity: a run, since nodes are in the order of their entities.
struct NodeRun {
  int dim = 0;
  std::int32_t entity = 0;
  std::size_t begin = 0, end = 0;
};

std::vector<NodeRun> node_runs(const SurfaceMesh& m) {
  std::vector<NodeRun> runs;
  for (std::size_t i = 0; i < m.node_xyz.size(); ++i) {
    const int dim = m.node_entity_dim[i];
    if (runs.empty() || runs.back().dim != dim || runs.back().entity != m.node_entity[i])
      runs.push_back({dim, m.node_entity[i], i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

/// Elements of one kind in one face.
struct ElementRun {
  FaceId face = 0;
  int type = kTriangle;
  std::size_t begin = 0, end = 0;  ///< in the elements of this kind
};

/// By face, its triangles before its quadrilaterals.
std::vector<ElementRun> element_runs(const SurfaceMesh& m, const QuadPairs& elements) {
  std::vector<ElementRun> runs;
  const auto add = [&](FaceId face, int type, std::size_t i) {
    if (runs.empty() || runs.back().face != face || runs.back().type != type) runs.push_back({face, type, i, i});
    runs.back().end = i + 1;
  };
  for (std::size_t i = 0; i < elements.triangles.size(); ++i) add(m.triangle_face[elements.triangles[i]], kTriangle, i);
  for (std::size_t i = 0; i < elements.quads.size(); ++i)
    add(m.triangle_face[elements.quads[i].triangle], kQuadrilateral, i);
  std::stable_sort(runs.begin(), runs.end(), [](const ElementRun& a, const ElementRun& b) { return a.face < b.face; });
  return runs;
}

/// Physical surfaces: names and, for each face, numbers. Main groups first, from 1, then parts and further tables,
/// their names with a prefix.
class Physicals {
 public:
  explicit Physicals(const SurfaceMesh& m) : divisions_(face_numbers(m)) {
    for (const std::string& name : m.labels.group_name) names_.push_back(clean_name(name, false));
    for (const FaceNumbers& d : divisions_) {
      first_.push_back(static_cast<std::int32_t>(names_.size()) + 1);
      for (const std::string& name : *d.names) names_.push_back(d.name + ":" + clean_name(name, false));
    }
  }
  const std::vector<std::string>& names() const { return names_; }
  std::vector<std::int64_t> of_face(FaceId face, std::int32_t group) const {
    std::vector<std::int64_t> tags = {group + 1};
    for (std::size_t i = 0; i < divisions_.size(); ++i)
      if (const std::int32_t number = (*divisions_[i].of_face)[face]; number != kNone)
        tags.push_back(first_[i] + number);
    return tags;
  }

 private:
  std::vector<FaceNumbers> divisions_;
  std::vector<std::string> names_;
  std::vector<std::int32_t> first_;
};

/// Physical curves or points: tags of each entity, and the lines of $PhysicalNames.
struct EntityPhysicals {
  std::map<std::int32_t, std::vector<std::int64_t>> tags;
  std::string names;
};

/// Numbers go on behind `n_before`, so that none stands for two things.
EntityPhysicals entity_physicals(int dim, const std::vector<EntityGroup>& groups, std::size_t n_before) {
  EntityPhysicals result;
  for (const EntityGroup& g : groups) {
    const std::string prefix = g.table.empty() ? "" : "group_" + g.table + ":";
    const std::string number = std::to_string(++n_before);
    result.names += std::to_string(dim) + " " + number + " \"" + prefix + clean_name(g.name, false) + "\"\n";
    for (const std::int32_t id : g.ids) result.tags[id].push_back(static_cast<std::int64_t>(n_before));
  }
  return result;
}

/// Physical groups of all dimensions.
struct AllPhysicals {
  explicit AllPhysicals(const SurfaceMesh& m)
      : surfaces(m),
        curves(entity_physicals(1, m.labels.edge_groups, surfaces.names().size())),
        points(entity_physicals(0, m.labels.vertex_groups, surfaces.names().size() + m.labels.edge_groups.size())),
        n_names(surfaces.names().size() + m.labels.edge_groups.size() + m.labels.vertex_groups.size()) {}

  std::vector<std::int64_t> of_entity(int dim, std::int32_t entity) const {
    const auto& tags = dim == 1 ? curves.tags : points.tags;
    const auto it = tags.find(entity);
    return it == tags.end() ? std::vector<std::int64_t>() : it->second;
  }

  Physicals surfaces;
  EntityPhysicals curves, points;
  std::size_t n_names;
};

/// Boxes of the entities of one dimension: their own nodes, for edges in groups those of their segments, for faces the
/// corners of their triangles.
std::map<std::int32_t, Box3> entity_boxes(const SurfaceMesh& m, const std::vector<NodeRun>& runs, int dim) {
  std::map<std::int32_t, Box3> boxes;
  for (const NodeRun& run : runs)
    for (std::size_t i = run.begin; run.dim == dim && i < run.end; ++i) boxes[run.entity].add(m.node_xyz[i]);
  for (std::size_t i = 0; dim == 1 && i < m.segment_nodes.size(); ++i)
    boxes[m.segment_edge[i / 2]].add(m.node_xyz[m.segment_nodes[i]]);
  for (std::size_t t = 0; dim == 2 && t < m.triangles.size(); ++t)
    for (const NodeId n : m.triangles[t].n) boxes[m.triangle_face[t]].add(m.node_xyz[n]);
  return boxes;
}

void write_entities(TextBuffer& text, const SurfaceMesh& m, const std::vector<NodeRun>& runs,
                    const AllPhysicals& physicals) {
  std::array<std::map<std::int32_t, Box3>, 3> boxes;
  for (int dim = 0; dim < 3; ++dim) boxes[dim] = entity_boxes(m, runs, dim);
  std::map<FaceId, std::int32_t> group;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) group.emplace(m.triangle_face[t], m.triangle_group[t]);
  text << "$Entities\n";
  for (const auto& of_dim : boxes) text << static_cast<std::int64_t>(of_dim.size()) << " ";
  text << "0\n";
  for (int dim = 0; dim < 3; ++dim) {
    for (const auto& [entity, box] : boxes[dim]) {
      text << std::int64_t{entity + 1} << " " << box.lo.x << " " << box.lo.y << " " << box.lo.z;
      if (dim > 0) text << " " << box.hi.x << " " << box.hi.y << " " << box.hi.z;
      const auto known = group.find(entity);
      const std::vector<std::int64_t> tags = dim < 2                ? physicals.of_entity(dim, entity)
                                             : known != group.end() ? physicals.surfaces.of_face(entity, known->second)
                                                                    : std::vector<std::int64_t>();
      text << " " << static_cast<std::int64_t>(tags.size());
      for (const std::int64_t tag : tags) text << " " << tag;
      text << (dim > 0 ? " 0\n" : "\n");
    }
  }
  text << "$EndEntities\n";
}

void write_nodes(TextBuffer& text, const SurfaceMesh& m, const std::vector<NodeRun>& runs) {
  text << "$Nodes\n"
       << static_cast<std::int64_t>(runs.size()) << " " << m.n_nodes() << " " << std::int64_t{m.n_nodes() > 0} << " "
       << m.n_nodes() << "\n";
  for (const NodeRun& run : runs) {
    text << std::int64_t{run.dim} << " " << std::int64_t{run.entity + 1} << " 0 "
         << static_cast<std::int64_t>(run.end - run.begin) << "\n";
    for (std::size_t i = run.begin; i < run.end; ++i) text << static_cast<std::int64_t>(i + 1) << "\n";
    for (std::size_t i = run.begin; i < run.end; ++i)
      text << m.node_xyz[i].x << " " << m.node_xyz[i].y << " " << m.node_xyz[i].z << "\n";
  }
  text << "$EndNodes\n";
}

/// Elements behind the triangles: lines of the edges in groups, points of the vertices in groups.
struct LowElements {
  int dim = 0, type = 0;
  std::int32_t entity = 0;
  std::vector<NodeId> nodes;  ///< of all elements
};

std::vector<LowElements> low_elements(const SurfaceMesh& m, const AllPhysicals& physicals) {
  std::vector<LowElements> blocks;
  for (std::size_t i = 0; i < m.segment_edge.size(); ++i) {
    if (blocks.empty() || blocks.back().entity != m.segment_edge[i])
      blocks.push_back({1, kLine, m.segment_edge[i], {}});
    blocks.back().nodes.insert(blocks.back().nodes.end(), {m.segment_nodes[2 * i], m.segment_nodes[2 * i + 1]});
  }
  for (std::size_t n = 0;
       n < m.node_entity.size() && m.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex); ++n)
    if (physicals.points.tags.contains(m.node_entity[n]))
      blocks.push_back({0, kPoint, m.node_entity[n], {static_cast<NodeId>(n)}});
  return blocks;
}

/// Numbers go on from block to block, from 1: without quadrilaterals those of the triangles in the mesh.
void write_elements(TextBuffer& text, const SurfaceMesh& m, const QuadPairs& elements, const AllPhysicals& physicals) {
  const std::vector<ElementRun> runs = element_runs(m, elements);
  const std::vector<LowElements> low = low_elements(m, physicals);
  std::int64_t n_elements = static_cast<std::int64_t>(elements.triangles.size() + elements.quads.size()), number = 0;
  for (const LowElements& block : low) n_elements += static_cast<std::int64_t>(block.nodes.size()) / (block.dim + 1);
  text << "$Elements\n"
       << static_cast<std::int64_t>(runs.size() + low.size()) << " " << n_elements << " "
       << std::int64_t{n_elements > 0} << " " << n_elements << "\n";
  for (const ElementRun& run : runs) {
    text << "2 " << std::int64_t{run.face + 1} << " " << std::int64_t{run.type} << " "
         << static_cast<std::int64_t>(run.end - run.begin) << "\n";
    for (std::size_t i = run.begin; i < run.end; ++i) {
      text << ++number;
      const bool is_triangle = run.type == kTriangle;
      const std::span<const NodeId> nodes = is_triangle ? std::span<const NodeId>(m.triangles[elements.triangles[i]].n)
                                                        : std::span<const NodeId>(elements.quads[i].n);
      for (const NodeId n : nodes) text << " " << std::int64_t{n + 1};
      text << "\n";
    }
  }
  for (const LowElements& block : low) {
    const std::size_t n_corners = block.dim + 1, n = block.nodes.size() / n_corners;
    text << std::int64_t{block.dim} << " " << std::int64_t{block.entity + 1} << " " << std::int64_t{block.type} << " "
         << static_cast<std::int64_t>(n) << "\n";
    for (std::size_t i = 0; i < block.nodes.size(); ++i) {
      if (i % n_corners == 0) text << ++number;
      text << " " << std::int64_t{block.nodes[i] + 1} << (i % n_corners + 1 == n_corners ? "\n" : "");
    }
  }
  text << "$EndElements\n";
}

}  // namespace

void export_msh(Output& out, const SurfaceMesh& m, const QuadPairs& elements) {
  const std::vector<NodeRun> runs = node_runs(m);
  const AllPhysicals all(m);
  const std::vector<std::string>& surfaces = all.surfaces.names();
  TextBuffer text(out);
  text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n" << static_cast<std::int64_t>(all.n_names) << "\n";
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    text << "2 " << static_cast<std::int64_t>(i + 1) << " \"" << surfaces[i] << "\"\n";
  text << all.curves.names << all.points.names << "$EndPhysicalNames\n";
  write_entities(text, m, runs, all);
  write_nodes(text, m, runs);
  write_elements(text, m, elements, all);
  text.flush();
}

}  // namespace st
