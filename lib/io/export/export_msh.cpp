// Gmsh's .msh, versions 4.1 and 2.2, text and binary: each CAD face is a surface, groups of all tables and parts are
// physical surfaces, groups of edges physical curves of lines, groups of vertices physical points.
#include <algorithm>
#include <array>
#include <map>

#include "io/export/export_formats.h"
#include "io/export/msh_periodic.h"
#include "io/export/node_value_export.h"
#include "io/hdf5/face_numbers.h"

namespace st {
namespace {

// Gmsh's element types
constexpr int kLine = 1, kTriangle = 2, kQuadrilateral = 3, kLine3 = 8, kTriangle6 = 9, kPoint = 15,
              kQuadrilateral8 = 16;

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

/// Elements of one kind in one face, behind one another.
struct ElementRun {
  FaceId face = 0;
  bool is_quad = false;
  std::int64_t begin = 0, end = 0;
};

/// By face, its triangles before its quadrilaterals.
std::vector<ElementRun> element_runs(const ExportTask& task) {
  std::vector<ElementRun> runs;
  for (std::int64_t i = 0; i < task.n_elements(); ++i) {
    const FaceId face = task.mesh.triangle_face[task.triangle_of(i)];
    const bool is_quad = i >= task.n_triangles();
    if (runs.empty() || runs.back().face != face || runs.back().is_quad != is_quad)
      runs.push_back({face, is_quad, i, i});
    runs.back().end = i + 1;
  }
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
  std::vector<std::string> names;
};

/// Numbers go on behind `n_before`, so that none stands for two things.
EntityPhysicals entity_physicals(int dim, const std::vector<EntityGroup>& groups, std::size_t n_before) {
  EntityPhysicals result;
  for (const EntityGroup& g : groups) {
    const std::string prefix = g.table.empty() ? "" : "group_" + g.table + ":";
    const std::string number = std::to_string(++n_before);
    result.names.push_back(std::to_string(dim) + " " + number + " \"" + prefix + clean_name(g.name, false) + "\"");
    for (const std::int32_t id : g.ids) result.tags[id].push_back(static_cast<std::int64_t>(n_before));
  }
  return result;
}

/// Physical groups of all dimensions.
struct AllPhysicals {
  explicit AllPhysicals(const SurfaceMesh& m)
      : surfaces(m),
        curves(entity_physicals(1, m.labels.edge_groups, surfaces.names().size())),
        points(entity_physicals(0, m.labels.vertex_groups, surfaces.names().size() + m.labels.edge_groups.size())) {}

  /// Of $PhysicalNames.
  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < surfaces.names().size(); ++i)
      all.push_back("2 " + std::to_string(i + 1) + " \"" + surfaces.names()[i] + "\"");
    all.insert(all.end(), curves.names.begin(), curves.names.end());
    all.insert(all.end(), points.names.begin(), points.names.end());
    return all;
  }

  std::vector<std::int64_t> of_entity(int dim, std::int32_t entity) const {
    const auto& tags = dim == 1 ? curves.tags : points.tags;
    const auto it = tags.find(entity);
    return it == tags.end() ? std::vector<std::int64_t>() : it->second;
  }

  Physicals surfaces;
  EntityPhysicals curves, points;
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

void write_head(Numbers& file, const char* version, const std::vector<std::string>& names) {
  file.line("$MeshFormat");
  file.line(std::string(version) + (file.is_binary() ? " 1 8" : " 0 8"));
  if (file.is_binary()) file.integer(1).line("");
  file.line("$EndMeshFormat");
  file.line("$PhysicalNames");
  file.line(std::to_string(names.size()));
  for (const std::string& name : names) file.line(name);
  file.line("$EndPhysicalNames");
}

void write_entities(Numbers& file, const SurfaceMesh& m, const std::vector<NodeRun>& runs,
                    const AllPhysicals& physicals) {
  std::array<std::map<std::int32_t, Box3>, 3> boxes;
  for (int dim = 0; dim < 3; ++dim) boxes[dim] = entity_boxes(m, runs, dim);
  std::map<FaceId, std::int32_t> group;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) group.emplace(m.triangle_face[t], m.triangle_group[t]);
  file.line("$Entities");
  for (const auto& of_dim : boxes) file.size(n_of(of_dim));
  file.size(0).end();
  for (int dim = 0; dim < 3; ++dim) {
    for (const auto& [entity, box] : boxes[dim]) {
      file.integer(std::int64_t{entity} + 1).point(box.lo);
      if (dim > 0) file.point(box.hi);
      const auto known = group.find(entity);
      const std::vector<std::int64_t> tags = dim < 2                ? physicals.of_entity(dim, entity)
                                             : known != group.end() ? physicals.surfaces.of_face(entity, known->second)
                                                                    : std::vector<std::int64_t>();
      file.size(n_of(tags));
      for (const std::int64_t tag : tags) file.integer(tag);
      if (dim > 0) file.size(0);
      file.end();
    }
  }
  file.end_section("Entities");
}

