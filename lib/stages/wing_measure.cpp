#include "stages/wing_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/radix_sort.h"
#include "base/threads.h"
#include "mesh/group_mesh.h"
#include "mesh/own_triangles.h"
#include "sizing/wing_sizes.h"
#include "stages/spanwise.h"

namespace st {
namespace {

constexpr double kAround = 1.5;      // lengths, or heights, around the nearest triangle: that row, some of the next
constexpr double kAlongSpan = 2;     // of these along the span: else few segments stand for a station's whole stretch
constexpr double kUnheldReach = 3;   // lengths around a place that is not held
constexpr double kAlong = 0.71;      // cosine to the span of a segment along it, at least
constexpr double kStretched = 2;     // heights of a triangle in its mean side: equilateral ones have 1.15
constexpr double kBeside = 2;        // radii of the nearest triangle: a place further away is not on the mesh
constexpr double kThick = 0.4;       // of the chord: a profile's points lie no further from it
constexpr double kHeld = 1.3;        // length over that asked for, at most
constexpr double kHeldShare = 0.99;  // of the span, at least: issue 36 asks for 0.98 of a mesh

/// Around a triangle.
struct Ball {
  TriangleId triangle;
  Vec3 center;
  double radius;
  double at = 0;  // the centre's coordinate along the wing
};

/// The triangles of one surface.
class WingMesh {
 public:
  WingMesh(const SurfaceMesh& mesh, const WingRecord& wing) : mesh_(mesh) {
    std::size_t n_skin = 0, n_base = 0;  // known first: the lists are large, and grow by copies
    for_each_own(wing, [&](TriangleId, bool is_skin, bool is_base) { n_skin += is_skin, n_base += is_base; });
    skin_.reserve(n_skin), base_.reserve(n_base);
    for_each_own(wing, [&](TriangleId t, bool is_skin, bool is_base) {
      if (is_skin) skin_.push_back({t, {}, 0});
      if (is_base) base_.push_back(ball_of(t));
    });
    Box3 box;
    for (const WingRecord::Station& s : wing.stations) box.add(s.trailing);
    const Vec3 size = box.hi - box.lo;
    axis_ = size.x >= size.y && size.x >= size.z ? &Vec3::x : size.y >= size.z ? &Vec3::y : &Vec3::z;
    parallel_for(skin_.size(), kTrianglesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (Ball& b : std::span(skin_).subspan(begin, end - begin)) b = ball_of(b.triangle), b.at = b.center.*axis_;
    });
    sort_by_number(skin_, [](const Ball& b) { return b.at; });  // triangles come in their order
  }
  std::int64_t n_triangles() const { return static_cast<std::int64_t>(skin_.size() + base_.size()); }
  bool is_empty() const { return skin_.empty(); }

  LengthsAt lengths_at(Vec3 place, Vec3 along_span) const {
    const TriangleId at_place = nearest(place, along_span);
    const double side = mean_side(at_place), height = norm(height_of(at_place));
    const bool is_flat = kStretched * height < side;
    const double reach_across = kAround * (is_flat ? height : side),
                 reach_along = is_flat ? kAround * side : kAlongSpan * reach_across;
    const Vec3 middle = ball_of(at_place).center;  // a station inside a base may lie out of reach
    const auto is_around = [&](Vec3 x) {
      const double own = dot(x, along_span);
      return own * own / (reach_along * reach_along) + (norm2(x) - own * own) / (reach_across * reach_across) <= 1;
    };
    Mean across, along;
    for (const auto& [t, center, radius, at] : skin_within(middle, reach_along)) {
      if (!is_around(center - middle)) continue;
      if (is_flat) across.add(width_of(t, along_span));
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 way = corner(t, (k + 1) % 3) - corner(t, k);
        if (std::abs(dot(normalized(way), along_span)) >= kAlong)
          along.add(norm(way));
        else if (!is_flat)
          across.add(norm(way));
      }
    }
    return {across.value(), along.value()};
  }

