#include "geometry/shape/loop_polygons.h"

#include <algorithm>
#include <cmath>

#include "base/predicates.h"

namespace st {
namespace {

constexpr std::size_t kMaxBins = 4096;

}  // namespace

LoopPolygons::LoopPolygons(std::vector<LoopSide> sides) : sides_(std::move(sides)) {
  if (sides_.empty()) return;
  double v_max = sides_.front().a.y;
  v_min_ = v_max;
  for (const LoopSide& s : sides_) {
    v_min_ = std::min({v_min_, s.a.y, s.b.y});
    v_max = std::max({v_max, s.a.y, s.b.y});
  }
  const std::size_t n_bins = std::clamp<std::size_t>(sides_.size(), 1, kMaxBins);
  bins_per_v_ = v_max > v_min_ ? static_cast<double>(n_bins) / (v_max - v_min_) : 0;
  const auto bin = [&](double v) { return std::min(static_cast<std::size_t>((v - v_min_) * bins_per_v_), n_bins - 1); };
  bin_offsets_.assign(n_bins + 1, 0);
  for (const LoopSide& s : sides_)
    for (std::size_t b = bin(std::min(s.a.y, s.b.y)); b <= bin(std::max(s.a.y, s.b.y)); ++b) ++bin_offsets_[b + 1];
  for (std::size_t b = 0; b < n_bins; ++b) bin_offsets_[b + 1] += bin_offsets_[b];
  bin_sides_.resize(static_cast<std::size_t>(bin_offsets_.back()));
  std::vector<std::int32_t> next(bin_offsets_.begin(), bin_offsets_.end() - 1);
  for (std::size_t i = 0; i < sides_.size(); ++i)
    for (std::size_t b = bin(std::min(sides_[i].a.y, sides_[i].b.y)); b <= bin(std::max(sides_[i].a.y, sides_[i].b.y));
         ++b)
      bin_sides_[next[b]++] = static_cast<std::int32_t>(i);
}

bool LoopPolygons::contains(Vec2 uv) const {
  if (sides_.empty()) return true;
  const double position = (uv.y - v_min_) * bins_per_v_;
  const std::size_t n_bins = bin_offsets_.size() - 1;
  if (!(position >= 0 && position <= static_cast<double>(n_bins))) return false;
  const std::size_t b = std::min(static_cast<std::size_t>(position), n_bins - 1);
  bool is_inside = false;
  for (std::int32_t k = bin_offsets_[b]; k < bin_offsets_[b + 1]; ++k) {
    const LoopSide& s = sides_[bin_sides_[k]];
    if ((s.a.y > uv.y) == (s.b.y > uv.y)) continue;
    if (uv.x < s.a.x + (uv.y - s.a.y) / (s.b.y - s.a.y) * (s.b.x - s.a.x)) is_inside = !is_inside;
  }
  return is_inside;
}

bool cross_properly(const LoopSide& s, const LoopSide& r) {
  const auto opposite = [](double x, double y) { return (x > 0 && y < 0) || (x < 0 && y > 0); };
  return opposite(orient2d(s.a, s.b, r.a), orient2d(s.a, s.b, r.b)) &&
         opposite(orient2d(r.a, r.b, s.a), orient2d(r.a, r.b, s.b));
}

std::vector<std::pair<std::int32_t, std::int32_t>> crossing_sides(std::span<const LoopSide> sides) {
  // Sweeps along the axis that the sides run along less: fewer of them lie side by side.
  double along_u = 0, along_v = 0;
  Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  for (const LoopSide& s : sides) {
    along_u += std::abs(s.b.x - s.a.x), along_v += std::abs(s.b.y - s.a.y);
    lo = {std::min({lo.x, s.a.x, s.b.x}), std::min({lo.y, s.a.y, s.b.y})},
    hi = {std::max({hi.x, s.a.x, s.b.x}), std::max({hi.y, s.a.y, s.b.y})};
  }
  const bool by_u = along_u * (hi.y - lo.y) < along_v * (hi.x - lo.x);
  struct Extent {
    double start, end, low, high;  // along the axis, and across it
    std::int32_t side;
  };
  std::vector<Extent> order, open;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const LoopSide& s = sides[i];
    const auto [start, end] = by_u ? std::minmax(s.a.x, s.b.x) : std::minmax(s.a.y, s.b.y);
    const auto [low, high] = by_u ? std::minmax(s.a.y, s.b.y) : std::minmax(s.a.x, s.b.x);
    order.push_back({start, end, low, high, static_cast<std::int32_t>(i)});
  }
  std::sort(order.begin(), order.end(),
            [](const Extent& a, const Extent& b) { return a.start != b.start ? a.start < b.start : a.side < b.side; });
  std::vector<std::pair<std::int32_t, std::int32_t>> result;
  for (const Extent& s : order) {
    std::erase_if(open, [&](const Extent& r) { return r.end < s.start; });
    for (const Extent& r : open)
      if (r.high >= s.low && r.low <= s.high && cross_properly(sides[s.side], sides[r.side]))
        result.emplace_back(std::min(s.side, r.side), std::max(s.side, r.side));
    open.push_back(s);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace st
