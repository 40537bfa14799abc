// Bodies that overlap made one.
#pragma once

#include <string>
#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Replaces solids that overlap or touch by their union, pair by pair, with growing fuzzy values: what is inside goes,
/// faces keep what the file says of them. A pair whose union fails, or has not a volume between that of the larger and
/// that of both, stays apart, with a finding that names both. `tables` are those of `model`, and made again where it
/// changes; `path` is for messages. Cost: a boolean operation for each pair whose boxes meet, until it is united; no
/// more after so many `seconds`: what is left stays apart, said likewise.
void unite_solids(ImportedShape& model, ModelOfFile& tables, double seconds, std::vector<ImportFinding>& findings,
                  const std::string& path);

}  // namespace st::occt
