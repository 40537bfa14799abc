// Edges that sewing gave to faces which do not meet there.
#pragma once

#include <TopoDS_Shape.hxx>
#include <vector>

namespace st::occt {

/// A face that an edge was wrongly joined to.
struct FalseJoin {
  TopoDS_Shape edge, face;
  double distance = 0;  ///< from the edge to where the face ends; 0: its faces cannot agree which side is outside
};

/// What no correct sewing leaves: edges with a tolerance above `limit` (positive, unit of the shape) that are further
/// than it from the end of a face that has them, however fast both curves run; and in faces that hang together without
/// a free edge, edges at which the sides of both faces, or of one, contradict those at all other edges. Of these the
/// shortest possible are named, with both faces: what shakes joins is shorter than a tolerance. Cost: as
/// count_free_edges(); curves of edges above the limit, and edge lengths where sides contradict, are sampled.
std::vector<FalseJoin> find_false_joins(const TopoDS_Shape& shape, double limit);

}  // namespace st::occt
