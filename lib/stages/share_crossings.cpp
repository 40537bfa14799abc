#include "stages/share_crossings.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/boxes.h"
#include "base/morton.h"
#include "base/radix_sort.h"
#include "mesh/patch_crossing.h"

namespace st {
namespace {

constexpr std::size_t kTrianglesPerBlock = 256;

Box3 box_of(const SurfaceMesh& mesh, TriangleId t) {
  Box3 box;
  for (const NodeId n : mesh.triangles[t].n) box.add(mesh.node_xyz[n]);
  return box;
}

/// Own triangles of a share, near ones together: blocks of kTrianglesPerBlock.
std::vector<TriangleId> in_blocks(const SurfaceMesh& mesh, const OwnTriangles& own) {
  struct Place {
    std::uint64_t key;
    TriangleId triangle;
  };
  Box3 all;
  for (TriangleId t = own.begin; t < own.end; ++t) all.add(mesh.node_xyz[mesh.triangles[t].n[0]]);
  const double extent = std::max({all.hi.x - all.lo.x, all.hi.y - all.lo.y, all.hi.z - all.lo.z, 1e-300});
  std::vector<Place> places, other;
  places.reserve(own.size());
  const auto grid = [&](double x, double low) {
    return static_cast<std::uint32_t>((x - low) / extent * (kCoordinateEnd - 1));
  };
  for (TriangleId t = own.begin; t < own.end; ++t) {
    const Vec3 x = mesh.node_xyz[mesh.triangles[t].n[0]];
    places.push_back({morton::encode({grid(x.x, all.lo.x), grid(x.y, all.lo.y), grid(x.z, all.lo.z)}), t});
  }
  radix_sort(places, other, [](const Place& p) { return p.key; });
  std::vector<TriangleId> order;
  order.reserve(places.size());
  for (const Place& p : places) order.push_back(p.triangle);
  return order;
}

/// Around each block.
std::vector<Box3> block_boxes(const SurfaceMesh& mesh, std::span<const TriangleId> blocks) {
  std::vector<Box3> boxes((blocks.size() + kTrianglesPerBlock - 1) / kTrianglesPerBlock);
  for (std::size_t i = 0; i < blocks.size(); ++i) boxes[i / kTrianglesPerBlock].add(box_of(mesh, blocks[i]));
  return boxes;
}

/// Calls visit(item) for items of leaves whose boxes meet `box`.
template <class Visit>
void visit_meeting(const BoxTree& tree, const Box3& box, const Visit& visit) {
  const std::span<const BoxTree::Node> nodes = tree.nodes();
  if (nodes.empty()) return;
  std::vector<std::int32_t> stack{0};
  while (!stack.empty()) {
    const std::int32_t at = stack.back();
    const BoxTree::Node& node = nodes[at];
    stack.pop_back();
    if (!meet(node.box, box)) continue;
    if (node.right != 0) {
      stack.push_back(node.right);
      stack.push_back(at + 1);
      continue;
    }
    for (std::int32_t i = node.begin; i < node.end; ++i) visit(tree.items()[i]);
  }
}

struct Pairs {
  std::vector<TrianglePair> all;
  std::int64_t n_compared = 0;
  bool was_ended = false;
  static auto fields(auto& p) { return std::tie(p.all, p.n_compared, p.was_ended); }
};

}  // namespace

void ShareCrossings::add(const MeshSelection& share) {
  own_.all.push_back({share.first, share.first + (share.end - share.begin),
                      block_boxes(share.mesh, in_blocks(share.mesh, share.own()))});
}

/// Triangles of share `k` that meet boxes of others.
ShareCrossings::NearLists ShareCrossings::near_of(const Boxes& boxes, const Cover& cover, std::int32_t k) const {
  std::vector<TriangleId> numbers(static_cast<std::size_t>(cover.end - cover.begin));
  std::iota(numbers.begin(), numbers.end(), cover.begin);
  const MeshSelection share = file_.select(std::move(numbers), MeshFile::Rows::kPlaces);
  const std::vector<TriangleId> order = in_blocks(share.mesh, share.own());
  const std::vector<Box3> own = block_boxes(share.mesh, order);
  std::map<std::int32_t, std::vector<TriangleId>> near;
  for (std::size_t b = 0; b < own.size(); ++b) {
    std::vector<std::int32_t> others;
    visit_meeting(boxes.tree, own[b], [&](std::int32_t i) {
      if (boxes.share[i] != k && meet(boxes.all[i], own[b])) others.push_back(i);
    });
    if (others.empty()) continue;
    const std::size_t end = std::min(order.size(), (b + 1) * kTrianglesPerBlock);
    for (std::size_t j = b * kTrianglesPerBlock; j < end; ++j) {
      const Box3 box = box_of(share.mesh, order[j]);
      for (const std::int32_t i : others)
        if (meet(boxes.all[i], box)) near[boxes.share[i]].push_back(share.triangle_number[order[j]]);
    }
  }
  NearLists lists;
  for (auto& [other, triangles] : near) {
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    lists.all.push_back({k, other, AscendingNumbers(triangles)});
  }
  return lists;
}

ShareCrossings::NearMap ShareCrossings::find_near() const {
  Boxes boxes;
  std::vector<Cover> covers;
  std::int32_t first = 0;  // of this rank
  const std::vector<Covers> of_ranks = gather_for_all(ranks_, own_);
  for (std::size_t r = 0; r < of_ranks.size(); ++r) {
    if (static_cast<int>(r) == ranks_.rank()) first = static_cast<std::int32_t>(covers.size());
    covers.insert(covers.end(), of_ranks[r].all.begin(), of_ranks[r].all.end());
  }
  for (std::size_t k = 0; k < covers.size(); ++k)
    for (const Box3& box : covers[k].boxes)
      boxes.all.push_back(box), boxes.share.push_back(static_cast<std::int32_t>(k));
  boxes.tree = BoxTree(boxes.all);
  NearLists own;
  for (std::int32_t k = first; k < first + static_cast<std::int32_t>(own_.all.size()); ++k)
    for (Near& near : near_of(boxes, covers[k], k).all) own.all.push_back(std::move(near));
  NearMap all;
  for (NearLists& of_rank : gather_for_all(ranks_, own))
    for (Near& near : of_rank.all) all[{near.share, near.other}] = std::move(near.triangles);
  return all;
}

void ShareCrossings::find(CheckParts& parts) {
  Pairs own;
  int turn = 0;
  const NearMap near = find_near();
  for (const auto& [shares, first] : near) {
    const auto other = near.find({shares.second, shares.first});
    if (shares.first > shares.second || other == near.end()) continue;
    if (turn++ % ranks_.size() != ranks_.rank()) continue;
    std::vector<TriangleId> both = first.all();
    const auto n_first = static_cast<std::int32_t>(both.size());
    const std::vector<TriangleId> second = other->second.all();
    both.insert(both.end(), second.begin(), second.end());
    const MeshSelection share = file_.select(std::move(both), MeshFile::Rows::kPlaces);
    bool was_ended = false;
    std::int64_t n_compared = 0;
    for (const TrianglePair& p :
         find_crossings_between(share.mesh.node_xyz, share.mesh.triangles, n_first, was_ended, &n_compared))
      own.all.push_back({share.triangle_number[p.a], share.triangle_number[p.b], p.n_shared});
    own.n_compared += n_compared;
    own.was_ended |= was_ended;
  }
  for (const Bytes& bytes : ranks_.gather(packed(own))) {
    Pairs pairs;
    unpack(bytes, pairs);
    parts.pairs.insert(parts.pairs.end(), pairs.all.begin(), pairs.all.end());
    parts.n_compared += pairs.n_compared;
    parts.was_ended |= pairs.was_ended;
  }
}

}  // namespace st
