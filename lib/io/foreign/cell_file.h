// Meshes of volumes and surfaces with values on their nodes, as solvers and other meshers write them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace st {

/// Cells as a file has them, unchecked but for the file's own structure.
struct CellFile {
  std::vector<Vec3> node_xyz;
  std::vector<std::int64_t> type;    ///< [n_cells] VTK's number
  std::vector<std::int64_t> offset;  ///< [n_cells+1] into `node`
  std::vector<std::int64_t> node;    ///< of all cells, from 0
  std::vector<double> value;         ///< [n_nodes][n_components]; components of tensors: xx yy zz xy yz xz, or rows
  std::vector<double> cell_value;    ///< the same at cells, where `value` is empty
  std::vector<std::int32_t> group;   ///< [n_cells]; empty: the file has no groups
  std::vector<std::pair<std::string, std::int32_t>> group_name;  ///< of groups that have one
};

/// Arrays of lengths that are looked for where none is named.
inline constexpr const char* kUsualSizes[] = {"size", "metric"};
/// The array of the cell data that holds their groups; `group:NAME` in the field data is the number of one with a name.
inline constexpr const char* kGroups = "group";
/// "; there are 'p', 'U'", behind what a reader says of an array that it does not find.
inline std::string arrays_there(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "; there are '" : ", '").append(name).append("'");
  return text.empty() ? "; there is none" : text;
}
/// What a reader says where it finds none; `names`: of the arrays of point and cell data.
inline std::string missing_sizes(const std::string& array, std::span<const std::string> names) {
  return (array.empty() ? "has neither 'size' nor 'metric' among its point data; name its array of lengths: FILE:ARRAY"
                        : "has no array '" + array + "' among its point or cell data") +
         arrays_there(names);
}

/// `array`: of the point data, else of the cell data; empty: one of kUsualSizes of the point data. All throw
/// Error(kInput) naming file and place. `bytes`: the whole file.
CellFile parse_vtu_cells(const std::string& path, std::string_view bytes, const std::string& array);
/// Gmsh's parsed views (.pos), the first one: scalars or tensors at the corners of triangles, quadrilaterals and
/// volumes, by the first time step. Corners at one place are one node with the value that stands first.
CellFile parse_pos_cells(const std::string& path, std::string_view text);
/// Gmsh's MSH 2.0 to 2.2 or 4.1, text or binary: the view named `view`, or the first: $NodeData, or the mean at nodes
/// of $ElementData or $ElementNodeData. Nodes without a value have NaN.
CellFile parse_msh_cells(const std::string& path, std::string_view bytes, const std::string& view);
CellFile read_vtkhdf_cells(const std::string& path, const std::string& array);
/// INRIA's Medit: nodes and cells of a .mesh or .meshb.
CellFile parse_medit_mesh(const std::string& path, std::string_view bytes);
/// Values of a .sol or .solb for the mesh in `file`: those of SolAtVertices, else those at cells. `number`: of the
/// field, from 1; 0: the first that is no vector. With values at cells of volumes, cells of surfaces are left out.
void parse_medit_solution(const std::string& path, std::string_view bytes, std::int64_t number, CellFile& file);

/// Corners of a cell of VTK's type `type`, curved ones without their nodes between: 3 for triangles, 4 for tetrahedra
/// and quadrilaterals, 5 for pyramids, 6 for wedges, 8 for hexahedra; 0: vertices and lines, -1: any other.
int n_corners_of(std::int64_t type);
/// Whether cells of the type have a volume.
bool is_volume(std::int64_t type);

/// Tetrahedra that fill a cell of 4 to 8 corners. A quadrilateral side is cut from its lowest node, so neighbours fit.
void split_volume(std::int64_t type, const std::int32_t* corner, std::vector<std::array<std::int32_t, 4>>& tets);
/// One or two triangles.
void split_surface(std::int64_t type, const std::int32_t* corner, std::vector<std::array<std::int32_t, 3>>& triangles);

}  // namespace st
