// The cuts between tiles, smoothed away. Internal to lib/meshing.
#pragma once

#include <cstdint>
#include <span>

#include "meshing/face/face_mesher.h"

namespace st {

/// Rows of triangles on each side of a cut that are enhanced.
inline constexpr int kSeamLayers = 4;

/// Enhances the triangles in a band about the first inner nodes, those of the cuts, and counts the folds in it.
/// Everything else stays as it is. `piece_of_cut` [n_cut] from 0: nodes of one piece of the cuts are enhanced together.
/// Pieces, and then the places where they meet, are enhanced on all threads, each with a surface from `make_surface`
/// (callable on all threads; empty: they share `surface`, which must remember nothing). Local, pure. Cost: that of the
/// enhancer, for some rows of triangles.
void improve_seams(const Surface& surface, const SurfaceMaker& make_surface, const FaceBoundary& boundary,
                   const SizeField& field, const FaceMeshOptions& options, std::span<const std::int32_t> piece_of_cut,
                   FaceMesh& mesh);

}  // namespace st
