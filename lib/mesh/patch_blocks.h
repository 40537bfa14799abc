// Where two patches are near each other, by boxes of some triangles each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Place of a patch's node: on a vertex, on an edge, or inside.
Vec3 node_place(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p, NodeId n);
/// Of all its nodes, boundary nodes first.
std::vector<Vec3> node_places(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p);

/// Boxes of a patch's triangles, some neighbours each, and a tree over these.
class PatchBlocks {
 public:
  static constexpr std::int32_t kTriangles = 64;  ///< of a block; the last has the rest

  PatchBlocks() = default;
  /// The cost is linear.
  PatchBlocks(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& p);
  /// Some blocks alone, without their triangles.
  explicit PatchBlocks(std::vector<Box3> boxes);

  std::int32_t size() const { return levels_.empty() ? 0 : static_cast<std::int32_t>(levels_[0].size()); }
  const Box3& operator[](std::int32_t block) const { return levels_[0][block]; }
  /// Places of its triangles in the patch.
  std::span<const std::int32_t> triangles(std::int32_t block) const {
    const auto begin = static_cast<std::size_t>(block) * kTriangles;
    return std::span(order_).subspan(begin, std::min<std::size_t>(kTriangles, order_.size() - begin));
  }
  /// The box of all; empty where there are no triangles.
  Box3 box() const { return levels_.empty() ? Box3() : levels_.back()[0]; }
  struct Meeting {
    std::int32_t block;
    Box3 others;  ///< over the blocks that it meets
  };
  /// Blocks that meet a block of the other, ascending.
  std::vector<Meeting> meeting(const PatchBlocks& other) const;
  std::vector<Meeting> meeting(const Box3& box) const { return meeting(PatchBlocks(std::vector<Box3>{box})); }

 private:
  struct Place {
    std::int32_t level, index;
  };
  using Pair = std::pair<Place, Place>;  // of this one and of another

  void build();
  void descend(const PatchBlocks& other, const Pair& pair, std::vector<Pair>& below, std::vector<Meeting>& found) const;
  std::vector<std::int32_t> order_;        // triangles by block
  std::vector<std::vector<Box3>> levels_;  // [0] the blocks; each box of the next one is over two of these
};

/// Every two boxes that meet, once, the lower number first; empty ones meet none. A sweep along the longest axis.
std::vector<std::pair<std::int32_t, std::int32_t>> meeting_pairs(std::span<const Box3> boxes);

/// Some triangles of a section, with their places and boundary alone.
struct SectionPart {
  FacePatch patch;                          ///< `owner` has none, or all nodes inside
  std::vector<TriangleId> triangle_number;  ///< [n_triangles] in the section

  static auto fields(auto& p) { return std::tie(p.patch, p.triangle_number); }
};

/// Those in the section's blocks `near` that meet the boxes there. Linear in these and in its nodes. `number`: of the
/// section, where they are compared with another one of the face: the part has owners then.
SectionPart part_of(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& section,
                    const PatchBlocks& blocks, std::span<const PatchBlocks::Meeting> near, std::int32_t number = kNone);

/// Two such parts, of different faces or sections, as places and triangles of one mesh: those of `a`, then of `b`.
SurfaceMesh weld_parts(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, const FacePatch& a, const FacePatch& b);

}  // namespace st
