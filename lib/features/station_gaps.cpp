#include "features/station_gaps.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "features/arc_table.h"
#include "features/edge_places.h"
#include "features/rim_edges.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr double kNearGuess = 0.05;  // of the chord: from a nose between or beside others to that on the surface
constexpr int kCurveSteps = 64;      // of a corner's edge, between which one place is looked for
constexpr int kBisections = 40;

class GapCloser {
 public:
  GapCloser(const GapSearch& search, const Vec3* axis, ChordEdge& edge)
      : search_(search),
        axis_(axis),
        edge_(edge),
        curve_(search.model.curve(edge.edge)),
        arc_(*curve_),
        rims_(search.model) {}

  void run() {
    const std::size_t n = edge_.stations.size();
    for (std::size_t i = 0; i < n; ++i) close(i, -1);
    for (std::size_t i = n; i-- > 0;) close(i, 1);
  }

 private:
  using Station = ChordStation;

  /// The nearest measured one from `i` on, that one left out; nullptr: there is none.
  const Station* next(std::size_t i, int step) const {
    for (auto k = static_cast<std::ptrdiff_t>(i) + step; k >= 0 && k < std::ssize(edge_.stations); k += step)
      if (edge_.stations[static_cast<std::size_t>(k)].is_measured) return &edge_.stations[static_cast<std::size_t>(k)];
    return nullptr;
  }

  /// `towards`: -1 or 1, where measured ones are.
  void close(std::size_t i, int towards) {
    Station& s = edge_.stations[i];
    if (s.is_measured || s.is_hidden) return;
    const Vec3 normal = axis_ ? *axis_ : normalized(curve_->evaluate(arc_.parameter_at(s.share)).d1);
    const Station *a = next(i, towards), *b = next(i, -towards);
    if (!a) return;
    s.is_hidden = has_no_nose(s, a->chord, normal);
    if (!b) b = next(static_cast<std::size_t>(a - edge_.stations.data()), towards);
    if (!s.is_hidden && b) measure(s, *a, *b, normal);
  }

  /// On the line through the noses of two others; further beside them than they are apart, at a corner alone.
  void measure(Station& s, const Station& a, const Station& b, Vec3 normal) {
    const double part = (s.share - a.share) / (b.share - a.share);
    const bool is_near = std::abs(part) <= 1;
    const Vec3 nose = a.nose + (is_near ? part * (b.nose - a.nose) : s.trailing - a.trailing);
    const Profile guess{.normal = normal, .nose = nose, .nose_face = a.nose_face, .chord = distance(nose, s.trailing)};
    if (!is_near || !measure_on_surface(s, a, b, guess)) measure_at_corner(s, a, b, guess);
  }

  bool measure_on_surface(Station& s, const Station& a, const Station& b, const Profile& guess) const {
    const double near = kNearGuess * guess.chord;
    for (const FaceId f : {a.nose_face, b.nose_face, search_.cutter.nearest_face(guess.nose, guess.normal, near)}) {
      if (f == kNone || !search_.is_own[f]) continue;
      const auto surface = search_.model.surface(f);
      std::optional<Vec2> uv = closest_point(*surface, guess.nose).uv;
      const auto x = exact_nose(*surface, s.trailing, guess, near, uv);
      if (!x || is_outlier(distance(*x, s.trailing), a.chord) ||
          search_.cutter.nearest_face(*x, guess.normal, search_.reach) != f)
        continue;
      s.nose = *x, s.nose_face = f, s.chord = distance(*x, s.trailing), s.is_measured = true;
      return true;
    }
    return false;
  }

