// A mesh put onto a moved geometry of the same topology.
#pragma once

#include <vector>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "sizing/size_field.h"

namespace st {

/// The mesh on the moved geometry.
struct MovedMesh {
  SurfaceMesh mesh;                ///< same nodes and triangles, new coordinates, t and (u,v)
  std::vector<TriangleId> spoilt;  ///< turned over or badly distorted by the move, ascending: to be made again
};

/// Nodes on vertices take these; nodes on edges keep their parameter, or their share of the edge's length where the
/// edge's range is another one; (u,v) inside a face are stretched as those of its boundary, in planes also turned and
/// mirrored, as axes in these may be others. Nothing is projected globally, so that the geometry may move as far as it
/// likes. Throws Error(kMismatch) when the mesh lies on other faces, edges or vertices than the model has (where
/// triangles of a face have nodes on edges that are not near it). With `smooth_for` nodes
/// inside faces give way where triangles became bad, see smooth_moved_face(), and triangles are judged by the metric of
/// these sizes where they are stretched. Local, linear.
MovedMesh move_mesh(const SurfaceMesh& old, const Model& model, const SizeField* smooth_for = nullptr);

}  // namespace st
