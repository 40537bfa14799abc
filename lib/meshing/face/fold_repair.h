// Folded places of a face's mesh, meshed again without its parametrisation.
#pragma once

#include "meshing/face/face_mesher.h"

namespace st {

/// Meshes the surroundings of folded triangles again, over the plane that they have in common: where du and dv are
/// nearly parallel, a triangle that is sound in (u,v) may be folded in space. A place stays as it is where its normals
/// turn too far for one plane, where it is no disc, or where the new triangles fold, too. `mesh`: of this boundary,
/// meshed; its `n_folds` and `refinement` are counted again. Local, pure; nothing happens without folds.
void repair_folds(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                  const FaceMeshOptions& options, FaceMesh& mesh);

}  // namespace st
