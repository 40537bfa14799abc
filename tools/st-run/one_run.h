// One model's run: options of all stages, where their artifacts go, what is being done.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/option_set.h"
#include "common/tool_main.h"
#include "io/file/folder_lock.h"
#include "io/file/run_folder.h"
#include "stages/run_stage.h"

namespace st {

/// Made in main; run() is for a fork of this process.
class OneRun {
 public:
  OneRun();
  RunStageOptions options;

  /// The options of the stages become the tool's.
  void add_stages(ToolMain& tool);
  /// After parsing: folders are made, and what is to stop the run is found.
  void prepare(const ToolMain& tool);
  StageSummary run();
  /// "st-mesh", of the fork.
  std::string part() const;

 private:
  /// By the tool of the part, under mpirun.
  StageSummary run_ranks(RunPart part, const std::vector<std::string>& inputs, const std::string& output) const;
  std::string place(const std::string& name, std::uint64_t bytes);
  void begin_part(RunPart part);

  OptionSet import_{"st-import", ""}, raster_{"st-raster", ""}, prolong_{"st-prolong", ""}, mesh_{"st-mesh", ""},
      merge_{"st-merge", ""}, check_{"st-check", ""};
  std::optional<RunFolder> folder_;
  std::optional<FolderLock> lock_;     ///< of the folder that keeps the artifacts
  std::string settings_;               ///< option file of this run, where tools need one
  std::vector<std::string> of_ranks_;  ///< options of tools that are started with ranks
  const int said_;                     ///< file in memory that forks share: what the stages said
  int* part_ = nullptr;                ///< of RunPart; memory that forks share
};

}  // namespace st
