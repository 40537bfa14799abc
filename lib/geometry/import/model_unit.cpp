#include "geometry/import/model_unit.h"

#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/length.h"
#include "geometry/brep/shape_queries.h"

namespace st {
namespace {

std::string unit_name(double in_mm) {
  static const std::pair<double, const char*> kNames[] = {{1, "mm"},    {10, "cm"},    {1000, "m"},
                                                          {25.4, "in"}, {304.8, "ft"}, {1e-3, "um"},
                                                          {1e6, "km"},  {914.4, "yd"}, {0.0254, "mil"}};
  for (const auto& [mm, name] : kNames)
    if (std::abs(in_mm - mm) < 1e-6 * mm) return name;
  return occt::format_number(in_mm) + "mm";
}

}  // namespace

ModelUnit choose_unit(std::optional<double> file_unit_in_mm, const std::string& asked) {
  ModelUnit unit;
  if (!asked.empty()) {
    unit.in_m = unit_in_metres(asked);
    if (!unit.in_m)
      throw Error(ExitCode::kUsage, "--unit: '" + asked + "' is not a unit of length; use mm, cm, m, in or ft");
    unit.name = unit_name(*unit.in_m * 1000);  // "MM" is "mm"
    if (file_unit_in_mm) unit.shape_units = *unit.in_m * 1000;
  } else if (file_unit_in_mm) {
    unit.name = unit_name(*file_unit_in_mm);
    unit.in_m = *file_unit_in_mm / 1000;
    unit.shape_units = *file_unit_in_mm;
  }
  return unit;
}

}  // namespace st
