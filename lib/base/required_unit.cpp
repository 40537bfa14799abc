#include "base/required_unit.h"

#include "base/error.h"

namespace st {

void require_unit(const LengthSpec& spec, const std::optional<double>& unit_in_m, const std::string& option) {
  if (spec.kind == LengthSpec::Kind::kAbsolute && !unit_in_m)
    throw Error(
        ExitCode::kUsage,
        option + ": '" + spec.text +
            "' has a unit but the model has none; give the model's unit with st-import --unit, or a plain number");
}

}  // namespace st
