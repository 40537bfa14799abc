// The faces at each edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Which faces use each edge. A face that uses an edge twice, a seam, is there twice. The cost of making it is linear.
class EdgeFaces {
 public:
  explicit EdgeFaces(const ModelTables& t) { t.edge_faces(offsets_, faces_); }
  /// Ascending.
  std::span<const FaceId> operator[](EdgeId e) const {
    const auto first = static_cast<std::size_t>(offsets_[e]);
    return std::span(faces_).subspan(first, static_cast<std::size_t>(offsets_[e + 1]) - first);
  }
  /// Of an edge between two faces, or a seam: the one across.
  FaceId beyond(EdgeId e, FaceId f) const { return (*this)[e][0] == f ? (*this)[e][1] : (*this)[e][0]; }

 private:
  std::vector<std::int32_t> offsets_;  // [n_edges+1]
  std::vector<FaceId> faces_;
};

}  // namespace st
