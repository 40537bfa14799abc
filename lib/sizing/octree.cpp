#include "sizing/octree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "base/assert.h"
#include "base/limits.h"
#include "base/radix_sort.h"
#include "base/threads.h"
#include "sizing/cell_limit.h"
#include "sizing/length_store.h"
#include "sizing/octree_nodes.h"

namespace st {
namespace {

/// Drops most repeated keys of a coherent stream before they cost memory; what it lets through twice the sort removes.
class RepeatFilter {
 public:
  RepeatFilter() { seen_.fill(~0ull); }
  bool is_new(std::uint64_t key) {
    std::uint64_t& slot = seen_[(key * 0x9e3779b97f4a7c15ull) >> 52];
    if (slot == key) return false;
    slot = key;
    return true;
  }

 private:
  std::array<std::uint64_t, 4096> seen_;
};

/// Coarsest level whose cells are not larger than the raster box.
std::uint8_t required_level(double root_edge, const RasterBox& box) {
  int level = 0;
  for (double cell = root_edge; level < kMaxLevel && cell > 2.0 * box.half; cell *= 0.5) ++level;
  return static_cast<std::uint8_t>(level);
}

constexpr std::size_t kBoxesPerPiece = 8'192;

std::vector<std::uint8_t> required_levels(double root_edge, std::span<const RasterBox> boxes) {
  std::vector<std::uint8_t> levels(boxes.size());
  parallel_for(boxes.size(), kBoxesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) levels[i] = required_level(root_edge, boxes[i]);
  });
  return levels;
}

/// Inner cells that the boxes from `begin` to the one before `end` ask for: the parents of all cells of the required
/// level that a box meets (at most eight per box). Some of them stand there more than once.
NodeLevels required_nodes(const OctreeShape& shape, std::span<const RasterBox> boxes,
                          std::span<const std::uint8_t> levels, std::size_t begin, std::size_t end) {
  NodeLevels nodes;
  std::array<std::unique_ptr<RepeatFilter>, kMaxLevel> filters;
  for (std::size_t i = begin; i < end; ++i) {
    if (levels[i] == 0) continue;
    const GridBox range = grid_box(shape, boxes[i], boxes[i].half);
    if (range.is_empty) continue;
    const int parent = levels[i] - 1, shift = kMaxLevel - parent;
    if (!filters[parent]) filters[parent] = std::make_unique<RepeatFilter>();
    for (std::uint32_t z = range.lo.z >> shift; z <= range.hi.z >> shift; ++z)
      for (std::uint32_t y = range.lo.y >> shift; y <= range.hi.y >> shift; ++y)
        for (std::uint32_t x = range.lo.x >> shift; x <= range.hi.x >> shift; ++x)
          if (const std::uint64_t key = morton::encode({x, y, z}); filters[parent]->is_new(key))
            nodes[parent].push_back(key);
  }
  return nodes;
}

/// Those of all boxes. Repeated ones are sorted out whenever the number of keys has doubled.
NodeLevels collect_required_nodes(const OctreeShape& shape, std::span<const RasterBox> boxes,
                                  std::span<const std::uint8_t> levels, std::uint64_t max_cells) {
  constexpr std::size_t kPiecesAtOnce = 64, kAtOnce = kPiecesAtOnce * kBoxesPerPiece, kFirstSort = std::size_t{1} << 22;
  NodeLevels nodes;
  std::array<std::size_t, kMaxLevel> next_sort;
  next_sort.fill(kFirstSort);
  for (std::size_t first = 0; first < boxes.size(); first += kAtOnce) {
    std::array<NodeLevels, kPiecesAtOnce> pieces;
    parallel_for(std::min(kAtOnce, boxes.size() - first), kBoxesPerPiece, [&](std::size_t begin, std::size_t end) {
      pieces[begin / kBoxesPerPiece] = required_nodes(shape, boxes, levels, first + begin, first + end);
    });
    for (std::size_t level = 0; level < nodes.size(); ++level) {
      std::vector<std::uint64_t>& keys = nodes[level];
      for (const NodeLevels& piece : pieces) keys.insert(keys.end(), piece[level].begin(), piece[level].end());
      if (keys.size() < next_sort[level]) continue;
      sort_unique(keys);
      next_sort[level] = std::max(kFirstSort, 2 * keys.size());
      require_cells(7.0 * static_cast<double>(keys.size()), max_cells);
    }
  }
  return nodes;
}

