// What an edited geometry says of how it was made. Internal to stages.
#pragma once

#include <string>

#include "base/similarity.h"
#include "io/hdf5/artifact.h"
#include "stages/edit_stage.h"

namespace st {

/// Resolved options for the header of what st-edit writes, one JSON object.
std::string edit_options_json(const EditStageOptions& options);

/// The motion by which st-edit made the geometry of `moved` out of the one with this hash, moving all of it and doing
/// nothing else. Throws Error(kMismatch) naming `path` when it was made in another way.
Similarity whole_motion(const std::string& path, const ArtifactHeader& moved, const std::string& geometry_hash);

}  // namespace st
