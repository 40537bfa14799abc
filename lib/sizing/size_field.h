// The mesh size specification as the mesher sees it: a length at every point of space.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace st {

/// The requested edge lengths at a point: `length` in every direction but `direction`, along which edges may be longer.
/// As a metric: length^-2 I - (length^-2 - along^-2) direction direction^T.
struct LocalSize {
  double length = 0;  ///< model unit, > 0
  double along = 0;   ///< model unit, >= length; equal: the same length in all directions
  Vec3 direction;     ///< unit; zero where both are equal

  /// Requested length of an edge along `d` (any length; zero: the smallest).
  double in(Vec3 d) const {
    const double d2 = norm2(d), part = dot(d, direction);
    if (!(along > length) || !(d2 > 0)) return length;
    const double share = std::min(1.0, part * part / d2), ratio = length / along;
    return length / std::sqrt(1 - share * (1 - ratio * ratio));
  }
};

/// Requested edge length in space. Implementations are immutable and safe to share between threads; `hint` is the
/// caller's own.
class SizeField {
 public:
  virtual ~SizeField() = default;
  /// Requested edge length at `xyz` (model unit, > 0). Points outside the field's box are clamped to it.
  /// `hint` remembers the last leaf (start with 0); nearby queries are faster with it. Same result whatever the hint.
  virtual double size(Vec3 xyz, int& hint) const = 0;
  double size(Vec3 xyz) const {
    int hint = 0;
    return size(xyz, hint);
  }
  /// Likewise, with the direction along which edges may be longer; local().length is size().
  virtual LocalSize local(Vec3 xyz, int& hint) const {
    const double length = size(xyz, hint);
    return {length, length, {}};
  }
  /// Whether local() ever differs from size().
  virtual bool is_stretched() const { return false; }
  /// Smallest length anywhere.
  virtual double min_size() const = 0;
  /// Largest change of length per distance that the field promises.
  virtual double slope() const = 0;
};

/// The same length everywhere (tests, and the simplest background).
class UniformField : public SizeField {
 public:
  explicit UniformField(double length) : length_(length) {}
  using SizeField::size;
  double size(Vec3, int&) const override { return length_; }
  double min_size() const override { return length_; }
  double slope() const override { return 0; }

 private:
  double length_;
};

}  // namespace st
