#include "features/round_tails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/disjoint_sets.h"
#include "base/sort_once.h"
#include "features/arc_table.h"
#include "features/concave_edges.h"
#include "features/edge_places.h"
#include "features/own_faces.h"
#include "features/profile.h"
#include "features/profile_facets.h"
#include "features/span_edges.h"
#include "geometry/model/edge_faces.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr double kDeflection = 1e-2;  // of the chord: of the facets; the ends of cuts are found on the surfaces
constexpr double kBluntest = 0.8;     // thickness near the tail over that near the nose: an ellipse has 1
constexpr double kTailRadius = 0.05, kNoseRadius = 0.15;  // of the chord: across the span, at most
constexpr double kRidge = 5;                              // curvature there across the span over that along it
constexpr double kLeastWay = 0.25, kMostWay = 3;          // of the way along the edge: ways along tails and along noses
constexpr double kOnEdge = 0.01;                          // of the chord: an edge is the trailing edge, or the nose
constexpr double kSameTail = 0.05;                        // of the chord: between the tails of two edges along one body
constexpr std::array<double, 6> kEnds = {0.002, 0.006, 0.012, 0.988, 0.994, 0.998};  // shares at which tails end

/// What cuts along one edge show.
struct Draft {
  ChordEdge edge;
  std::vector<FaceId> faces;
  bool is_on_nose = false;
  double span = 0;   // along the tails, model unit
  double chord = 0;  // median, model unit
};

using Profiles = std::vector<std::optional<RoundProfile>>;

double way_along(const ChordEdge& edge, Vec3 ChordStation::*place) {
  double way = 0;
  const ChordStation* last = nullptr;
  for (const ChordStation& s : edge.stations) {
    if (!s.is_measured) continue;
    if (last) way += distance(last->*place, s.*place);
    last = &s;
  }
  return way;
}

std::vector<Vec3> tail_of(const Draft& draft) {
  std::vector<Vec3> tail;
  for (const ChordStation& s : draft.edge.stations)
    if (s.is_measured) tail.push_back(s.trailing);
  return tail;
}

/// Whether most of its tail is near a line.
bool runs_along(const Draft& own, std::span<const Vec3> line) {
  std::size_t n = 0, n_near = 0;
  for (const ChordStation& s : own.edge.stations) {
    if (!s.is_measured) continue;
    ++n;
    bool is_near = false;
    for (std::size_t i = 1; i < line.size() && !is_near; ++i)
      is_near = segment_distance(s.trailing, line[i - 1], line[i]) < kSameTail * s.chord;
    n_near += is_near;
  }
  return 2 * n_near > n;
}

bool has_same_tail(const Draft& own, const Draft& other) { return runs_along(own, tail_of(other)); }

/// Cuts along one edge.
class TailMeasurer {
 public:
  TailMeasurer(const Model& model, const FaceRoles& roles)
      : model_(model), roles_(roles), facets_(model, roles), faces_at_(model.tables()) {}

  std::optional<Draft> run(const EdgeWithChord& span_edge) {
    leave_other_bodies(span_edge.edge);
    const WingEdge own{.edge = span_edge.edge, .length = model_.tables().edge_length[span_edge.edge]};
    ProfileFacets& facets = facets_.near(kDeflection * span_edge.chord, true);
    if (!is_wing_half_way(own, facets)) return std::nullopt;
    facets.add_along({&own, 1}, SerialExecutor());
    const std::vector<EdgePlace> places = places_with_ends(own);
    const Profiles profiles = best_profiles(places, ProfileCutter(facets.facets()), facets.reach());
    return draft_of(own, places, profiles, facets.reach());
  }

 private:
  /// Cuts search all facets that are there: those of faces that the last edges did not reach are dropped, so that a
  /// hundred blades take a hundred times as long as one.
  void leave_other_bodies(EdgeId e) {
    if (std::ranges::none_of(faces_at_[e], [&](FaceId f) { return facets_.knows(f); })) facets_.clear();
  }

