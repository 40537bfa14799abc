// st-info --groups: who belongs together.
#pragma once

#include <string>

#include "stages/summary.h"

namespace st {

/// Groups of all tables with role, attributes and faces, parts with their paths, names of faces, of a geometry, patches
/// or mesh artifact; of a geometry also layers, colours and kinds of surfaces. Throws Error(kInput) for any other
/// artifact.
StageSummary run_groups(const std::string& artifact);

}  // namespace st