/// (u,v) of each node inside a face: that of the first corner there.
std::vector<Vec2> inner_uv(const SurfaceMesh& m) {
  std::vector<Vec2> uv(m.node_xyz.size());
  for (std::size_t c = m.corner_uv.size(); c-- > 0;) uv[m.triangles[c / 3].n[c % 3]] = m.corner_uv[c];
  return uv;
}

/// Nodes of the entities, then those on sides: a block for each of these, with the numbers behind.
void write_nodes(Numbers& file, const ExportTask& task, const std::vector<NodeRun>& runs) {
  const SurfaceMesh& m = task.mesh;
  const bool is_parametric = task.options.has_parameters;
  const std::vector<Vec2> uv = is_parametric ? inner_uv(m) : std::vector<Vec2>();
  file.line("$Nodes");
  file.size(n_of(runs) + task.mid_nodes.size()).size(task.n_nodes());
  file.size(task.n_nodes() > 0).size(task.n_nodes()).end();
  for (const NodeRun& run : runs) {
    file.integer(run.dim).integer(std::int64_t{run.entity} + 1).integer(is_parametric && run.dim > 0);
    file.size(static_cast<std::int64_t>(run.end - run.begin)).end();
    for (std::size_t i = run.begin; i < run.end; ++i) file.size(static_cast<std::int64_t>(i) + 1).end();
    for (std::size_t i = run.begin; i < run.end; ++i) {
      file.point(m.node_xyz[i]);
      if (is_parametric && run.dim == 1) file.real(m.node_t[i]);
      if (is_parametric && run.dim == 2) file.real(uv[i].x).real(uv[i].y);
      file.end();
    }
  }
  for (std::int64_t k = 0; k < task.mid_nodes.size(); ++k) {
    file.integer(task.mid_nodes.entity_dim[k]).integer(std::int64_t{task.mid_nodes.entity[k]} + 1);
    file.integer(0).size(1).end();
    file.size(m.n_nodes() + k + 1).end();
    file.point(task.mid_nodes.xyz[k]).end();
  }
  file.end_section("Nodes");
}

/// Elements behind the triangles: lines of the edges, points of the vertices in groups.
struct LowElements {
  int dim = 0, type = 0;
  std::int32_t entity = 0;
  std::size_t n_nodes = 1;          ///< of an element
  std::vector<std::int64_t> nodes;  ///< of all elements, from 0
  std::int64_t n_elements() const { return static_cast<std::int64_t>(nodes.size() / n_nodes); }
};

std::vector<LowElements> low_elements(const ExportTask& task, const AllPhysicals& physicals) {
  const SurfaceMesh& m = task.mesh;
  const bool is_curved = !task.mid_nodes.empty();
  std::vector<LowElements> blocks;
  for (std::size_t i = 0; i < m.segment_edge.size(); ++i) {
    if (blocks.empty() || blocks.back().entity != m.segment_edge[i])
      blocks.push_back({1, is_curved ? kLine3 : kLine, m.segment_edge[i], is_curved ? 3u : 2u, {}});
    const NodeId a = m.segment_nodes[2 * i], b = m.segment_nodes[2 * i + 1];
    blocks.back().nodes.insert(blocks.back().nodes.end(), {a, b});
    if (is_curved) blocks.back().nodes.push_back(m.n_nodes() + task.mid_nodes.between(a, b));
  }
  for (std::size_t n = 0;
       n < m.node_entity.size() && m.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex); ++n)
    if (physicals.points.tags.contains(m.node_entity[n]))
      blocks.push_back({0, kPoint, m.node_entity[n], 1, {static_cast<std::int64_t>(n)}});
  return blocks;
}

int element_type(const ExportTask& task, bool is_quad) {
  if (task.mid_nodes.empty()) return is_quad ? kQuadrilateral : kTriangle;
  return is_quad ? kQuadrilateral8 : kTriangle6;
}

