#include "base/box_tree.h"

#include <algorithm>
#include <numeric>

namespace st {
namespace {

constexpr std::int32_t kFew = 4;  // items of a leaf

double along(Vec3 x, int axis) { return axis == 0 ? x.x : axis == 1 ? x.y : x.z; }

int longest_axis(const Box3& box) {
  const Vec3 d = box.hi - box.lo;
  return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box3> boxes) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (!boxes.empty()) build(boxes, 0, static_cast<std::int32_t>(boxes.size()));
}

/// Halves the items along the axis on which their centres lie farthest apart.
void BoxTree::build(std::span<const Box3> boxes, std::int32_t begin, std::int32_t end) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({{}, begin, end, 0});
  Box3 centers;
  for (std::int32_t i = begin; i < end; ++i) {
    nodes_[at].box.add(boxes[items_[i]]);
    centers.add(boxes[items_[i]].center());
  }
  if (end - begin <= kFew) return;
  const int axis = longest_axis(centers);
  const std::int32_t middle = begin + (end - begin) / 2;
  const auto key = [&](std::int32_t item) { return std::pair(along(boxes[item].center(), axis), item); };
  std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
  build(boxes, begin, middle);
  nodes_[at].right = static_cast<std::int32_t>(nodes_.size());
  build(boxes, middle, end);
}

}  // namespace st
