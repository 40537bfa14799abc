#include "mesh/patch_blocks.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "base/axis.h"
#include "base/boxes.h"
#include "base/morton.h"
#include "base/parallel_reserve.h"
#include "base/radix_sort.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "mesh/merge.h"
#include "mesh/node_key.h"

namespace st {
namespace {

constexpr std::size_t kPerPiece = 1024 * PatchBlocks::kTriangles;  // whose order is mixed

/// Numbers of points, in pieces that keep their places, each along a curve that fills the box of all: neighbours follow
/// each other where those of a piece are neighbours.
std::vector<std::int32_t> along_curve(std::size_t n, const Box3& box,
                                      const std::function<Vec3(std::size_t point)>& place) {
  constexpr double kCells = 1 << 10;  // per axis
  const Vec3 extent = box.hi - box.lo;
  const auto cell = [&](double x, double size) {
    return size > 0 ? static_cast<std::uint32_t>(std::clamp(x / size * kCells, 0.0, kCells - 1)) : 0;
  };
  std::vector<std::int32_t> order(n);
  parallel_for(n, kPerPiece, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint64_t> keys;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 x = place(i) - box.lo;
      keys.push_back(morton::encode({cell(x.x, extent.x), cell(x.y, extent.y), cell(x.z, extent.z)}) << 32 | i);
    }
    sort_unique(keys);
    std::transform(keys.begin(), keys.end(), order.begin() + static_cast<std::ptrdiff_t>(begin),
                   [](std::uint64_t k) { return static_cast<std::int32_t>(k); });
  });
  return order;
}

/// Of all nodes of the patch.
Box3 box_of(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p) {
  constexpr std::size_t kPerPart = 65'536;
  const std::size_t n = p.n_boundary + p.inner_xyz.size();
  std::vector<Box3> boxes(n / kPerPart + 1);
  parallel_for(n, kPerPart, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      boxes[begin / kPerPart].add(node_place(edges, vertex_xyz, p, static_cast<NodeId>(i)));
  });
  Box3 all;
  for (const Box3& box : boxes) all.add(box);
  return all;
}

/// Numbers of the triangles in blocks that meet the boxes there.
std::vector<TriangleId> near_triangles(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p,
                                       const PatchBlocks& blocks, std::span<const PatchBlocks::Meeting> near) {
  constexpr std::size_t kBlocksPerPiece = 32;
  std::vector<std::vector<TriangleId>> pieces(near.size() / kBlocksPerPiece + 1);
  parallel_for(near.size(), kBlocksPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (const std::int32_t t : blocks.triangles(near[i].block)) {
        Box3 box;
        for (const NodeId n : p.triangles[t].n) box.add(node_place(edges, vertex_xyz, p, n));
        if (meet(box, near[i].others)) pieces[begin / kBlocksPerPiece].push_back(t);
      }
  });
  std::vector<TriangleId> all;
  append_pieces(pieces, all);
  return all;
}

/// Of the nodes that another part may have.
std::vector<NodeKey> keys_of(const FacePatch& part) {
  std::vector<NodeKey> keys;
  keys.reserve(part.n_boundary + part.owner.size());
  for (std::int32_t i = 0; i < part.n_boundary; ++i) keys.push_back(boundary_key(part, i));
  for (const InnerNode& n : part.owner) keys.push_back(inner_key(n));
  return keys;
}

}  // namespace

Vec3 node_place(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p, NodeId n) {
  if (n >= p.n_boundary) return p.inner_xyz[n - p.n_boundary];
  if (p.boundary_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex)) return vertex_xyz[p.boundary_entity[n]];
  return edges.node_xyz[edges.first_node(p.boundary_entity[n]) + p.boundary_index[n]];
}

std::vector<Vec3> node_places(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p) {
  constexpr std::size_t kPerPart = 65'536;
  std::vector<Vec3> xyz;
  const std::size_t n = p.n_boundary + p.inner_xyz.size();
  parallel_reserve(xyz, n);
  xyz.resize(n);
  parallel_for(n, kPerPart, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) xyz[i] = node_place(edges, vertex_xyz, p, static_cast<NodeId>(i));
  });
  return xyz;
}

