// Nodes on the CAD edges of a model.
#pragma once

#include <utility>
#include <vector>

#include "base/executor.h"
#include "geometry/model/model.h"
#include "mesh/edge_mesh.h"
#include "meshing/engine/facing_edges.h"
#include "meshing/engine/mesh_result.h"
#include "meshing/face/refinements.h"
#include "meshing/topology/mesh_topology.h"
#include "meshing/topology/periodic_pairs.h"

namespace st {

/// An edge of its own is meshed by the lengths along it; the second edge of a closed strip follows the first, edges of
/// narrow faces follow those across from them, and periodic edges have the images of others' nodes. Pure: the nodes
/// follow from the inputs, whoever makes them.
class EdgeMesher {
 public:
  /// All references outlive the object.
  EdgeMesher(const Model& model, const MeshTopology& topology, const SizeField& field, const MeshOptions& options,
             const Executor& executor);

  /// Collective. `present`, but for the nodes of `dirty` edges, which are made anew.
  EdgeMesh mesh(const std::vector<EdgeId>& dirty, const Refinements& refinements, const EdgeMesh& present) const;
  /// Edges that take their nodes from another one, with that one.
  std::vector<std::pair<EdgeId, EdgeId>> followers() const;

 private:
  struct Fresh;  // nodes that are being made
  EdgeMesh make_edge(EdgeId e, const Refinements& refinements) const;
  double exactness(const MeshTopology::Strip& strip) const;
  EdgeMesh make_mirrored(const MeshTopology::Strip& strip, const EdgeMesh& kept) const;
  void follow_leaders(const Refinements& refinements, const EdgeMesh& present, Fresh& fresh) const;
  void mirror(const std::vector<const MeshTopology::Strip*>& strips, Fresh& fresh) const;
  void follow_pairs(const std::vector<EdgeId>& dirty, Fresh& fresh) const;
  EdgeMesh make_image(EdgeId e, const EdgeMesh& leader) const;
  const PairFollower* pair_follower(EdgeId e) const;
  void end_at_vertices(EdgeId e, EdgeMesh& nodes, int min_segments) const;

  const Model& model_;
  const MeshTopology& topology_;
  const ModelTables& tables_;  // of topology_
  const SizeField& field_;
  const Executor& executor_;
  double max_turning_deg_, merge_below_;  // see MeshOptions
  std::vector<double> face_tolerance_;    // [n_faces] of their groups, or empty
  std::vector<int> min_segments_;
  std::vector<FacingEdges> facing_;
  const PeriodicPairs* pairs_;  // or null
};

}  // namespace st
