// st-mesh: curve discretisation, then one advancing-front patch per face.
#pragma once

#include <string>

#include "comm/communicator.h"
#include "stages/summary.h"

namespace st {

struct MeshStageOptions {
  std::string geometry;  ///< geometry artifact
  std::string sizing;    ///< sizing artifact
  std::string output = "patches.hdf";
  std::string faces;            ///< mesh these only: 1-based ids and ranges, "12,17,30-40"; empty: all
  std::string group;            ///< mesh the faces of this group only; empty: all
  std::string edges;            ///< patches artifact of an earlier part, whose edge nodes are taken over; empty: none
  int enhance_rounds = 5;       ///< rounds of the enhancer, [0, 10]
  double merge_below = 0.05;    ///< of the requested length: shorter edges and narrower strips are merged, [0, 0.2]; 0:
                                ///< none
  double max_turning_deg = 30;  ///< largest turning of a CAD edge along one segment, degrees, (0, 60]
};

/// Collective. Summary code kIncomplete when a face has no patch. Throws Error.
StageSummary run_mesh(const MeshStageOptions& options, const Communicator& comm);

}  // namespace st
