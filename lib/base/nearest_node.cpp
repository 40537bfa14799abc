#include "base/nearest_node.h"

#include <algorithm>
#include <limits>

#include "base/axis.h"

namespace st {
NearestNode::NearestNode(std::span<const Vec3> xyz, std::vector<NodeId> nodes) : xyz_(xyz), node_(std::move(nodes)) {
  build(0, node_.size(), 0);
}

void NearestNode::build(std::size_t begin, std::size_t end, int axis) {
  if (end - begin < 2) return;
  const std::size_t middle = (begin + end) / 2;
  std::nth_element(node_.begin() + begin, node_.begin() + middle, node_.begin() + end, [&](NodeId a, NodeId b) {
    const double xa = component(xyz_[a], axis), xb = component(xyz_[b], axis);
    return xa < xb || (xa == xb && a < b);
  });
  build(begin, middle, (axis + 1) % 3);
  build(middle + 1, end, (axis + 1) % 3);
}

NodeId NearestNode::find(Vec3 x, NodeId guess) const {
  std::pair best(guess == kNone ? std::numeric_limits<double>::infinity() : norm2(xyz_[guess] - x), guess);
  search(x, 0, node_.size(), 0, best);
  return best.second;
}

void NearestNode::search(Vec3 x, std::size_t begin, std::size_t end, int axis, std::pair<double, NodeId>& best) const {
  if (begin >= end) return;
  const std::size_t middle = (begin + end) / 2;
  const NodeId n = node_[middle];
  if (const std::pair here(norm2(xyz_[n] - x), n); here < best) best = here;
  const double side = component(x, axis) - component(xyz_[n], axis);
  const int next = (axis + 1) % 3;
  side < 0 ? search(x, begin, middle, next, best) : search(x, middle + 1, end, next, best);
  if (side * side > best.first) return;
  side < 0 ? search(x, middle + 1, end, next, best) : search(x, begin, middle, next, best);
}

}  // namespace st
