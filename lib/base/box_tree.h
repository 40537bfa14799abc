// A binary tree of boxes: what lies near a point is found without looking at all.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "base/boxes.h"

namespace st {

/// Depends on the boxes and their order alone. O(n log n) to build.
class BoxTree {
 public:
  struct Node {
    Box3 box;
    std::int32_t begin = 0, end = 0;  ///< its items are items()[begin, end)
    std::int32_t right = 0;           ///< second child; the first one follows the node. 0: a leaf
  };

  BoxTree() = default;
  explicit BoxTree(std::span<const Box3> boxes);
  /// Of `n` boxes that are made twice when they are asked for, and not kept.
  BoxTree(std::int32_t n, const std::function<Box3(std::int32_t item)>& box_of);

  bool is_empty() const { return nodes_.empty(); }
  /// Parents stand before their children; the root is the first.
  std::span<const Node> nodes() const { return nodes_; }
  std::span<const std::int32_t> items() const { return items_; }

  /// Calls visit(item) for the items of all leaves of which, as of all nodes above, matters(node, squared distance from
  /// x) holds when their turn comes; nearer nodes come first.
  template <class Matters, class Visit>
  void visit_near(Vec3 x, const Matters& matters, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<Ahead, kDeepest> stack;
    std::size_t n = 0;
    stack[n++] = {0, distance2(x, nodes_[0].box)};
    while (n > 0) {
      const auto [at, d2] = stack[--n];
      if (!matters(at, d2)) continue;
      const Node& node = nodes_[at];
      if (node.right == 0) {
        for (std::int32_t i = node.begin; i < node.end; ++i) visit(items_[i]);
        continue;
      }
      Ahead a{at + 1, distance2(x, nodes_[at + 1].box)}, b{node.right, distance2(x, nodes_[node.right].box)};
      if (b.distance2 < a.distance2) std::swap(a, b);
      stack[n++] = b;
      stack[n++] = a;
    }
  }

 private:
  /// Without first values: they would be set for the whole stack, which costs as much as a short search.
  struct Ahead {
    std::int32_t node;
    double distance2;
  };
  static constexpr std::size_t kDeepest = 80;  // halved until few are left: 2 per level of at most 31 levels
  void build(std::span<const Vec3> centers, const std::function<Box3(std::int32_t)>& box_of, std::int32_t begin,
             std::int32_t end);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> items_;
};

}  // namespace st
