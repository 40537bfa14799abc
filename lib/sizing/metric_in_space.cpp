#include "sizing/metric_in_space.h"

namespace st {
namespace {

SymmetricTensor plain_metric(const LocalSize& s) {
  const double across = 1 / (s.length * s.length), cut = across - 1 / (s.along * s.along);
  const Vec3 d = s.direction;
  return {across - cut * d.x * d.x, across - cut * d.y * d.y, across - cut * d.z * d.z,
          0 - cut * d.x * d.y,      0 - cut * d.y * d.z,      0 - cut * d.x * d.z};
}

}  // namespace

SymmetricTensor metric_in_space(const SizeField& field, Vec3 xyz, int& hint) {
  const LocalSize local = field.local(xyz, hint);
  if (!field.has_metrics()) return plain_metric(local);
  const auto cut = [&](Vec3 normal) { return plain_metric(field.local_on(xyz, normal, hint)); };
  const SymmetricTensor x = cut({1, 0, 0}), y = cut({0, 1, 0}), z = cut({0, 0, 1});
  const SymmetricTensor all{0.5 * (y[0] + z[0]), 0.5 * (x[1] + z[1]), 0.5 * (x[2] + y[2]), z[3], x[4], y[5]};
  return size_of_metric(all).length > 0 ? all : plain_metric(local);
}

}  // namespace st
