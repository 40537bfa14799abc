// st-import --suggest-groups: a groups file that the shape of the model suggests, to be edited.
#pragma once

#include <string>
#include <vector>

#include "features/suggested_groups.h"
#include "geometry/model/model.h"

namespace st {

/// Lifting surfaces as st-raster finds them, and what they say of all faces. Local; the time of finding them.
std::vector<SuggestedGroup> suggest_groups_of(const Model& model);

/// The groups as a groups file (TOML): faces by their numbers, each group with
/// what it was recognised by. `model`: name of the CAD file, for the first line.
std::string groups_file_text(const std::vector<SuggestedGroup>& groups, const ModelTables& tables,
                             const std::string& model);

/// "wing 62, fuselage 48 faces; 3 of 237 faces are in none".
std::string groups_in_words(const std::vector<SuggestedGroup>& groups, const ModelTables& tables);

/// What a groups file made: "inlet 1 face (inlet), hub 3 faces and 4 more". The main groups with their roles where
/// these are no walls, then further tables and groups of edges and vertices, 16 in all.
std::string groups_in_words(const FaceLabels& labels);

}  // namespace st
