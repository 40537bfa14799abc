#include "geometry/shape/composite_surface.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/assert.h"

namespace st {
namespace {

constexpr double kLeastCosine = 0.5;          // between the normals of a facet and of its face
constexpr double kSlender = 0.025;            // height over longest side: chords across a bend turn such a facet,
constexpr double kLeastSlenderCosine = 0.1;   // which may be turned this far
constexpr double kMostCompositeStretch = 40;  // of (u,v): four times what a chart of facets may have

}  // namespace

struct CompositeSurface::Data {
  Data(Chart c, CompositeSupport support) : corner_uv(std::move(support.corner_uv)), member(std::move(support.member)) {
    ST_ASSERT(member.size() == c.corners.size() && corner_uv.size() == c.corners.size() &&
              support.pole.size() == c.corners.size());
    for (std::size_t t = 0; t < c.corners.size(); ++t) {
      const Corners& n = c.corners[t];
      map.emplace_back(std::array{c.uv[n[0]], c.uv[n[1]], c.uv[n[2]]}, corner_uv[t], support.pole[t]);
      largest_stretch = std::max(largest_stretch, stretch(c, n));
    }
    pole = std::move(support.pole);
    chart = std::make_unique<ChartSurface>(std::move(c));
  }

  std::unique_ptr<ChartSurface> chart;
  std::vector<std::array<Vec2, 3>> corner_uv;
  std::vector<std::int32_t> member;
  std::vector<std::int32_t> pole;
  std::vector<MemberMap> map;
  double largest_stretch = 0;
};

CompositeSurface::CompositeSurface(Chart chart, CompositeSupport support, std::vector<std::unique_ptr<Surface>> members,
                                   const std::array<double, 4>& bounds)
    : CompositeSurface(std::make_shared<const Data>(std::move(chart), std::move(support)), std::move(members), bounds) {
}

CompositeSurface::CompositeSurface(std::shared_ptr<const Data> data, std::vector<std::unique_ptr<Surface>> members,
                                   const std::array<double, 4>& bounds)
    : data_(std::move(data)), members_(std::move(members)) {
  u_min_ = bounds[0], u_max_ = bounds[1];
  v_min_ = bounds[2], v_max_ = bounds[3];
  type_ = SurfaceType::kOther;
}

std::unique_ptr<Surface> CompositeSurface::copy() const {
  std::vector<std::unique_ptr<Surface>> members;
  for (const auto& member : members_) {
    members.push_back(member->copy());
    if (!members.back()) return nullptr;
  }
  return with_members(std::move(members));
}

std::unique_ptr<CompositeSurface> CompositeSurface::with_members(std::vector<std::unique_ptr<Surface>> members) const {
  return std::unique_ptr<CompositeSurface>(
      new CompositeSurface(data_, std::move(members), {u_min_, u_max_, v_min_, v_max_}));
}

namespace {

/// Not further outside than evaluation is allowed: beyond, splines may be anywhere. Corners of a triangle count as
/// inside, wherever a period puts them.
Vec2 within_bounds(const Surface& surface, const std::array<Vec2, 3>& corners, Vec2 uv) {
  constexpr double kMargin = 0.01;  // of the bounds
  Vec2 lo{surface.u_min(), surface.v_min()}, hi{surface.u_max(), surface.v_max()};
  const Vec2 margin = kMargin * (hi - lo);
  for (const Vec2 c : corners) {
    lo = {std::min(lo.x, c.x), std::min(lo.y, c.y)};
    hi = {std::max(hi.x, c.x), std::max(hi.y, c.y)};
  }
  return {std::clamp(uv.x, lo.x - margin.x, hi.x + margin.x), std::clamp(uv.y, lo.y - margin.y, hi.y + margin.y)};
}

}  // namespace

CompositeSurface::MemberPlace CompositeSurface::place(Vec2 p) const {
  constexpr double kFar = 2;  // sides of the chart triangle: further beside the patch its rim stands for (u,v)
  const ChartSurface::Place at = data_->chart->locate(p);
  const auto t = static_cast<std::size_t>(at.triangle);
  const std::array<Vec2, 3>& uv = data_->corner_uv[t];
  const Vec2 inside = at.weight[0] * uv[0] + at.weight[1] * uv[1] + at.weight[2] * uv[2];
  const MemberMap::Image beyond = data_->map[t](p);
  const Vec2 way = beyond.uv - inside;
  const double side2 = std::max(
      {dot(uv[1] - uv[0], uv[1] - uv[0]), dot(uv[2] - uv[1], uv[2] - uv[1]), dot(uv[0] - uv[2], uv[0] - uv[2])});
  const std::int32_t member = data_->member[t];
  const bool is_far = dot(way, way) > kFar * kFar * side2;
  return {at.triangle, member, is_far ? inside : within_bounds(*members_[member], uv, beyond.uv), beyond.along_u,
          beyond.along_v};
}

bool CompositeSurface::holds(Vec2 uv) const { return data_->chart->holds(uv); }

double CompositeSurface::largest_stretch() const { return data_->largest_stretch; }

Vec3 CompositeSurface::point(Vec2 uv) const {
  const MemberPlace at = place(uv);
  return members_[at.member]->point(at.uv);
}

SurfacePoint CompositeSurface::evaluate(Vec2 uv) const {
  const MemberPlace at = place(uv);
  const SurfacePoint s = members_[at.member]->evaluate(at.uv);
  const Vec2 a = at.along_u, b = at.along_v;
  return {s.x, a.x * s.du + a.y * s.dv, b.x * s.du + b.y * s.dv};
}

SurfacePoint2 CompositeSurface::evaluate2(const MemberPlace& at) const {
  const SurfacePoint2 s = members_[at.member]->evaluate2(at.uv);
  const Vec2 a = at.along_u, b = at.along_v;
  const auto second = [&](Vec2 p, Vec2 q) {
    return p.x * q.x * s.duu + (p.x * q.y + p.y * q.x) * s.duv + p.y * q.y * s.dvv;
  };
  return {s.x, a.x * s.du + a.y * s.dv, b.x * s.du + b.y * s.dv, second(a, a), second(a, b), second(b, b)};
}

/// The chart's map has kinks where Newton's method with second derivatives would not help.
std::optional<Vec2> CompositeSurface::refined(Vec3 p, std::optional<Vec2> start) const {
  if (!start) return std::nullopt;
  constexpr int kSteps = 12;
  constexpr double kSmall = 1e-11;  // of the bounds: as near as (u,v) can tell
  Vec2 best = *start, uv = best;
  SurfacePoint s = evaluate(uv);
  double best2 = norm2(s.x - p);
  const double small = kSmall * std::max(u_max_ - u_min_, v_max_ - v_min_);
  for (int i = 0; i < kSteps; ++i) {
    const auto step = tangent_step(s.du, s.dv, p - s.x);
    if (!step) break;
    uv = uv + *step;
    uv = {std::clamp(uv.x, u_min_, u_max_), std::clamp(uv.y, v_min_, v_max_)};
    s = evaluate(uv);
    if (const double d2 = norm2(s.x - p); d2 < best2) best = uv, best2 = d2;
    if (std::abs(step->x) + std::abs(step->y) <= small) break;
  }
  return best;
}

std::optional<Vec2> CompositeSurface::exact_foot(Vec3 p) const { return refined(p, data_->chart->exact_foot(p)); }

std::optional<Vec2> CompositeSurface::foot_near(Vec3 p, Vec2 guess) const {
  return refined(p, data_->chart->foot_near(p, guess));
}

namespace {

/// What a triangle covers of the (u,v) of its member, in order; at a pole all of the way between two meridians.
std::vector<Vec2> outline(const std::array<Vec2, 3>& uv, std::int32_t pole) {
  if (pole == kNone) return {uv.begin(), uv.end()};
  const PoleCorner at = PoleCorner::of_code(pole);
  const Vec2 tip = uv[at.corner], a = uv[(at.corner + 1) % 3], b = uv[(at.corner + 2) % 3];
  const auto beside = [&](Vec2 x) { return at.is_along_v ? Vec2{tip.x, x.y} : Vec2{x.x, tip.y}; };
  return {beside(a), a, b, beside(b)};
}

}  // namespace

std::vector<LoopSide> CompositeSurface::rim_of_member(std::int32_t i) const {
  std::vector<LoopSide> sides;  // from the lower to the higher end
  const auto is_before = [](Vec2 a, Vec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
  for (std::size_t t = 0; t < data_->member.size(); ++t) {
    if (data_->member[t] != i) continue;
    const std::vector<Vec2> corner = outline(data_->corner_uv[t], data_->pole[t]);
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 a = corner[k], b = corner[(k + 1) % corner.size()];
      sides.push_back(is_before(a, b) ? LoopSide{a, b} : LoopSide{b, a});
    }
  }
  const auto ends = [](const LoopSide& s) { return std::tie(s.a.x, s.a.y, s.b.x, s.b.y); };
  std::sort(sides.begin(), sides.end(), [&](const auto& s, const auto& r) { return ends(s) < ends(r); });
  std::vector<LoopSide> rim;
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (k + 1 < sides.size() && ends(sides[k]) == ends(sides[k + 1]))
      ++k;  // between two triangles
    else
      rim.push_back(sides[k]);
  return rim;
}

bool CompositeSurface::is_member_turned(std::int32_t i) const {
  double area = 0;  // in (u,v)
  for (std::size_t t = 0; t < data_->member.size(); ++t) {
    if (data_->member[t] != i) continue;
    const std::vector<Vec2> corner = outline(data_->corner_uv[t], data_->pole[t]);
    for (std::size_t k = 2; k < corner.size(); ++k) area += cross(corner[k - 1] - corner[0], corner[k] - corner[0]);
  }
  return area < 0;
}

bool is_turned(Vec3 a, Vec3 b, Vec3 c, Vec3 normal) {
  constexpr double kNeedle = 1e-6;  // height over longest side: rounding turns its normal
  const Vec3 n = cross(b - a, c - a);
  const double longest2 = std::max({norm2(b - a), norm2(c - a), norm2(c - b)}), twice_area = norm(n);
  if (twice_area <= kNeedle * longest2) return false;
  const double least = twice_area <= kSlender * longest2 ? kLeastSlenderCosine : kLeastCosine;
  return !(dot(normal, n) > least * norm(normal) * twice_area);
}

bool follows_facets(const CompositeSurface& surface, const Chart& chart) {
  for (const Corners& c : chart.corners)
    for (const std::array<double, 3>& w : kFacetPlaces) {
      const SurfacePoint p = surface.evaluate(w[0] * chart.uv[c[0]] + w[1] * chart.uv[c[1]] + w[2] * chart.uv[c[2]]);
      if (is_turned(chart.x[c[0]], chart.x[c[1]], chart.x[c[2]], cross(p.du, p.dv))) return false;
      const double e = norm2(p.du), f = dot(p.du, p.dv), g = norm2(p.dv), mean = 0.5 * (e + g),
                   root = std::hypot(0.5 * (e - g), f);
      if (!(mean + root <= kMostCompositeStretch * kMostCompositeStretch * (mean - root))) return false;
    }
  return true;
}

}  // namespace st
