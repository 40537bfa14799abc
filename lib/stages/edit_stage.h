// st-edit: geometries put together, parts taken out, left out, moved.
#pragma once

#include <string>
#include <vector>

#include "stages/summary.h"

namespace st {

struct EditStageOptions {
  std::vector<std::string> geometries;  ///< geometry artifacts, at least one; appended in this order
  std::string output = "edited.hdf";
  std::string as;       ///< "wing,flap": names of the inputs; empty: those of their files
  std::string join;     ///< names of groups that become one where several inputs have them; see select_faces for names
  std::string extract;  ///< names: only these faces stay; empty: all
  std::string remove;   ///< names: these faces go; empty: none
  std::vector<std::string> transforms;  ///< see parse_similarity; done in this order, after faces are taken out
  std::vector<std::string> of;  ///< names of what each of `transforms` moves; empty: all of them move everything
  bool require_valid = false;   ///< an open result, or one whose parts cross, is an error (exit 4)
};

/// Local. Names and numbers are those of all inputs put together. Throws Error: kUsage for names that match nothing and
/// when nothing is left, kMismatch for inputs of different units or joined groups of different roles, kGeometry where a
/// motion would tear a body.
StageSummary run_edit(const EditStageOptions& options);

}  // namespace st
