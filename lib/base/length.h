// Lengths as users write them: "0.25mm", "2in", "0.1%", "3", "0.3%chord".
#pragma once

#include <optional>
#include <string>

namespace st {

/// A length as given on a command line or in an option file, before the model is known.
struct LengthSpec {
  enum class Kind { kModelUnit, kPercentOfDiagonal, kAbsolute, kPercentOfChord, kPercentOfSpan };
  Kind kind = Kind::kModelUnit;
  double value = 0;  ///< model unit, per cent, or metres
  std::string text;  ///< as the user wrote it

  /// Known only where there is a lifting surface.
  bool is_of_wing() const { return kind == Kind::kPercentOfChord || kind == Kind::kPercentOfSpan; }
};

/// What a length may refer to.
struct LengthReference {
  double diagonal = 0;                             ///< model unit
  std::optional<double> unit_in_m = std::nullopt;  ///< empty for a model without a unit (BREP, FLITE)
  std::optional<double> chord = std::nullopt;  ///< local chord of the lifting surface, model unit; empty where there is
                                               ///< none
  std::optional<double> span = std::nullopt;   ///< its span, model unit
};

/// Unit name (mm, cm, m, km, um, in, ft, any case; also millimetre, inch, foot ...) in metres; nullopt when unknown.
std::optional<double> unit_in_metres(const std::string& name);

/// Parses "3", "0.1%", "0.25mm", "2 in", "0.3%chord", "1%span". Throws Error(kUsage) naming `option` for anything else,
/// for a non-finite or a non-positive value.
LengthSpec parse_length(const std::string& text, const std::string& option);

/// What follows a number that is printed: " m", " m^2"; empty for a model without a unit.
std::string in_unit(const std::string& unit, int power = 1);

/// The length in the model unit. Throws Error(kUsage) for an absolute length in a model without a unit (names --unit),
/// for one of chord or span where there is none, and for one above 1e15, which single precision does not bear.
double resolve_length(const LengthSpec& spec, const LengthReference& reference, const std::string& option);

}  // namespace st
