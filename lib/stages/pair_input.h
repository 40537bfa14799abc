// What --pairs asks for: pairs of faces, and the model with its vertices where these want them.
#pragma once

#include <string>

#include "io/hdf5/artifact.h"
#include "meshing/topology/periodic_pairs.h"

namespace st {

/// Of the geometry in `path`: `option` is "auto" or a file of tables [[pair]]; empty: no pairs. The vertices of
/// `geometry` are moved to the images of others, by no more than the tolerance of the CAD and 1e-6 of the diagonal.
/// Throws Error as PeriodicPairs, read_pair_file() and find_pairs() do. Local.
PeriodicPairs read_pairs(const std::string& option, GeometryArtifact& geometry, const std::string& path);

}  // namespace st