  /// Where both noses lie on corners of the CAD, as on the rim of a plate, that between or beside them does, too.
  void measure_at_corner(Station& s, const Station& a, const Station& b, const Profile& guess) {
    const std::vector<EdgeId> of_a = rims_.at(a, search_.reach), of_b = rims_.at(b, search_.reach);
    if (of_a.empty() || of_b.empty()) return;
    double least = kNearGuess * guess.chord;
    for (std::size_t i = 0; i < of_a.size() + of_b.size(); ++i) {
      const EdgeId e = i < of_a.size() ? of_a[i] : of_b[i - of_a.size()];
      const std::optional<Vec3> x = place_on(*search_.model.curve(e), s.trailing, guess);
      if (!x || !(distance(*x, guess.nose) < least) || is_outlier(distance(*x, s.trailing), a.chord)) continue;
      const FaceId seen = search_.cutter.nearest_face(*x, guess.normal, search_.reach);
      if (seen == kNone || !search_.is_own[seen]) continue;
      least = distance(*x, guess.nose);
      s.nose = *x, s.nose_face = a.nose_face, s.chord = distance(*x, s.trailing), s.is_measured = true;
    }
  }

  /// Of a curve's places in the plane through a trailing edge, that nearest to the guess.
  static std::optional<Vec3> place_on(const Curve& curve, Vec3 trailing, const Profile& guess) {
    const auto height = [&](double t) { return dot(curve.point(t) - trailing, guess.normal); };
    const auto at = [&](int i) { return curve.t_min() + (curve.t_max() - curve.t_min()) * i / kCurveSteps; };
    std::optional<Vec3> best;
    for (int i = 0; i < kCurveSteps; ++i) {
      double low = at(i), high = at(i + 1);
      const bool is_below = height(low) < 0;
      if (is_below == (height(high) < 0)) continue;
      for (int k = 0; k < kBisections; ++k) {
        const double middle = 0.5 * (low + high);
        ((height(middle) < 0) == is_below ? low : high) = middle;
      }
      const Vec3 x = curve.point(low);
      if (!best || distance(x, guess.nose) < distance(*best, guess.nose)) best = x;
    }
    return best;
  }

  /// What is longer than the chord beside it, as a cut along a tip, says nothing.
  bool has_no_nose(const Station& s, double usual, Vec3 normal) const {
    const auto cut = search_.cutter.whole_cut(s.trailing, normal, search_.reach, search_.is_own);
    return cut && cut->chord <= kOutlier * usual && !cut->is_covered() &&
           (!cut->is_own || cut->thickness > ProfileCutter::kThickestPart);
  }

  const GapSearch& search_;
  const Vec3* axis_;
  ChordEdge& edge_;
  std::unique_ptr<Curve> curve_;
  ArcTable arc_;
  RimEdges rims_;
};

}  // namespace

bool is_along_chord(const LiftingSurface& surface, EdgeId edge, Vec3 x, Vec3 tangent) {
  LiftingSurface others;
  for (const ChordEdge& other : surface.trailing)
    if (other.edge != edge) others.trailing.push_back(other);
  const ChordStation* nearest = others.nearest_station(x);
  if (!nearest) nearest = surface.nearest_station(x);
  return nearest && std::abs(dot(tangent, normalized(nearest->nose - nearest->trailing))) > kAlongChord;
}

void hide_tip(const Model& model, const LiftingSurface& surface, ChordEdge& edge) {
  const auto curve = model.curve(edge.edge);
  const ArcTable arc(*curve);
  for (ChordStation& s : edge.stations)
    if (!s.is_measured && !s.is_hidden)
      s.is_hidden =
          is_along_chord(surface, edge.edge, s.trailing, normalized(curve->evaluate(arc.parameter_at(s.share)).d1));
}

void close_gaps(const GapSearch& search, const Vec3* axis, ChordEdge& edge) { GapCloser(search, axis, edge).run(); }

std::vector<UncoveredStretch> uncovered_stretches(const LiftingSurface& surface) {
  std::vector<UncoveredStretch> stretches;
  for (const ChordEdge& edge : surface.trailing) {
    bool goes_on = false;
    for (std::size_t i = 1; i < edge.stations.size(); ++i) {
      const ChordStation &a = edge.stations[i - 1], &b = edge.stations[i];
      for (const ChordStation* s : {&a, &b}) {
        const bool is_open = !s->is_measured && !s->is_hidden;
        if (is_open && !goes_on) stretches.push_back({edge.edge, 0});
        if (is_open) stretches.back().length += 0.5 * distance(a.trailing, b.trailing);
        goes_on = is_open;
      }
    }
  }
  return stretches;
}

}  // namespace st
