// What the readers of the mesh formats have in common.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace st {

/// Triangles as a file has them, unchecked but for the file's own structure.
struct TriangulationFile {
  std::vector<Vec3> node_xyz;
  std::vector<std::array<std::int64_t, 3>> triangles;  ///< nodes, from 0
  std::vector<std::int64_t> surface;                   ///< empty, or [n_triangles] number of the surface in the file
  std::vector<std::string> surface_name;               ///< empty, or of the surfaces 0, 1, 2 ...
  std::vector<double> node_size;                       ///< empty, or [n_nodes] requested length
};

/// All throw Error(kInput) naming file and place. `bytes`: the whole file.
TriangulationFile parse_msh(const std::string& path, const std::string& bytes);
TriangulationFile parse_vtu(const std::string& path, const std::string& bytes);
/// The array `name` of the point data of a .vtu, as many values as it has.
std::vector<double> parse_vtu_point_array(const std::string& path, const std::string& bytes, const std::string& name);
TriangulationFile parse_fro(const std::string& path, const std::string& bytes);
/// Polygons become triangles. Groups or objects of an OBJ file are its surfaces; where there is one, its materials are.
TriangulationFile parse_obj(const std::string& path, const std::string& bytes);
TriangulationFile parse_ply(const std::string& path, const std::string& bytes);
/// By the first bytes of a file.
bool is_obj(std::string_view head);
bool is_ply(std::string_view head);
/// An HDF5 file with a group /VTKHDF of type UnstructuredGrid, by whomever.
TriangulationFile read_vtkhdf(const std::string& path);
/// An HDF5 file that can be opened and has a group /VTKHDF, but not ours, /st.
bool is_foreign_vtkhdf(const std::string& path);

}  // namespace st
