#include "sizing/source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen.h"

namespace st {
namespace {

constexpr double kLn2 = 0.69314718055994530942;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Length at the distance `r`: constant, then exponential, then, from where that would exceed the slope, linear.
double length_at(const SourceSpacing& s, double slope, double r) {
  const double t = r - s.radius;
  if (!(t > 0)) return s.length;
  const double width = (s.doubling - s.radius) / kLn2;  // grows by e over this
  if (!(width > 0) || s.length >= slope * width) return s.length + slope * t;
  const double steep = width * std::log(slope * width / s.length);  // here the slope is reached
  return t <= steep ? s.length * std::exp(t / width) : slope * (width + t - steep);
}

/// What the source asks for at the point of it that is nearest to a place, and how far that is.
struct Nearest {
  double distance = 0;  // negative inside volumes
  SourceSpacing spacing;
};

Nearest nearest_on_segment(Vec3 x, const Vec3* p, const SourceSpacing* s) {
  const Vec3 d = p[1] - p[0];
  const double d2 = norm2(d), t = d2 > 0 ? std::clamp(dot(x - p[0], d) / d2, 0.0, 1.0) : 0;
  const auto mix = [t](double a, double b) { return a + t * (b - a); };
  return {distance(x, p[0] + t * d),
          {mix(s[0].length, s[1].length), mix(s[0].radius, s[1].radius), mix(s[0].doubling, s[1].doubling)}};
}

/// Nearest point of a triangle: inside when its foot is, else on one of the sides.
Nearest nearest_on_triangle(Vec3 x, const std::array<Vec3, 3>& p, const std::array<SourceSpacing, 3>& s) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], n = cross(a, b), r = x - p[0];
  const double n2 = norm2(n);
  if (n2 > 0) {
    const double wb = dot(cross(r, b), n) / n2, wc = dot(cross(a, r), n) / n2, wa = 1 - wb - wc;
    if (wa >= 0 && wb >= 0 && wc >= 0) {
      const auto mix = [&](double SourceSpacing::*m) { return wa * (s[0].*m) + wb * (s[1].*m) + wc * (s[2].*m); };
      return {std::abs(dot(r, n)) / std::sqrt(n2),
              {mix(&SourceSpacing::length), mix(&SourceSpacing::radius), mix(&SourceSpacing::doubling)}};
    }
  }
  Nearest best{kInfinity, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 q[2] = {p[k], p[(k + 1) % 3]};
    const SourceSpacing t[2] = {s[k], s[(k + 1) % 3]};
    const Nearest side = nearest_on_segment(x, q, t);
    if (side.distance < best.distance) best = side;
  }
  return best;
}

/// Negative inside, as below: how far from the surface.
double distance_to_box(Vec3 x, const SourceSpec& s) {
  double d2 = 0, deepest = -kInfinity;
  for (const Vec3& axis : s.half_axis) {
    const double half = norm(axis), outside = std::abs(dot(x - s.point[0], axis)) / half - half;
    if (outside > 0) d2 += outside * outside;
    deepest = std::max(deepest, outside);
  }
  return deepest < 0 ? deepest : std::sqrt(d2);
}

/// `axis`: unit vector from one end to the other, `height` away; a disc has no height.
double distance_to_cylinder(Vec3 x, Vec3 a, Vec3 axis, double height, double radius) {
  const Vec3 r = x - a;
  const double along = dot(r, axis), across = norm(r - along * axis);
  const double lengthwise = std::max(-along, along - height), sideways = across - radius;
  if (lengthwise < 0 && sideways < 0) return std::max(lengthwise, sideways);
  return std::hypot(std::max(lengthwise, 0.0), std::max(sideways, 0.0));
}

class ShapeSource final : public SizeSource {
 public:
  ShapeSource(const SourceSpec& spec, double slope) : spec_(spec), slope_(slope) {
    const int n = n_spacings(spec.kind);
    min_size_ = spec.spacing[0].length;
    for (int k = 1; k < n; ++k) min_size_ = std::min(min_size_, spec.spacing[k].length);
    if (n > 1) measure_change(n);
  }

  double size(Vec3 x, int&) const override {
    const Nearest n = nearest(x);
    return length_at(n.spacing, slope_, n.distance);
  }
  LocalSize local(Vec3 x, int& hint) const override {
    const double length = size(x, hint);
    return {length, spec_.aspect * length, spec_.aspect > 1 ? spec_.direction : Vec3{}};
  }
  bool is_stretched() const override { return spec_.aspect > 1; }
  double max_aspect() const override { return spec_.aspect; }
  double min_size() const override { return min_size_; }
  double slope() const override { return slope_; }

