// The small features that were merged for meshing, as datasets of patches.hdf and mesh.hdf.
#pragma once

#include <cstdint>
#include <limits>

#include "io/hdf5/hdf5_file.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Number of edges where the artifact does not know it.
inline constexpr std::size_t kAnyEdge = std::numeric_limits<std::int32_t>::max();

/// Nothing is written when nothing was merged.
void write_merged(Hdf5Writer& writer, const MergedFeatures& merged);
/// Throws Error(kInput) for ids that are not below `n_edges` and `n_faces`.
MergedFeatures read_merged(const Hdf5Reader& reader, std::size_t n_edges, std::size_t n_faces);

}  // namespace st
