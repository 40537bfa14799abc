#pragma once

#include "wing_sections.h"

namespace st::wing_models {

/// More bodies that are rare, and machine parts beside them (part_...).
const Makers& unusual_models();

}  // namespace st::wing_models
