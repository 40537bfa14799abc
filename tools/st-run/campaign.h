// st-run on many models: each in a process of its own, a table, a page.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "base/number_option.h"
#include "common/tool_main.h"
#include "io/file/folder_lock.h"
#include "stages/campaign.h"
#include "stages/summary.h"

namespace st {

struct CampaignOptions {
  std::vector<std::string> models;
  int jobs = 1;
  static constexpr NumberOption kJobs{"--jobs", "N", "[1, 1024]",
                                      "several models: so many at once, each in a process of its own"};
  std::string table;          ///< empty: results.csv in `into`
  std::string page;           ///< empty: none
  std::string into = "runs";  ///< folder with a folder of results for each model

  bool is_asked_for() const { return models.size() > 1 || !table.empty() || !page.empty(); }
};

class Campaign {
 public:
  explicit Campaign(CampaignOptions options) : o_(std::move(options)) {}
  /// After parsing: what is not for several models is refused; folders are made.
  void prepare(const ToolMain& tool);
  /// Code kIncomplete where a model has no mesh that passes.
  StageSummary run();

 private:
  struct Job {
    pid_t process = 0;
    std::size_t model = 0;
    Timer timer = {};
  };
  std::string folder(std::size_t model) const { return o_.into + "/" + rows_[model].name; }
  bool is_done(std::size_t model) const { return !rows_[model].verdict.empty(); }
  void take_earlier_rows(const std::vector<CampaignRow>& earlier);
  Job start(std::size_t model) const;
  void finish(const Job& job, int status);
  void write_table() const;
  void write_page() const;

  CampaignOptions o_;
  std::optional<FolderLock> lock_;      ///< of the folder with the results
  std::vector<std::string> arguments_;  ///< of each run, besides model and outputs
  std::vector<CampaignRow> rows_;       ///< as o_.models
  std::vector<CampaignRow> others_;     ///< of the table: models of other calls
  std::size_t n_done_ = 0;
};

}  // namespace st
