// How much of each face lies in which cell: what weights and triangle counts are computed from, for any lengths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sizing/octree.h"

namespace st {

/// CSR by face: cells that hold part of the face, ascending, and the area in them.
struct FaceCells {
  std::vector<std::int64_t> offsets;     ///< [n_faces+1]
  std::vector<std::int32_t> leaf;        ///< [offsets.back()]
  std::vector<float> area;               ///< model unit squared, > 0

  std::int32_t n_faces() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
};

/// Appends the next face: the areas of its raster boxes (all of that face), summed per cell of the box's centre and scaled to `face_area` (model unit
/// squared; 0: unknown, not scaled).
void append_face_cells(const OctreeView& octree, std::span<const RasterBox> boxes, double face_area, FaceCells& cells);

/// Per face: sum of area over squared length. Times 4/sqrt(3): the number of triangles. `lengths` by leaf, times `scale`.
std::vector<double> face_weights(const FaceCells& faces, std::span<const CellLength> lengths, double scale);

}  // namespace st
