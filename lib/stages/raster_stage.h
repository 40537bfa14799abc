// st-raster: sample lengths of curves and trimmed surfaces into a balanced octree.
#pragma once

#include <optional>
#include <string>

#include "base/number_option.h"
#include "comm/communicator.h"
#include "sizing/size_options.h"
#include "stages/summary.h"

namespace st {

struct RasterStageOptions {
  std::string geometry;  ///< geometry artifact
  std::string output = "raster.hdf";
  std::string lmin;       ///< smallest length; "3", "0.1%", "0.25mm"; empty: lmax/64
  std::string lmax;       ///< largest length; empty: 2.5 % of the diagonal
  double alpha_deg = 10;  ///< see SizeOptions for this and all that has no option below it
  std::string chord;      ///< largest distance of a length's chord from the geometry; empty: no limit
  std::string sizes;      ///< file of rules for groups, faces and edges; empty: none
  std::optional<int> gap_cells, wall_cells, edge_cells;
  std::string trailing_edges;  ///< lengths at detected trailing edges: "LMIN:LMAX" or "LMAX"; empty: not detected
  std::string leading_edges;   ///< lengths at detected leading edges, written the same way
  std::string end_size;        ///< length along the rims of tips and roots of lifting surfaces; empty: off
  std::string edge_size = "0.3%chord";  ///< length at trailing edges and noses of lifting surfaces; "none": off
  int base_cells = 2;
  static constexpr NumberOption kBaseCells{"--base-cells", "N", "[1, 100]",
                                           "edge lengths across the base of a blunt trailing edge"};
  int chord_cells = 30;
  static constexpr NumberOption kChordCells{
      "--chord-cells", "N", "[1, 1000]", "smallest number of edge lengths along the local chord of a lifting surface"};
  double cell_per_length = 4;
  static constexpr NumberOption kCellPerLength{"--cell-per-length", "N", "[1, 8]",
                                               "octree cell size in edge lengths: larger means fewer cells"};
  double max_aspect = 1;
  std::optional<int> max_cells;
  static constexpr NumberOption kMaxCells{
      "--max-cells", "N", "[1, 2147483647]",
      "refuse an octree with more cells than this; default: what 80% of the memory can hold"};
  double time_limit = 600;
  static constexpr NumberOption kTimeLimit{"--time-limit", "SECONDS", "[0.1, 1e9]",
                                           "do not sample a face that takes longer"};
  std::string trace;              ///< table of the time of each task, see TaskTrace; empty: none
  std::string preset;             ///< where options come from, for the record alone; empty: no preset
  bool asks_for_wings = false;    ///< somebody set `edge_size`: trailing edges that get none of it are warned of
  bool no_surface = false;        ///< leave out the coarse surface of a closed model: st-prolong lets no length pass it
  bool allow_incomplete = false;  ///< exit code 0 although parts could not be sampled

  /// Throws Error(kUsage) for what no model could be sampled with.
  void validate() const;
};

/// Collective. Summary code kIncomplete when a part could not be sampled; the artifact is flagged then. Throws Error.
StageSummary run_raster(const RasterStageOptions& options, const Communicator& comm);

}  // namespace st
