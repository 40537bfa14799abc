#include "sizing/source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "sizing/source_types.h"

namespace st {
namespace {

constexpr double kLn2 = 0.69314718055994530942;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The smallest value of f over [0, 1]: the best of evenly spaced places, then golden sections about it.
template <class F>
double least_over(const F& f) {
  constexpr int kPlaces = 8;     // a line has two least places at most: at its own least length and at its foot
  constexpr int kSections = 32;  // about the best place, to 1e-7
  constexpr double kGolden = 0.6180339887498949;
  double best = f(0.0), at = 0;
  for (int i = 1; i <= kPlaces; ++i)
    if (const double value = f(static_cast<double>(i) / kPlaces); value < best) best = value, at = i;
  double lo = std::max(0.0, (at - 1) / kPlaces), hi = std::min(1.0, (at + 1) / kPlaces);
  double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo), f_a = f(a), f_b = f(b);
  for (int i = 0; i < kSections; ++i) {
    if (f_a < f_b) {
      hi = b, b = a, f_b = f_a;
      f_a = f(a = hi - kGolden * (hi - lo));
    } else {
      lo = a, a = b, f_a = f_b;
      f_b = f(b = lo + kGolden * (hi - lo));
    }
  }
  return std::min({best, f_a, f_b});
}

/// The smallest over a segment of a linear length plus `slope` times the distance from x.
double least_over_segment(Vec3 x, Vec3 a, Vec3 b, double length_a, double length_b, double slope) {
  const Vec3 d = b - a;
  const double d2 = norm2(d), rise = length_b - length_a;
  double t = rise < 0 ? 1 : 0;
  if (d2 > 0 && std::abs(rise) < slope * std::sqrt(d2)) {
    const double foot = dot(x - a, d) / d2, m = rise / (slope * std::sqrt(d2)), height = distance(x, a + foot * d);
    t = std::clamp(foot - m * height / std::sqrt((1 - m * m) * d2), 0.0, 1.0);
  }
  return length_a + t * rise + slope * distance(x, a + t * d);
}

SourceSpacing mixed(const SourceSpacing& a, const SourceSpacing& b, double t) {
  return {a.length + t * (b.length - a.length), a.radius + t * (b.radius - a.radius),
          a.doubling + t * (b.doubling - a.doubling)};
}

class ShapeSource final : public SizeSource {
 public:
  ShapeSource(const SourceSpec& spec, double slope, ShapeDistance distance)
      : SizeSource(slope), spec_(spec), distance_(distance) {
    const auto& s = spec.spacing;
    least_ = s[0];
    double width = s[0].doubling - s[0].radius;
    for (int k = 1; k < n_spacings(spec.kind); ++k) {
      is_varied_ |= s[k].length != s[0].length || s[k].radius != s[0].radius || s[k].doubling != s[0].doubling;
      least_.length = std::min(least_.length, s[k].length);
      least_.radius = std::max(least_.radius, s[k].radius);
      width = std::max(width, s[k].doubling - s[k].radius);
    }
    least_.doubling = least_.radius + width;
    is_plain_ = least_.radius == 0 && !(width > 0);
    if (!(spec.aspect > 1)) return;
    SourceSpec longer = spec;  // from its points on lengths along grow as those across do, by the slope at most
    for (SourceSpacing& of_point : longer.spacing) of_point.length *= spec.aspect;
    longer.aspect = 1;
    along_ = std::make_unique<ShapeSource>(longer, slope, distance);
  }

  double size(Vec3 x, int&) const override { return size_below(x, kInfinity); }
  double size_below(Vec3 x, double upper) const override {
    const double at_least = grown_length(least_, slope(), distance_(spec_, x));
    if (!is_varied_ || !(at_least < upper)) return std::min(at_least, upper);
    return std::min(upper, spec_.kind == SourceKind::kLine ? on_line(x) : on_triangle(x));
  }
  LocalSize local(Vec3 x, int& hint) const override {
    const double length = size(x, hint);
    if (!along_) return {length, length, {}};
    return {length, std::max(length, along_->size(x, hint)), spec_.direction};
  }
  double max_aspect() const override { return spec_.aspect; }
  double min_size() const override { return least_.length; }
  SourceGrowth growth() const override {
    SourceSpec shape = spec_;
    for (SourceSpacing& s : shape.spacing) s.radius = 0;
    return {core_box(shape), least_};
  }

