// Requested lengths at the nodes of a mesh in little memory. Internal to mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "base/local_size.h"
#include "base/threads.h"
#include "mesh/conformity.h"

namespace st {

/// 8 bytes per node where lengths are the same in all directions, 48 elsewhere.
class NodeSizes {
 public:
  /// The places outlive the object. `along` null: `requested` is asked once at each node; else it for each length.
  NodeSizes(const std::vector<Vec3>& xyz, const RequestedSize& requested, const RequestedLength& along = {})
      : xyz_(xyz),
        requested_(requested),
        along_(along),
        length_(xyz.size()),
        stretched_((xyz.size() + kPerPiece - 1) / kPerPiece) {
    if (along_) return;
    parallel_for(xyz.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      int hint = 0;
      bool is_stretched = false;
      std::vector<LocalSize> sizes(end - begin);
      for (std::size_t n = begin; n < end; ++n) {
        const LocalSize& size = sizes[n - begin] = requested(xyz[n], hint);
        length_[n] = size.length;
        is_stretched |= size.along > size.length;
      }
      if (is_stretched) stretched_[begin / kPerPiece] = std::move(sizes);
    });
  }
  /// Of an edge along `d` at a place, model unit.
  double length(Vec3 x, Vec3 d, int& hint) const { return along_ ? along_(x, d, hint) : requested_(x, hint).in(d); }
  /// Likewise at a node.
  double length(NodeId n, Vec3 d, int& hint) const {
    if (along_) return along_(xyz_[static_cast<std::size_t>(n)], d, hint);
    const std::vector<LocalSize>& piece = stretched_[static_cast<std::size_t>(n) / kPerPiece];
    return piece.empty() ? length_[static_cast<std::size_t>(n)] : piece[static_cast<std::size_t>(n) % kPerPiece].in(d);
  }

 private:
  static constexpr std::size_t kPerPiece = 2'048;
  const std::vector<Vec3>& xyz_;
  RequestedSize requested_;
  RequestedLength along_;
  std::vector<double> length_;                     // [n_nodes] model unit
  std::vector<std::vector<LocalSize>> stretched_;  // by piece, empty: the same in all directions
};

}  // namespace st
