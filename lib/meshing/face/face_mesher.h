// Triangulates one face: a pure function of (surface, boundary nodes, size field).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/shape/surface.h"
#include "meshing/face/face_node.h"
#include "meshing/face/failure_cause.h"
#include "sizing/size_field.h"

namespace st {

/// Neighbours the cosine between whose normals is less are folded onto each other.
inline constexpr double kFoldedCosine = -0.8;

/// Of the requested length: where the sides around a boundary node are shorter on the mean, the mesh grows from them.
inline constexpr double kShortSides = 0.6;
/// Times the length of such sides: what the node asks for.
inline constexpr double kGrowFrom = 1.25;

/// Places to refine that a face tells of, at most.
inline constexpr std::size_t kMostRefined = 64;

/// Makes a surface once more: one object serves one thread, for it remembers where it was evaluated last.
using SurfaceMaker = std::function<std::unique_ptr<Surface>()>;

/// The loops of a face as nodes in (u,v) and segments between them.
struct FaceBoundary {
  std::vector<FaceNode> nodes;
  std::vector<std::pair<std::int32_t, std::int32_t>> segments;  ///< node pairs; interior on the left
};

struct FaceMeshOptions {
  int enhance_rounds = 5;
  double max_turning_deg = 60;  ///< largest turning of the normal along one length, where L_min would ask for more
};

/// A place where the sizes must become smaller before the face can be meshed.
struct RefinementPoint {
  Vec3 x;
  double length = 0;       ///< requested length there
  double radius = 0;       ///< around x, where it is requested, too
  double factor = 0;       ///< of the length there so far: what it takes; 0: not known
  double n_triangles = 0;  ///< that need the factor
};

struct FaceMesh {
  std::vector<FaceNode> inner;
  std::vector<std::int32_t> corners;  ///< [3*n] boundary node i as i, inner node j as n_boundary + j; counter-clockwise
                                      ///< in (u,v)
  FailureCause cause = FailureCause::kNone;  ///< kNone: meshed
  std::vector<RefinementPoint> refinement;   ///< where smaller sizes may help
  int n_folds = 0;                           ///< triangles whose normal is against the surface's

  static auto fields(auto& x) { return std::tie(x.inner, x.corners, x.cause, x.refinement, x.n_folds); }
};

/// Meshes the face. Never throws for geometry: a face that cannot be meshed says why. Local, pure.
FaceMesh mesh_face(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                   const FaceMeshOptions& options);

}  // namespace st