/// Writes leaves and links of an octree: a walk to the stems, then all of them at once. In a walk each level's nodes
/// are met in order.
class TreeLinker {
 public:
  TreeLinker(const NodeLevels& nodes, OctreeShape& shape) : nodes_(nodes), shape_(shape) {
    for (std::size_t l = 0; l < kMaxLevel; ++l) first_[l + 1] = first_[l] + nodes[l].size();
  }

  void run() {
    const std::size_t n_nodes = first_[kMaxLevel];
    require_countable(7 * n_nodes + 1, "cells of the octree");
    shape_.leaf_keys.resize(7 * n_nodes + 1);
    shape_.leaf_levels.resize(7 * n_nodes + 1);
    shape_.node_children.resize(8 * n_nodes);
    Next top;
    link(top, 0, 0, kStemLevel);
    parallel_for(stems_.size(), 1, [this](std::size_t i, std::size_t) {
      Next next = stems_[i].first;
      link(next, kStemLevel, stems_[i].key, kMaxLevel);
    });
  }

 private:
  static constexpr std::size_t kStemLevel = 4;
  /// What a walk comes to next: of each level a node, and a leaf.
  struct Next {
    std::array<std::size_t, kMaxLevel> node{};
    std::size_t leaf = 0;
  };
  struct Stem {
    std::uint64_t key;
    Next first;
  };

  /// Returns the node of a cell, or ~leaf. What is below nodes of the level `last` is left for later.
  std::int32_t link(Next& next, std::size_t level, std::uint64_t key, std::size_t last) {
    if (level == kMaxLevel || next.node[level] == nodes_[level].size() || nodes_[level][next.node[level]] != key) {
      shape_.leaf_keys[next.leaf] = key << (3 * (kMaxLevel - level));
      shape_.leaf_levels[next.leaf] = static_cast<std::uint8_t>(level);
      return ~static_cast<std::int32_t>(next.leaf++);
    }
    const std::size_t node = first_[level] + next.node[level];
    if (level == last) {
      stems_.push_back({key, next});
      pass_by(next, level, key);
      return static_cast<std::int32_t>(node);
    }
    ++next.node[level];
    for (std::uint64_t o = 0; o < 8; ++o)
      shape_.node_children[8 * node + o] = link(next, level + 1, key << 3 | o, last);
    return static_cast<std::int32_t>(node);
  }

  /// All that is in the cell.
  void pass_by(Next& next, std::size_t level, std::uint64_t key) const {
    std::size_t n = 0;
    for (std::size_t l = level; l < kMaxLevel; ++l) {
      const auto first = nodes_[l].begin() + static_cast<std::ptrdiff_t>(next.node[l]);
      const auto end = std::lower_bound(first, nodes_[l].end(), (key + 1) << (3 * (l - level)));
      n += static_cast<std::size_t>(end - first);
      next.node[l] = static_cast<std::size_t>(end - nodes_[l].begin());
    }
    next.leaf += 7 * n + 1;
  }

  const NodeLevels& nodes_;
  OctreeShape& shape_;
  std::array<std::size_t, kMaxLevel + 1> first_{};  // node of each level
  std::vector<Stem> stems_;
};

}  // namespace

