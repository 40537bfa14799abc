// The image of a meshed face under a motion.
#pragma once

#include <cstdint>
#include <functional>
#include <tuple>

#include "mesh/surface_mesh.h"

namespace st {

/// Where a boundary node of a patch is: EntityDim, vertex or edge, node on the edge (0 for a vertex). Ascending, the
/// order of a patch's boundary.
using RimPlace = std::tuple<std::uint8_t, std::int32_t, std::int32_t>;

/// What makes a patch another face's.
struct FaceImage {
  FaceId face = kNone;  ///< that has the image
  std::function<Vec3(Vec3)> motion;
  bool is_turned_over = false;  ///< its outside is not the image of the other's outside
  std::function<RimPlace(const RimPlace&)> boundary;
};

/// The patch with all places moved: its triangles are the others', turned over where asked for, so that both have the
/// same shapes. (u,v) are those of `patch`; see set_parameters() where the parametrisation is not an image, too.
/// Numbers of an earlier mesh are dropped. Local, n log n in the boundary nodes.
FacePatch image_of(const FacePatch& patch, const FaceImage& image);

}  // namespace st
