// Lays single nodes and triangles of rows into the triangulation that the front goes on with. Internal to lib/meshing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshing/face/front.h"

namespace st {

class RowLayer {
 public:
  explicit RowLayer(FaceWork& work) : w_(work), m_(work.mesh) {}

  /// A node that is seen straight from node `from`; kNone: it is not, or it is nearer than a part of its distance from
  /// there to another node or to an edge that must stay.
  std::int32_t insert(const MeshNode& p, std::int32_t from);

  /// Triangles, their corners counter-clockwise, that are laid with all their edges; false, and nothing: an edge or a
  /// node is in the way.
  bool lay(const std::vector<std::array<std::int32_t, 3>>& corners);

  /// A node of a row stays. Its lengths are those that were laid, so that the front goes on from them.
  void settle(std::int32_t n, double height, double width);

 private:
  bool is_crowded(const MeshNode& p, double height) const;

  FaceWork& w_;
  Triangulation& m_;
};

}  // namespace st
