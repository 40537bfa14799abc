// How many cells an octree may have, what sampling will need at least, and how to refuse what passes the limit.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "base/error.h"
#include "base/limits.h"
#include "sizing/model_limits.h"
#include "sizing/octree.h"

namespace st {

/// Memory of st-raster per cell and rank, bytes, samples included: measured at one million to five million cells
/// (docs/dev/bench.md).
inline constexpr double kRasterBytesPerCell = 60;
/// Likewise of st-prolong, one process.
inline constexpr double kProlongBytesPerCell = 92;

/// The octree, or the samples for it, would pass the limit. Not to be taken for a part that cannot be sampled.
class TooManyCells : public Error {
 public:
  explicit TooManyCells(const std::string& message) : Error(ExitCode::kUsage, message) {}
};

/// Throws TooManyCells when the octree needs at least `n_cells` cells and that passes `max_cells`: with cells, memory
/// and what to do.
void require_cells(double n_cells, std::uint64_t max_cells);

/// Throws TooManyCells when at least `n_samples` are needed and that passes `max_samples`: before any is made.
void require_room_for(double n_samples, std::uint64_t max_samples);

/// Throws TooManyCells when one curve or face has more than `max_samples`, or all have.
void require_samples(std::uint64_t n_samples, std::uint64_t max_samples);

/// Fewest cells that sampling can lead to, from the areas of the faces and their largest lengths; nothing is sampled.
/// Two walls may share their cells.
double least_cells(const ModelTables& tables, const ModelLimits& limits);

/// Fewest samples of all faces, from their areas and largest lengths; nothing is sampled.
double least_samples(const ModelTables& tables, const ModelLimits& limits);

/// What asks for cells below the deepest level of the octree (kMaxLevel).
struct DepthLimit {
  std::uint64_t n_samples = 0;                                     ///< with raster boxes smaller than its cells
  float smallest_length = std::numeric_limits<float>::infinity();  ///< of these
  double smallest_cell = 0;                                        ///< edge of a cell of the deepest level, model unit

  void add(const DepthLimit& other);
};

/// `root`: the box of the model, as for build_octree.
DepthLimit find_depth_limit(const Box3& root, std::span<const RasterBox> boxes);

}  // namespace st
