// Why a mesh is bad where it is bad: does the CAD leave no choice, or could the mesher have done better?
// (docs/checks.md)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/conformity.h"
#include "mesh/own_triangles.h"
#include "mesh/quality.h"
#include "mesh/surface_mesh.h"

namespace st {

/// In the order in which they are asked for.
enum class ShapeCause : std::uint8_t {
  kCorner,     ///< the CAD's edges meet in such an angle
  kShortEdge,  ///< a CAD edge of at most three segments, shorter than its sizes
  kStrip,      ///< the face is narrower than its sizes
  kSizeJump,   ///< the sizes asked for differ that much, or a CAD edge turns so much that its segments are shorter than
               ///< asked for
  kFree        ///< none of these: the mesher's
};
inline constexpr std::size_t kNShapeCauses = 5;

/// "corner", "short edge", "strip", "size jump", "free".
const char* cause_name(ShapeCause cause);

struct CausePlace {
  ShapeCause cause = ShapeCause::kFree;
  FaceId face = kNone;
  EdgeId edge = kNone;      ///< the CAD edge, when the cause is one
  VertexId vertex = kNone;  ///< the CAD vertex of a corner
  double value = 0;         ///< angle in degrees, ratio of areas' roots, length over request
  EdgeId beside = kNone;    ///< of a sharp triangle: the edge that it has a node or a side on, the smoothest of several
  double beside_deg = 0;    ///< largest angle between the normals on both sides of that edge, degrees
  Vec3 xyz;                 ///< model unit
  std::int64_t order = 0;   ///< in the mesh
};

/// What was found by cause, and the worst places.
struct CauseList {
  static constexpr std::size_t kMaxPlaces = 10;
  std::array<std::int64_t, kNShapeCauses> count{};
  std::array<std::vector<CausePlace>, kNShapeCauses> worst;  ///< at most kMaxPlaces each, the worst first
  std::int64_t n_smooth = 0;  ///< of sharp triangles: beside an edge whose normals stay within kSmoothEdgeDeg
  std::int64_t total() const;
  std::int64_t free() const { return count[static_cast<std::size_t>(ShapeCause::kFree)]; }
  static auto fields(auto& l) {
    return std::tie(l.count, l.worst[0], l.worst[1], l.worst[2], l.worst[3], l.worst[4], l.n_smooth);
  }
};
static_assert(kNShapeCauses == 5, "CauseList::fields() names each");

struct ShapeCauses {
  double angle_deg = 10;  ///< what counts as sharp
  CauseList sharp;        ///< triangles with an angle below it; value: the angle
  CauseList growth;       ///< neighbours that grow by more than kLargeGrowth; value: the growth
  CauseList lengths;  ///< edges outside 0.7 to 1.4 of the requested length beyond those of ConformityReport::forced;
                      ///< value: the ratio

  /// Those of another share of the mesh.
  void add(const ShapeCauses& other);
  static auto fields(auto& c) { return std::tie(c.angle_deg, c.sharp, c.growth, c.lengths); }
};

/// What of a share is to be explained.
struct ShapesToExplain {
  std::span<const QualityReport::LargeJump> jumps;
  std::span<const ConformityReport::OutsideEdge> edges;
  double angle_deg = 10;
};

/// Local, linear in the mesh; the CAD is asked at the places found only. Precondition: `mesh` was made on `model`, and
/// has all its nodes on edges and vertices. Angles are those of `corners`.
ShapeCauses find_shape_causes(const Model& model, const SurfaceMesh& mesh, const TriangleCorners& corners,
                              const ShapesToExplain& shapes, const OwnTriangles& own);
/// Of a whole mesh. `conformity` may be null.
ShapeCauses find_shape_causes(const Model& model, const SurfaceMesh& mesh, const TriangleCorners& corners,
                              const QualityReport& quality, const ConformityReport* conformity, double angle_deg);

}  // namespace st
