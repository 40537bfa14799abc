// Faces of an imported model that meet smoothly become one.
#pragma once

#include <string>

#include "geometry/model/composite_finder.h"
#include "io/hdf5/artifact.h"

namespace st {

/// Whether a value of --composite asks for them. Throws Error(kUsage) for an unknown word, and for facets, which have
/// none. `path`: of the model.
bool asks_for_composites(const std::string& word, const std::string& path);

/// Smooth edges inside of a group and a part, but named ones, those in groups and those of wings. An edge is urgent
/// where the layout forces bad triangles at the default lengths, or everywhere (`is_harm_only` false): by its length.
/// Local. Cost: some evaluations per edge, and the recognition of wing edges.
JoinRequest join_request(const Model& cad, bool is_harm_only);

/// Fills composites of an artifact that has tables and B-Rep. Returns what was done, for people; what was refused is
/// logged.
std::string compose(GeometryArtifact& geometry, bool is_harm_only);

}  // namespace st
