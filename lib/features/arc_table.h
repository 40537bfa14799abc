// Shares of a curve's length, by a table.
#pragma once

#include <vector>

#include "geometry/shape/curve.h"

namespace st {

/// Arc length between equal steps of the parameter; linear in between.
class ArcTable {
 public:
  explicit ArcTable(const Curve& curve);
  double length() const { return s_.back(); }
  /// Share of the length, in [0, 1], at parameter t, and the other way round. Monotone.
  double share_at(double t) const { return interpolate(t_, s_, t) / length(); }
  double parameter_at(double share) const { return interpolate(s_, t_, share * length()); }

 private:
  static double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at);
  std::vector<double> t_, s_;
};

}  // namespace st
