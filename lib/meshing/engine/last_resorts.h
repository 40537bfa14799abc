// What is done to triangles that no smaller sizes could mend.
#pragma once

#include "base/executor.h"
#include "meshing/engine/meshed_faces.h"

namespace st {

/// Collective. Folds and crossings: triangles of the same nodes without them, off the surface rather than through
/// themselves. Stays only where clearly fewer are left.
void refill_bad(MeshedFaces& faces, const Executor& executor);

/// Collective. Likewise, where nothing bad is left; otherwise all is as before. Whether it is so.
bool refill_all_bad(MeshedFaces& faces, const Executor& executor);

/// Collective. Obtuse triangles of faces with folds or crossings: others are swapped where the surface's normals tell
/// whether they fold. Stays only where no more cross.
void swap_obtuse(MeshedFaces& faces, const Executor& executor);

/// Collective. Triangles that touch because the CAD touches itself: a hair apart. Stays only where fewer are left.
void part_touching(MeshedFaces& faces, const Executor& executor);

}  // namespace st
