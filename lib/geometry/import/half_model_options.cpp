// What --symmetry, --mirror and --farfield say.
#include <cmath>
#include <cstdlib>

#include "base/axis.h"
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

bool choose_side(SymmetryPlane& plane, const Box3& box, double diagonal, const std::string& prefix) {
  constexpr double kBothSides = 1e-4;  // of the diagonal: reaching less far beyond the plane is no other side
  const double below = plane.value - component(box.lo, plane.axis), above = component(box.hi, plane.axis) - plane.value;
  const int side = below <= kBothSides * diagonal ? 1 : above <= kBothSides * diagonal ? -1 : 0, asked = plane.side;
  if (side != 0 && asked != 0 && side != asked)
    throw Error(
        ExitCode::kGeometry,
        prefix + "the whole model is on the other side of the symmetry plane; use the other sign in --symmetry");
  plane.side = asked != 0 ? asked : side != 0 ? side : 1;
  return side == 0;
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
