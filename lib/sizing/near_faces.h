// What is near the faces of a model.
#pragma once

#include "sizing/background.h"
#include "sizing/face_cells.h"

namespace st {

/// Leaves the tetrahedra that come nearer to a cell with a face than their longest edge, with their nodes, and all
/// where none does. `cells` of `raster`, in the frame of the mesh. O(tetrahedra * log cells).
void keep_near_tets(const FaceCells& cells, const OctreeView& raster, BackgroundMesh& mesh);

/// The unit normal, of either sign, of the part of a face in a cell that is nearest to x, about; zero: there is none.
/// O(cells).
Vec3 normal_near(const FaceCells& cells, const OctreeView& raster, Vec3 x);

}  // namespace st
