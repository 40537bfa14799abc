#include "geometry/shape/chain_curve.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "geometry/shape/projection.h"

namespace st {

ChainParameters::ChainParameters(std::vector<Piece> pieces) : pieces_(std::move(pieces)), start_{0} {
  ST_ASSERT(!pieces_.empty());
  for (const Piece& p : pieces_) start_.push_back(start_.back() + p.length);
}

std::size_t ChainParameters::piece(double t) const {
  return static_cast<std::size_t>(std::upper_bound(start_.begin() + 1, start_.end() - 1, t) - start_.begin()) - 1;
}

double ChainParameters::rate(std::size_t i) const { return (pieces_[i].to - pieces_[i].from) / pieces_[i].length; }

double ChainParameters::own(std::size_t i, double t) const {
  if (t == start_[i + 1]) return pieces_[i].to;  // without rounding
  return pieces_[i].from + rate(i) * (t - start_[i]);
}

double ChainParameters::common(std::size_t i, double own) const {
  return start_[i] + (own - pieces_[i].from) / rate(i);
}

ChainCurve::ChainCurve(ChainParameters parameters, std::vector<std::unique_ptr<Curve>> pieces)
    : parameters_(std::move(parameters)), pieces_(std::move(pieces)) {
  ST_ASSERT(parameters_.size() == pieces_.size());
  t_min_ = 0, t_max_ = parameters_.end();
}

Vec3 ChainCurve::point(double t) const {
  const std::size_t i = parameters_.piece(t);
  return pieces_[i]->point(parameters_.own(i, t));
}

CurvePoint ChainCurve::evaluate(double t) const {
  const std::size_t i = parameters_.piece(t);
  const CurvePoint p = pieces_[i]->evaluate(parameters_.own(i, t));
  const double rate = parameters_.rate(i);
  return {p.x, rate * p.d1, rate * rate * p.d2};
}

std::vector<double> ChainCurve::knots() const {
  std::vector<double> all;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (i > 0) all.push_back(parameters_.start(i));
    for (const double own : pieces_[i]->knots()) all.push_back(parameters_.common(i, own));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::optional<double> ChainCurve::foot_near(Vec3 p, double guess) const {
  const auto foot = [&](std::size_t i, double own) {
    const double ends[] = {parameters_.own(i, parameters_.start(i)),
                           parameters_.own(i, i + 1 < pieces_.size() ? parameters_.start(i + 1) : t_max_)};
    const double t = std::clamp(project_near(*pieces_[i], p, own).value_or(own), std::min(ends[0], ends[1]),
                                std::max(ends[0], ends[1]));
    return std::pair(distance(pieces_[i]->point(t), p), parameters_.common(i, t));
  };
  const std::size_t at = parameters_.piece(guess);
  auto best = foot(at, parameters_.own(at, guess));
  for (const int way : {1, -1})
    for (std::size_t i = at; way > 0 ? i + 1 < pieces_.size() : i > 0;) {
      i = way > 0 ? i + 1 : i - 1;
      const double nearest = way > 0 ? parameters_.start(i) : parameters_.start(i + 1);
      const auto next = foot(i, parameters_.own(i, nearest));
      if (next.first > best.first) break;
      best = next;
    }
  return best.second;
}

std::unique_ptr<Curve> ChainCurve::copy() const {
  std::vector<std::unique_ptr<Curve>> pieces;
  for (const auto& piece : pieces_) {
    pieces.push_back(piece->copy());
    if (!pieces.back()) return nullptr;
  }
  return std::make_unique<ChainCurve>(parameters_, std::move(pieces));
}

ChainCurve2d::ChainCurve2d(ChainParameters parameters, std::vector<std::unique_ptr<Curve2d>> pieces)
    : parameters_(std::move(parameters)), pieces_(std::move(pieces)) {
  ST_ASSERT(parameters_.size() == pieces_.size());
}

Vec2 ChainCurve2d::point(double t) const {
  const std::size_t i = parameters_.piece(t);
  return pieces_[i]->point(parameters_.own(i, t));
}

RimCurve2d::RimCurve2d(std::unique_ptr<Curve2d> own, std::vector<Segment> segments)
    : own_(std::move(own)), segments_(std::move(segments)) {
  ST_ASSERT(!segments_.empty());
}

Vec2 RimCurve2d::point(double t) const {
  const auto next =
      std::upper_bound(segments_.begin() + 1, segments_.end(), t, [](double at, const Segment& s) { return at < s.t; });
  return (next - 1)->map.chart(own_->point(t));
}

}  // namespace st