/// Numbers go on from block to block, from 1: without quadrilaterals those of the triangles in the mesh.
void write_elements(Numbers& file, const ExportTask& task, const AllPhysicals& physicals) {
  const std::vector<ElementRun> runs = element_runs(task);
  const std::vector<LowElements> low = low_elements(task, physicals);
  std::int64_t n_elements = task.n_elements(), number = 0;
  for (const LowElements& block : low) n_elements += block.n_elements();
  file.line("$Elements");
  file.size(n_of(runs) + n_of(low)).size(n_elements).size(n_elements > 0).size(n_elements).end();
  for (const ElementRun& run : runs) {
    file.integer(2).integer(std::int64_t{run.face} + 1).integer(element_type(task, run.is_quad));
    file.size(run.end - run.begin).end();
    for (std::int64_t i = run.begin; i < run.end; ++i) {
      file.size(++number);
      for (const std::int64_t n : task.nodes_of(i)) file.size(n + 1);
      file.end();
    }
  }
  for (const LowElements& block : low) {
    file.integer(block.dim).integer(std::int64_t{block.entity} + 1).integer(block.type).size(block.n_elements()).end();
    for (std::size_t i = 0; i < block.nodes.size(); ++i) {
      if (i % block.n_nodes == 0) file.size(++number);
      file.size(block.nodes[i] + 1);
      if (i % block.n_nodes + 1 == block.n_nodes) file.end();
    }
  }
  file.end_section("Elements");
}

void write_msh4(Output& out, const ExportTask& task, bool is_binary) {
  const std::vector<NodeRun> runs = node_runs(task.mesh);
  const AllPhysicals all(task.mesh);
  Numbers file(out, is_binary);
  write_head(file, "4.1", all.lines());
  write_entities(file, task.mesh, runs, all);
  write_nodes(file, task, runs);
  write_elements(file, task, all);
  write_periodic(file, task.mesh);
  write_node_data(file, task);
  file.flush();
}

/// One element of version 2.2: a block of its own in binary.
void write_element2(Numbers& file, std::int64_t number, int type, std::int64_t physical, std::int64_t entity,
                    const std::vector<std::int64_t>& nodes) {
  constexpr int kTags = 2;  // physical group, entity
  if (file.is_binary())
    file.integer(type).integer(1).integer(kTags).integer(number);
  else
    file.integer(number).integer(type).integer(kTags);
  file.integer(physical).integer(entity + 1);
  for (const std::int64_t n : nodes) file.integer(n + 1);
  file.end();
}

/// Version 2.2 has one physical group for an element: the main one. Lines and points are those of groups.
void write_msh2(Output& out, const ExportTask& task, bool is_binary) {
  const SurfaceMesh& m = task.mesh;
  const AllPhysicals all(m);
  Numbers file(out, is_binary);
  write_head(file, "2.2", all.lines());
  file.line("$Nodes");
  file.line(std::to_string(task.n_nodes()));
  for (std::int64_t n = 0; n < task.n_nodes(); ++n) file.integer(n + 1).point(task.xyz(n)).end();
  file.end_section("Nodes");
  std::vector<LowElements> low = low_elements(task, all);
  std::int64_t n_elements = task.n_elements(), number = 0;
  for (const LowElements& block : low) n_elements += block.n_elements();
  file.line("$Elements");
  file.line(std::to_string(n_elements));
  for (std::int64_t i = 0; i < task.n_elements(); ++i) {
    const TriangleId t = task.triangle_of(i);
    write_element2(file, ++number, element_type(task, i >= task.n_triangles()), group_number(m, t), m.triangle_face[t],
                   task.nodes_of(i));
  }
  for (const LowElements& block : low) {
    const std::vector<std::int64_t> tags = all.of_entity(block.dim, block.entity);
    for (std::size_t i = 0; i < block.nodes.size(); i += block.n_nodes)
      write_element2(file, ++number, block.type, tags.empty() ? 0 : tags[0], block.entity,
                     std::vector<std::int64_t>(block.nodes.begin() + static_cast<std::ptrdiff_t>(i),
                                               block.nodes.begin() + static_cast<std::ptrdiff_t>(i + block.n_nodes)));
  }
  file.end_section("Elements");
  write_periodic2(file, m);
  write_node_data(file, task);
  file.flush();
}

}  // namespace

/// Gmsh's script that fills the mesh beside it: Gmsh fills no volume of a .msh alone, not even one that it names.
void export_geo(Output& out, const ExportTask& task) {
  out.text("// Fills " + task.stem + ".msh with tetrahedra: gmsh -3 " + task.stem + ".geo\nMerge \"" + task.stem +
           ".msh\";\nSurface Loop(1) = Surface{:};\nVolume(1) = {1};\nPhysical Volume(\"volume\") = {1};\n");
}

void export_msh(Output& out, const ExportTask& task) { write_msh4(out, task, false); }
void export_binary_msh(Output& out, const ExportTask& task) { write_msh4(out, task, true); }
void export_msh2(Output& out, const ExportTask& task) { write_msh2(out, task, false); }
void export_binary_msh2(Output& out, const ExportTask& task) { write_msh2(out, task, true); }

}  // namespace st