  /// Whether a triangle is there.
  bool is_at(Vec3 place) const {
    const Ball ball = ball_of(nearest(place));
    return distance(ball.center, place) <= kBeside * ball.radius;
  }
  bool is_stretched_at(Vec3 place) const { return is_flat(nearest(place)); }

  /// Lengths along the profile at a station, mean of both sides; of half a fin those of its only one.
  double chord_cells(const WingRecord::Station& s, Vec3 normal) const {
    constexpr double kOneSide = 1.5;  // of the chord: longer profiles have two sides
    const auto [cells, length] = cells_along(skin_, s, normal);
    return length < kOneSide * s.chord ? cells : 0.5 * cells;
  }
  /// Across the base, and how wide it is.
  auto base_cells(const WingRecord::Station& s, Vec3 normal) const { return cells_along(base_, s, normal); }

  /// From `at_nose` to the mean extent 2 per cent of the chord away; 0: nothing is cut there.
  double growth(const WingRecord::Station& s, Vec3 normal, double at_nose) const {
    constexpr double kBand = 0.25;
    double sum = 0, way = 0, weight = 0;
    cut(skin_, s, normal, [&](double cells, double extent, double from_nose) {
      if (std::abs(from_nose - kNoseReach * s.chord) > kBand * kNoseReach * s.chord) return;
      sum += cells * extent;
      way += cells * from_nose;
      weight += cells;
    });
    return weight > 0 ? 1 + std::max(0.0, sum - weight * at_nose) / way : 0;
  }