PatchBlocks::PatchBlocks(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p) {
  constexpr std::size_t kBlocksPerPiece = 1024;
  const std::size_t n = p.triangles.size();
  if (n == 0) return;
  const auto corner = [&](std::size_t t, int k) { return node_place(edges, vertex_xyz, p, p.triangles[t].n[k]); };
  const Box3 box = box_of(edges, vertex_xyz, p);
  order_ = along_curve(n, box, [&](std::size_t t) { return (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3; });
  levels_.emplace_back((n + kTriangles - 1) / kTriangles);
  parallel_for(levels_[0].size(), kBlocksPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      for (const std::int32_t t : triangles(static_cast<std::int32_t>(b)))
        for (int k = 0; k < 3; ++k) levels_[0][b].add(corner(t, k));
  });
  build();
}

PatchBlocks::PatchBlocks(std::vector<Box3> boxes) {
  if (boxes.empty()) return;
  levels_.push_back(std::move(boxes));
  build();
}

void PatchBlocks::build() {
  while (levels_.back().size() > 1) {
    const std::vector<Box3>& below = levels_.back();
    std::vector<Box3> above((below.size() + 1) / 2);
    for (std::size_t i = 0; i < below.size(); ++i) above[i / 2].add(below[i]);
    levels_.push_back(std::move(above));
  }
}

/// One step down: the pairs below one that meets, or the pair of two blocks.
void PatchBlocks::descend(const PatchBlocks& other, const Pair& pair, std::vector<Pair>& below,
                          std::vector<Meeting>& found) const {
  const auto [a, b] = pair;
  if (!meet(levels_[a.level][a.index], other.levels_[b.level][b.index])) return;
  const auto for_each_child = [](const PatchBlocks& tree, Place p, const auto& visit) {
    const auto n = static_cast<std::int32_t>(tree.levels_[p.level - 1].size());
    for (std::int32_t i = 2 * p.index; i < std::min(n, 2 * p.index + 2); ++i) visit(Place{p.level - 1, i});
  };
  if (a.level == 0 && b.level == 0)
    found.push_back({a.index, other.levels_[0][b.index]});
  else if (a.level >= b.level)
    for_each_child(*this, a, [&, other_one = b](Place child) { below.push_back({child, other_one}); });
  else
    for_each_child(other, b, [&, own = a](Place child) { below.push_back({own, child}); });
}

std::vector<PatchBlocks::Meeting> PatchBlocks::meeting(const PatchBlocks& other) const {
  constexpr std::size_t kWorthIt = 256;  // pairs to share
  if (levels_.empty() || other.levels_.empty()) return {};
  const auto top = [](const PatchBlocks& tree) { return Place{static_cast<std::int32_t>(tree.levels_.size()) - 1, 0}; };
  std::vector<Pair> open{{top(*this), top(other)}}, below;
  std::vector<std::vector<Meeting>> found(1);
  while (!open.empty() && open.size() < kWorthIt) {
    below.clear();
    for (const Pair& pair : open) descend(other, pair, below, found[0]);
    std::swap(open, below);
  }
  found.resize(1 + open.size());
  parallel_for(open.size(), 1, [&](std::size_t i, std::size_t) {
    std::vector<Pair> own{open[i]};
    while (!own.empty()) {
      const Pair pair = own.back();
      own.pop_back();
      descend(other, pair, own, found[1 + i]);
    }
  });
  std::vector<Box3> others(size());
  for (const auto& some : found)
    for (const Meeting& m : some) others[m.block].add(m.others);
  std::vector<Meeting> blocks;
  for (std::int32_t i = 0; i < size(); ++i)
    if (!others[i].is_empty()) blocks.push_back({i, others[i]});
  return blocks;
}

