// Triangulates one face: a pure function of (surface, boundary nodes, size field).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"
#include "geometry/shape/surface.h"
#include "meshing/face/failure_cause.h"
#include "sizing/size_field.h"

namespace st {

/// The loops of a face as nodes in (u,v) and segments between them.
struct FaceBoundary {
  struct Node {
    Vec2 uv;
    Vec3 x;                   ///< space, model unit
    double h = 0;             ///< requested length
    std::int32_t id = kNone;  ///< node outside the face; equal for seam twins and for the nodes of a pole
    bool is_pole = false;     ///< on a degenerate edge
  };
  std::vector<Node> nodes;
  std::vector<std::pair<std::int32_t, std::int32_t>> segments;  ///< node pairs; interior on the left
};

struct FaceMeshOptions {
  int enhance_rounds = 5;
  double max_turning_deg = 60;  ///< largest turning of the normal along one length, where L_min would ask for more
};

/// A place where the sizes must become smaller before the face can be meshed.
struct RefinementPoint {
  Vec3 x;
  double length = 0;  ///< requested length there
};

struct FaceMesh {
  /// Nodes: first the boundary's (same order as FaceBoundary::nodes), then inner ones.
  struct InnerNode {
    Vec2 uv;
    Vec3 x;
    double h = 0;
  };
  std::vector<InnerNode> inner;
  std::vector<std::int32_t> corners;  ///< [3*n] boundary node i as i, inner node j as n_boundary + j; counter-clockwise
                                      ///< in (u,v)
  FailureCause cause = FailureCause::kNone;  ///< kNone: meshed
  std::vector<RefinementPoint> refinement;   ///< where smaller sizes may help
  int n_folds = 0;                           ///< triangles whose normal is against the surface's
};

/// Meshes the face. Never throws for geometry: a face that cannot be meshed says why. Local, pure.
FaceMesh mesh_face(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                   const FaceMeshOptions& options);

/// Only the test of the loops that mesh_face makes first: crossing or touching segments, as places to refine. Empty:
/// usable.
std::vector<RefinementPoint> check_boundary(const Surface& surface, const FaceBoundary& boundary);

}  // namespace st
