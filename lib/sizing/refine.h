// Sources and background meshes burnt into the octree: cells fine enough for them, and their lengths in the cells.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sizing/octree.h"
#include "sizing/source.h"

namespace st {

/// A source, and what to call it when it is the cause of a length.
struct NamedSource {
  const SizeSource* source = nullptr;
  std::int32_t cause = kNone;
};

/// What a source asks for at the centre of a leaf.
struct SourceRequest {
  std::int32_t leaf = 0;
  float length = 0;       ///< model unit, > 0
  SampleStretch stretch;  ///< along 0: none
};

struct RefineOptions {
  double max_length = 0;                 ///< longer lengths are of no interest, model unit
  double cell_per_length = 2;            ///< cells are never split below this many lengths
  std::int64_t max_leaves = 50'000'000;  ///< Error(kUsage) beyond
};

/// The octree refined where the lengths of the sources change over a cell by more than half and more than linearly,
/// balanced again; stored lengths are the smaller of the raster's and the sources': the smallest of a source's lengths
/// in cells that meet its core, its length at the centre elsewhere. Cells that lie within one core stay as they are,
/// however small the length. Independent of the order of sources with different causes. Cost: cells times the sources
/// that matter there. `requests` (may be null) gets all that the sources ask for, by leaf.
RasterOctree refine_octree(const RasterOctree& raster, std::span<const NamedSource> sources,
                           const RefineOptions& options, std::vector<SourceRequest>* requests = nullptr);

}  // namespace st