std::vector<std::pair<std::int32_t, std::int32_t>> meeting_pairs(std::span<const Box3> boxes) {
  Box3 all;
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].is_empty()) continue;
    order.push_back(static_cast<std::int32_t>(i));
    all.add(boxes[i]);
  }
  const int axis = longest_axis(all);
  const auto along = [&](const Vec3& x) { return component(x, axis); };
  std::sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
    return std::pair(along(boxes[i].lo), i) < std::pair(along(boxes[j].lo), j);
  });
  std::vector<std::int32_t> open;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const std::int32_t i : order) {
    std::erase_if(open, [&](std::int32_t j) { return along(boxes[j].hi) < along(boxes[i].lo); });
    for (const std::int32_t j : open)
      if (meet(boxes[i], boxes[j])) pairs.push_back(std::minmax(i, j));
    open.push_back(i);
  }
  return pairs;
}

SectionPart part_of(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& section,
                    const PatchBlocks& blocks, std::span<const PatchBlocks::Meeting> near, std::int32_t number) {
  SectionPart result;
  FacePatch& part = result.patch;
  part.face = section.face;
  result.triangle_number = near_triangles(edges, vertex_xyz, section, blocks, near);
  std::vector<NodeId> nodes, place(section.n_boundary + section.inner_xyz.size(), kNone);
  for (const TriangleId t : result.triangle_number)
    for (const NodeId n : section.triangles[t].n)
      if (std::exchange(place[n], 0) == kNone) nodes.push_back(n);
  const auto inner = std::partition(nodes.begin(), nodes.end(), [&](NodeId n) { return n < section.n_boundary; });
  part.n_boundary = static_cast<std::int32_t>(inner - nodes.begin());
  for (const NodeId n : std::span(nodes).first(part.n_boundary)) {
    part.boundary_dim.push_back(section.boundary_dim[n]);
    part.boundary_entity.push_back(section.boundary_entity[n]);
    part.boundary_index.push_back(section.boundary_index[n]);
  }
  for (const NodeId n : std::span(nodes).subspan(part.n_boundary)) {
    const std::int32_t i = n - section.n_boundary, n_own = section.n_own();
    part.inner_xyz.push_back(section.inner_xyz[i]);
    if (number != kNone) part.owner.push_back(i < n_own ? InnerNode{number, i} : section.owner[i - n_own]);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) place[nodes[i]] = static_cast<NodeId>(i);
  part.triangles.reserve(result.triangle_number.size());
  for (const TriangleId t : result.triangle_number) {
    const NodeId* n = section.triangles[t].n;
    part.triangles.push_back({{place[n[0]], place[n[1]], place[n[2]]}});
  }
  return result;
}

SurfaceMesh weld_parts(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& a,
                       const FacePatch& b) {
  const FacePatch* const parts[] = {&a, &b};
  const std::vector<NodeKey> keys[] = {keys_of(a), keys_of(b)};
  std::vector<NodeKey> all = keys[0];
  all.insert(all.end(), keys[1].begin(), keys[1].end());
  sort_once(all);
  PatchNumbers numbers(all.size());
  PatchUse uses[2];
  for (int i = 0; i < 2; ++i) {
    for (const NodeKey key : keys[i])
      uses[i].boundary.push_back(static_cast<std::int32_t>(std::ranges::lower_bound(all, key) - all.begin()));
    uses[i].n_inner = parts[i]->n_own();
    uses[i].n_triangles = std::ssize(parts[i]->triangles);
    numbers.add(uses[i]);
  }
  numbers.number();
  SurfaceMesh mesh = numbers.make_mesh();
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<NodeId> number = numbers.of_piece(i, uses[i].boundary, parts[i]->n_own());
    for (NodeId n = 0; n < std::ssize(number); ++n)
      mesh.node_xyz[number[n]] = node_place(edges, vertex_xyz, *parts[i], n);
    numbers.place_triangles(*parts[i], i, number, mesh);
  }
  return mesh;
}

}  // namespace st
