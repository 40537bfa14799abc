#include "stages/common_octree.h"

#include <algorithm>
#include <limits>

#include "base/boxes.h"
#include "base/packer.h"
#include "base/share.h"
#include "sizing/cell_limit.h"
#include "sizing/octree_nodes.h"

namespace st {
namespace {

Bytes pack(const NodeLevels& nodes) {
  Packer packer;
  for (const std::vector<std::uint64_t>& level : nodes) packer.add(level);
  return packer.take();
}

NodeLevels unpack_nodes(const Bytes& bytes) {
  NodeLevels nodes;
  Unpacker unpacker(bytes);
  for (std::vector<std::uint64_t>& level : nodes) unpacker.get(level);
  return nodes;
}

/// Collective: the inner cells of all ranks on every rank.
NodeLevels unite_over_ranks(NodeLevels nodes, const Communicator& comm) {
  Bytes bytes;
  const std::vector<Bytes> all = comm.gather(comm.is_root() ? Bytes() : pack(nodes));
  for (std::size_t rank = 1; rank < all.size(); ++rank) unite_nodes(nodes, unpack_nodes(all[rank]));
  if (comm.is_root()) bytes = pack(nodes);
  comm.broadcast(bytes);
  return comm.is_root() ? nodes : unpack_nodes(bytes);
}

constexpr double kMargin = 1;      // around the walls, over their diagonal
constexpr double kWorthIt = 0.5;   // diagonal of what is left, over the model's
constexpr double kFarShare = 0.5;  // least length outside, over the far field's

/// What the samples of a rank say of the box around the walls.
struct OctreeNeed {
  std::uint64_t n_too_small = 0;  // for the cells of the model's octree
  float least_outside = std::numeric_limits<float>::infinity();
};

OctreeNeed find_need(const Box3& model, const Box3& near_walls, std::span<const RasterBox> boxes) {
  OctreeNeed need{find_depth_limit(model, boxes).n_samples};
  for (const RasterBox& box : boxes)
    if (!contains(near_walls, box.center)) need.least_outside = std::min(need.least_outside, box.length);
  return need;
}

}  // namespace

Box3 choose_octree_box(const Box3& model, const Box3& walls, std::span<const RasterBox> own_boxes, double far_length,
                       const Communicator& comm) {
  const double margin = kMargin * walls.diagonal();
  const Vec3 around{margin, margin, margin};
  const Box3 near_walls{walls.lo - around, walls.hi + around};
  if (walls.is_empty() || near_walls.diagonal() > kWorthIt * model.diagonal()) return model;
  Packer packer;
  packer.add(find_need(model, near_walls, own_boxes));
  OctreeNeed all;
  for (const Bytes& bytes : comm.gather(packer.take())) {
    OctreeNeed of_rank;
    Unpacker(bytes).get(of_rank);
    all.n_too_small += of_rank.n_too_small;
    all.least_outside = std::min(all.least_outside, of_rank.least_outside);
  }
  std::uint8_t is_near = all.n_too_small > 0 && all.least_outside >= kFarShare * far_length;
  share(comm, is_near);
  return is_near ? near_walls : model;
}

RasterOctree build_common_octree(const Box3& root, std::span<const RasterBox> own_boxes, std::uint64_t max_cells,
                                 const Communicator& comm) {
  NodeLevels nodes = split_cells(root, own_boxes, max_cells);
  if (comm.size() > 1) nodes = unite_over_ranks(std::move(nodes), comm);
  require_cells(static_cast<double>(count_leaves(nodes)), max_cells);
  OctreeShape shape = make_shape(root, nodes);
  PackedLengths packed = store_boxes(shape, own_boxes);
  comm.reduce_min(packed);
  return unpack_octree(std::move(shape), packed);
}

std::vector<std::vector<LengthSample>> gather_samples(std::span<const RasterBox> own_boxes, Vec3 origin,
                                                      const Communicator& comm) {
  std::vector<std::vector<LengthSample>> all = {sorted_samples(own_boxes, origin)};
  const std::vector<Bytes> sent = comm.gather(comm.is_root() ? Bytes() : packed(all.front()));
  for (std::size_t rank = 1; rank < sent.size(); ++rank) unpack(sent[rank], all.emplace_back());
  return all;
}

}  // namespace st
