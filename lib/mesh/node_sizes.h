// Requested lengths at the nodes of a mesh in little memory. Internal to mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "base/local_size.h"
#include "base/threads.h"
#include "mesh/quality.h"

namespace st {

/// 8 bytes per node where lengths are the same in all directions, 48 elsewhere.
class NodeSizes {
 public:
  NodeSizes(const std::vector<Vec3>& xyz, const RequestedSize& requested)
      : length_(xyz.size()), stretched_((xyz.size() + kPerPiece - 1) / kPerPiece) {
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
  /// Of an edge along `d` at a node, model unit.
  double length(NodeId n, Vec3 d) const {
    const std::vector<LocalSize>& piece = stretched_[static_cast<std::size_t>(n) / kPerPiece];
    return piece.empty() ? length_[static_cast<std::size_t>(n)] : piece[static_cast<std::size_t>(n) % kPerPiece].in(d);
  }

 private:
  static constexpr std::size_t kPerPiece = 16'384;
  std::vector<double> length_;                     // [n_nodes] model unit
  std::vector<std::vector<LocalSize>> stretched_;  // by piece, empty: the same in all directions
};

}  // namespace st
