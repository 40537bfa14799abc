// How patches become one mesh, found out with one of them in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/merge.h"

namespace st {

/// Patches that are kept elsewhere.
struct PatchSource {
  std::vector<FaceId> face;                           ///< [n_patches] strictly ascending
  std::vector<std::int64_t> n_triangles;              ///< [n_patches]
  std::function<FacePatch(std::size_t patch)> shape;  ///< face, boundary, inner_xyz and triangles; from any thread

  std::size_t size() const { return face.size(); }
};

/// What check_topology() counts, and measure_mesh() measures.
struct MergedFacts {
  std::int32_t n_components = 0;
  std::int64_t n_boundary_edges = 0, n_nonmanifold_edges = 0, n_misoriented_edges = 0;
  double area = 0, volume = 0;
  bool is_closed() const { return n_boundary_edges == 0 && n_nonmanifold_edges == 0; }
};

/// The mesh that merge_patches() makes, without what lies inside faces.
struct MergeOrder {
  SurfaceMesh boundary;  ///< nodes on vertices and edges; no triangles, no labels
  PatchNumbers numbers;
  std::vector<std::uint8_t> is_turned = {};   ///< [n_patches]
  std::vector<std::uint8_t> has_unused = {};  ///< [n_patches] nodes inside that no triangle has, and which are left out
  OrientationReport orientation = {};
  MergedFacts facts = {};
};

/// Of `input` the patches are not used. Reads each patch twice; a third time where parts are inside out, and then all
/// places and triangles are in memory, 28 bytes per triangle. Else memory is that of the largest patch, or of patches
/// of a million triangles, at 12 bytes per triangle and 28 per node; and 16 bytes for each side between two nodes on
/// edges. Throws as merge_patches() does.
MergeOrder find_merge_order(const MergeInput& input, const PatchSource& source);

}  // namespace st
