// Section $Periodic of Gmsh's files: which nodes are images of which.
#pragma once

#include <utility>
#include <vector>

#include "io/export/msh_numbers.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Nodes of one entity that are images of those of another.
struct PeriodicLink {
  int dim = 0;
  std::int32_t slave = 0, master = 0;
  Similarity motion;                                  ///< from the master
  std::vector<std::pair<NodeId, NodeId>> nodes = {};  ///< of the slave, of the master
};

/// By dimension: vertices, edges and faces of pairs, each a slave once and never of itself. A face has all its nodes,
/// those on its edges too.
std::vector<PeriodicLink> periodic_links(const SurfaceMesh& mesh);

/// The section in version 4.1, and in version 2.2, where it is text in either form. Nothing without pairs.
void write_periodic(Numbers& file, const SurfaceMesh& mesh);
void write_periodic2(Numbers& file, const SurfaceMesh& mesh);

}  // namespace st
