#include "geometry/shape/member_map.h"

#include <algorithm>
#include <utility>

namespace st {
namespace {

constexpr double kNearPole = 1e-6;  // of the height of the triangle

Vec2 turned(Vec2 uv, std::int32_t pole) { return PoleCorner::of_code(pole).is_along_v ? Vec2{uv.y, uv.x} : uv; }

}  // namespace

bool are_pole_codes(std::span<const std::int32_t> codes) {
  return std::ranges::all_of(codes, [](std::int32_t c) { return c == kNone || (c >= 0 && c < kNPoleCorners); });
}

AffineMap::AffineMap(const std::array<Vec2, 3>& places, const std::array<Vec2, 3>& images)
    : from(places[0]), to(images[0]) {
  const Vec2 a = places[1] - places[0], b = places[2] - places[0], x = images[1] - images[0], y = images[2] - images[0];
  const double det = cross(a, b);
  along_u = (1 / det) * (b.y * x - a.y * y);
  along_v = (1 / det) * (a.x * y - b.x * x);
}

MemberMap::MemberMap(const std::array<Vec2, 3>& chart, const std::array<Vec2, 3>& uv, std::int32_t pole) : pole_(pole) {
  if (pole == kNone) {
    forth_ = AffineMap(chart, uv);
    back_ = AffineMap(uv, chart);
    return;
  }
  const auto k = static_cast<std::size_t>(PoleCorner::of_code(pole).corner);
  const std::array<Vec2, 3> places{chart[k], chart[(k + 1) % 3], chart[(k + 2) % 3]}, cone{{{0, 0}, {0, 1}, {1, 1}}};
  forth_ = AffineMap(places, cone);
  back_ = AffineMap(cone, places);
  pole_uv_ = turned(uv[k], pole);
  a_ = turned(uv[(k + 1) % 3], pole);
  b_ = turned(uv[(k + 2) % 3], pole);
}

MemberMap::Image MemberMap::operator()(Vec2 chart) const {
  const Vec2 q = forth_(chart);
  if (pole_ == kNone) return {q, forth_.along_u, forth_.along_v};
  const double s = std::max(q.y, kNearPole), share = q.y < kNearPole ? std::clamp(q.x / s, 0.0, 1.0) : q.x / s;
  const double height = a_.y + share * (b_.y - a_.y) - pole_uv_.y;
  const auto derivative = [&](Vec2 way) {
    const double by_share = (way.x - share * way.y) / s;
    return turned({(b_.x - a_.x) * by_share, way.y * height + s * (b_.y - a_.y) * by_share}, pole_);
  };
  return {turned({a_.x + share * (b_.x - a_.x), pole_uv_.y + s * height}, pole_), derivative(forth_.along_u),
          derivative(forth_.along_v)};
}

Vec2 MemberMap::chart(Vec2 uv) const {
  if (pole_ == kNone) return back_(uv);
  const Vec2 p = turned(uv, pole_);
  const double share = (p.x - a_.x) / (b_.x - a_.x);
  const double s = (p.y - pole_uv_.y) / (a_.y + share * (b_.y - a_.y) - pole_uv_.y);
  return back_({share * s, s});
}

}  // namespace st
