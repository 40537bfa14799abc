// What --symmetry, --mirror and --farfield say.
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "geometry/import/half_model.h"

namespace st::occt {
namespace {

double number_after(const std::string& text, std::size_t start, std::size_t end, const std::string& message) {
  const std::string digits = text.substr(start, end - start);
  char* rest = nullptr;
  const double value = std::strtod(digits.c_str(), &rest);
  if (digits.empty() || *rest != '\0' || !std::isfinite(value)) throw Error(ExitCode::kUsage, message);
  return value;
}

}  // namespace

SymmetryPlane parse_symmetry(const std::string& text, const std::string& option) {
  const std::string message =
      option + ": '" + text +
      "' is not a plane; use x=, y= or z= and a number, then + or - for the kept side (y=0, y=0-)";
  SymmetryPlane plane;
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || text[1] != '=') throw Error(ExitCode::kUsage, message);
  plane.axis = text[0] - 'x';
  plane.side = text.back() == '+' ? 1 : text.back() == '-' ? -1 : 0;
  plane.value = number_after(text, 2, text.size() - (plane.side != 0), message);
  return plane;
}

FarField parse_farfield(const std::string& text, const std::string& option) {
  const std::string message =
      option + ": '" + text + "' is not a far field; use box:20 or sphere:50, in diagonals of the model from 1 to 1000";
  FarField far;
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon == std::string::npos || (kind != "box" && kind != "sphere")) throw Error(ExitCode::kUsage, message);
  far.kind = kind == "box" ? FarField::Kind::kBox : FarField::Kind::kSphere;
  far.size = number_after(text, colon + 1, text.size(), message);
  if (far.size < 1 || far.size > 1000) throw Error(ExitCode::kUsage, message);
  return far;
}

}  // namespace st::occt
