#include "features/thin_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace st {
namespace {

constexpr double kSharpest = radians(30);  // of an edge that is not declared
constexpr double kGrows = 2;               // thickness half way over that of the base, at least: a plate has 1

using Parts = std::vector<std::optional<ThinPart>>;

class ThinMeasurer {
 public:
  ThinMeasurer(const CutFrame& frame, bool is_leading)
      : frame_(frame), thickest_(is_leading ? std::numeric_limits<double>::infinity() : ProfileCutter::kThickestPart) {}

  /// Square to the axis that shows most, or to the edge where that shows more.
  Parts along(std::span<const EdgePlace> places) const {
    Parts best(places.size());
    std::size_t most = 0;
    for (const Vec3* axis : {&frame_.axes[0], &frame_.axes[1], &frame_.axes[2], static_cast<const Vec3*>(nullptr)}) {
      Parts own;
      for (const EdgePlace& place : places) own.push_back(at(place, axis));
      const auto n = static_cast<std::size_t>(std::ranges::count_if(own, [](const auto& p) { return p.has_value(); }));
      if (n <= most) continue;
      most = n;
      best = std::move(own);
    }
    drop_outliers(best);
    return best;
  }

 private:
  std::optional<ThinPart> at(const EdgePlace& place, const Vec3* axis) const {
    if (axis && std::abs(dot(place.tangent, *axis)) < kAlongAxis) return std::nullopt;
    return frame_.cutter.thin_part(place.x, axis ? *axis : place.tangent, frame_.reach, thickest_);
  }

  /// Neighbours of a place tell what is usual there.
  static void drop_outliers(Parts& parts) {
    const Parts all = parts;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i] && is_outlier(all[i]->chord, median(chords_around(std::span(all), i)))) parts[i].reset();
  }

  const CutFrame& frame_;
  const double thickest_;
};

/// Whether a place of an edge that nobody declared is behind a wing's trailing edge.
bool is_like_wing(const WingEdge& w, const ThinPart& part) {
  if (w.base == kNone) return w.angle <= kSharpest;
  return w.size <= kWidestBase * part.chord && part.middle >= kGrows * w.size;
}

double chord_near(std::span<const EdgePlace> places, const Parts& parts, Vec3 x) {
  double chord = 0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const double d = distance(places[i].x, x); parts[i] && d < nearest) {
      nearest = d;
      chord = parts[i]->chord;
    }
  return chord;
}

}  // namespace

ChordEdge chords_along(const Model& model, const WingEdge& edge, const std::function<double(const EdgePlace&)>& chord) {
  ChordEdge own{
      edge.edge, edge.base, edge.base != kNone && edge.mirror != kNone, edge.base == kNone ? 0 : edge.size, {}};
  std::vector<EdgePlace> places = places_along(model, {&edge, 1});
  const auto curve = model.curve(edge.edge);
  places.insert(places.begin(), {0, 0, 0, curve->point(curve->t_min()), {}});
  places.push_back({0, 1, 0, curve->point(curve->t_max()), {}});
  for (const EdgePlace& place : places) own.stations.push_back({place.share, place.x, chord(place)});
  return own;
}

std::optional<LiftingSurface> find_thin_surface(const Model& model, const CutFrame& frame,
                                                const std::vector<WingEdge>& edges) {
  LiftingSurface surface;
  surface.has_noses = false;
  surface.is_declared = edges.front().is_declared;
  const bool is_leading = edges.front().kind == WingEdgeKind::kLeading;
  const std::vector<EdgePlace> places = places_along(model, edges);
  const ThinMeasurer measurer(frame, is_leading);
  Parts parts;
  double way = 0, measured = 0;
  std::vector<double> chords;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto own = std::span(places).subspan(k * kPlacesPerEdge, kPlacesPerEdge);
    for (std::optional<ThinPart>& part : measurer.along(own)) {
      if (part && !surface.is_declared && !is_like_wing(edges[k], *part)) part.reset();
      way += own.front().way;
      if (part) measured += own.front().way, chords.push_back(part->chord);
      parts.push_back(part);
    }
  }
  if (chords.empty()) return std::nullopt;
  surface.set_chords(chords);
  for (const WingEdge& w : edges) {
    const ChordEdge own = chords_along(model, w, [&](const EdgePlace& p) { return chord_near(places, parts, p.x); });
    (is_leading ? surface.declared_leading : surface.trailing).push_back(own);
    if (is_leading) surface.leading.push_back(w.edge);
    surface.is_blunt = surface.is_blunt || own.base != kNone;
    surface.span += own.base == kNone || own.is_half ? w.length : 0.5 * w.length;
  }
  const bool is_wing = measured >= kMeasured * way && surface.span >= kLeastSpan * surface.median_chord;
  return surface.is_declared || is_wing ? std::optional(std::move(surface)) : std::nullopt;
}

}  // namespace st
