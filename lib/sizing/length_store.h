// The smallest length that raster boxes store in each leaf of an octree. Internal to sizing.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/radix_sort.h"
#include "base/threads.h"
#include "sizing/octree_nodes.h"

namespace st {

inline constexpr std::uint64_t kNothingStored = ~std::uint64_t{0};

/// Range of grid cells that a raster box meets, both ends included; empty when it lies outside the root.
struct GridBox {
  GridPoint lo, hi;
  bool is_empty = false;
};

inline GridBox grid_box(const OctreeShape& shape, const RasterBox& box, double half) {
  const double scale = kCoordinateEnd / shape.edge;
  GridBox result;
  const auto range = [&](double center, double origin, std::uint32_t& lo, std::uint32_t& hi) {
    const double a = std::floor((center - half - origin) * scale), b = std::floor((center + half - origin) * scale);
    if (!(a < kCoordinateEnd && b >= 0)) {
      result.is_empty = true;
      return;
    }
    lo = static_cast<std::uint32_t>(std::max(a, 0.0));
    hi = static_cast<std::uint32_t>(std::min(b, kCoordinateEnd - 1.0));
  };
  range(box.center.x, shape.lo.x, result.lo.x, result.hi.x);
  range(box.center.y, shape.lo.y, result.lo.y, result.hi.y);
  range(box.center.z, shape.lo.z, result.lo.z, result.hi.z);
  return result;
}

/// Gives each leaf the smallest length of the boxes that meet it. A cell that lies in a box as a whole keeps the length
/// for all its leaves. Boxes of fine levels come first, and whole subtrees that hold smaller lengths already are
/// skipped, so that large boxes do not visit every fine cell inside them. Subtrees are filled on all threads.
class LengthStore {
 public:
  /// `levels` [n_boxes]: the coarsest one whose cells are not larger than the box. Both arrays have to outlive it.
  LengthStore(const OctreeShape& shape, std::span<const RasterBox> boxes, const std::vector<std::uint8_t>& levels)
      : shape_(shape),
        boxes_(boxes),
        levels_(levels),
        leaf_(shape.leaf_keys.size(), kNothingStored),
        node_(shape.node_children.size() / 8, kNothingStored),
        largest_(node_.size(), kNothingStored) {
    file_boxes();
    if (node_.empty()) whole_.node = ~0;
  }

  PackedLengths run() {
    parallel_for(stems_.size(), 1,
                 [this](std::size_t i, std::size_t) { fill(stems_[i], kCoordinateEnd >> kStemLevel); });
    fill(whole_, kCoordinateEnd);
    std::size_t begin = 0;
    for (std::size_t end = std::min<std::size_t>(node_.size(), 1); begin < end;) {  // level by level
      parallel_for(end - begin, kNodesPerPiece,
                   [&](std::size_t first, std::size_t last) { pass_down(begin + first, begin + last); });
      const std::size_t after = after_children(begin, end);
      begin = end;
      end = after;
    }
    return std::move(leaf_);
  }

 private:
  static constexpr std::size_t kStemLevel = 4, kBoxesPerPiece = 8'192, kNodesPerPiece = 8'192;
  /// A box, and where it is put in.
  struct Filing {
    std::uint32_t stem;  // the upper part of its key, or kWhole
    std::uint32_t box;
    std::uint8_t level;  // of the box
  };
  static constexpr std::uint32_t kWhole = 1u << (3 * kStemLevel);
  /// A subtree, and the boxes that are put in from its root on, those of fine levels first.
  struct Stem {
    std::int32_t node = 0;
    GridPoint lo = {};
    std::span<const Filing> boxes = {};
  };
  /// A box on its way through a subtree.
  struct Visitor {
    GridBox range;
    std::uint64_t value = 0;
    std::size_t n_visits = 0;  // of nodes, since the last refresh
  };

  static GridBox range_of(const OctreeShape& shape, const RasterBox& box) {
    return grid_box(shape, box, std::min(box.half, box.length));
  }

