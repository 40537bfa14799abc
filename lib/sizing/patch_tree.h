// Binary tree of boxes and cones of normals around sampled patches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box_tree.h"
#include "sizing/gap_patch.h"

namespace st {

/// Finds patches that may face a patch. Built in O(n log n); does not depend on anything but the patches and their
/// order.
class PatchTree {
 public:
  /// `patches` must outlive the tree.
  explicit PatchTree(std::span<const GapPatch> patches);

  /// Clears `found` and fills it with the patches, in the tree's order, that meet the prism swept by this patch along
  /// its normal by `reach` (model unit) to both sides and of whose normals some are opposed to some of the patch's by
  /// more than 135 degrees.
  void find_facing(std::size_t patch, double reach, std::vector<std::int32_t>& found) const;

 private:
  struct Cone {
    Vec3 axis;                    // unit
    double angle = 0;             // half the opening, radians
    double cosine = 1, sine = 0;  // of the angle
  };
  static Cone make_cone(Vec3 axis, double angle);
  static Cone cone_of(const Paraboloid& patch);
  static Cone united(const Cone& a, const Cone& b);

  std::span<const GapPatch> patches_;
  std::vector<Cone> cones_;
  std::vector<Box3> boxes_;
  BoxTree tree_;                  // of these
  std::vector<Cone> node_cones_;  // [nodes of the tree]
};

}  // namespace st
