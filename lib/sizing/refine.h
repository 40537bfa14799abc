// Octrees for programs that know cells only: fine enough to show what sources ask for.
#pragma once

#include <cstdint>
#include <vector>

#include "sizing/octree_field.h"

namespace st {

struct RefineOptions {
  double cell_per_length = 2;            ///< cells are never split below this many lengths
  std::int64_t max_leaves = 50'000'000;  ///< Error(kUsage) beyond
};

/// The octree of the field, refined until the lengths of its sources change by less than a quarter from the centre of a
/// cell to anywhere in it, balanced again. Cells within the core of a source stay as they are, however small its
/// length.
OctreeShape refine_octree(const OctreeField& field, const RefineOptions& options = {});

/// What each cell tells at its centre, before scale.
struct ShownOctree {
  OctreeShape shape;                ///< refined where there are sources
  std::vector<float> length;        ///< [leaves]
  std::vector<std::int32_t> cause;  ///< [leaves]
  std::vector<std::int32_t> leaf;   ///< [leaves] of the field's own octree, in which each lies
};

ShownOctree show_octree(const OctreeField& field);

}  // namespace st
