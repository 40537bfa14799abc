// Lengths as users write them: "0.25mm", "2in", "0.1%", "3".
#pragma once

#include <optional>
#include <string>

namespace st {

/// A length as given on a command line or in an option file, before the model is known.
struct LengthSpec {
  enum class Kind { kModelUnit, kPercentOfDiagonal, kAbsolute };
  Kind kind = Kind::kModelUnit;
  double value = 0;  ///< model unit, per cent, or metres
  std::string text;  ///< as the user wrote it
};

/// Unit name (mm, cm, m, km, um, in, ft, any case; also millimetre, inch, foot ...) in metres; nullopt when unknown.
std::optional<double> unit_in_metres(const std::string& name);

/// Parses "3", "0.1%", "0.25mm", "2 in". Throws Error(kUsage) naming `option` for anything else, for a non-finite or a
/// non-positive value.
LengthSpec parse_length(const std::string& text, const std::string& option);

/// The length in the model unit. `diagonal` in the model unit; `unit_in_m` is empty for a model without a unit (BREP,
/// FLITE): an absolute length is then Error(kUsage) that names --unit.
double resolve_length(const LengthSpec& spec, double diagonal, std::optional<double> unit_in_m,
                      const std::string& option);

}  // namespace st