  /// Spares facets of bodies that are none.
  bool is_wing_half_way(const WingEdge& own, ProfileFacets& facets) {
    const auto curve = model_.curve(own.edge);
    const CurvePoint p = curve->evaluate(ArcTable(*curve).parameter_at(0.5));
    const auto is_wing = [&](Vec3 normal) {
      facets.add_cut(own.edge, p.x, normal, SerialExecutor());
      const auto profile = ProfileCutter(facets.facets()).round_profile(p.x, normal, facets.reach());
      return profile && is_ridged(*profile, station_at({0, 0.5, 0, p.x, normal}, *profile, facets.reach()));
    };
    const Vec3 tangent = normalized(p.d1);
    const auto is_along = [&](Vec3 axis) { return std::abs(dot(tangent, axis)) >= kAlongAxis && is_wing(axis); };
    return is_wing(tangent) || std::ranges::any_of(roles_.own.axis, is_along);
  }

  /// Sharply bent across the span at both ends, and hardly along it; more so at the tail.
  bool is_ridged(const RoundProfile& p, const ChordStation& s) const {
    const auto is_ridge = [&](FaceId f, Vec3 x, double radius) {
      const auto surface = model_.surface(f);
      const SurfacePoint2 at = surface->evaluate2(closest_point(*surface, x).uv);
      const Curvature c = principal_curvature(at);
      return std::abs(c.k1) * radius * s.chord >= 1 && std::abs(c.k1) >= kRidge * std::abs(c.k2) &&
             std::abs(dot(flattest_direction(at, c), p.profile.normal)) >= kAlongAxis;
    };
    return p.bluntness <= kBluntest && is_ridge(s.tail_face, s.trailing, kTailRadius) &&
           is_ridge(s.nose_face, s.nose, kNoseRadius);
  }

  std::vector<EdgePlace> places_with_ends(const WingEdge& own) const {
    std::vector<EdgePlace> places = places_along(model_, {&own, 1});
    const auto curve = model_.curve(own.edge);
    const ArcTable arc(*curve);
    for (const double share : kEnds) {
      const CurvePoint p = curve->evaluate(arc.parameter_at(share));
      places.push_back({0, share, 0, p.x, normalized(p.d1)});
    }
    std::ranges::sort(places, {}, &EdgePlace::share);
    return places;
  }

  /// Square to the axis of the model that shows most, or to the line between the ends of the edge where that shows
  /// more; square to the edge only where that shows clearly more.
  Profiles best_profiles(std::span<const EdgePlace> places, const ProfileCutter& cutter, double reach) const {
    Profiles best;
    double longest = -1;
    const auto take = [&](const Vec3* axis, double most) {
      Profiles own;
      double way = 0;
      for (const EdgePlace& place : places) {
        own.emplace_back();
        if (axis && std::abs(dot(place.tangent, *axis)) < kAlongAxis) continue;
        own.back() = cutter.round_profile(place.x, axis ? *axis : place.tangent, reach);
        way += own.back() ? place.way : 0;
      }
      if (way <= most * longest) return;
      longest = way;
      best = std::move(own);
    };
    const Vec3 direction = normalized(places.back().x - places.front().x);
    for (const Vec3& axis : roles_.own.axis) take(&axis, 1);
    take(&direction, 1);
    take(nullptr, kClearlyMore);
    drop_outliers(best);
    return best;
  }

