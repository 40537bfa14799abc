// A metric with one short and two long lengths.
#pragma once

#include "sizing/background.h"

namespace st::test {

/// Short across the plane with this unit normal, long along it.
inline SymmetricTensor metric_of_shock(Vec3 n, double across, double along) {
  const double most = 1 / (across * across), least = 1 / (along * along), d = most - least;
  return {least + d * n.x * n.x, least + d * n.y * n.y, least + d * n.z * n.z,
          d * n.x * n.y,         d * n.y * n.z,         d * n.x * n.z};
}

}  // namespace st::test
