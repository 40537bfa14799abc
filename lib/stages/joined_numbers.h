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

/// Whether a rule selects, in the CAD's tables, some of the faces or edges that are one, or an edge inside of joined
/// faces: then none may be joined. Throws Error(kUsage) as find_targets() does.
bool select_parts(const std::vector<SizeRule>& rules, const GeometryArtifact& geometry);

/// Rules whose `faces` and `edges` select in the CAD's tables, as numbers of what they are part of. Throws
/// Error(kUsage) as find_targets() does. Precondition: they do not select_parts().
std::vector<SizeRule> rules_on_joined(std::vector<SizeRule> rules, const GeometryArtifact& geometry);

/// Whether sizes are those of the CAD's faces, one by one, by their weights, though `composites` are joined.
bool are_of_cad_faces(const std::vector<double>& face_weight, const Composites& composites);

/// Faces that are one in the mesh must be one in the moved geometry, and no others. Throws Error(kMismatch), naming
/// both files.
void require_same_composites(const std::string& mesh, const MeshArtifact& old, const std::string& moved,
                             const GeometryArtifact& geometry);

}  // namespace st