 private:
  double between(Vec3 x, Vec3 a, Vec3 b, const SourceSpacing& at_a, const SourceSpacing& at_b) const {
    if (is_plain_) return least_over_segment(x, a, b, at_a.length, at_b.length, slope());
    return least_over(
        [&](double t) { return grown_length(mixed(at_a, at_b, t), slope(), distance(x, a + t * (b - a))); });
  }
  double on_line(Vec3 x) const {
    return between(x, spec_.point[0], spec_.point[1], spec_.spacing[0], spec_.spacing[1]);
  }
  double on_triangle(Vec3 x) const {
    const auto& p = spec_.point;
    const auto& s = spec_.spacing;
    if (is_plain_) return least_over_triangle(x, p, {s[0].length, s[1].length, s[2].length}, slope());
    return least_over([&](double t) {
      return between(x, p[0] + t * (p[1] - p[0]), p[0] + t * (p[2] - p[0]), mixed(s[0], s[1], t), mixed(s[0], s[2], t));
    });
  }

  SourceSpec spec_;
  ShapeDistance distance_;
  SourceSpacing least_;                       // smallest length, largest radius, slowest growth of all its points
  bool is_varied_ = false;                    // the spacing is not one for all points
  bool is_plain_ = false;                     // lengths grow by the slope from every point on
  std::unique_ptr<const ShapeSource> along_;  // lengths along `direction`; null: the same in all directions
};

}  // namespace

double grown_length(const SourceSpacing& s, double slope, double r) {
  const double t = r - s.radius;
  if (!(t > 0)) return s.length;
  const double width = (s.doubling - s.radius) / kLn2;  // grows by e over this
  if (!(width > 0) || s.length >= slope * width) return s.length + slope * t;
  const double steep = width * std::log(slope * width / s.length);  // here the slope is reached
  return t <= steep ? s.length * std::exp(t / width) : slope * (width + t - steep);
}

Vec3 SizeSource::gradient(Vec3 x) const {
  return gradient_of([this](Vec3 at) { return size(at); }, x);
}

double SizeSource::least_within(Vec3 x, double radius, double upper) const {
  const double drop = slope() * radius;
  return std::min(upper, std::max(min_size(), size_below(x, upper + drop) - drop));
}

SourceGrowth SizeSource::growth() const {
  constexpr double kFar = 1e150;  // whose square is a number
  return {{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}, {min_size(), 0, 0}};
}

double least_over_triangle(Vec3 x, const std::array<Vec3, 3>& p, const std::array<double, 3>& length, double slope) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], n = cross(a, b);
  const double n2 = norm2(n);
  if (n2 > 0) {
    const Vec3 gradient = ((length[1] - length[0]) * cross(b, n) + (length[2] - length[0]) * cross(n, a)) / n2;
    const double m2 = norm2(gradient) / (slope * slope);
    if (m2 < 1) {  // the place from which the length at x grows, if it lies inside
      const double height = std::abs(dot(x - p[0], n)) / std::sqrt(n2);
      const Vec3 r = x - p[0] - (height / (slope * std::sqrt(1 - m2))) * gradient;
      const double wb = dot(cross(r, b), n) / n2, wc = dot(cross(a, r), n) / n2;
      if (wb >= 0 && wc >= 0 && wb + wc <= 1)
        return length[0] + wb * (length[1] - length[0]) + wc * (length[2] - length[0]) +
               slope * height / std::sqrt(1 - m2);
    }
  }
  return std::min({least_over_segment(x, p[0], p[1], length[0], length[1], slope),
                   least_over_segment(x, p[1], p[2], length[1], length[2], slope),
                   least_over_segment(x, p[2], p[0], length[2], length[0], slope)});
}

