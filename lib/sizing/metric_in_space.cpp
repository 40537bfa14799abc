#include "sizing/metric_in_space.h"

namespace st {

SymmetricTensor metric_in_space(const SizeField& field, Vec3 xyz, int& hint) {
  const LocalSize local = field.local(xyz, hint);
  if (!field.has_metrics()) return metric_of(local);
  const auto cut = [&](Vec3 normal) { return metric_of(field.local_on(xyz, normal, hint)); };
  const SymmetricTensor x = cut({1, 0, 0}), y = cut({0, 1, 0}), z = cut({0, 0, 1});
  const SymmetricTensor all{0.5 * (y[0] + z[0]), 0.5 * (x[1] + z[1]), 0.5 * (x[2] + y[2]), z[3], x[4], y[5]};
  return size_of_metric(all).length > 0 ? all : metric_of(local);
}

}  // namespace st