  /// Largest angle between neighbours on one face of the skin around a place, radians: kinks of the CAD are its own.
  double turning(Vec3 place, double reach) const {
    std::map<std::pair<NodeId, NodeId>, TriangleId> sides;
    double most = 0;
    for (const auto& [t, center, radius, at] : skin_within(place, reach)) {
      if (norm2(center - place) > reach * reach) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(mesh_.triangles[t].n[k], mesh_.triangles[t].n[(k + 1) % 3]);
        const auto [known, is_new] = sides.emplace(std::pair(a, b), t);
        if (!is_new && mesh_.triangle_face[t] == mesh_.triangle_face[known->second])
          most = std::max(most, angle_between(normal_of(t), normal_of(known->second)));
      }
    }
    return most;
  }

 private:
  struct Mean {
    double sum = 0;
    std::int64_t n = 0;
    void add(double x) { sum += x, ++n; }
    double value() const { return n ? sum / static_cast<double>(n) : 0; }
  };
  /// Calls f(triangle, is_skin, is_base).
  template <class F>
  void for_each_own(const WingRecord& wing, const F& f) const {
    FaceId last = kNone;  // triangles come face by face
    bool is_skin = false, is_base = false;
    for (TriangleId t = 0; t < mesh_.n_triangles(); ++t) {
      if (const FaceId face = mesh_.triangle_face[t]; face != last) {
        last = face;
        is_skin = wing.faces.empty() || std::ranges::binary_search(wing.faces, face);
        is_base = std::ranges::binary_search(wing.bases, face);
      }
      if (is_skin || is_base) f(t, is_skin, is_base);
    }
  }
  Vec3 corner(TriangleId t, std::size_t k) const { return mesh_.node_xyz[mesh_.triangles[t].n[k]]; }
  Ball ball_of(TriangleId t) const {
    const Vec3 center = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3;
    const auto away2 = [&](std::size_t k) { return norm2(center - corner(t, k)); };
    return {t, center, std::sqrt(std::max({away2(0), away2(1), away2(2)}))};
  }
  /// A part of the skin that holds all centres not further from `place` than `reach`.
  std::span<const Ball> skin_within(Vec3 place, double reach) const {
    const auto begin = std::ranges::lower_bound(skin_, place.*axis_ - reach, {}, &Ball::at);
    const auto end = std::ranges::upper_bound(begin, skin_.end(), place.*axis_ + reach, {}, &Ball::at);
    return {begin, end};
  }
  /// Of those beside the nearest one, where that is stretched, the nearest across the span.
  TriangleId nearest(Vec3 place, Vec3 along_span) const {
    TriangleId best = nearest(place);
    if (!is_flat(best)) return best;
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& b : skin_within(place, ball_of(best).radius)) {
      const double along = dot(b.center - place, along_span), across2 = norm2(b.center - place) - along * along;
      if (std::abs(along) <= b.radius && across2 < least) least = across2, best = b.triangle;
    }
    return best;
  }
  /// By the centre; the skin is not empty.
  TriangleId nearest(Vec3 place) const {
    auto after = std::ranges::lower_bound(skin_, place.*axis_, {}, &Ball::at), before = after;
    double least = std::numeric_limits<double>::infinity();
    TriangleId best = kNone;
    const auto take = [&](const Ball& b) {
      if (std::abs(b.at - place.*axis_) >= least) return false;
      if (const double d = distance(b.center, place); d < least) least = d, best = b.triangle;
      return true;
    };
    for (bool is_on = true; is_on && after != skin_.end(); ++after) is_on = take(*after);
    for (bool is_on = true; is_on && before != skin_.begin();) is_on = take(*--before);
    return best;
  }
  bool is_flat(TriangleId t) const { return kStretched * norm(height_of(t)) < mean_side(t); }
  double mean_side(TriangleId t) const {
    return (distance(corner(t, 0), corner(t, 1)) + distance(corner(t, 1), corner(t, 2)) +
            distance(corner(t, 2), corner(t, 0))) /
           3;
  }
  /// Its height over the longest side, as a vector.
  Vec3 height_of(TriangleId t) const {
    Vec3 longest;
    for (std::size_t k = 0; k < 3; ++k)
      if (const Vec3 way = corner(t, (k + 1) % 3) - corner(t, k); norm2(way) > norm2(longest)) longest = way;
    return cross(normal_of(t), longest) / std::max(norm2(longest), std::numeric_limits<double>::min());
  }
  /// Across a direction: that of a row of right-angled triangles along it, whichever way its diagonals run;
  /// at most the longest side.
  double width_of(TriangleId t, Vec3 direction) const {
    const double a = dot(corner(t, 0), direction), b = dot(corner(t, 1), direction), c = dot(corner(t, 2), direction);
    const double extent = std::max(std::max({a, b, c}) - std::min({a, b, c}), norm(height_of(t)));
    return extent > 0 ? norm(normal_of(t)) / extent : 0;
  }
  Vec3 normal_of(TriangleId t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }

  /// How much of a triangle's extent a cut crosses, and that extent: along the cut, of a stretched one over its longest
  /// side, as a cut that is hardly oblique sees much of that.
  std::pair<double, double> crossed(TriangleId t, Vec3 way) const {
    const Vec3 up = height_of(t);
    if (norm(up) > 0 && kStretched * norm(up) < mean_side(t)) return {std::abs(dot(way, up)) / norm(up), norm(up)};
    const Vec3 direction = normalized(way);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < 3; ++k) {
      low = std::min(low, dot(corner(t, k), direction));
      high = std::max(high, dot(corner(t, k), direction));
    }
    return {norm(way), high - low};
  }

  /// `visit` gets of each triangle that the profile's plane cuts: the part that the cut is of the triangle's extent
  /// along it, that extent, and how far it is from the nose.
  template <class Visit>
  void cut(const std::vector<Ball>& triangles, const WingRecord::Station& s, Vec3 normal, const Visit& visit) const {
    const Vec3 forward = normalized(s.trailing - s.nose);
    for (const auto& [t, center, radius, at] : triangles) {
      if (std::abs(dot(center - s.trailing, normal)) > radius) continue;
      std::array<Vec3, 2> end;
      std::size_t n = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = corner(t, k), b = corner(t, (k + 1) % 3);
        const double ha = dot(a - s.trailing, normal), hb = dot(b - s.trailing, normal);
        if ((ha < 0) != (hb < 0) && n < 2) end[n++] = a + ha / (ha - hb) * (b - a);
      }
      if (n < 2 || !(distance(end[0], end[1]) > 0)) continue;
      const Vec3 middle = 0.5 * (end[0] + end[1]) - s.nose;
      const double from_nose = dot(middle, forward);
      if (norm(middle - from_nose * forward) > kThick * s.chord || from_nose < -kNoseReach * s.chord ||
          from_nose > (1 + kNoseReach) * s.chord)
        continue;
      const auto [own, extent] = crossed(t, end[1] - end[0]);
      visit(own / extent, extent, norm(middle));
    }
  }

  /// Lengths along what the profile's plane cuts, and how long that is.
  std::pair<double, double> cells_along(const std::vector<Ball>& triangles, const WingRecord::Station& s,
                                        Vec3 normal) const {
    double cells = 0, length = 0;
    cut(triangles, s, normal, [&](double own, double extent, double) { cells += own, length += own * extent; });
    return {cells, length};
  }

  const SurfaceMesh& mesh_;
  std::vector<Ball> skin_, base_;  // skin_ by centres along axis_
  double Vec3::*axis_ = &Vec3::x;  // along which the wing is longest
};

