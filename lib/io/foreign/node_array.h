// Numbers on the nodes of a mesh, from another program's file.
#pragma once

#include <string>
#include <vector>

namespace st {

/// The array `name` of a file: .vtu (PointData, any of its encodings) or HDF5 (any other suffix;
/// /VTKHDF/PointData/name, /name, or a path with slashes). One number per node. Throws Error(kInput) for a missing file
/// or array, another number of values than `n_nodes`, and values that are not positive and finite; the message names
/// file, array and the first bad index.
std::vector<double> read_node_lengths(const std::string& path, const std::string& name, std::size_t n_nodes);

/// Likewise one to nine numbers per node, those of a node one after the other; any that are finite.
std::vector<double> read_node_values(const std::string& path, const std::string& name, std::size_t n_nodes);

}  // namespace st
