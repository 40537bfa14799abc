// What st-report shows of a size field: cells for a slice, and why each triangle has its size.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/hdf5/sizing_artifact.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Cells of an octree, blanked ones left out. Where there are more than asked for, the smallest are united, with the
/// least of their lengths.
struct SliceCells {
  std::vector<std::uint32_t> corner;  ///< [3*n_cells] lower corner, in edges of the root / 2^20
  std::vector<std::uint8_t> level;    ///< [n_cells] edge of the cell = edge of the root / 2^level
  std::vector<float> length;          ///< [n_cells] at the centre, times scale, model unit
};

/// Local, linear. At most `most` cells, or as many as the first two levels have.
SliceCells slice_cells(const SizingArtifact& sizing, std::size_t most);

/// Where the octree lies in the model: {"origin": [x, y, z], "axes": [[x, y, z], ...] of the root's edges}.
nlohmann::ordered_json slice_frame(const SizingArtifact& sizing);

/// Which rule decided the length at a triangle, seen from its CAD face.
enum class SizeReason : int {
  kOwnFace = 0,  ///< curvature or a rule of its own face
  kEdge = 1,
  kOtherFace = 2,  ///< growth from another face
  kSource = 3,     ///< a source or a background mesh
  kNone = 4        ///< the largest length
};

/// Causes of the lengths at the middles of triangles.
struct TriangleCauses {
  nlohmann::ordered_json list;       ///< [{"text": "face 12 \"WING\"", "reason": 0}, ...]: what `index` refers to
  std::vector<std::uint16_t> index;  ///< [n_triangles]
};

/// Local; a microsecond per triangle.
TriangleCauses triangle_causes(const SizingArtifact& sizing, const SurfaceMesh& mesh);

}  // namespace st
