#include "features/arc_table.h"

#include <algorithm>

namespace st {
namespace {

constexpr int kSamples = 128;

}  // namespace

ArcTable::ArcTable(const Curve& curve) {
  Vec3 last = curve.point(curve.t_min());
  for (int i = 0; i <= kSamples; ++i) {
    t_.push_back(curve.t_min() + (curve.t_max() - curve.t_min()) * i / kSamples);
    const Vec3 x = curve.point(t_.back());
    s_.push_back((i ? s_.back() : 0.0) + distance(last, x));
    last = x;
  }
}

double ArcTable::interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const std::size_t i = std::clamp<std::size_t>(std::lower_bound(x.begin(), x.end(), at) - x.begin(), 1, x.size() - 1);
  const double width = x[i] - x[i - 1];
  return width > 0 ? y[i - 1] + (y[i] - y[i - 1]) * std::clamp((at - x[i - 1]) / width, 0.0, 1.0) : y[i];
}

}  // namespace st
