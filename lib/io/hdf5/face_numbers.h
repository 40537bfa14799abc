// Divisions of the faces beside the main groups, as arrays of triangles: parts and further tables of groups.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// One division; points into the labels of the mesh.
struct FaceNumbers {
  std::string name;                                    ///< of the array: "part", "group_bc"
  const std::vector<std::string>* names = nullptr;     ///< of number 1, 2 ...
  const std::vector<std::int32_t>* of_face = nullptr;  ///< [n_faces] from 0, kNone: none
};

/// Parts where there are two or more (by their paths), and every further table of groups that has one.
std::vector<FaceNumbers> face_numbers(const SurfaceMesh& mesh);

/// Number of each triangle, from 1; 0: none.
std::vector<std::int32_t> triangle_numbers(const SurfaceMesh& mesh, const FaceNumbers& numbers);

}  // namespace st
