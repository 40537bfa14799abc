#include "sizing/gap_sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace st {
namespace {

constexpr double kFacing = -0.71;   // cosine between normals: facing surfaces are below (a V of 60 degrees is no gap)
constexpr double kTouching = 1e-3;  // of the smallest length: nearer surfaces touch
constexpr double kFill = 0.9;       // largest side of a tile over the edge of its raster box
constexpr int kMaxDepth = 10;       // halvings of the square around a disc
constexpr std::size_t kLeafDiscs = 4;

/// Binary tree of boxes around discs, halved at the median of the longest side.
class DiscTree {
 public:
  explicit DiscTree(const std::vector<FaceDisc>& discs) : discs_(discs), order_(discs.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!discs.empty()) build(0, discs.size());
  }

  /// Distance from x, along +-normal, to the next disc facing `normal`; `reach` when there is none nearer.
  double gap(const Vec3& x, const Vec3& normal, double nearest, double reach) const {
    if (!nodes_.empty()) search(0, x, normal, nearest, reach);
    return reach;
  }

 private:
  struct Node {
    Box3 box;
    std::size_t begin = 0, end = 0;
    std::size_t right = 0;  // index of the right child, the left one follows its parent; 0: a leaf
  };

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({{}, begin, end, 0});
    Box3 box, centres;
    for (std::size_t i = begin; i < end; ++i) {
      const FaceDisc& d = discs_[order_[i]];
      const Vec3 half{d.radius, d.radius, d.radius};
      box.add(d.x - half);
      box.add(d.x + half);
      centres.add(d.x);
    }
    nodes_[index].box = box;
    if (end - begin <= kLeafDiscs) return index;
    const Vec3 size = centres.hi - centres.lo;
    const auto coordinate = [&](std::size_t i) {
      const Vec3& x = discs_[i].x;
      return size.x >= size.y && size.x >= size.z ? x.x : size.y >= size.z ? x.y : x.z;
    };
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
      const double xa = coordinate(a), xb = coordinate(b);
      return xa != xb ? xa < xb : a < b;
    });
    build(begin, middle);
    const std::size_t right = build(middle, end);
    nodes_[index].right = right;
    return index;
  }

  /// Does the segment from x - reach n to x + reach n meet the box?
  static bool meets(const Box3& box, const Vec3& x, const Vec3& n, double reach) {
    double t0 = -reach, t1 = reach;
    const auto clip = [&](double lo, double hi, double at, double direction) {
      if (std::abs(direction) < 1e-12) return at >= lo && at <= hi;
      const double a = (lo - at) / direction, b = (hi - at) / direction;
      t0 = std::max(t0, std::min(a, b));
      t1 = std::min(t1, std::max(a, b));
      return t0 <= t1;
    };
    return clip(box.lo.x, box.hi.x, x.x, n.x) && clip(box.lo.y, box.hi.y, x.y, n.y) && clip(box.lo.z, box.hi.z, x.z, n.z);
  }

  void search(std::size_t index, const Vec3& x, const Vec3& normal, double nearest, double& reach) const {
    const Node& node = nodes_[index];
    if (!meets(node.box, x, normal, reach)) return;
    if (node.right) {
      search(index + 1, x, normal, nearest, reach);
      search(node.right, x, normal, nearest, reach);
      return;
    }
    for (std::size_t i = node.begin; i < node.end; ++i) {
      const FaceDisc& d = discs_[order_[i]];
      const double cosine = dot(d.normal, normal);
      if (cosine > kFacing) continue;
      const double t = dot(d.x - x, d.normal) / cosine;
      if (std::abs(t) > nearest && std::abs(t) < reach && distance(x + t * normal, d.x) <= d.radius) reach = std::abs(t);
    }
  }

  const std::vector<FaceDisc>& discs_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

/// Tiles the square around one disc.
class GapTiler {
 public:
  GapTiler(const DiscTree& tree, const FaceDisc& disc, int gap_cells, double cell_per_length, std::vector<RasterBox>& boxes)
      : tree_(tree), disc_(disc), gap_cells_(gap_cells), cell_per_length_(cell_per_length), boxes_(boxes) {
    const Vec3& n = disc.normal;
    const Vec3 across = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    s_ = normalized(cross(n, across));
    t_ = cross(n, s_);
  }

  void run() { tile(disc_.x, disc_.radius, 0); }

 private:
  double length_at(const Vec3& x) const {
    const double gap = tree_.gap(x, disc_.normal, kTouching * disc_.min_length, gap_cells_ * disc_.length);
    return std::max(gap / gap_cells_, disc_.min_length);
  }

  void tile(const Vec3& x, double half, int depth) {
    double length = length_at(x);
    for (const double a : {-half, half})
      for (const double b : {-half, half}) length = std::min(length, length_at(x + a * s_ + b * t_));
    if (!(length < disc_.length)) return;
    if (2 * half > kFill * cell_per_length_ * length && depth < kMaxDepth) {
      for (const double a : {-0.5 * half, 0.5 * half})
        for (const double b : {-0.5 * half, 0.5 * half}) tile(x + a * s_ + b * t_, 0.5 * half, depth + 1);
      return;
    }
    boxes_.push_back({x, static_cast<float>(0.5 * cell_per_length_ * length), static_cast<float>(length), disc_.cause});
  }

  const DiscTree& tree_;
  const FaceDisc& disc_;
  const int gap_cells_;
  const double cell_per_length_;
  std::vector<RasterBox>& boxes_;
  Vec3 s_, t_;
};

}  // namespace

void add_gap_boxes(const std::vector<FaceDisc>& discs, int gap_cells, double cell_per_length, std::vector<RasterBox>& boxes) {
  const DiscTree tree(discs);
  for (const FaceDisc& disc : discs) GapTiler(tree, disc, gap_cells, cell_per_length, boxes).run();
}

}  // namespace st
