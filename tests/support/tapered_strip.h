// A narrow face whose width grows along it.
#pragma once

#include <cmath>

#include "features/strip.h"
#include "support/shapes.h"

namespace st::test {

/// The strip of the shape wedge_strip that is 0.02 wide at x = 0 and 1 at x = 20; without a face when it is not found.
inline Strip tapered_strip() {
  for (const Strip& s : find_strips(make_model("wedge_strip")))
    if (std::abs(s.stations.front().width() - s.stations.back().width()) > 0.9 &&
        s.stations.front().width() + s.stations.back().width() < 1.1)
      return s;
  return {};
}

}  // namespace st::test
