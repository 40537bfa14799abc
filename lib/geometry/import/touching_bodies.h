// Bodies that touch, joined.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Gives solids that touch common faces and edges, by OpenCASCADE's general fuse. A common face is named after both
/// sides: "interface_plate_bolt". What does not keep the area of every face stays as it was, with a finding;
/// `left_out` are solids that are not joined (0-based). `model_tables` are those of `model`, and made again where it
/// changes; `path` is for messages.
void join_touching_solids(ImportedShape& model, ModelOfFile& model_tables, const std::set<int>& left_out,
                          std::vector<ImportFinding>& findings, const std::string& path);

/// The same for solids that touch themselves along edges, or others with which they have edges in common: two meshes of
/// one edge, or between the same edges, would lie on each other.
/// Nothing is said where one stays as it is.
void join_self_touching_solids(ImportedShape& model, ModelOfFile& model_tables, const std::set<int>& left_out,
                               std::vector<ImportFinding>& findings, const std::string& path);

}  // namespace st::occt
