#include "sizing/near_faces.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/box_tree.h"
#include "base/sort_once.h"
#include "base/threads.h"

namespace st {
namespace {

Box3 box_of_leaf(const OctreeView& octree, std::int32_t leaf) {
  const Vec3 middle = octree.leaf_center(leaf), half = 0.5 * octree.cell_edge(octree.leaf_levels[leaf]) * Vec3{1, 1, 1};
  return {middle - half, middle + half};
}

std::vector<Box3> boxes_of(const FaceCells& cells, const OctreeView& raster) {
  std::vector<std::int32_t> leaves = cells.leaf;
  sort_once(leaves);
  std::vector<Box3> boxes;
  for (const std::int32_t leaf : leaves) boxes.push_back(box_of_leaf(raster, leaf));
  return boxes;
}

/// Of the ball around its corners' middle that has all of it, and as much more.
bool is_near(const BackgroundMesh& mesh, const std::array<std::int32_t, 4>& tet, const BoxTree& tree,
             std::span<const Box3> boxes) {
  Vec3 middle;
  for (const std::int32_t n : tet) middle = middle + 0.25 * mesh.node_xyz[n];
  double longest = 0, radius = 0;
  for (const std::int32_t a : tet) {
    radius = std::max(radius, distance(middle, mesh.node_xyz[a]));
    for (const std::int32_t b : tet) longest = std::max(longest, distance(mesh.node_xyz[a], mesh.node_xyz[b]));
  }
  const double reach2 = (radius + longest) * (radius + longest);
  bool found = false;
  tree.visit_near(
      middle, [&](std::int32_t, double d2) { return !found && d2 <= reach2; },
      [&](std::int32_t i) { found = found || distance2(middle, boxes[i]) <= reach2; });
  return found;
}

}  // namespace

void keep_near_tets(const FaceCells& cells, const OctreeView& raster, BackgroundMesh& mesh) {
  constexpr std::size_t kPerPiece = 4096;
  const std::vector<Box3> boxes = boxes_of(cells, raster);
  const BoxTree tree(boxes);
  std::vector<std::uint8_t> is_kept(mesh.tets.size());
  parallel_for(mesh.tets.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) is_kept[t] = is_near(mesh, mesh.tets[t], tree, boxes);
  });
  if (std::count(is_kept.begin(), is_kept.end(), 1) == 0) return;
  std::size_t n = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (is_kept[t]) mesh.tets[n++] = mesh.tets[t];
  mesh.tets.resize(n);
  const std::vector<std::int32_t> kept = number_used_nodes(mesh);
  keep_only(kept, mesh.node_xyz);
  keep_only(kept, mesh.node_size);
  if (!mesh.node_metric.empty()) keep_only(kept, mesh.node_metric);
}

Vec3 normal_near(const FaceCells& cells, const OctreeView& raster, Vec3 x) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 nearest;
  for (std::size_t i = 0; i < cells.leaf.size(); ++i) {
    const float *c = cells.plane[i].center, *n = cells.plane[i].normal;
    const Vec3 normal = normalized(Vec3{n[0], n[1], n[2]});
    if (normal == Vec3{}) continue;
    const Vec3 from_plane = dot(x - cells.origin - Vec3{c[0], c[1], c[2]}, normal) * normal, foot = x - from_plane;
    const double d2 = norm2(from_plane) + distance2(foot, box_of_leaf(raster, cells.leaf[i]));
    if (!(d2 < least)) continue;
    least = d2;
    nearest = normal;
  }
  return nearest;
}

}  // namespace st
