// The mesh size specification as the mesher sees it: a length at every point of space.
#pragma once

#include "base/local_size.h"

namespace st {

/// Equilateral triangles of the local length h, per unit of the integral of 1/h^2 over a surface: 4/sqrt(3).
inline constexpr double kTrianglesPerWeight = 2.3094010767585034;

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
  /// Likewise on a surface with this unit normal: of a metric in space what its tangent plane cuts, both lengths of
  /// which may be longer than size(). Normal zero: as local().
  virtual LocalSize local_on(Vec3 xyz, Vec3 /*normal*/, int& hint) const { return local(xyz, hint); }
  /// Requested length of an edge along `way`.
  double length_along(Vec3 xyz, Vec3 way, int& hint) const { return local_on(xyz, a_normal_to(way), hint).in(way); }
  /// Whether local_on() ever differs from local().
  virtual bool has_metrics() const { return false; }
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
