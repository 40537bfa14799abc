#pragma once

#include "wing_sections.h"

namespace st::wing_models {

/// Bodies that are rare, and machine parts beside them (part_...).
const Makers& rare_models();

}  // namespace st::wing_models
