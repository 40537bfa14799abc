// st-mesh: curve discretisation, then one advancing-front patch per face.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/number_option.h"
#include "comm/communicator.h"
#include "stages/summary.h"

namespace st {

struct MeshStageOptions {
  std::string geometry;  ///< geometry artifact
  std::string sizing;    ///< sizing artifact
  std::string output = "patches.hdf";
  std::string faces;        ///< mesh these only: 1-based ids and ranges, "12,17,30-40"; empty: all
  std::string group;        ///< mesh the faces of this group only; empty: all
  std::string edges;        ///< patches artifact of an earlier part, whose edge nodes are taken over; empty: none
  std::string pairs;        ///< "auto", or a file with tables [[pair]]; empty: none
  bool begins_new = false;  ///< without what an earlier run has kept, see Resumption
  int enhance_rounds = 5;
  static constexpr NumberOption kEnhanceRounds{"--enhance-rounds", "N", "[0, 10]",
                                               "rounds of mesh improvement: swaps, smoothing, collapses"};
  double merge_below = 0.05;
  static constexpr NumberOption kMergeBelow{
      "--merge-below", "F", "[0, 0.2]",
      "merge CAD edges shorter and strips narrower than this times the requested length; 0: merge nothing"};
  double max_turning_deg = 30;
  static constexpr NumberOption kMaxTurning{
      "--max-turning", "DEG", "[0.001, 60]",
      "largest angle in degrees by which a CAD edge turns along one mesh segment"};
  std::optional<double> tile_triangles;
  static constexpr NumberOption kTile{
      "--tile", "N", "[0, 1e9]",
      "cut faces that expect more than 1.5 N triangles into tiles of about N, meshed in parallel; 0: cut none; "
      "default: a sixteenth of the triangles expected, 8000 to 25000"};
  std::optional<double> time_limit;
  static constexpr NumberOption kTimeLimit{
      "--time-limit", "SECONDS", "[0.1, 1e9]",
      "leave out a face that takes longer; default: 600 and 50 times what its triangles need"};
  std::string trace;  ///< table of the time of each task, see TaskTrace; empty: none
  double journal_after = 2;
  static constexpr NumberOption kJournalAfter{
      "--journal-after", "SECONDS", "[0, 1e9]",
      "keep finished faces in OUTPUT.journal from then on: the same command goes on there after a sudden end"};

  /// Throws Error(kUsage) for what no model could be meshed with.
  void validate() const;
};

/// Collective. Summary code kIncomplete when a face has no patch. Throws Error.
StageSummary run_mesh(const MeshStageOptions& options, const Communicator& comm);

}  // namespace st
