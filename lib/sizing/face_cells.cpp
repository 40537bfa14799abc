#include "sizing/face_cells.h"

#include <algorithm>
#include <utility>

namespace st {

void append_face_cells(const OctreeView& octree, std::span<const RasterBox> boxes, double face_area, FaceCells& cells) {
  if (cells.offsets.empty()) cells.offsets.push_back(0);
  std::vector<std::pair<std::int32_t, double>> parts;
  double sum = 0;
  for (const RasterBox& b : boxes) {
    if (!(b.area > 0)) continue;
    parts.emplace_back(octree.find_leaf(morton::encode(octree.grid_point(b.center))), static_cast<double>(b.area));
    sum += static_cast<double>(b.area);
  }
  std::sort(parts.begin(), parts.end());
  const double scale = face_area > 0 && sum > 0 ? face_area / sum : 1;
  for (std::size_t i = 0; i < parts.size();) {
    double area = 0;
    const std::int32_t leaf = parts[i].first;
    for (; i < parts.size() && parts[i].first == leaf; ++i) area += parts[i].second;
    cells.leaf.push_back(leaf);
    cells.area.push_back(static_cast<float>(scale * area));
  }
  cells.offsets.push_back(static_cast<std::int64_t>(cells.leaf.size()));
}

std::vector<double> face_weights(const FaceCells& faces, std::span<const CellLength> lengths, double scale) {
  std::vector<double> weights(static_cast<std::size_t>(faces.n_faces()), 0.0);
  for (std::size_t f = 0; f < weights.size(); ++f)
    for (std::int64_t k = faces.offsets[f]; k < faces.offsets[f + 1]; ++k) {
      const double length = scale * static_cast<double>(lengths[static_cast<std::size_t>(faces.leaf[static_cast<std::size_t>(k)])].length);
      weights[f] += static_cast<double>(faces.area[static_cast<std::size_t>(k)]) / (length * length);
    }
  return weights;
}

}  // namespace st
