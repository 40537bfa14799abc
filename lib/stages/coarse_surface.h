// The surface of a closed model as a few triangles: what tells st-prolong where the flow is.
#pragma once

#include "base/executor.h"
#include "features/face_roles.h"
#include "features/strip.h"
#include "geometry/model/model.h"
#include "io/hdf5/sizing_artifact.h"
#include "sizing/blanking.h"

namespace st {

/// Whether a model has a coarse surface: it is closed.
bool has_coarse_surface(const ModelTables& tables);

/// Local. Lengths of cells that grow through everything, across faces: exact enough for the coarse surface. `raster`:
/// as on rank 0.
std::vector<float> prolong_openly(const RasterArtifact& raster);

/// Collective. Meshes the model at a multiple of the raster's own sizes; complete on rank 0, the same at every number
/// of ranks. `lengths`: by prolong_openly(), of rank 0. Precondition: has_coarse_surface(). A face that cannot be
/// meshed, or not in `seconds`, leaves a hole, and a warning. `raster`: shape on every rank, lengths and samples on
/// rank 0. `strips`: those of the model, by find_strips().
BlankSurface make_coarse_surface(const Model& model, const FaceRoles& roles, const RasterArtifact& raster,
                                 std::vector<float> lengths, const std::vector<Strip>& strips, double seconds,
                                 const Executor& executor);

}  // namespace st
