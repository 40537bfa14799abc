// Numbers that users give are those of the CAD: what they mean where faces are joined.
#pragma once

#include <string>
#include <vector>

#include "base/ids.h"
#include "geometry/model/composites.h"
#include "io/hdf5/artifact.h"
#include "sizing/size_rules.h"

namespace st {

/// Faces that these are part of, ascending, each once. A composite of which only some are given is said: it is meant
/// as a whole. `where`: of the numbers, for that line.
std::vector<FaceId> whole_faces(const std::vector<FaceId>& faces, const Composites& composites,
                                const std::string& where);

/// Rules whose `faces` and `edges` select in the CAD's tables, as numbers of what they are part of. Throws
/// Error(kUsage) as find_targets() does, and for edges that are all inside joined faces.
std::vector<SizeRule> rules_on_joined(std::vector<SizeRule> rules, const GeometryArtifact& geometry);

}  // namespace st
