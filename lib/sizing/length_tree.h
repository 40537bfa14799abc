// A tree of boxes with lengths: which may tell the length at a point.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/box_tree.h"

namespace st {

/// A tree of boxes, and the smallest length in each of its nodes.
class LengthTree {
 public:
  LengthTree() = default;
  /// `least`: of each box; infinite: it counts only after lower().
  LengthTree(std::span<const Box3> boxes, std::span<const double> least)
      : LengthTree(BoxTree(boxes), [&](std::int32_t item) { return least[item]; }) {}
  /// `least_of(item)`: likewise, asked for once.
  template <class LeastOf>
  LengthTree(BoxTree tree, const LeastOf& least_of)
      : tree_(std::move(tree)), least_(tree_.nodes().size(), std::numeric_limits<double>::infinity()) {
    const std::span<const BoxTree::Node> nodes = tree_.nodes();
    for (std::size_t at = nodes.size(); at-- > 0;) {  // children first
      if (nodes[at].right != 0)
        least_[at] = std::min(least_[at + 1], least_[nodes[at].right]);
      else
        for (std::int32_t i = nodes[at].begin; i < nodes[at].end; ++i)
          least_[at] = std::min<double>(least_[at], least_of(tree_.items()[i]));
    }
  }
  /// From now on the box at `position` of items() has this length. As deep as the tree.
  void lower(std::int32_t position, double length) {
    const std::span<const BoxTree::Node> nodes = tree_.nodes();
    for (std::int32_t at = 0;;) {
      least_[at] = std::min(least_[at], length);
      if (nodes[at].right == 0) return;
      at = position < nodes[nodes[at].right].begin ? at + 1 : nodes[at].right;
    }
  }
  std::span<const std::int32_t> items() const { return tree_.items(); }
  /// Those whose box holds x, while one may be below `best`.
  template <class Visit>
  void visit_at(Vec3 x, const double& best, const Visit& visit) const {
    tree_.visit_near(
        x, [&](std::int32_t node, double d2) { return d2 == 0 && least_[node] < best; }, visit);
  }
  /// Those whose box comes within `radius` of x, while one may be below `best`.
  template <class Visit>
  void visit_within(Vec3 x, double radius, const double& best, const Visit& visit) const {
    tree_.visit_near(
        x, [&](std::int32_t node, double d2) { return d2 <= radius * radius && least_[node] < best; }, visit);
  }
  /// Those from which lengths that grow by `slope` may reach x below `best`.
  template <class Visit>
  void visit_from(Vec3 x, double slope, const double& best, const Visit& visit) const {
    const auto matters = [&](std::int32_t node, double d2) {
      const double room = best - least_[node];
      return room > 0 && slope * slope * d2 < room * room;
    };
    tree_.visit_near(x, matters, visit);
  }

 private:
  BoxTree tree_;
  std::vector<double> least_;  // [nodes of the tree]
};

}  // namespace st
