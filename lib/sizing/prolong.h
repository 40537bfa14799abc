// Slope-limited prolongation: from stored sample lengths to a length in every cell.
#pragma once

#include "sizing/blanking.h"
#include "sizing/neighbours.h"
#include "sizing/octree.h"

namespace st {

/// Lengths of all cells after prolongation. Arrays are [n_leaves].
struct ProlongedLengths {
  std::vector<CellLength> cells;  ///< no point of a cell is below the smallest or above the largest length of the cell
                                  ///< and its neighbours
  std::vector<std::int32_t> cause;              ///< whose sample length it goes back to; kNone: the largest length
  std::vector<CellLength> second_cells = {};    ///< [n_split] of the second parts of cells that a surface splits; their
                                                ///< `upper` is negated in `cells`
  std::vector<std::int32_t> second_cause = {};  ///< [n_split]
};

struct ProlongOptions {
  double slope = 0.2;                      ///< largest change of length per distance, > 0
  double max_length = 0;                   ///< length where nothing asks for less, model unit, > 0
  std::span<const float> cell_slope = {};  ///< [n_leaves] slope in each cell, > 0; between two cells the mean holds.
                                           ///< Empty: `slope` everywhere
  bool wants_gradients = true;             ///< false: lengths are constant in each cell
  bool across_faces = false;               ///< lengths pass across faces alone, at a quarter of the cost: up to
                                           ///< sqrt(3) as far; not with blanking
};

/// Appends what the second parts of split leaves start from: what their leaf stores.
void add_second_parts(const Blanking& blanking, RasterOctree& octree);

/// Slopes of regions: lengths are prolonged with `options.slope`, and each cell takes the slope that `seed_slope` gives
/// to the site that its length comes from (0: options.slope). `seed_slope` and `stored_length` are [n_sites], as in
/// prolong(); the result is [n_leaves]. Unique, as prolong().
std::vector<float> spread_slopes(const Neighbours& neighbours, std::span<const float> stored_length,
                                 std::span<const float> seed_slope, const ProlongOptions& options,
                                 const Blanking* blanking = nullptr);

/// The largest lengths with h <= stored, h <= max_length and h(a) <= h(b) + slope * |centre a - centre b| for all cells
/// a, b that touch at a face, an edge or a corner. Minimum over paths of sums rounded in path order: a unique fixed
/// point, so the result is exactly reproducible; equal lengths take the smallest cause. Then the least-squares
/// gradient. O(n) in practice. Precondition: balanced octree. With `blanking` (may be null) lengths pass through its
/// open links only, and the stored arrays are [n_sites], see add_second_parts().
ProlongedLengths prolong(const Neighbours& neighbours, std::span<const float> stored_length,
                         std::span<const std::int32_t> stored_cause, const ProlongOptions& options,
                         const Blanking* blanking = nullptr);

}  // namespace st
