// Lengths asked for in space besides the raster: points, lines, triangles and volumes. Background meshes:
// background.h.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/similarity.h"
#include "sizing/size_field.h"

namespace st {

/// What a source asks for at one of its points (FLITE): `length` up to the distance `radius`, twice as much at
/// `doubling`, growing exponentially, but never faster than the slope.
struct SourceSpacing {
  double length = 0;    ///< model unit, > 0
  double radius = 0;    ///< model unit, >= 0
  double doubling = 0;  ///< model unit; <= radius: growth by the slope alone
};

/// The length that such a point asks for at the distance `r`.
double grown_length(const SourceSpacing& spacing, double slope, double r);

/// A bound of what a source asks for: nothing at the distance r from `core` is below grown_length(spacing, slope, r).
struct SourceGrowth {
  Box3 core;
  SourceSpacing spacing;
};

/// Something that asks for lengths in all of space. A new type of source is a new implementation of min_size() and
/// size(), the two methods of the paper (section 3.1), and an entry of source_types(); it shall grow by slope() at
/// most.
class SizeSource : public SizeField {
 public:
  explicit SizeSource(double slope) : slope_(slope) {}
  using SizeField::size;
  double slope() const final { return slope_; }
  /// min(upper, size(x)), sooner where a bound is enough.
  virtual double size_below(Vec3 x, double upper) const { return std::min(upper, size(x)); }
  /// A bound: it asks for no less than it, or `upper`, within `radius` of x. Here: by the slope.
  virtual double least_within(Vec3 x, double radius, double upper) const;
  /// Of size() at x. Here: by differences.
  virtual Vec3 gradient(Vec3 x) const;
  /// The tighter, the sooner a search passes over it. Here: it may ask for its smallest length anywhere.
  virtual SourceGrowth growth() const;
  /// Largest ratio of the two lengths of local().
  virtual double max_aspect() const { return 1; }
  bool is_stretched() const override { return max_aspect() > 1; }

 private:
  double slope_;
};

/// Of a length at x, by central differences.
template <class Length>
Vec3 gradient_of(const Length& length, Vec3 x) {
  const double step = 1e-4 * length(x);
  const auto change = [&](Vec3 d) { return (length(x + d) - length(x - d)) / (2 * step); };
  return {change({step, 0, 0}), change({0, step, 0}), change({0, 0, step})};
}

/// The number of a type in the table (source_types.h).
enum class SourceKind { kPoint, kLine, kTriangle, kBox, kCylinder, kSphere, kDisc };

/// A source as the user describes it.
struct SourceSpec {
  std::string name;
  SourceKind kind = SourceKind::kPoint;
  std::array<Vec3, 3> point;  ///< point; ends; corners; centre of box, sphere, disc; ends of the cylinder's axis
  std::array<SourceSpacing, 3> spacing;  ///< at each point of point, line and triangle; [0] for the others
  std::array<Vec3, 3> half_axis;         ///< box: its three half axes; disc: [0] the normal
  double extent = 0;                     ///< radius of cylinder, sphere, disc: the length is constant inside
  double aspect = 1;                     ///< >= 1: length along `direction` over that across
  Vec3 direction = {};                   ///< unit, where aspect > 1
};

/// Of its type: points of a line or triangle, 1 for most.
int n_spacings(SourceKind kind);

/// A line whose ends are one point becomes a point, a triangle whose corners lie on a line a line (or a point), with
/// the spacings of those ends; of several spacings at one place the one of the smallest length. False: it is neither.
bool simplify(SourceSpec& source);

/// A box around where the length is constant: points and volumes with their radii.
Box3 core_box(const SourceSpec& source);

/// Positions and directions are moved; lengths, radii and extents are scaled.
void transform(const Similarity& motion, SourceSpec& source);

/// The source as a field, as its type makes it. Precondition: lengths > 0, radii >= 0, slope > 0; of a type that
/// exists.
std::unique_ptr<SizeSource> make_source(const SourceSpec& spec, double slope);

/// From a source's points to x; not positive inside volumes.
using ShapeDistance = double (*)(const SourceSpec&, Vec3 x);

/// A shape as a field: at each point the smallest over the shape's points of what they ask for there. Exact where the
/// spacing is one for all points, or grows by the slope from all of them without radii; otherwise to 1e-6.
std::unique_ptr<SizeSource> make_shape_source(const SourceSpec& spec, double slope, ShapeDistance distance);

/// The smallest over a triangle of a linear length plus `slope` times the distance from x. Exact.
double least_over_triangle(Vec3 x, const std::array<Vec3, 3>& point, const std::array<double, 3>& length, double slope);
/// Not above that, to rounding, and near it for triangles that are small beside their distance. A tenth of the work.
double bound_over_triangle(Vec3 x, const std::array<Vec3, 3>& point, const std::array<double, 3>& length, double slope);

}  // namespace st
