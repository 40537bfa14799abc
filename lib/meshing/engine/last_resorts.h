// What is done to triangles that no smaller sizes could mend.
#pragma once

#include <vector>

#include "base/executor.h"
#include "base/ids.h"
#include "meshing/engine/meshed_faces.h"

namespace st {

/// Collective. Folds and crossings: triangles of the same nodes without them, off the surface rather than through
/// themselves. Stays only where clearly fewer are left.
void refill_bad(MeshedFaces& faces, const Executor& executor);

/// Collective. Likewise, where nothing bad is left; otherwise all is as before. Whether it is so.
bool refill_all_bad(MeshedFaces& faces, const Executor& executor);

/// Collective. Triangles of these faces with angles above this one, radians, mended in space: the metric does not see
/// them, and where a surface folds its normals do not tell. Stays only where no more cross.
void mend_obtuse(MeshedFaces& faces, const std::vector<FaceId>& which, double above, const Executor& executor);

/// Collective. Likewise, of a stretched mesh that is finished: on faces that neither fold nor cross, where rows stay
/// wherever they can, only above kFarAngle. `has_metrics`: on these nothing.
void mend_last_obtuse(MeshedFaces& faces, bool has_metrics, const Executor& executor);

/// Collective. Triangles that touch because the CAD touches itself: a hair apart. Stays only where fewer are left.
void part_touching(MeshedFaces& faces, const Executor& executor);

}  // namespace st
