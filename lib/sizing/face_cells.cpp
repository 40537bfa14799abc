#include "sizing/face_cells.h"

#include <algorithm>
#include <cstddef>

#include "sizing/patch_walk.h"

namespace st {
namespace {

struct PositionProbe {
  Vec3 x;
};

/// Halves a face down to the cells and notes the area in each.
class CellLocator {
 public:
  CellLocator(const Surface& surface, const OctreeView& octree) : surface_(surface), octree_(octree) {}

  PositionProbe probe(Vec2 uv) { return {surface_.point(uv)}; }

  bool visit(const Patch<PositionProbe>& patch, const PatchSize& size, int&) {
    int level = 0;
    const std::int32_t leaf = octree_.find_leaf(morton::encode(octree_.grid_point(size.center)), level);
    if (size.extent > octree_.cell_edge(level)) return true;
    // A patch that the loops only graze counts a little, so that a sliver between the probes is somewhere.
    const double area = patch.n_inside > 0 ? inside_area(patch) : 1e-3 * size.along_u * size.along_v;
    parts_.push_back({leaf, static_cast<float>(area)});
    return false;
  }

  std::vector<CellArea> take() { return std::move(parts_); }

 private:
  const Surface& surface_;
  const OctreeView& octree_;
  std::vector<CellArea> parts_;
};

/// Sums parts of the same leaf, in the order in which they came, and scales the total to `face_area`.
std::vector<CellArea> unite(std::vector<CellArea> parts, double face_area) {
  std::stable_sort(parts.begin(), parts.end(), [](const CellArea& a, const CellArea& b) { return a.leaf < b.leaf; });
  double total = 0;
  for (const CellArea& p : parts) total += p.area;
  const double scale = face_area > 0 && total > 0 ? face_area / total : 1;
  std::vector<CellArea> cells;
  for (std::size_t i = 0; i < parts.size();) {
    const std::int32_t leaf = parts[i].leaf;
    double area = 0;
    for (; i < parts.size() && parts[i].leaf == leaf; ++i) area += parts[i].area;
    if (area > 0) cells.push_back({leaf, static_cast<float>(scale * area)});
  }
  return cells;
}

}  // namespace

void FaceCells::append_face(std::span<const CellArea> cells) {
  for (const CellArea& c : cells) {
    leaf.push_back(c.leaf);
    area.push_back(c.area);
  }
  offsets.push_back(static_cast<std::int64_t>(leaf.size()));
}

std::vector<CellArea> locate_face(const Surface& surface, const LoopPolygons& loops, const OctreeView& octree, double face_area) {
  CellLocator locator(surface, octree);
  PatchWalk<PositionProbe, CellLocator> walk(loops, locator);
  walk.walk(surface.u_min(), surface.u_max(), surface.v_min(), surface.v_max(), surface.is_planar() ? 1 : 2);
  return unite(locator.take(), face_area);
}

std::vector<double> face_weights(const FaceCells& faces, std::span<const CellLength> lengths, double scale) {
  std::vector<double> weights(static_cast<std::size_t>(faces.n_faces()), 0.0);
  for (std::size_t f = 0; f < weights.size(); ++f)
    for (std::int64_t k = faces.offsets[f]; k < faces.offsets[f + 1]; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const double length = scale * static_cast<double>(lengths[faces.leaf[i]].length);
      weights[f] += static_cast<double>(faces.area[i]) / (length * length);
    }
  return weights;
}

}  // namespace st
