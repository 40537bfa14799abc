// What st-report shows of the CAD model itself: its edges as lines, and its faces where no mesh was made.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Why a line is drawn; the later of two wins.
enum class LineKind : std::uint8_t {
  kEdge = 0,
  kTrailing = 1,  ///< a detected trailing edge
  kLeading = 2,   ///< a detected leading edge
  kFree = 3,      ///< an edge of one face: the CAD is open there
  kUnmeshed = 4   ///< in a loop of a face that was not meshed
};

/// Lines of one kind, in one group of faces.
struct LineRun {
  LineKind kind = LineKind::kEdge;
  std::int32_t group = 0;  ///< of a face beside the edge, a wall before a far field or symmetry plane
  std::int64_t n_lines = 0;
};

/// The lines of one edge.
struct EdgeLines {
  EdgeId edge = kNone;
  std::int64_t n_lines = 0;
};

/// Edges as straight lines, sorted by kind and group.
struct CadLines {
  std::vector<Vec3> ends;  ///< [2*n_lines]
  std::vector<LineRun> runs;
  std::vector<EdgeLines> edges;  ///< in the same order
};

/// All edges but poles. `unmeshed`: faces, any order. Local; some microseconds per line.
CadLines cad_lines(const Model& model, std::span<const FaceId> unmeshed);

/// The faces as coarse triangles with groups and labels, in the shape of a mesh: to look at, not to measure.
SurfaceMesh facet_mesh(const Model& model);

}  // namespace st
