#include "base/box_tree.h"

#include <algorithm>
#include <numeric>

#include "base/axis.h"

namespace st {
namespace {

constexpr std::int32_t kFew = 4;  // items of a leaf

}  // namespace

BoxTree::BoxTree(std::span<const Box3> boxes)
    : BoxTree(static_cast<std::int32_t>(boxes.size()), [&](std::int32_t item) { return boxes[item]; }) {}

BoxTree::BoxTree(std::int32_t n, const std::function<Box3(std::int32_t)>& box_of) : items_(n) {
  std::iota(items_.begin(), items_.end(), 0);
  if (n == 0) return;
  std::vector<Vec3> centers;
  centers.reserve(n);
  for (std::int32_t item = 0; item < n; ++item) centers.push_back(box_of(item).center());
  nodes_.reserve(n);  // leaves have two items at least, but a single one
  build(centers, box_of, 0, n);
}

/// Halves the items along the axis on which their centres lie farthest apart.
void BoxTree::build(std::span<const Vec3> centers, const std::function<Box3(std::int32_t)>& box_of, std::int32_t begin,
                    std::int32_t end) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({{}, begin, end, 0});
  if (end - begin <= kFew) {
    for (std::int32_t i = begin; i < end; ++i) nodes_[at].box.add(box_of(items_[i]));
    return;
  }
  Box3 extent;
  for (std::int32_t i = begin; i < end; ++i) extent.add(centers[items_[i]]);
  const int axis = longest_axis(extent);
  const std::int32_t middle = begin + (end - begin) / 2;
  const auto key = [&](std::int32_t item) { return std::pair(component(centers[item], axis), item); };
  std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
  build(centers, box_of, begin, middle);
  const auto right = static_cast<std::int32_t>(nodes_.size());
  nodes_[at].right = right;
  build(centers, box_of, middle, end);
  nodes_[at].box.add(nodes_[at + 1].box);
  nodes_[at].box.add(nodes_[right].box);
}

}  // namespace st
