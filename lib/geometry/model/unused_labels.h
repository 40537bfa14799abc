// Names that no face has any more after faces were taken out of a model.
#pragma once

#include "geometry/model/model.h"

namespace st {

/// Takes away groups (of all tables) and parts without faces; shells and solids that are left are renumbered without
/// gaps.
void drop_unused(ModelTables& tables);

}  // namespace st
