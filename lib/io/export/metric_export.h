// Metrics at the nodes of a mesh for mesh adapters and st-prolong.
#pragma once

#include <array>
#include <span>
#include <string>

#include "sizing/background.h"

namespace st {

/// The two files of INRIA's Medit for `path`, the mesh first: .solb and .meshb, binary, or .sol and .mesh, text. Throws
/// Error(kUsage) for another suffix.
std::array<std::string, 2> metric_files(const std::string& path);

/// Writes both files: triangles, or tetrahedra where there are some, and at each node xx yy zz xy yz xz of `metric`;
/// one length each where all of them are multiples of the unit matrix. Throws Error(kOutput).
void export_metric(const std::string& path, const BackgroundMesh& mesh, std::span<const std::array<double, 6>> metric);

}  // namespace st
