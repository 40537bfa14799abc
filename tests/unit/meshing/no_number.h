// A model with a number that is none, as in a damaged file.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/shapes.h"

namespace st::test {

/// The window of a tube, whose trimming curve along u = 7.1 is no number.
inline Model window_without_a_number() {
  const Model sound = make_model("tube_window");
  std::vector<std::byte> brep = sound.brep();
  const std::array<double, 2> origin = {7.1, 0};
  std::array<std::byte, sizeof origin> bytes{};
  std::memcpy(bytes.data(), origin.data(), bytes.size());
  const auto at = std::search(brep.begin(), brep.end(), bytes.begin(), bytes.end());
  if (at == brep.end()) throw std::logic_error("no such curve");
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(&*at, &none, sizeof none);
  return {sound.tables(), std::move(brep)};
}

}  // namespace st::test
