// Traces the trimming curves of a face as polygons, as closely as its sizes need.
#pragma once

#include "geometry/model/model.h"
#include "geometry/shape/loop_polygons.h"
#include "sizing/model_limits.h"

namespace st {

/// Polygons of the face's loops: each coedge at the parameters of its measured curve, refined until the polygon follows
/// the trimming curve within 0.1 % of the face's (u,v) range, and further where sides cross each other.
LoopPolygons loop_polygons(const Model& model, FaceId face, const ModelLimits& limits);

}  // namespace st