  void file_boxes() {
    std::vector<std::vector<Filing>> pieces((boxes_.size() + kBoxesPerPiece - 1) / kBoxesPerPiece);
    parallel_for(boxes_.size(), kBoxesPerPiece, [&](std::size_t begin, std::size_t end) {
      std::vector<Filing>& own = pieces[begin / kBoxesPerPiece];
      own.reserve(end - begin);
      for (std::size_t i = begin; i < end; ++i) file_box(static_cast<std::uint32_t>(i), own);
    });
    std::size_t n = 0;
    for (const std::vector<Filing>& own : pieces) n += own.size();
    filings_.reserve(n);
    for (const std::vector<Filing>& own : pieces) filings_.insert(filings_.end(), own.begin(), own.end());
    std::vector<Filing> other;
    radix_sort(filings_, other, [](const Filing& f) {
      return std::uint64_t{f.stem} * (kMaxLevel + 1) + static_cast<std::uint64_t>(kMaxLevel - f.level);
    });
    for (std::size_t first = 0, last = 0; first < n; first = last) {
      while (last < n && filings_[last].stem == filings_[first].stem) ++last;
      (filings_[first].stem == kWhole ? whole_ : add_stem(filings_[first].stem)).boxes =
          std::span<const Filing>(filings_).subspan(first, last - first);
    }
  }

  /// All cells of their own level that boxes meet are there, so all nodes that they meet at a coarser one.
  void file_box(std::uint32_t i, std::vector<Filing>& filings) const {
    constexpr int kShift = kMaxLevel - static_cast<int>(kStemLevel);
    if (levels_[i] <= kStemLevel) return filings.push_back({kWhole, i, levels_[i]});
    const GridBox range = range_of(shape_, boxes_[i]);
    if (range.is_empty) return;
    for (std::uint32_t z = range.lo.z >> kShift; z <= range.hi.z >> kShift; ++z)
      for (std::uint32_t y = range.lo.y >> kShift; y <= range.hi.y >> kShift; ++y)
        for (std::uint32_t x = range.lo.x >> kShift; x <= range.hi.x >> kShift; ++x)
          filings.push_back({static_cast<std::uint32_t>(morton::encode({x, y, z})), i, levels_[i]});
  }

  Stem& add_stem(std::uint32_t key) {
    std::int32_t node = 0;
    for (std::size_t level = 0; level < kStemLevel; ++level)
      node = shape_.node_children[8 * static_cast<std::size_t>(node) + (key >> (3 * (kStemLevel - 1 - level)) & 7)];
    const GridPoint at = morton::decode(key);
    constexpr int kShift = kMaxLevel - static_cast<int>(kStemLevel);
    return stems_.emplace_back(Stem{node, {at.x << kShift, at.y << kShift, at.z << kShift}, {}});
  }

  /// What nodes have, all below them have.
  void pass_down(std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node)
      for (std::size_t o = 0; o < 8; ++o) {
        const std::int32_t child = shape_.node_children[8 * node + o];
        std::uint64_t& value = child >= 0 ? node_[child] : leaf_[~child];
        value = std::min(value, node_[node]);
      }
  }

  /// The node after the last below those of a level.
  std::size_t after_children(std::size_t begin, std::size_t end) const {
    std::size_t link = 8 * end;  // nodes are numbered in the order of the links to them
    while (link > 8 * begin && shape_.node_children[link - 1] < 0) --link;
    return link == 8 * begin ? end : static_cast<std::size_t>(shape_.node_children[link - 1]) + 1;
  }