// Finest level first: where a cell is split, all 26 neighbours of its size must exist, so their parents are split.
void close_nodes(NodeLevels& nodes) {
  for (int level = kMaxLevel - 1; level >= 0; --level) {
    std::vector<std::uint64_t>& split = nodes[level];
    sort_unique(split);
    if (level == 0) break;
    std::vector<std::uint64_t>& parents = nodes[level - 1];
    RepeatFilter filter;
    const std::uint32_t end = 1u << (level - 1);
    for (const std::uint64_t key : split) {
      const GridPoint c = morton::decode(key);
      const std::uint32_t x[2] = {c.x >> 1, (c.x >> 1) + ((c.x & 1) ? 1u : ~0u)};
      const std::uint32_t y[2] = {c.y >> 1, (c.y >> 1) + ((c.y & 1) ? 1u : ~0u)};
      const std::uint32_t z[2] = {c.z >> 1, (c.z >> 1) + ((c.z & 1) ? 1u : ~0u)};
      for (int o = 0; o < 8; ++o) {
        const GridPoint p{x[o & 1], y[o >> 1 & 1], z[o >> 2]};
        if (p.x >= end || p.y >= end || p.z >= end) continue;  // outside the root (below zero wraps around)
        const std::uint64_t parent = morton::encode(p);
        if (filter.is_new(parent)) parents.push_back(parent);
      }
    }
  }
}

void link_tree(const NodeLevels& nodes, OctreeShape& shape) { TreeLinker(nodes, shape).run(); }

Vec3 OctreeView::leaf_center(std::int32_t leaf) const {
  const GridPoint p = morton::decode(leaf_keys[leaf]);
  const double unit = edge / kCoordinateEnd, half = 0.5 * morton::cell_extent(leaf_levels[leaf]);
  return {lo.x + (p.x + half) * unit, lo.y + (p.y + half) * unit, lo.z + (p.z + half) * unit};
}

GridPoint OctreeView::grid_point(Vec3 xyz) const {
  const double scale = kCoordinateEnd / edge;
  const auto to_grid = [&](double x, double origin) {
    return static_cast<std::uint32_t>(std::min(std::max((x - origin) * scale, 0.0), kCoordinateEnd - 1.0));
  };
  return {to_grid(xyz.x, lo.x), to_grid(xyz.y, lo.y), to_grid(xyz.z, lo.z)};
}

void octree_root(const Box3& box, Vec3& lo, double& edge) {
  if (box.is_empty()) {
    lo = {-0.5, -0.5, -0.5};
    edge = 1;
    return;
  }
  const Vec3 extent = box.hi - box.lo;
  edge = 1.02 * std::max({extent.x, extent.y, extent.z});
  if (!(edge > 0)) edge = 1;
  const Vec3 c = box.center();
  lo = c - Vec3{0.5 * edge, 0.5 * edge, 0.5 * edge};
}

std::uint64_t count_leaves(const NodeLevels& nodes) {
  std::uint64_t n = 0;
  for (const std::vector<std::uint64_t>& level : nodes) n += level.size();
  return 7 * n + 1;
}

NodeLevels split_cells(const Box3& root, std::span<const RasterBox> boxes, std::uint64_t max_cells) {
  OctreeShape shape;
  octree_root(root, shape.lo, shape.edge);
  NodeLevels nodes = collect_required_nodes(shape, boxes, required_levels(shape.edge, boxes), max_cells);
  close_nodes(nodes);
  require_cells(static_cast<double>(count_leaves(nodes)), max_cells);
  return nodes;
}

void unite_nodes(NodeLevels& nodes, const NodeLevels& other) {
  for (std::size_t level = 0; level < nodes.size(); ++level) {
    std::vector<std::uint64_t> all;
    all.reserve(nodes[level].size() + other[level].size());
    std::set_union(nodes[level].begin(), nodes[level].end(), other[level].begin(), other[level].end(),
                   std::back_inserter(all));
    nodes[level] = std::move(all);
  }
}

OctreeShape make_shape(const Box3& root, const NodeLevels& nodes) {
  OctreeShape shape;
  octree_root(root, shape.lo, shape.edge);
  link_tree(nodes, shape);
  return shape;
}