  SizeRange range(Vec3 center, double half) const override {
    const double radius = std::sqrt(3.0) * half;
    const Nearest n = nearest(center);
    const SourceSpacing& s = n.spacing;
    const double dl = change_.length * radius, dr = change_.radius * radius, dd = change_.doubling * radius;
    const double nearest_r = std::max(0.0, n.distance - radius);
    const SourceSpacing least{std::max(min_size_, s.length - dl), s.radius + dr,
                              s.doubling > s.radius ? s.doubling + dd : 0};
    const SourceSpacing most{s.length + dl, std::max(0.0, s.radius - dr), s.doubling - dd};
    const bool meets_core = nearest_r <= least.radius;
    return {length_at(least, slope_, nearest_r), length_at(most, slope_, n.distance + radius), meets_core, meets_core};
  }

 private:
  Nearest nearest(Vec3 x) const {
    const auto& p = spec_.point;
    switch (spec_.kind) {
      case SourceKind::kPoint:
        return {distance(x, p[0]), spec_.spacing[0]};
      case SourceKind::kLine:
        return nearest_on_segment(x, p.data(), spec_.spacing.data());
      case SourceKind::kTriangle:
        return nearest_on_triangle(x, p, spec_.spacing);
      case SourceKind::kBox:
        return {distance_to_box(x, spec_), spec_.spacing[0]};
      case SourceKind::kCylinder:
        return {distance_to_cylinder(x, p[0], normalized(p[1] - p[0]), distance(p[0], p[1]), spec_.extent),
                spec_.spacing[0]};
      case SourceKind::kSphere:
        return {distance(x, p[0]) - spec_.extent, spec_.spacing[0]};
      case SourceKind::kDisc:
        return {distance_to_cylinder(x, p[0], normalized(spec_.half_axis[0]), 0, spec_.extent), spec_.spacing[0]};
    }
    return {};
  }

  /// Bounds how fast the spacing changes along a line or triangle: largest difference over the smallest extent.
  void measure_change(int n) {
    double extent = distance(spec_.point[0], spec_.point[1]);
    if (n == 3) {
      double longest = 0;
      for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, distance(spec_.point[k], spec_.point[(k + 1) % 3]));
      extent = norm(cross(spec_.point[1] - spec_.point[0], spec_.point[2] - spec_.point[0])) / longest;
    }
    const auto bound = [&](double SourceSpacing::*m) {
      double lo = spec_.spacing[0].*m, hi = lo;
      for (int k = 1; k < n; ++k) {
        lo = std::min(lo, spec_.spacing[k].*m);
        hi = std::max(hi, spec_.spacing[k].*m);
      }
      return hi > lo && extent > 0 ? (hi - lo) / extent : 0;
    };
    change_ = {bound(&SourceSpacing::length), bound(&SourceSpacing::radius), bound(&SourceSpacing::doubling)};
  }

  SourceSpec spec_;
  double slope_, min_size_;
  SourceSpacing change_;  // per distance
};

