// st-remesh: redo only what no longer respects the sizes.
#pragma once

#include <string>

#include "base/number_option.h"
#include "comm/communicator.h"
#include "stages/mesh_stage.h"
#include "stages/summary.h"

namespace st {

struct RemeshStageOptions {
  std::string mesh;      ///< mesh artifact, or a triangulation of another program (read_triangulation)
  std::string geometry;  ///< geometry artifact the mesh was made on
  std::string sizing;    ///< new sizing artifact
  std::string output = "patches.hdf";
  std::string merged;  ///< mesh artifact to write instead of `output`, merged already; empty: none
  double too_long = 1.4;
  static constexpr NumberOption kTooLong{
      "--too-long", "F", "(1, 100]", "where sizes changed, remesh edges longer than this times the requested length"};
  double too_short = 0.7;
  static constexpr NumberOption kTooShort{
      "--too-short", "F", "(0, 1)", "where sizes changed, remesh edges shorter than this times the requested length"};
  std::string keep;            ///< group of which nothing changes; empty: none
  std::string sizes_on_nodes;  ///< FILE:ARRAY, lengths on the nodes of `mesh` that take the place of the sizing's;
                               ///< empty: none
  std::string interpolate;  ///< FILE:ARRAY[,ARRAY...], values on the nodes of `mesh` to be given to those of `merged`;
                            ///< empty: none
  bool moved = false;  ///< `geometry` is the mesh's own one moved, of the same topology: what is kept is put onto it
  bool keep_connectivity = false;  ///< with `moved`: sizes do not count, only triangles that the move spoilt are
                                   ///< remeshed
  std::string displacements;       ///< .vtu or .csv to write of how far nodes moved, with `moved`; empty: none
  std::string tolerance;  ///< length: how far nodes of a foreign mesh may lie from the CAD; empty: by its edges
  std::string made_for;   ///< sizing artifact that a foreign mesh was made for; empty: unknown
  bool dry_run = false;   ///< say how much would change, write nothing
  double journal_after = 2;
  static constexpr NumberOption kJournalAfter{
      "--journal-after", "SECONDS", "[0, 1e9]",
      "keep finished places in OUTPUT.journal from then on: the same command goes on there after a sudden end"};
  bool begins_new = false;  ///< without what an earlier run has kept
};

/// Collective. Throws Error.
StageSummary run_remesh(const RemeshStageOptions& options, const Communicator& comm);

}  // namespace st