/// Rows run along the span, or along their edge or nose. By another direction than theirs they are higher.
LengthsAt lengths_of(const WingMesh& mesh, const Spanwise& spanwise, std::size_t i, Vec3 WingRecord::Station::*place) {
  const Vec3 x = spanwise.station[i]->*place, edge = spanwise.direction_of_edge(i, place);
  const LengthsAt by_span = mesh.lengths_at(x, spanwise.direction(i, place));
  if (edge == Vec3{} || !mesh.is_stretched_at(x)) return by_span;
  const LengthsAt by_edge = mesh.lengths_at(x, edge);
  return by_edge.normal < by_span.normal ? by_edge : by_span;
}

LengthsAt nose_of(const WingMesh& mesh, const WingRecord& wing, const Spanwise& spanwise, std::size_t i) {
  return wing.has_noses ? lengths_of(mesh, spanwise, i, &WingRecord::Station::nose) : LengthsAt{};
}

WingStationMeasure measure_station(const WingMesh& mesh, const WingRecord& wing, const Spanwise& spanwise,
                                   std::size_t i) {
  const WingRecord::Station& s = *spanwise.station[i];
  WingStationMeasure own{.share = spanwise.share[i], .place = s.trailing, .chord = s.chord, .asked = s.asked};
  own.trailing = lengths_of(mesh, spanwise, i, &WingRecord::Station::trailing);
  if (!wing.has_noses) return own;
  const Vec3 normal = spanwise.profile_normal(i);
  own.nose = nose_of(mesh, wing, spanwise, i);
  own.chord_cells = mesh.chord_cells(s, normal);
  const auto [cells, width] = mesh.base_cells(s, normal);
  own.base_cells = cells;
  if (width > 0 && s.asked > 0 && wing.base_cells > 0)
    own.asked_base_cells = width / length_across(wing.base_cells, width, s.asked);
  own.growth = mesh.growth(s, normal, own.nose.normal);
  own.turning = mesh.turning(s.nose, kNoseReach * s.chord);
  return own;
}

/// Of stations so far.
struct HeldSpan {
  double span = 0, held = 0;  ///< model unit
  double most = 0;            ///< length over that asked for
  std::optional<WingMiss> worst = std::nullopt;
};

/// Of stations with trailing edges, or of noses alone. By index, `share_of`: of the whole wing's span, and `way_of`:
/// what a station stands for, model unit.
template <class ShareOf, class WayOf>
void add_stations(const WingMesh& mesh, const WingRecord& wing, const Spanwise& spanwise, const ShareOf& share_of,
                  const WayOf& way_of, HeldSpan& all) {
  const std::vector<const WingRecord::Station*>& stations = spanwise.station;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const WingRecord::Station& s = *stations[i];
    const double part = way_of(i);
    all.span += part;
    double factor = 0;
    const auto take = [&](const char* what, double has, Vec3 place) {
      factor = std::max(factor, has / s.asked);
      if (has / s.asked <= all.most) return;
      all.most = has / s.asked;
      all.worst = WingMiss{0, share_of(i), place, what, has / s.chord, s.asked / s.chord};
    };
    if (s.asked > 0) {
      take("nose", nose_of(mesh, wing, spanwise, i).normal, s.nose);
      take("trailing edge", lengths_of(mesh, spanwise, i, &WingRecord::Station::trailing).normal, s.trailing);
    }
    if (factor <= kHeld) all.held += part;
  }
}

