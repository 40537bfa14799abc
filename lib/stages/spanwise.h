// The order of a lifting surface's stations.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/eigen.h"
#include "sizing/wing_record.h"

namespace st {

/// Stations of a wing in the order of the span; those of a ring around it, from the first one on.
struct Spanwise {
  std::vector<const WingRecord::Station*> station;
  std::vector<double> share;
  bool is_ring = false;
  const WingRecord::Station* first;  // of the record
  std::ptrdiff_t n_recorded;

  enum class Kind { kOfEdges, kNosesAlone };

  explicit Spanwise(const WingRecord& wing, Kind kind = Kind::kOfEdges)
      : first(wing.stations.data()), n_recorded(std::ssize(wing.stations)) {
    for (const WingRecord::Station& s : wing.stations)
      if ((wing.has_noses && s.is_nose_alone()) == (kind == Kind::kNosesAlone)) station.push_back(&s);
    if (station.empty() || sort_around()) return;
    const auto furthest_from = [&](Vec3 x) {
      return *std::ranges::max_element(station, {}, [&](const auto* s) { return distance(s->trailing, x); });
    };
    const WingRecord::Station* a = furthest_from(furthest_from(station.front()->trailing)->trailing);
    const WingRecord::Station* b = furthest_from(a->trailing);
    if (b->chord > a->chord) std::swap(a, b);
    const Vec3 way = b->trailing - a->trailing;
    sort_by([&](const WingRecord::Station* s) {
      return dot(way, way) > 0 ? dot(s->trailing - a->trailing, way) / dot(way, way) : 0;
    });
  }

  std::size_t nearest(double at) const {
    const auto i = std::ranges::min_element(share, {}, [&](double own) { return std::abs(own - at); });
    return static_cast<std::size_t>(i - share.begin());
  }

  /// Those nearest to 10, 30, 50, 70 and 90 per cent of the span, each once; there are stations.
  std::vector<std::size_t> listed() const {
    std::vector<std::size_t> chosen;
    for (const double at : {0.1, 0.3, 0.5, 0.7, 0.9}) chosen.push_back(nearest(at));
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
  }

  /// The one before or after, around a ring; nothing beyond an end.
  std::optional<std::size_t> beside(std::size_t i, int step) const {
    const std::size_t n = station.size();
    if (!is_ring && i == (step > 0 ? n - 1 : 0)) return std::nullopt;
    return (i + n + static_cast<std::size_t>(step)) % n;
  }

  /// Where noses, or trailing edges, run at a station; by those about 2 per cent of the span away.
  Vec3 direction(std::size_t i, Vec3 WingRecord::Station::*place) const {
    return normalized(station[away(i, 1)]->*place - station[away(i, -1)]->*place);
  }

  /// Likewise by those before and after it in the record, edge by edge: both edges of a base may have noses far apart.
  /// A far one of these is another edge's. Zero where there is no other.
  Vec3 direction_of_edge(std::size_t i, Vec3 WingRecord::Station::*place) const {
    const WingRecord::Station* own = station[i];
    const auto place_of = [&](const WingRecord::Station* s) {
      const bool is_other = s < first || s >= first + n_recorded || s->is_nose_alone() != own->is_nose_alone();
      return is_other ? own->*place : s->*place;
    };
    Vec3 a = place_of(own - 1), b = place_of(own + 1);
    const double before = distance(a, own->*place), after = distance(b, own->*place);
    if (before > kMuchFurther * after && after > 0) a = own->*place;
    if (after > kMuchFurther * before && before > 0) b = own->*place;
    return norm(b - a) > 0 ? normalized(b - a) : Vec3{};
  }

  /// Of the profile's plane at a station that has a nose.
  Vec3 profile_normal(std::size_t i) const {
    const WingRecord::Station& s = *station[i];
    const Vec3 along = direction(i, &WingRecord::Station::trailing), forward = normalized(s.trailing - s.nose);
    return normalized(along - dot(along, forward) * forward);
  }

  /// From the first trailing edge to the last; around a ring along all. Model unit.
  double way() const {
    double sum = distance(station.front()->trailing, station.back()->trailing);
    for (std::size_t i = 1; is_ring && i < station.size(); ++i)
      sum += distance(station[i - 1]->trailing, station[i]->trailing);
    return sum;
  }

  /// The way from the station before it to the one after it, or from or to the end.
  double part(std::size_t i) const {
    const std::size_t a = beside(i, -1).value_or(i), b = beside(i, 1).value_or(i);
    return share[b] - share[a] + (is_ring && b < a ? 1 : 0);
  }

  /// The way to the noses before and after it in the record, of noses alone; model unit. These come in runs, far from
  /// each other: what lies between runs is none's.
  double nose_way(std::size_t i) const {
    const WingRecord::Station* own = station[i];
    double way = 0;
    for (const WingRecord::Station* s : {own - 1, own + 1})
      if (s >= first && s < first + n_recorded && s->is_nose_alone())
        if (const double step = distance(s->nose, own->nose); step <= kRunStep * own->chord) way += step;
    return way;
  }

 private:
  static constexpr double kWidestGap = radians(90);  // between stations about their middle: with a wider one they are
                                                     // no ring
  static constexpr double kMuchFurther = 4;          // times: stations are up to three times as far as those before
  static constexpr double kRunStep = 0.1;          // of the chord, twice a step of noses alone: further is another run
  static constexpr double kOpenGap = radians(30);  // with a wider one the ring is open

  template <class ShareOf>
  void sort_by(const ShareOf& share_of) {
    std::ranges::stable_sort(station, {}, share_of);
    for (const auto* s : station) share.push_back(share_of(s));
  }

  std::size_t away(std::size_t i, int step) const {
    constexpr double kStep = 0.02;
    std::size_t at = i;
    double way = 0;
    while (way < kStep) {
      const std::optional<std::size_t> next = beside(at, step);
      if (!next || *next == i) break;
      const double own = std::abs(share[*next] - share[at]);
      way += std::min(own, is_ring ? 1 - own : own);
      at = *next;
    }
    return at;
  }

  /// By the angle about the middle; false: the stations do not lie all around it.
  bool sort_around() {
    Vec3 middle;
    for (const auto* s : station) middle += s->trailing / static_cast<double>(station.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto* s : station) spread += to_eigen(s->trailing - middle) * to_eigen(s->trailing - middle).transpose();
    const PrincipalAxes plane = principal_axes(spread);
    const auto angle_of = [&](const WingRecord::Station* s) {
      return std::atan2(dot(s->trailing - middle, plane.axis[1]), dot(s->trailing - middle, plane.axis[2]));
    };
    std::vector<double> angles;
    for (const auto* s : station) angles.push_back(angle_of(s));
    std::sort(angles.begin(), angles.end());
    double begin = angles.front(), gap = begin + 2 * kPi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i)
      if (angles[i] - angles[i - 1] > gap) gap = angles[i] - angles[i - 1], begin = angles[i];
    if (gap > kWidestGap) return false;
    is_ring = gap < kOpenGap;
    const double whole = is_ring ? 2 * kPi : 2 * kPi - gap;
    sort_by([&](const WingRecord::Station* s) {
      const double from_begin = angle_of(s) - begin;
      return (from_begin < 0 ? from_begin + 2 * kPi : from_begin) / whole;
    });
    return true;
  }
};

}  // namespace st