  static void drop_outliers(Profiles& profiles) {
    std::vector<std::optional<Profile>> all;
    for (const auto& p : profiles) all.push_back(p ? std::optional(p->profile) : std::nullopt);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i] && is_outlier(all[i]->chord, median(chords_around(std::span(std::as_const(all)), i))))
        profiles[i].reset();
  }

  /// The ends of a profile on the CAD's surfaces: each is the furthest from the other.
  ChordStation station_at(const EdgePlace& place, const RoundProfile& p, double reach) {
    ChordStation s{.share = place.share, .trailing = p.tail, .is_measured = true};
    s.nose = p.profile.nose;
    s.nose_face = p.profile.nose_face;
    s.tail_face = p.tail_face;
    const auto on_surface = [&](FaceId f, Vec3 from, Vec3& x, std::optional<Vec2>& guess) {
      Profile own = p.profile;
      own.nose = x;
      if (const auto exact = exact_nose(*model_.surface(f), from, own, reach, guess)) x = *exact;
    };
    on_surface(s.nose_face, s.trailing, s.nose, nose_guess_[s.nose_face]);
    on_surface(s.tail_face, s.nose, s.trailing, tail_guess_[s.tail_face]);
    s.chord = distance(s.nose, s.trailing);
    return s;
  }

  /// nullopt: its ends do not run along the edge, or it is too short.
  std::optional<Draft> draft_of(const WingEdge& own, std::span<const EdgePlace> places, const Profiles& profiles,
                                double reach) {
    Draft draft;
    draft.edge.edge = own.edge;
    draft.edge.is_inside = true;
    std::vector<double> chords;
    std::size_t n_on_tail = 0, n_on_nose = 0;
    double way = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!profiles[i]) continue;
      const ChordStation s = station_at(places[i], *profiles[i], reach);
      const auto& known = draft.edge.stations;
      if (!is_ridged(*profiles[i], s) ||
          (!known.empty() && dot(s.trailing - s.nose, known.back().trailing - known.back().nose) < 0))
        continue;  // as where a plane leaves the wing through its tip
      way += places[i].way;
      n_on_tail += distance(s.trailing, places[i].x) < kOnEdge * s.chord;
      n_on_nose += distance(s.nose, places[i].x) < kOnEdge * s.chord;
      chords.push_back(s.chord);
      draft.edge.stations.push_back(s);
      draft.faces.insert(draft.faces.end(), profiles[i]->profile.faces.begin(), profiles[i]->profile.faces.end());
    }
    draft.span = way_along(draft.edge, &ChordStation::trailing);
    draft.chord = median(chords);
    const auto runs_along = [&](double way) { return way >= kLeastWay * own.length && way <= kMostWay * own.length; };
    if (way < kMeasured * own.length || draft.span < kLeastSpan * draft.chord || !runs_along(draft.span) ||
        !runs_along(way_along(draft.edge, &ChordStation::nose)))
      return std::nullopt;
    draft.is_on_nose = 2 * n_on_nose > chords.size();
    if (2 * n_on_tail > chords.size()) put_on_edge(draft.edge);
    add_ends(draft.edge);
    return draft;
  }

  void put_on_edge(ChordEdge& edge) const {
    const auto curve = model_.curve(edge.edge);
    const ArcTable arc(*curve);
    edge.is_inside = false;
    for (ChordStation& s : edge.stations) {
      s.trailing = curve->point(arc.parameter_at(s.share));
      s.chord = distance(s.nose, s.trailing);
    }
  }

  /// Stations at the ends of the edge; where the tail is inside faces, they are where it was seen last.
  void add_ends(ChordEdge& edge) const {
    const auto curve = model_.curve(edge.edge);
    ChordStation first = edge.stations.front(), last = edge.stations.back();
    first.share = 0;
    last.share = 1;
    first.is_measured = last.is_measured = false;
    if (!edge.is_inside) {
      first.trailing = curve->point(curve->t_min());
      last.trailing = curve->point(curve->t_max());
    }
    edge.stations.insert(edge.stations.begin(), first);
    edge.stations.push_back(last);
  }

  const Model& model_;
  const FaceRoles& roles_;
  FacetStore facets_;
  EdgeFaces faces_at_;
  std::map<FaceId, std::optional<Vec2>> nose_guess_, tail_guess_;  // (u,v) of the last one on each face
};

/// All of a model.
class TailFinder {
 public:
  TailFinder(const Model& model, const FaceRoles& roles, std::span<const std::uint8_t> is_excluded)
      : model_(model), t_(model.tables()), roles_(roles), is_excluded_(is_excluded) {}

  std::vector<LiftingSurface> run(std::span<const EdgeWithChord> along_span) {
    TailMeasurer measurer(model_, roles_);
    std::vector<Draft> drafts;
    std::vector<std::vector<Vec3>> excluded = excluded_edges();
    for (const EdgeWithChord& e : along_span) {
      std::optional<Draft> own = measurer.run(e);
      if (own && is_excluded_[e.edge]) excluded.push_back(tail_of(*own));
      if (own && !is_excluded_[e.edge]) drafts.push_back(std::move(*own));
    }
    std::erase_if(drafts, [&](const Draft& own) {
      return std::ranges::any_of(excluded, [&](const std::vector<Vec3>& line) { return runs_along(own, line); });
    });
    if (drafts.empty()) return {};
    const std::vector<Draft> best = once(drafts);
    const std::vector<std::uint8_t> is_concave = find_concave_edges(model_, roles_);
    std::vector<LiftingSurface> found;
    for (const Draft& own : best)
      if (std::optional<LiftingSurface> wing = surface_of(own, drafts, is_concave)) found.push_back(std::move(*wing));
    return united(std::move(found));
  }

