#include "mesh/group_mesh.h"

#include <algorithm>
#include <set>

namespace st {
namespace {

template <class T>
void keep(const std::vector<T>& from, std::span<const NodeId> kept, std::vector<T>& to) {
  if (from.empty()) return;
  to.reserve(kept.size());
  for (const NodeId n : kept) to.push_back(from[n]);
}

}  // namespace

std::vector<std::vector<TriangleId>> triangles_by_group(const SurfaceMesh& mesh) {
  std::vector<std::vector<TriangleId>> of_group(mesh.labels.group_name.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    of_group[mesh.triangle_group[t]].push_back(static_cast<TriangleId>(t));
  return of_group;
}

void count_groups(const SurfaceMesh& mesh, std::span<const FaceId> faces, std::span<std::int64_t> count) {
  FaceId last = kNone;  // triangles come face by face
  bool is_counted = false;
  for (std::size_t t = 0; t < mesh.triangle_group.size(); ++t) {
    if (const FaceId face = mesh.triangle_face[t]; face != last)
      is_counted = std::ranges::binary_search(faces, last = face);
    const auto group = static_cast<std::size_t>(mesh.triangle_group[t]);
    if (is_counted && group < count.size()) ++count[group];
  }
}

std::string main_group(const FaceLabels& labels, std::span<const std::int64_t> count) {
  const auto most = std::ranges::max_element(count);
  if (most == count.end() || *most == 0) return "";
  const std::string& name = labels.group_name[static_cast<std::size_t>(most - count.begin())];
  return name == "default" ? "" : name;
}

SurfaceMesh mesh_of_triangles(const SurfaceMesh& mesh, std::span<const TriangleId> triangles) {
  std::vector<NodeId> old_to_new(mesh.node_xyz.size(), kNone), kept;
  for (const TriangleId t : triangles)
    for (const NodeId n : mesh.triangles[t].n) old_to_new[n] = 0;
  for (std::size_t n = 0; n < old_to_new.size(); ++n) {
    if (old_to_new[n] == kNone) continue;
    old_to_new[n] = static_cast<NodeId>(kept.size());
    kept.push_back(static_cast<NodeId>(n));
  }
  SurfaceMesh part;
  keep(mesh.node_xyz, kept, part.node_xyz);
  keep(mesh.node_entity_dim, kept, part.node_entity_dim);
  keep(mesh.node_entity, kept, part.node_entity);
  keep(mesh.node_t, kept, part.node_t);
  keep(mesh.node_size, kept, part.node_size);
  for (const TriangleId t : triangles) {
    const auto& n = mesh.triangles[t].n;
    part.triangles.push_back({{old_to_new[n[0]], old_to_new[n[1]], old_to_new[n[2]]}});
    for (std::size_t k = 0; k < 3; ++k) part.corner_uv.push_back(mesh.corner_uv[3 * static_cast<std::size_t>(t) + k]);
  }
  keep(mesh.triangle_face, triangles, part.triangle_face);
  keep(mesh.triangle_group, triangles, part.triangle_group);
  for (std::size_t i = 0; i < mesh.segment_edge.size(); ++i) {
    const NodeId a = old_to_new[mesh.segment_nodes[2 * i]], b = old_to_new[mesh.segment_nodes[2 * i + 1]];
    if (a == kNone || b == kNone) continue;
    part.segment_nodes.insert(part.segment_nodes.end(), {a, b});
    part.segment_edge.push_back(mesh.segment_edge[i]);
  }
  part.labels = mesh.labels;
  part.merged = mesh.merged;
  const std::set<FaceId> faces(part.triangle_face.begin(), part.triangle_face.end());
  std::erase_if(part.merged.pairs, [&](const FacePair& p) { return !faces.contains(p.a) || !faces.contains(p.b); });
  return part;
}

}  // namespace st
