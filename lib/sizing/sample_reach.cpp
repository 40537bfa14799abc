#include "sizing/sample_reach.h"

#include <cmath>
#include <utility>

namespace st {
namespace {

void store(Vec3 from, float (&to)[3]) {
  to[0] = static_cast<float>(from.x);
  to[1] = static_cast<float>(from.y);
  to[2] = static_cast<float>(from.z);
}

}  // namespace

SampleReach reach_of(Vec3 a, Vec3 b) {
  if (norm2(b) > norm2(a)) std::swap(a, b);
  SampleReach reach;
  if (!(norm2(a) > 0)) return reach;
  const double shear = dot(b, a) / norm2(a);
  store((1 + std::abs(shear)) * a, reach.u);
  store(b - shear * a, reach.v);
  return reach;
}

}  // namespace st
