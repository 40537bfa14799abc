// What length holds at a place, and why.
#pragma once

#include <string>
#include <vector>

#include "io/hdf5/sizing_artifact.h"
#include "stages/summary.h"

namespace st {

/// Length, gradient and cause at "x,y,z" of a sizing artifact. Throws Error(kUsage), Error(kInput).
StageSummary run_size_at(const std::string& artifact, const std::string& xyz);

/// Which causes make the expected triangles of the faces of a group, part or name, of a sizing artifact. `raster`:
/// the artifact that it was made from; empty: the file of that name in the folder of the sizing. Throws Error(kUsage)
/// for a name that nothing has, Error(kInput), Error(kMismatch) for another raster.
StageSummary run_size_why(const std::string& artifact, const std::string& group, const std::string& raster);

/// Writes x, y, z, length, gradient and cause of each point of a CSV file (three numbers per line; a heading and lines
/// with # are passed over) as CSV. Returns the number of points. Throws Error(kInput) with file and line,
/// Error(kOutput).
std::size_t sample_sizes(const OctreeField& field, const CauseNames& names, const std::string& points,
                         const std::string& output);

}  // namespace st