/// Sets `held` and `worst`, from all stations.
void measure_all_stations(const WingMesh& mesh, const WingRecord& wing, const Spanwise& spanwise, WingMeasure& own) {
  HeldSpan all;
  const double way = spanwise.way();
  add_stations(
      mesh, wing, spanwise, [&](std::size_t i) { return spanwise.share[i]; },
      [&](std::size_t i) { return way * spanwise.part(i); }, all);
  const Spanwise front(wing, Spanwise::Kind::kNosesAlone);
  const auto share_of_front = [&](std::size_t i) {
    const auto nearest = std::ranges::min_element(
        spanwise.station, {}, [&](const auto* s) { return distance(s->nose, front.station[i]->nose); });
    return spanwise.share[static_cast<std::size_t>(nearest - spanwise.station.begin())];
  };
  add_stations(
      mesh, wing, front, share_of_front, [&](std::size_t i) { return front.nose_way(i); }, all);
  own.worst = all.worst;
  if (all.span > 0) own.held = all.held / all.span;
}

/// Of stations with trailing edges, or of noses alone.
void add_unheld(const WingMesh& mesh, const WingRecord& wing, const Spanwise& spanwise, std::vector<UnheldPlace>& all) {
  const auto add = [&](std::size_t i, Vec3 WingRecord::Station::*place, double has) {
    const WingRecord::Station& s = *spanwise.station[i];
    if (s.asked > 0 && has > kHeld * s.asked && mesh.is_at(s.*place)) all.push_back({s.*place, kUnheldReach * s.asked});
  };
  for (std::size_t i = 0; i < spanwise.station.size(); ++i) {
    add(i, &WingRecord::Station::nose, nose_of(mesh, wing, spanwise, i).normal);
    add(i, &WingRecord::Station::trailing, lengths_of(mesh, spanwise, i, &WingRecord::Station::trailing).normal);
  }
}

}  // namespace

std::vector<WingMeasure> measure_wings(const SurfaceMesh& mesh, std::span<const WingRecord> wings) {
  std::vector<WingMeasure> all;
  for (const WingRecord& wing : wings) {
    WingMeasure own{.span = wing.span,
                    .covered = wing.covered,
                    .first_edge = wing.edges.empty() ? kNone : wing.edges[0],
                    .has_noses = wing.has_noses};
    const WingMesh triangles(mesh, wing);
    const Spanwise spanwise(wing);
    if (!wing.faces.empty()) own.n_triangles = triangles.n_triangles();
    std::vector<std::int64_t> of_groups(mesh.labels.group_name.size());
    count_groups(mesh, wing.faces, of_groups);
    own.group = main_group(mesh.labels, of_groups);
    if (!triangles.is_empty() && !spanwise.station.empty()) {
      measure_all_stations(triangles, wing, spanwise, own);
      const std::vector<std::size_t> listed = spanwise.listed();
      own.stations.resize(listed.size());
      parallel_for(listed.size(), 1, [&](std::size_t i, std::size_t) {
        own.stations[i] = measure_station(triangles, wing, spanwise, listed[i]);
      });
    }
    all.push_back(std::move(own));
  }
  return all;
}

std::vector<UnheldPlace> find_unheld(const SurfaceMesh& mesh, std::span<const WingRecord> wings) {
  std::vector<UnheldPlace> all;
  for (const WingRecord& wing : wings) {
    const WingMesh triangles(mesh, wing);
    WingMeasure whole;
    if (const Spanwise spanwise(wing); !triangles.is_empty() && !spanwise.station.empty())
      measure_all_stations(triangles, wing, spanwise, whole);
    if (triangles.is_empty() || whole.held >= kHeldShare) continue;
    for (const auto kind : {Spanwise::Kind::kOfEdges, Spanwise::Kind::kNosesAlone})
      add_unheld(triangles, wing, Spanwise(wing, kind), all);
  }
  return all;
}

}  // namespace st
