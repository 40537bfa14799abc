// Why a mesh is bad where it is bad: does the CAD leave no choice, or could the mesher have done better?
// (docs/checks.md)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/model/model.h"
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
  Vec3 xyz;                 ///< model unit
};

/// What was found by cause, and the worst places.
struct CauseList {
  static constexpr std::size_t kMaxPlaces = 10;
  std::array<std::int64_t, kNShapeCauses> count{};
  std::array<std::vector<CausePlace>, kNShapeCauses> worst;  ///< at most kMaxPlaces each, the worst first
  std::int64_t total() const;
  std::int64_t free() const { return count[static_cast<std::size_t>(ShapeCause::kFree)]; }
};

struct ShapeCauses {
  double angle_deg = 10;  ///< what counts as sharp
  CauseList sharp;        ///< triangles with an angle below it; value: the angle
  CauseList growth;       ///< neighbours that grow by more than kLargeGrowth; value: the growth
  CauseList lengths;  ///< edges outside 0.7 to 1.4 of the requested length beyond those of ConformityReport::forced;
                      ///< value: the ratio
};

/// `conformity` may be null. Local, linear in the mesh; the CAD is asked at the places found only. Precondition: `mesh`
/// was made on `model`. Angles are those of `corners`.
ShapeCauses find_shape_causes(const Model& model, const SurfaceMesh& mesh, const TriangleCorners& corners,
                              const QualityReport& quality, const ConformityReport* conformity, double angle_deg);

}  // namespace st
