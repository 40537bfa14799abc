// What metrics ask for along the sides of triangles, asked for once at both ends of each.
#pragma once

#include <array>
#include <vector>

#include "mesh/surface_mesh.h"
#include "sizing/size_field.h"

namespace st {

class SideRequests {
 public:
  /// The sides of the triangles [begin, end) of the mesh, and these segments of edges. On all threads.
  SideRequests(const SurfaceMesh& mesh, TriangleId begin, TriangleId end,
               const std::vector<std::array<NodeId, 2>>& segments, const SizeField& metrics);

  /// The length of the side from `a` to `b` over what the metrics ask for in its direction, up to `most_at_a` and
  /// `most_at_b` at its ends. Precondition: one of the sides.
  double ratio(NodeId a, NodeId b, double most_at_a, double most_at_b) const;

 private:
  struct Side {
    NodeId low, high;
    double length = 0, at_low = 0, at_high = 0;  // its own, and asked for along it
  };
  std::vector<Side> sides_;  // ascending by (low, high), each once
};

}  // namespace st
