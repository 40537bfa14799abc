#include "stages/common_octree.h"

#include "base/packer.h"
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

}  // namespace

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

std::vector<LengthSample> gather_samples(const std::vector<RasterBox>& own_boxes, Vec3 origin,
                                         const Communicator& comm) {
  Packer packer;
  packer.add(own_boxes);
  std::vector<RasterBox> all;
  for (const Bytes& bytes : comm.gather(packer.take())) {
    std::vector<RasterBox> boxes;
    Unpacker(bytes).get(boxes);
    all.insert(all.end(), boxes.begin(), boxes.end());
  }
  return sorted_samples(all, origin);
}

}  // namespace st