PackedLengths store_boxes(const OctreeShape& shape, std::span<const RasterBox> boxes) {
  ST_ASSERT(std::all_of(boxes.begin(), boxes.end(), [](const RasterBox& b) { return b.half > 0 && b.length > 0; }));
  require_countable(boxes.size(), "samples on one rank");
  const std::vector<std::uint8_t> levels = required_levels(shape.edge, boxes);
  return LengthStore(shape, boxes, levels).run();
}

RasterOctree unpack_octree(OctreeShape shape, const PackedLengths& packed) {
  constexpr std::size_t kLeavesPerPiece = 8'192;
  ST_ASSERT(packed.size() == shape.leaf_keys.size());
  RasterOctree octree{std::move(shape), std::vector<float>(packed.size(), std::numeric_limits<float>::infinity()),
                      std::vector<std::int32_t>(packed.size(), kNone)};
  parallel_for(packed.size(), kLeavesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      if (packed[leaf] == kNothingStored) continue;
      octree.stored_length[leaf] = std::bit_cast<float>(static_cast<std::uint32_t>(packed[leaf] >> 32));
      octree.stored_cause[leaf] = static_cast<std::int32_t>(packed[leaf]);
    }
  });
  return octree;
}

RasterOctree build_octree(const Box3& root, std::span<const RasterBox> boxes) {
  OctreeShape shape = make_shape(root, split_cells(root, boxes));
  const PackedLengths packed = store_boxes(shape, boxes);
  return unpack_octree(std::move(shape), packed);
}

namespace {

const char* shape_defect(const OctreeView& octree) {
  const std::size_t n = octree.leaf_keys.size();
  if (n == 0 || octree.leaf_levels.size() != n || octree.node_children.size() % 8 != 0)
    return "array lengths do not fit";
  if (n != 7 * (octree.node_children.size() / 8) + 1) return "number of leaves does not fit the number of nodes";
  if (!(octree.edge > 0) || !std::isfinite(octree.edge) || !std::isfinite(norm2(octree.lo)))
    return "root cube has no size";
  std::uint64_t expected = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (octree.leaf_levels[i] > kMaxLevel) return "level out of range";
    if (octree.leaf_keys[i] != expected) return "leaves leave a gap, overlap or are out of order";
    expected += 1ull << (3 * (kMaxLevel - octree.leaf_levels[i]));
  }
  return expected == 1ull << (3 * kMaxLevel) ? nullptr : "leaves do not fill the root cube";
}

/// Follows all links: parents come before their children, and each leaf and node is reached once, from where its key
/// says. One pass over the nodes.
const char* link_defect(const OctreeView& octree) {
  constexpr const char* kDefect = "links and keys do not agree";
  struct Place {
    std::uint64_t key = 0;
    int level = -1;  // not reached yet
  };
  std::vector<Place> place(octree.node_children.size() / 8);
  if (place.empty()) return octree.leaf_levels[0] == 0 ? nullptr : kDefect;
  place[0].level = 0;
  for (std::size_t node = 0; node < place.size(); ++node) {
    const Place here = place[node];
    if (here.level < 0 || here.level >= kMaxLevel) return kDefect;
    for (std::uint64_t o = 0; o < 8; ++o) {
      const std::int32_t child = octree.node_children[8 * node + o];
      const std::uint64_t key = here.key | o << (3 * (kMaxLevel - 1 - here.level));
      if (child >= 0) {
        const std::size_t c = static_cast<std::size_t>(child);
        if (c <= node || c >= place.size() || place[c].level >= 0) return kDefect;
        place[c] = {key, here.level + 1};
      } else if (~child >= octree.n_leaves() || octree.leaf_keys[~child] != key ||
                 octree.leaf_levels[~child] != here.level + 1) {
        return kDefect;
      }
    }
  }
  return nullptr;
}

}  // namespace

const char* octree_tree_defect(const OctreeView& octree) {
  if (const char* defect = shape_defect(octree)) return defect;
  if (const char* defect = link_defect(octree)) return defect;
  return "";
}

}  // namespace st
