// Small faces that are folded back onto a neighbour, within the CAD's tolerance.
#pragma once

#include <vector>

#include "geometry/import/crossing_faces.h"
#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Merges each small face that lies on a neighbour within the tolerances of both into it: the edges that they share go,
/// its others bound the neighbour, with trimming curves on the neighbour's surface. So the model is covered once where
/// the file covers it three times. Where an edge then runs back beside the next one, both become one, for all faces.
/// What would not become one face with the area that is left stays as it was. `found` is of `model` and `tables`;
/// lengths in the model unit. A finding says each; returns whether there was one: then the tables are to be made again.
bool merge_folded_slivers(ImportedShape& model, const ModelTables& tables, const std::vector<FaceCrossing>& found,
                          std::vector<ImportFinding>& findings);

}  // namespace st::occt