/// One tetrahedron of a background mesh. Barycentric coordinate k at x is weight_[k] . x + offset_[k].
class TetSource final : public SizeSource {
 public:
  TetSource(const std::array<Vec3, 4>& p, const std::array<LocalSize, 4>& size) {
    std::array<double, 4> h{};
    for (std::size_t k = 0; k < 4; ++k) h[k] = size[k].length;
    length_ = h;
    find_direction(size);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 a = p[(k + 1) % 4], b = p[(k + 2) % 4], c = p[(k + 3) % 4], n = cross(b - a, c - a);
      weight_[k] = n / dot(n, p[k] - a);
      offset_[k] = -dot(weight_[k], a);
      gradient_ += h[k] * weight_[k];
      box_.add(p[k]);
    }
    min_size_ = *std::min_element(h.begin(), h.end());
  }

  /// Inside: linear. Outside: at the nearest point, roughly (coordinates cut off at zero).
  double size(Vec3 x, int&) const override { return interpolate(length_, x); }
  LocalSize local(Vec3 x, int& hint) const override {
    const double length = size(x, hint);
    return {length, is_stretched() ? std::max(length, interpolate(along_, x)) : length, direction_};
  }
  bool is_stretched() const override { return max_aspect_ > 1; }
  double max_aspect() const override { return max_aspect_; }
  double min_size() const override { return min_size_; }
  double slope() const override { return norm(gradient_); }
  bool is_everywhere() const override { return false; }
  bool covers(Vec3 x) const override {
    constexpr double kOnSide = -1e-9;  // of the height: sides are shared
    for (std::size_t k = 0; k < 4; ++k)
      if (coordinate(k, x) < kOnSide) return false;
    return true;
  }

  SizeRange range(Vec3 center, double half) const override {
    constexpr SizeRange kNothing{kInfinity, kInfinity, false, false};
    const Vec3 a = box_.lo - center, b = center - box_.hi;
    if (std::max({a.x, a.y, a.z, b.x, b.y, b.z}) > half) return kNothing;
    double value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double c = coordinate(k, center);
      if (c + half * sum_abs(weight_[k]) < 0) return kNothing;
      value += c * length_[k];
    }
    const double change = half * sum_abs(gradient_), largest = *std::max_element(length_.begin(), length_.end());
    const Vec3 e = box_.hi - box_.lo;
    return {std::clamp(value - change, min_size_, largest), std::clamp(value + change, min_size_, largest), false,
            2 * half > std::max({e.x, e.y, e.z})};
  }

 private:
  static double sum_abs(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }
  double coordinate(std::size_t k, Vec3 x) const { return dot(weight_[k], x) + offset_[k]; }
  double interpolate(const std::array<double, 4>& value, Vec3 x) const {
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double w = std::max(0.0, coordinate(k, x));
      sum += w * value[k];
      weights += w;
    }
    return sum / weights;
  }
  /// The direction that the squeezes of the nodes share most, and the lengths along it.
  void find_direction(const std::array<LocalSize, 4>& size) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const LocalSize& s : size) sum += to_eigen(s.squeeze()) * to_eigen(s.squeeze()).transpose();
    if (sum.trace() > 0) direction_ = principal_axes(sum).axis[2];
    for (std::size_t k = 0; k < 4; ++k) {
      along_[k] = size[k].in(direction_);
      max_aspect_ = std::max(max_aspect_, along_[k] / length_[k]);
    }
  }

  std::array<Vec3, 4> weight_;
  std::array<double, 4> offset_{}, length_{}, along_{};
  Vec3 direction_;
  double max_aspect_ = 1;
  Vec3 gradient_;
  Box3 box_;
  double min_size_ = 0;
};

}  // namespace

int n_spacings(SourceKind kind) { return kind == SourceKind::kLine ? 2 : kind == SourceKind::kTriangle ? 3 : 1; }

bool simplify(SourceSpec& source) {
  constexpr double kFlat = 1e-12;  // of the largest coordinate, of the longest side
  const int n = n_spacings(source.kind);
  if (n == 1) return false;
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

void transform(const Similarity& motion, BackgroundMesh& mesh) {
  for (Vec3& p : mesh.node_xyz) p = motion(p);
  for (LocalSize& s : mesh.node_size)
    s = {motion.scale * s.length, motion.scale * s.along, motion.rotated(s.direction)};
}

std::int64_t remove_stretch(BackgroundMesh& mesh) {
  std::int64_t n_stretched = 0;
  for (LocalSize& s : mesh.node_size) {
    n_stretched += s.along > s.length;
    s = {s.length, s.length, {}};
  }
  return n_stretched;
}

std::unique_ptr<SizeSource> make_source(const SourceSpec& spec, double slope) {
  return std::make_unique<ShapeSource>(spec, slope);
}

std::vector<std::unique_ptr<SizeSource>> make_sources(const BackgroundMesh& mesh) {
  constexpr double kFlat = 1e-12;  // volume over cubed edge
  std::vector<std::unique_ptr<SizeSource>> sources;
  for (const auto& tet : mesh.tets) {
    std::array<Vec3, 4> p;
    std::array<LocalSize, 4> size;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] = mesh.node_xyz[tet[k]];
      size[k] = mesh.node_size[tet[k]];
    }
    const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
    const double volume6 = std::abs(dot(cross(a, b), c)), longest = std::max({norm(a), norm(b), norm(c)});
    if (volume6 > kFlat * longest * longest * longest) sources.push_back(std::make_unique<TetSource>(p, size));
  }
  return sources;
}

}  // namespace st
