// Which solids of a model touch.
#pragma once

#include <TopoDS_Shape.hxx>
#include <set>
#include <vector>

#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Numbers of solids, in TopExp order, ascending.
struct TouchingGroups {
  std::vector<std::vector<int>> groups;  ///< solids that lie on each other; or one that touches itself
  std::set<int> self_touching;           ///< two edges of the solid are at one place
};

/// Solids with faces of the same surface, or with edges between the same points. `tables` are those of `model`. Cost:
/// comparisons of boxes; surfaces only where these meet.
TouchingGroups find_touching_solids(const ImportedShape& model, const ModelTables& tables);

/// Those of which two edges are at one place.
std::set<int> find_self_touching(const ImportedShape& model, const ModelTables& tables);

/// Solids that have edges in common with others (0-based). Instances of one solid at different places have none.
std::set<int> edge_sharers(const TopoDS_Shape& shape);

}  // namespace st::occt