 private:
  /// Points along each.
  std::vector<std::vector<Vec3>> excluded_edges() const {
    constexpr int kPoints = 17;
    std::vector<std::vector<Vec3>> lines;
    for (EdgeId e = 0; e < t_.n_edges(); ++e) {
      if (!is_excluded_[e] || t_.edge_is_degenerate[e]) continue;
      const auto curve = model_.curve(e);
      std::vector<Vec3>& line = lines.emplace_back();
      for (int i = 0; i < kPoints; ++i)
        line.push_back(curve->point(std::lerp(curve->t_min(), curve->t_max(), static_cast<double>(i) / (kPoints - 1))));
    }
    return lines;
  }

  /// One of those along each tail: on the tail itself before others, and longer before shorter ones.
  static std::vector<Draft> once(std::vector<Draft> drafts) {
    std::ranges::stable_sort(drafts, [](const Draft& a, const Draft& b) {
      return a.edge.is_inside != b.edge.is_inside ? b.edge.is_inside : a.span > b.span;
    });
    std::vector<Draft> best;
    for (Draft& own : drafts)
      if (std::ranges::none_of(best, [&](const Draft& other) { return has_same_tail(own, other); }))
        best.push_back(std::move(own));
    return best;
  }

  /// nullopt: no profile is its own.
  std::optional<LiftingSurface> surface_of(const Draft& own, const std::vector<Draft>& all,
                                           std::span<const std::uint8_t> is_concave) const {
    LiftingSurface wing;
    wing.trailing = {own.edge};
    wing.faces = own.faces;
    wing.span = own.span;
    sort_once(wing.faces);
    keep_own(t_, is_concave, {}, wing);
    for (const Draft& other : all)
      if (other.is_on_nose && has_same_tail(other, own)) wing.leading.push_back(other.edge.edge);
    for (ChordStation& s : wing.trailing[0].stations) s.chord = s.chord > 0 ? s.chord : own.chord;
    return wing.covered() > 0 ? std::optional(std::move(wing)) : std::nullopt;
  }

  /// Those with faces in common become one. By first edge.
  static std::vector<LiftingSurface> united(std::vector<LiftingSurface> wings) {
    std::ranges::sort(wings, {}, [](const LiftingSurface& w) { return w.trailing.front().edge; });
    DisjointSets sets(static_cast<std::int64_t>(wings.size()));
    std::map<FaceId, std::int32_t> first;
    for (std::size_t i = 0; i < wings.size(); ++i)
      for (const FaceId f : wings[i].faces) {
        const auto [known, is_new] = first.emplace(f, static_cast<std::int32_t>(i));
        if (!is_new) sets.join(static_cast<std::int32_t>(i), known->second);
      }
    std::vector<LiftingSurface> all;
    for (const std::vector<std::int32_t>& group : sets.groups()) {
      LiftingSurface& own = all.emplace_back();
      own.is_round = true;
      for (const std::int32_t i : group) append(wings[static_cast<std::size_t>(i)], own);
      std::vector<double> chords;
      for (const ChordEdge& edge : own.trailing)
        for (const ChordStation& s : edge.stations)
          if (s.is_measured) chords.push_back(s.chord);
      own.set_chords(chords);
    }
    return all;
  }

  static void append(const LiftingSurface& part, LiftingSurface& all) {
    all.trailing.insert(all.trailing.end(), part.trailing.begin(), part.trailing.end());
    all.leading.insert(all.leading.end(), part.leading.begin(), part.leading.end());
    all.faces.insert(all.faces.end(), part.faces.begin(), part.faces.end());
    all.span += part.span;
    sort_once(all.leading);
    sort_once(all.faces);
  }

  const Model& model_;
  const ModelTables& t_;
  const FaceRoles& roles_;
  std::span<const std::uint8_t> is_excluded_;  // [n_edges]
};

}  // namespace

void add_round_tails(const Model& model, const FaceRoles& roles, std::span<const WingEdge> edges,
                     std::span<const std::uint8_t> is_excluded, std::vector<LiftingSurface>& wings,
                     const Executor& executor) {
  const std::vector<EdgeWithChord> along_span = find_span_edges(model, roles, wings, executor);
  if (!executor.is_root()) return;
  for (LiftingSurface& wing : TailFinder(model, roles, is_excluded).run(along_span)) {
    add_leading(model, edges, wing);
    wings.push_back(std::move(wing));
  }
}

}  // namespace st
