// The unit of a model: the one asked for, else that of its file.
#pragma once

#include <optional>
#include <string>

namespace st {

struct ModelUnit {
  std::string name;  ///< empty: none
  std::optional<double> in_m;
  double shape_units = 1;  ///< of the shape as it was read (mm, or the plain numbers) in one model unit
};

/// `asked`: of --unit, empty: none. A file without a unit is taken to be in the unit that is asked for: nothing to
/// scale. Throws Error(kUsage) for what is no unit.
ModelUnit choose_unit(std::optional<double> file_unit_in_mm, const std::string& asked);

}  // namespace st
