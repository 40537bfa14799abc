#include "geometry/shape/polyline.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"

namespace st {
namespace {

/// The segment that holds t; the first and the last one go on beyond the ends.
std::size_t segment_of(const std::vector<double>& t, double at) {
  return static_cast<std::size_t>(std::upper_bound(t.begin() + 1, t.end() - 1, at) - t.begin()) - 1;
}

/// A segment may be so short beside the whole that it has no parameters.
double share_of(const std::vector<double>& t, std::size_t i, double at) {
  return t[i + 1] > t[i] ? (at - t[i]) / (t[i + 1] - t[i]) : 0;
}

constexpr int kPasses = 3;  // in which tangents see those beside them

/// As an arc begins whose chord and tangent at its other end these are.
Vec3 mirrored(Vec3 tangent, Vec3 chord) { return 2 * dot(tangent, chord) * chord - tangent; }

/// Of the curve that the segments stand for. Each is that of the circle through three points, or, where an arc ends at
/// a line, more that of the longer segment: whichever makes arcs of the segments beside it.
std::vector<Vec3> smooth_tangents(const std::vector<Vec3>& points) {
  const std::size_t n = points.size();
  std::vector<Vec3> direction, tangent(n), round, straight;
  for (std::size_t i = 0; i + 1 < n; ++i) direction.push_back(normalized(points[i + 1] - points[i]));
  if (n == 2) return {direction[0], direction[0]};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = distance(points[i - 1], points[i]), after = distance(points[i], points[i + 1]);
    round.push_back(normalized(after * direction[i - 1] + before * direction[i]));
    straight.push_back(normalized(before * direction[i - 1] + after * direction[i]));
    tangent[i] = round.back();
  }
  const auto set_ends = [&] {
    tangent.front() = mirrored(tangent[1], direction.front());
    tangent.back() = mirrored(tangent[n - 2], direction.back());
  };
  const auto misfit = [&](std::size_t segment, Vec3 a, Vec3 b) { return norm2(cross(direction[segment], a + b)); };
  set_ends();
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<Vec3> last = tangent;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const auto sum = [&](Vec3 own) { return misfit(i - 1, last[i - 1], own) + misfit(i, own, last[i + 1]); };
      tangent[i] = sum(straight[i - 1]) < sum(round[i - 1]) ? straight[i - 1] : round[i - 1];
    }
    set_ends();
  }
  return tangent;
}

}  // namespace

std::vector<double> polyline_parameters(std::span<const Vec3> points) {
  std::vector<double> t{0};
  for (std::size_t i = 1; i < points.size(); ++i) t.push_back(t.back() + distance(points[i - 1], points[i]));
  return t;
}

PolylineCurve::PolylineCurve(std::vector<Vec3> points)
    : points_(std::move(points)), bend_(points_.size()), t_(polyline_parameters(points_)) {
  ST_ASSERT(points_.size() >= 2);
  t_min_ = 0, t_max_ = t_.back();
  const std::size_t n = points_.size();
  const auto direction = [&](std::size_t i) { return normalized(points_[i + 1] - points_[i]); };
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (t_[i + 1] > t_[i - 1]) bend_[i] = (direction(i) - direction(i - 1)) / (0.5 * (t_[i + 1] - t_[i - 1]));
  tangent_ = smooth_tangents(points_);
  if (n == 2) return;
  bend_.front() = bend_[1];
  bend_.back() = bend_[n - 2];
}

Vec3 PolylineCurve::point(double t) const {
  const std::size_t i = segment_of(t_, t);
  const double s = share_of(t_, i, t);
  return (1 - s) * points_[i] + s * points_[i + 1];
}

CurvePoint PolylineCurve::evaluate(double t) const {
  const std::size_t i = segment_of(t_, t);
  const double s = std::clamp(share_of(t_, i, t), 0.0, 1.0);
  const Vec3 d = normalized((1 - s) * tangent_[i] + s * tangent_[i + 1]);
  const Vec3 bend = (1 - s) * bend_[i] + s * bend_[i + 1];
  return {point(t), d, bend - dot(bend, d) * d};
}

std::optional<double> PolylineCurve::foot_near(Vec3 p, double guess) const {
  const auto foot = [&](std::size_t i) {
    const Vec3 d = points_[i + 1] - points_[i];
    const double s = norm2(d) > 0 ? std::clamp(dot(p - points_[i], d) / norm2(d), 0.0, 1.0) : 0;
    return std::pair(distance(points_[i] + s * d, p), t_[i] + s * (t_[i + 1] - t_[i]));
  };
  std::size_t at = segment_of(t_, guess);
  auto best = foot(at);
  for (const int way : {1, -1})
    for (std::size_t i = at; way > 0 ? i + 2 < t_.size() : i > 0;) {
      i = way > 0 ? i + 1 : i - 1;
      const auto next = foot(i);
      if (next.first > best.first) break;
      best = next;
      at = i;
    }
  return best.second;
}

PolylineCurve2d::PolylineCurve2d(std::vector<double> t, std::vector<Vec2> points)
    : t_(std::move(t)), points_(std::move(points)) {
  ST_ASSERT(t_.size() == points_.size() && t_.size() >= 2);
}

Vec2 PolylineCurve2d::point(double t) const {
  const std::size_t i = segment_of(t_, t);
  const double s = share_of(t_, i, t);
  return (1 - s) * points_[i] + s * points_[i + 1];
}

}  // namespace st
