// What a stage tells its caller at the end.
#pragma once

#include <string>

#include "base/error.h"

namespace st {

/// The end of a stage: one line for people, one JSON object for programs, and the exit code.
struct StageSummary {
  std::string line;  ///< "geometry.hdf: 137 faces, closed, 2 repairs, 0.4 s"
  std::string json;  ///< one JSON object on one line
  ExitCode code = ExitCode::kOk;
};

}  // namespace st
