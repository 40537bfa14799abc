// st-raster: sample lengths of curves and trimmed surfaces into a balanced octree.
#pragma once

#include <optional>
#include <string>

#include "comm/communicator.h"
#include "stages/summary.h"

namespace st {

struct RasterStageOptions {
  std::string geometry;  ///< geometry artifact
  std::string output = "raster.hdf";
  std::string lmin;               ///< smallest length; "3", "0.1%", "0.25mm"; empty: lmax/64
  std::string lmax;               ///< largest length; empty: 2.5 % of the diagonal
  double alpha_deg = 10;          ///< largest turning of the normal or tangent along one length, degrees, (0, 90]
  std::string chord;              ///< largest distance of a length's chord from the geometry; empty: no limit
  std::string sizes;              ///< file of rules for groups, faces and edges; empty: none
  std::optional<int> gap_cells;   ///< lengths across gaps in the flow, [1, 100]
  std::optional<int> wall_cells;  ///< lengths across thin walls, inside the material, [1, 100]
  std::optional<int> edge_cells;  ///< lengths along each CAD edge at least, [1, 100]
  std::string trailing_edges;     ///< lengths at detected trailing edges: "LMIN:LMAX" or "LMAX"; empty: not detected
  std::string leading_edges;      ///< likewise at leading edges
  std::string edge_size = "0.3%chord";  ///< length at trailing edges and noses of lifting surfaces; "none": off
  int base_cells = 2;                   ///< lengths across the base of a blunt trailing edge, [1, 100]
  int chord_cells = 30;                 ///< lengths along the local chord of a lifting surface at least, [1, 1000]
  double cell_per_length = 2;           ///< raster boxes reach this many sample lengths, [1, 8]
  std::optional<int> max_cells;   ///< of the octree, >= 1: refused beyond; nullopt: what fits 80 % of the memory. No
                                  ///< part of the content
  bool surface = false;           ///< store a coarse surface of a closed model: st-prolong lets no length pass it
  bool allow_incomplete = false;  ///< exit code 0 although parts could not be sampled
};

/// Collective. Summary code kIncomplete when a part could not be sampled; the artifact is flagged then. Throws Error.
StageSummary run_raster(const RasterStageOptions& options, const Communicator& comm);

}  // namespace st
