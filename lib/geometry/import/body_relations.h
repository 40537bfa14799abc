// What bodies of a file are to each other: they overlap, touch, or are apart.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Bodies that overlap are united and those that touch are joined where `options` say so, and where a far field is made
/// around them (`has_new_air`): no air is between them. What touches itself is always joined. `findings` get what was
/// united and joined, and else what crosses and touches. `tables` are those of `model`, and made again where it
/// changes; `path` is for messages. Cost: what unite_solids() and find_touching_solids() take.
void relate_bodies(ImportedShape& model, ModelOfFile& tables, const ImportOptions& options, bool has_new_air,
                   std::vector<ImportFinding>& findings, const std::string& path, Progress& progress);

}  // namespace st::occt
