// The nearest of many points.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"

namespace st {

/// Points in a k-d tree.
class NearestNode {
 public:
  /// Of `xyz`, which outlives the object, these. n log n.
  NearestNode(std::span<const Vec3> xyz, std::vector<NodeId> nodes);
  /// The nearest, of equally near ones the lowest; kNone when there is no point. About log n, less if the point `guess`
  /// is near; kNone: none is known.
  NodeId find(Vec3 x, NodeId guess = kNone) const;

 private:
  void build(std::size_t begin, std::size_t end, int axis);
  void search(Vec3 x, std::size_t begin, std::size_t end, int axis, std::pair<double, NodeId>& best) const;

  std::span<const Vec3> xyz_;
  std::vector<NodeId> node_;
};

}  // namespace st
