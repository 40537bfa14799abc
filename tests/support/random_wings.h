#pragma once

#include "wing_sections.h"

namespace st::wing_models {

/// A wing of chord 1, sharp or blunt, swept by -45 to 60 degrees: alone, upright, on a body, or with its other half in
/// a V, some of them turned in space. Tips are plane. The same for each number everywhere.
TopoDS_Shape random_wing(unsigned number);

}  // namespace st::wing_models
