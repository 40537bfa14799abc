// Nodes in the middle of a mesh's sides, on the CAD.
#pragma once

#include <cstdint>

#include "geometry/model/model.h"
#include "mesh/mid_nodes.h"
#include "mesh/quad_pairs.h"

namespace st {

/// One node for each side of the elements: the point of the CAD edge or face closest to the side's middle. A side whose
/// point would lie further off than a third of its length, or that finds none, gets its middle and is counted in
/// `n_straight`. Precondition: the mesh has the segments of all edges (add_all_segments). Local; some microseconds per
/// side.
MidNodes make_mid_nodes(const SurfaceMesh& mesh, const QuadPairs& elements, const Model& model,
                        std::int64_t& n_straight);

}  // namespace st
