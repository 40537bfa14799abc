// Wings, blades and boards that were made after the search for trailing edges, to try it.
#pragma once

#include "wing_sections.h"

namespace st::wing_models {

const Makers& late_models();

}  // namespace st::wing_models
