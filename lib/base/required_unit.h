// Lengths with a unit of their own need a model with one.
#pragma once

#include <optional>
#include <string>

#include "base/length.h"

namespace st {

/// Throws Error(kUsage), naming --unit, for an absolute length where the model has no unit: known before all else that
/// lengths refer to.
void require_unit(const LengthSpec& spec, const std::optional<double>& unit_in_m, const std::string& option);

}  // namespace st
