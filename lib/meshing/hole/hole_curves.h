// New nodes on the marked segments of CAD edges, between the nodes that stay.
#pragma once

#include <vector>

#include "meshing/hole/hole_marks.h"
#include "meshing/topology/curve_discretiser.h"

namespace st {

/// Consecutive marked segments of one edge: from node `first` to node `last` (indices into the old EdgeMesh), both of
/// which stay.
struct SegmentRun {
  EdgeId edge = kNone;
  std::int32_t first = 0, last = 0;
};

/// The runs come by edge and place on it.
std::vector<SegmentRun> marked_runs(const HoleMesh& mesh, const HoleMarks& marks);

/// Nodes of a run; the first and the last are the nodes that stay, to the bit. `min_segments` of the whole edge are
/// left. Local, pure.
EdgeMesh discretise_run(const HoleMesh& mesh, const SegmentRun& run, const Curve& curve, const SizeField& field,
                        const CurveMeshOptions& options);

/// The edges with new nodes in their runs.
struct EdgeUpdate {
  EdgeMesh edges;  ///< node_request (of nodes that stay: the old) and node_previous (mesh node, or kNone) filled
  std::vector<std::int32_t> old_to_new;  ///< [old edges.node_t] into edges.node_*; kNone: inside a run
};

/// `fresh`: what discretise_run gave, run by run.
EdgeUpdate update_edges(const HoleMesh& mesh, const std::vector<SegmentRun>& runs, const EdgeMesh& fresh);

}  // namespace st
