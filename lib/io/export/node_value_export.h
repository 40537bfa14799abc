// Values at the nodes of a mesh in formats that have room for them.
#pragma once

#include <string>
#include <vector>

#include "io/export/msh_numbers.h"

namespace st {

/// With nodes on sides, which have the mean of the ends: [n_nodes()][n_components].
std::vector<double> values_at_nodes(const NodeValues& v, const ExportTask& task);

/// Of number k of an array: "p" where it has one, else "p_1".
std::string component_name(const NodeValues& v, std::size_t k);

/// Sections $NodeData: a view for each array of 1, 3 or 9 numbers, which are all that Gmsh knows, else one for each
/// number.
void write_node_data(Numbers& file, const ExportTask& task);

}  // namespace st
