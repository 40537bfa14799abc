// Vertices that are merged to one.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/ids.h"

namespace st {

/// Disjoint sets of vertices; the root of a set is its vertex of the lowest id.
class VertexSets {
 public:
  explicit VertexSets(std::int32_t n_vertices) : parent_(n_vertices) { std::iota(parent_.begin(), parent_.end(), 0); }
  VertexId root(VertexId v) const {
    while (parent_[v] != v) v = parent_[v];
    return v;
  }
  void unite(VertexId a, VertexId b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

 private:
  std::vector<VertexId> parent_;
};

}  // namespace st
