// st-run: all stages from CAD to a checked mesh in one process.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "comm/communicator.h"
#include "stages/check_stage.h"
#include "stages/import_stage.h"
#include "stages/merge_stage.h"
#include "stages/mesh_stage.h"
#include "stages/prolong_stage.h"
#include "stages/raster_stage.h"
#include "stages/report_stage.h"
#include "stages/summary.h"

namespace st {

/// In their order.
enum class RunPart : int { kImport, kRaster, kProlong, kMesh, kMerge, kCheck, kReport };

/// "st-mesh"
const char* tool_of(RunPart part);

struct RunStageOptions {
  std::string model;                ///< CAD file
  std::string output = "mesh.hdf";  ///< mesh artifact
  std::string report;               ///< page of st-report; empty: none
  std::string keep;                 ///< folder for the artifacts of the stages, made if missing; empty: they go
  // What the stages are asked for; their inputs and outputs are set here.
  ImportStageOptions import_options;
  RasterStageOptions raster;
  ProlongStageOptions prolong;
  MeshStageOptions mesh;
  MergeStageOptions merge;  ///< with the exports
  CheckStageOptions check;
  RunPart first = RunPart::kImport;  ///< what comes before is there already: of an earlier try of this run
  std::string said;                  ///< what the parts before said, see on_said
  std::function<void(const std::string& json)> on_said = [](const std::string&) {};  ///< after a part: what all said
  /// Runs the tool of kRaster or kMesh with ranks, on these inputs and this output; empty: all is done in this process.
  std::function<StageSummary(RunPart, const std::vector<std::string>& inputs, const std::string& output)> run_ranks;
  std::function<void(RunPart)> on_part = [](RunPart) {};  ///< a part begins
};

/// Where a file of this name is, or goes: its name, and how many bytes are expected of it.
using PlaceFile = std::function<std::string(const std::string& name, std::uint64_t bytes)>;

/// What is wrong with options and their files, as far as it shows without the model, is found before the work: a large
/// model may take minutes before its turn comes. Throws Error(kUsage), Error(kInput).
void require_run_inputs(const RunStageOptions& options);

/// Everything that could stop the outputs is found before the work. Throws Error.
void require_run_outputs(const RunStageOptions& options);

/// One line on stderr for each part; the summary has the verdict, figures and files. Code kIncomplete when the mesh
/// does not pass. Throws Error, whose message begins with the tool of the part; kIncomplete where a part left something
/// out that it was not allowed to. Precondition: one rank.
StageSummary run_all(const RunStageOptions& options, const PlaceFile& place, const Communicator& comm);

}  // namespace st