  /// Reaches `extent` from its lower corner.
  void fill(const Stem& stem, std::uint32_t extent) {
    const std::size_t n_nodes = stem.boxes.empty() ? 0 : count_nodes(stem.node);
    Visitor box;
    for (std::size_t i = 0; i < stem.boxes.size(); ++i) {
      const RasterBox& of = boxes_[stem.boxes[i].box];
      box.range = range_of(shape_, of);
      if (box.range.is_empty) continue;
      box.value = pack(of.length, of.cause);
      visit(box, stem.node, stem.lo, extent / 2);
      const bool is_last = i + 1 == stem.boxes.size() || stem.boxes[i + 1].level != stem.boxes[i].level;
      if (!is_last || box.n_visits < n_nodes) continue;  // until it is worth its time the old values are upper bounds
      box.n_visits = 0;
      refresh(stem.node);
    }
  }

  /// The bits of positive floats order like their values.
  static std::uint64_t pack(float length, std::int32_t cause) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(length)} << 32 | static_cast<std::uint32_t>(cause);
  }

  std::size_t count_nodes(std::int32_t node) const {
    if (node < 0) return 0;
    std::size_t n = 1;
    for (std::size_t o = 0; o < 8; ++o) n += count_nodes(shape_.node_children[8 * static_cast<std::size_t>(node) + o]);
    return n;
  }

  /// Returns the upper bound.
  std::uint64_t refresh(std::int32_t node) {
    if (node < 0) return leaf_[~node];
    std::uint64_t largest = 0;
    for (std::size_t o = 0; o < 8; ++o)
      largest = std::max(largest, refresh(shape_.node_children[8 * static_cast<std::size_t>(node) + o]));
    return largest_[node] = std::min(largest, node_[node]);
  }

  /// The node's cell reaches 2*half from `lo`.
  void visit(Visitor& box, std::int32_t node, GridPoint lo, std::uint32_t half) {
    if (node < 0) {
      leaf_[~node] = std::min(leaf_[~node], box.value);
      return;
    }
    ++box.n_visits;
    if (largest_[node] <= box.value) return;
    if (is_inside(box.range, lo, 2 * half)) {
      node_[node] = std::min(node_[node], box.value);
      largest_[node] = box.value;
      return;
    }
    const GridPoint middle{lo.x + half, lo.y + half, lo.z + half};
    // children on the sides that the range meets, a bit each
    const unsigned met = side_mask(box.range.lo.x, box.range.hi.x, middle.x, 0x55, 0xaa) &
                         side_mask(box.range.lo.y, box.range.hi.y, middle.y, 0x33, 0xcc) &
                         side_mask(box.range.lo.z, box.range.hi.z, middle.z, 0x0f, 0xf0);
    for (unsigned left = met; left != 0; left &= left - 1) {
      const auto o = static_cast<unsigned>(std::countr_zero(left));
      visit(box, shape_.node_children[8 * static_cast<std::size_t>(node) + o],
            {o & 1 ? middle.x : lo.x, o & 2 ? middle.y : lo.y, o & 4 ? middle.z : lo.z}, half / 2);
    }
  }

  static unsigned side_mask(std::uint32_t lo, std::uint32_t hi, std::uint32_t middle, unsigned low, unsigned high) {
    return (lo < middle ? low : 0u) | (hi >= middle ? high : 0u);
  }

  static bool is_inside(const GridBox& range, GridPoint lo, std::uint32_t extent) {
    const auto holds = [extent](std::uint32_t a, std::uint32_t first, std::uint32_t last) {
      return first <= a && a + (extent - 1) <= last;
    };
    return holds(lo.x, range.lo.x, range.hi.x) && holds(lo.y, range.lo.y, range.hi.y) &&
           holds(lo.z, range.lo.z, range.hi.z);
  }

  const OctreeShape& shape_;
  const std::span<const RasterBox> boxes_;
  const std::vector<std::uint8_t>& levels_;
  std::vector<Filing> filings_;
  std::vector<Stem> stems_;
  Stem whole_;                          // from the octree's root on: large boxes
  PackedLengths leaf_, node_;           // smallest so far: of a leaf, of all leaves of a node
  std::vector<std::uint64_t> largest_;  // upper bound of what the leaves of a node have
};

}  // namespace st