double bound_over_triangle(Vec3 x, const std::array<Vec3, 3>& p, const std::array<double, 3>& length, double slope) {
  const Vec3 to_centre = (p[0] + p[1] + p[2]) / 3 - x;
  const double distance2 = norm2(to_centre);
  if (!(distance2 > 0)) return std::min({length[0], length[1], length[2]});
  // no distance is below its part along the way to the centre, and what is linear is least at a corner
  const Vec3 growth = (slope / std::sqrt(distance2)) * to_centre;
  return std::min(
      {length[0] + dot(growth, p[0] - x), length[1] + dot(growth, p[1] - x), length[2] + dot(growth, p[2] - x)});
}

int n_spacings(SourceKind kind) {
  const SourceType* type = find_source_type(kind);
  ST_ASSERT(type);
  return type->n_spacings;
}

bool simplify(SourceSpec& source) {
  constexpr double kFlat = 1e-12;  // of the largest coordinate, of the longest side
  if (source.kind != SourceKind::kLine && source.kind != SourceKind::kTriangle) return false;
  const int n = n_spacings(source.kind);
  const auto& p = source.point;
  double extent = 0, longest = 0;
  int from = 0, to = 0;  // the two points farthest apart
  for (int i = 0; i < n; ++i) {
    extent = std::max({extent, std::abs(p[i].x), std::abs(p[i].y), std::abs(p[i].z)});
    for (int k = 0; k < i; ++k)
      if (const double d = distance(p[i], p[k]); d > longest) longest = d, from = k, to = i;
  }
  if (longest <= kFlat * extent) {
    for (int k = 1; k < n; ++k)
      if (source.spacing[k].length < source.spacing[0].length) source.spacing[0] = source.spacing[k];
    source.kind = SourceKind::kPoint;
    return true;
  }
  if (n == 2 || norm(cross(p[1] - p[0], p[2] - p[0])) > kFlat * longest * longest) return false;
  source.point = {p[from], p[to], {}};
  source.spacing = {source.spacing[from], source.spacing[to], {}};
  source.kind = SourceKind::kLine;
  return true;
}

Box3 core_box(const SourceSpec& source) {
  Box3 box;
  const auto add = [&](Vec3 x, double radius) {
    box.add(x - Vec3{radius, radius, radius});
    box.add(x + Vec3{radius, radius, radius});
  };
  if (source.kind == SourceKind::kBox) {
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 x = source.point[0];
      for (int k = 0; k < 3; ++k) x = x + (corner >> k & 1 ? 1.0 : -1.0) * source.half_axis[k];
      add(x, source.spacing[0].radius);
    }
    return box;
  }
  const int n = source.kind == SourceKind::kCylinder ? 2 : n_spacings(source.kind);
  for (int k = 0; k < n; ++k)
    add(source.point[k], source.extent + source.spacing[n_spacings(source.kind) == 1 ? 0 : k].radius);
  return box;
}

void transform(const Similarity& motion, SourceSpec& source) {
  for (Vec3& p : source.point) p = motion(p);
  for (Vec3& a : source.half_axis) a = motion.scale * motion.rotated(a);
  for (SourceSpacing& s : source.spacing)
    s = {motion.scale * s.length, motion.scale * s.radius, motion.scale * s.doubling};
  source.extent *= motion.scale;
  source.direction = motion.rotated(source.direction);
}

std::unique_ptr<SizeSource> make_source(const SourceSpec& spec, double slope) {
  const SourceType* type = find_source_type(spec.kind);
  ST_ASSERT(type);
  return type->make(spec, slope);
}

std::unique_ptr<SizeSource> make_shape_source(const SourceSpec& spec, double slope, ShapeDistance distance) {
  return std::make_unique<ShapeSource>(spec, slope, distance);
}

}  // namespace st
