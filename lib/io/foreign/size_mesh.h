// Background meshes from the files of solvers and other meshers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sizing/background.h"

namespace st {

/// Whether read_size_mesh() reads files of this name.
bool is_size_mesh(const std::string& file);
/// The files that read_size_mesh() reads: one, or a mesh and its solution. Throws as that does.
std::vector<std::string> files_of_size_mesh(const std::string& file);

/// Lengths or metrics at the nodes of a mesh of volumes or surfaces: `file` is
///   - Medit's .sol or .solb, with the .mesh or .meshb of the same name beside it, or that mesh, with the solution
///     beside it, or MESH:SOLUTION. :N behind it names a field by its number from 1, else the first that is no vector
///     counts; of the nodes, or of the cells, whose mean counts at nodes,
///   - Gmsh's .msh (2.0 to 2.2, 4.1, text, binary) with $NodeData, $ElementData or $ElementNodeData, whose means count
///     at nodes: FILE:VIEW names one, else the first counts,
///   - a parsed view of Gmsh, .pos: scalars or tensors of the first time step,
///   - VTK's .vtu, or .vtkhdf, .hdf, .h5: FILE:ARRAY names the array of the point data, or else of the cell data, whose
///     mean counts at nodes; without it `size` or `metric`; one, six (xx yy zz xy yz xz) or nine components.
/// Cells are cut into tetrahedra; triangles count where there are none. Nodes without a cell are passed over. Throws
/// Error(kInput) naming file and place: for what cannot be read, and for a length that is not positive or a metric that
/// is not positive definite, with the number of such nodes and the first.
BackgroundMesh read_size_mesh(const std::string& file);

/// A number at each node of a mesh without lengths.
struct FieldMesh {
  BackgroundMesh mesh;                   ///< node_size is empty
  std::vector<double> value;             ///< [n_nodes]
  std::vector<std::int32_t> cell_group;  ///< [tets, or triangles where there are none]; empty: the file has no groups
  std::vector<std::pair<std::string, std::int32_t>> group_name;
};

/// A scalar field from the same files. Groups of cells are references of Medit, or the array `group` of VTK. Throws
/// Error(kInput) as read_size_mesh(), and for values that are no numbers, with the number of such nodes and the first.
FieldMesh read_field_mesh(const std::string& file);

}  // namespace st
