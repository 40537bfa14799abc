#include "geometry/shape/polyline.h"

#include <algorithm>
#include <array>
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

/// Tangents of the curve that segments stand for.
class SmoothTangents {
 public:
  explicit SmoothTangents(const std::vector<Vec3>& points) : n_(points.size()), tangent_(n_), way_(n_, 0), ways_(n_) {
    for (std::size_t i = 0; i + 1 < n_; ++i) {
      length_.push_back(distance(points[i], points[i + 1]));
      direction_.push_back(normalized(points[i + 1] - points[i]));
    }
  }

  std::vector<Vec3> run() {
    if (n_ == 2) return {direction_[0], direction_[0]};
    for (std::size_t i = 1; i + 1 < n_; ++i) {
      const Vec3 a = direction_[i - 1], b = direction_[i];
      const double before = length_[i - 1], after = length_[i];
      ways_[i] = {normalized(after * a + before * b), normalized(a + b), normalized(before * a + after * b)};
      tangent_[i] = ways_[i][0];
    }
    for (int pass = 0; pass < kPasses; ++pass) choose();
    tangent_.front() = at_end(1, 2, 0, 1);
    tangent_.back() = at_end(n_ - 2, n_ - 3, n_ - 2, n_ - 3);
    return std::move(tangent_);
  }

 private:
  /// That of the circle through three points, halfway between the segments, as where an end cuts one off, or leaning to
  /// the longer one, as where an arc ends at a line: whichever makes arcs of the segments beside it.
  void choose() {
    const std::vector<Vec3> last = tangent_;
    for (std::size_t i = 1; i + 1 < n_; ++i) {
      const auto misfit = [&](Vec3 own) { return misfit_of(i - 1, last[i - 1], own) + misfit_of(i, own, last[i + 1]); };
      for (std::size_t way = 0; way < 3; ++way)
        if (misfit(ways_[i][way]) < misfit(ways_[i][way_[i]])) way_[i] = way;
      tangent_[i] = ways_[i][way_[i]];
    }
  }

  /// Those at the ends fit whatever is beside them.
  double misfit_of(std::size_t segment, Vec3 a, Vec3 b) const {
    return segment == 0 || segment + 2 == n_ ? 0.0 : norm2(cross(direction_[segment], a + b));
  }

  /// By the point beside the end and the one before it, and the segments at the former. One that is cut off turns as
  /// fast as the one before.
  Vec3 at_end(std::size_t beside, std::size_t before, std::size_t own, std::size_t other) const {
    const Vec3 tangent = tangent_[beside];
    if (way_[beside] != kHalfway || length_[own] >= length_[other]) return mirrored(tangent, direction_[own]);
    return normalized(tangent + length_[own] / length_[other] * (tangent - tangent_[before]));
  }

  static constexpr std::size_t kHalfway = 1;  // of ways_
  std::size_t n_;
  std::vector<Vec3> direction_, tangent_;
  std::vector<double> length_;    // of segments
  std::vector<std::size_t> way_;  // that was chosen
  std::vector<std::array<Vec3, 3>> ways_;
};

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
  tangent_ = SmoothTangents(points_).run();
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
