#include "base/length.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/required_unit.h"

namespace st {

std::optional<double> unit_in_metres(const std::string& name) {
  std::string s;
  for (char c : name)
    if (!std::isspace(static_cast<unsigned char>(c)))
      s += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  static const std::pair<const char*, double> kUnits[] = {
      {"um", 1e-6},         {"micron", 1e-6},     {"micrometre", 1e-6}, {"micrometer", 1e-6}, {"mm", 1e-3},
      {"millimetre", 1e-3}, {"millimeter", 1e-3}, {"cm", 1e-2},         {"centimetre", 1e-2}, {"centimeter", 1e-2},
      {"m", 1.0},           {"metre", 1.0},       {"meter", 1.0},       {"km", 1e3},          {"kilometre", 1e3},
      {"kilometer", 1e3},   {"in", 0.0254},       {"inch", 0.0254},     {"ft", 0.3048},       {"foot", 0.3048},
      {"feet", 0.3048},     {"mil", 0.0254e-3},   {"yd", 0.9144}};
  for (const auto& [unit, metres] : kUnits)
    if (s == unit) return metres;
  return std::nullopt;
}

LengthSpec parse_length(const std::string& text, const std::string& option) {
  const auto fail = [&](const std::string& why) -> LengthSpec {
    throw Error(ExitCode::kUsage, option + ": '" + text + "' " + why + "; write 3, 0.1%, 0.25mm, 2in or 0.3%chord");
  };
  LengthSpec spec;
  spec.text = text;
  const char* begin = text.data();
  const char* end = begin + text.size();
  while (begin != end && std::isspace(static_cast<unsigned char>(*begin))) ++begin;
  const auto [rest, status] = std::from_chars(begin, end, spec.value);
  if (status != std::errc() || !std::isfinite(spec.value)) return fail("is not a length");
  if (spec.value <= 0) return fail("is not a positive length");
  std::string unit(rest, end);
  unit.erase(std::remove_if(unit.begin(), unit.end(), [](unsigned char c) { return std::isspace(c); }), unit.end());
  if (unit.empty()) return spec;
  static const std::pair<const char*, LengthSpec::Kind> kShares[] = {{"%", LengthSpec::Kind::kPercentOfDiagonal},
                                                                     {"%chord", LengthSpec::Kind::kPercentOfChord},
                                                                     {"%span", LengthSpec::Kind::kPercentOfSpan}};
  for (const auto& [share, kind] : kShares)
    if (unit == share) {
      spec.kind = kind;
      return spec;
    }
  const auto metres = unit_in_metres(unit);
  if (!metres) return fail("has an unknown unit");
  spec.kind = LengthSpec::Kind::kAbsolute;
  spec.value *= *metres;
  return spec;
}

std::string in_unit(const std::string& unit, int power) {
  if (unit.empty()) return "";
  return power == 1 ? " " + unit : " " + unit + "^" + std::to_string(power);
}

namespace {

double length_in_model_unit(const LengthSpec& spec, const LengthReference& reference, const std::string& option) {
  const auto of_wing = [&](const std::optional<double>& length) {
    if (!length)
      throw Error(ExitCode::kUsage,
                  option + ": '" + spec.text +
                      "' refers to a wing, and no lifting surface is known here; write a length or a per "
                      "cent of the diagonal, such as 0.1%");
    return spec.value * 0.01 * *length;
  };
  switch (spec.kind) {
    case LengthSpec::Kind::kModelUnit:
      return spec.value;
    case LengthSpec::Kind::kPercentOfDiagonal:
      return spec.value * 0.01 * reference.diagonal;
    case LengthSpec::Kind::kPercentOfChord:
      return of_wing(reference.chord);
    case LengthSpec::Kind::kPercentOfSpan:
      return of_wing(reference.span);
    case LengthSpec::Kind::kAbsolute:
      break;
  }
  require_unit(spec, reference.unit_in_m, option);
  return spec.value / *reference.unit_in_m;
}

}  // namespace

double resolve_length(const LengthSpec& spec, const LengthReference& reference, const std::string& option) {
  constexpr double kLargestLength = 1e15;  // a thousand times kLargestCoordinate; sizes are stored as float
  const double length = length_in_model_unit(spec, reference, option);
  if (length <= kLargestLength) return length;
  std::ostringstream text;
  text << option << ": " << length << " in the unit of the model; give a length of at most " << kLargestLength;
  throw Error(ExitCode::kUsage, text.str());
}

}  // namespace st
