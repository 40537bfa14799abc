// A mesh with values at its nodes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/artifact.h"

namespace st {

struct NodeValues {
  std::string name;  ///< of the array, without '/'
  std::size_t n_components = 1;
  std::vector<double> values;  ///< [n_nodes][n_components]
};

/// Throws Error(kUsage) for the name of an array that meshes have.
void require_free_name(const std::string& name);

/// As write_mesh(), and the point data `arrays` of free names; readers of meshes pass over them.
std::string write_mesh_with(const std::string& path, const MeshArtifact& mesh, std::span<const NodeValues> arrays);
/// The arrays of a mesh that write_mesh_with() stored, by name. Throws Error(kInput).
std::vector<NodeValues> read_stored_values(const std::string& path);

}  // namespace st
