// Flat tables of a B-Rep.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/brep/loop_crossing.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// What the report and the volume need of each face beyond the tables.
struct FaceMeasures {
  std::vector<double> cone_volume;  ///< [n_faces] over the face as du x dv orients it, from one common point
  std::vector<std::optional<LoopCrossing>> crossing;  ///< [n_faces]
  std::vector<Box3> edge_box;                         ///< [n_edges] empty for poles
};

/// The model as it is in the import, and what its faces measure there.
struct ModelOfFile {
  ModelTables tables;
  FaceMeasures measures;
};

/// Tables of `model`: ids in TopExp order; unit and findings are left to the caller. Throws Error(kGeometry) naming
/// `path` for an edge without a vertex.
ModelOfFile make_tables(const ImportedShape& model, const std::string& path);

/// Only what groups of faces are chosen by, of a model whose loops may need repair: names, colours, layers, parts,
/// kinds of surfaces, groups of the file, and boxes, whose lengths are multiplied by `scale`.
ModelTables make_face_tables(const ImportedShape& model, double scale);

}  // namespace st::occt
