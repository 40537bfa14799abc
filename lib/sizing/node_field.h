// Lengths given on the nodes of a surface mesh, as a solver's adaptation asks for them.
#pragma once

#include <span>
#include <vector>

#include "base/lists_by_key.h"
#include "base/nearest_node.h"
#include "mesh/surface_mesh.h"
#include "sizing/size_field.h"

namespace st {

/// Linear within the triangle of the nearest node that is closest; between the nodes the length grows no faster than a
/// slope: larger ones are reduced. Where two walls are closer than a node's neighbours, a point may get the length of
/// the other wall.
class NodeField : public SizeField {
 public:
  /// `size` [n_nodes] > 0, finite. `slope` > 0: change of length per distance along mesh edges. `mesh` outlives it. n
  /// log n.
  NodeField(const SurfaceMesh& mesh, std::vector<double> size, double slope);
  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override;
  double min_size() const override { return min_size_; }
  double slope() const override { return slope_; }

 private:
  void limit_growth();

  const SurfaceMesh& mesh_;
  std::vector<double> size_;
  double slope_, min_size_ = 0;
  ListsByKey<> triangles_of_;  // by node
  NearestNode nearest_;
};

}  // namespace st
