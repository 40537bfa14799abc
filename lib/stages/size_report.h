// What length holds at a place, and why.
#pragma once

#include <string>
#include <vector>

#include "io/hdf5/sizing_artifact.h"
#include "stages/summary.h"

namespace st {

/// Length, gradient and cause at "x,y,z" of a sizing artifact. Throws Error(kUsage), Error(kInput).
StageSummary run_size_at(const std::string& artifact, const std::string& xyz);

/// Writes x, y, z, length, gradient and cause of each point of a CSV file (three numbers per line; a heading and lines
/// with # are passed over) as CSV. Returns the number of points. Throws Error(kInput) with file and line,
/// Error(kOutput).
std::size_t sample_sizes(const OctreeField& field, const CauseNames& names, const std::string& points,
                         const std::string& output);

}  // namespace st
