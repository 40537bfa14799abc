// The cuts between tiles, smoothed away. Internal to lib/meshing.
#pragma once

#include "meshing/face/face_mesher.h"

namespace st {

/// Enhances the triangles in a band about the first `n_cut` inner nodes, those of the cuts, and counts the folds in it.
/// Everything else stays as it is. Local, pure. Cost: that of the enhancer, for some rows of triangles.
void improve_seams(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                   const FaceMeshOptions& options, std::int32_t n_cut, FaceMesh& mesh);

}  // namespace st
