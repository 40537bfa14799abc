#include "features/lifting_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/disjoint_sets.h"
#include "base/share.h"
#include "base/sort_once.h"
#include "features/arc_table.h"
#include "features/concave_edges.h"
#include "features/edge_places.h"
#include "features/front_noses.h"
#include "features/own_faces.h"
#include "features/profile.h"
#include "features/profile_facets.h"
#include "features/station_gaps.h"
#include "features/thin_surface.h"
#include "features/trailing_chains.h"
#include "geometry/model/edge_faces.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr int kStations = kPlacesPerEdge;
constexpr std::size_t kChainsPerTask = 8;      // each task sorts the facets once
constexpr double kDeflection = 1e-3;           // of the reference diagonal: of the facets
constexpr double kOffSurface = 0.75;           // of the reach: a nose on facets further from the CAD is none
constexpr double kOffBeside = 0.02;            // of the chord: likewise pieces of the cut beside a nose
constexpr double kSharpNose = radians(30);     // what is its own nose, as a lens, may be a wing's tip if no less sharp
constexpr double kSeen = 0.9;                  // of the way with noses: less asks for exact facets
constexpr double kSeenSmall = 0.95;            // likewise of what is short beside the model
constexpr double kLongBlade = 0.05;            // of the reference diagonal: extent of a blade's edges at least
constexpr double kLargeBody = 5;               // of a small blade's extent: the diagonal of its faces at most
constexpr double kStraightBlade = 0.7;         // the same over their length
constexpr double kLeastNoseWay = 0.25;         // of the way along the trailing edge: way along the noses
constexpr double kOnPlane = 1e-6;              // of the reference diagonal: from a plane of symmetry
constexpr double kAcrossSpan = 0.7;            // cosine between the normal of a tip or a root and the chain
constexpr double kJump = 3;                    // chord over that of the next cut: one along the span
constexpr double kParallelSides = radians(1);  // of a base, from square to it
constexpr double kRoundCorner = radians(150);  // material at the edges of a base without corners
constexpr double kWidestCut = 0.1;             // of the chord: base of a profile whose tail may have been cut off
constexpr double kThickBefore = 1.8;           // thickness of such a profile over its base, at least
constexpr double kShortest = 0.2;              // span over the median chord: pylons, blades of impellers
constexpr double kSmallPart = 0.01;            // of the reference diagonal: a shorter one has to be half a chord long
constexpr double kNeedle = 30;                 // span over the median chord: slivers beside wings
constexpr double kSliverChord = 0.05;          // of the largest wing's: chord of such a sliver at most
constexpr double kRunsOut = 0.1;               // least chord of such a sliver over its largest, at most
constexpr double kNearAxis = 0.94;             // cosine: 20 degrees
constexpr double kNarrowStrip = 0.05;          // width of a strip of the skin over the length of its edge, at most
constexpr double kParallelEnds = 0.9998;       // cosine: 1 degree
constexpr double kAlongEnds = 0.3;             // as kAlongAxis, for normals that the ends of a chain tell
constexpr double kSameDirection = 0.998;       // cosine: 4 degrees
constexpr double kMostCorners = 0.5;           // of the way with profiles: where these end in a square corner
constexpr double kSquareCorner = 0.5;          // cosine: 60 to 120 degrees
constexpr double kPlaneFace = 1e-3;            // radians: between normals of a plane face
constexpr double kNoseStrip = 0.02;            // of the chord: width of the faces at such a corner, at least
constexpr double kNearNose = 0.05;             // of the chord: between nose and leading edge at most
constexpr double kLeftAtTip = 1e-3;            // of the chord: from the last nose to a tip, as `rans` asks
constexpr double kCovered = 1e-3;              // of the chord: from a nose to another face that is nearer, at least
constexpr double kClearlyFurther = 1e-4;       // of the chord: of two noses side by side, the one that counts
constexpr double kApart = 1e-3;                // of the chord: two noses, and not one on an edge
constexpr Vec3 kUp{0.27, 0.53, 0.80};          // upper means so, in any position: no plane of symmetry is along it
constexpr double kLens = 0.75;                 // of the way where the nose is on the edge itself: does not count

constexpr const char *kRimOfEnd = "they are rims of a tip or a root",
                     *kRimOfPlate = "its base is square to both sides: the rim of a plate",
                     *kSliver = "they are those of a sliver that runs out to a point";

/// A lifting surface that is not finished; see SurfaceMeasurer.
struct SurfaceDraft {
  LiftingSurface surface;
  std::vector<const Vec3*> axis;  // by edge: to which its profiles are square; nullptr: to the edge
};

/// Whether a nose lies on the trailing edge of a surface.
bool is_nose_on(const ChordStation& s, const LiftingSurface& surface) {
  for (const ChordEdge& edge : surface.trailing)
    for (std::size_t i = 1; i < edge.stations.size(); ++i)
      if (segment_distance(s.nose, edge.stations[i - 1].trailing, edge.stations[i].trailing) < kNearNose * s.chord)
        return true;
  return false;
}

/// Whether noses of most stations of `a` lie on the trailing edge of `b`.
bool has_nose_on(const LiftingSurface& a, const LiftingSurface& b) {
  std::size_t n = 0, n_near = 0;
  for (const ChordEdge& edge : a.trailing)
    for (const ChordStation& s : edge.stations) {
      if (!s.is_measured) continue;
      ++n;
      n_near += is_nose_on(s, b);
    }
  return 2 * n_near > n;
}

/// How far the trailing edge of `a` runs with noses, on that of `b` alone where it is given.
double way_with_noses(const LiftingSurface& a, const LiftingSurface* b = nullptr) {
  double way = 0;
  for (const ChordEdge& edge : a.trailing)
    for (std::size_t i = 1; i < edge.stations.size(); ++i)
      for (const ChordStation* s : {&edge.stations[i - 1], &edge.stations[i]})
        if (s->is_measured && (!b || is_nose_on(*s, *b)))
          way += 0.5 * distance(edge.stations[i - 1].trailing, edge.stations[i].trailing);
  return way;
}

/// Whether an edge runs along the chord of the nearest station: a rim of the tip or the root, in a chain because it
/// looks like a blunt trailing edge where the profile is thin.
bool is_rim(const Model& model, EdgeId e, const LiftingSurface& surface) {
  const auto curve = model.curve(e);
  const Vec3 begin = curve->point(curve->t_min()), end = curve->point(curve->t_max()), middle = 0.5 * (begin + end);
  return is_along_chord(surface, e, middle, normalized(end - begin));
}

/// Why there is no lifting surface.
struct Reason {
  std::string text;
  bool may_be_wing = true;
  bool is_inexact = false;   // facets are too coarse to tell
  bool is_own_nose = false;  // and as sharp as a nose may be

  static auto fields(auto& r) { return std::tie(r.text, r.may_be_wing, r.is_inexact, r.is_own_nose); }
};

/// Edges of a chain that are no part of a surface with noses.
struct Rest {
  std::vector<WingEdge> edges;
  Reason why;

  static auto fields(auto& r) { return std::tie(r.edges, r.why); }
};

/// Trailing edges that belong together.
struct Chain {
  std::vector<WingEdge> edges;

  static auto fields(auto& c) { return std::tie(c.edges); }
};

/// What a search along chains finds.
struct ChainSurfaces {
  std::vector<LiftingSurface> surfaces;
  std::vector<Rest> rest;
  std::vector<CutPlace> ends;  // of cuts through the facets

  static auto fields(auto& f) { return std::tie(f.surfaces, f.rest, f.ends); }
};

/// What exact facets of a chain's own faces show.
struct ExactSurface {
  std::optional<LiftingSurface> surface;
  Reason why;
};

/// What all searches of a rank need, made once. For any thread.
class FinderMemory {
 public:
  FinderMemory(const Model& model, const FaceRoles& roles) : model_(model), roles_(roles) {}

  const std::vector<std::uint8_t>& concave_edges() {
    std::call_once(has_concave_, [this] { is_concave_ = find_concave_edges(model_, roles_); });
    return is_concave_;
  }

  /// By the edges of the chain: coarse facets that are added later do not change it.
  template <class Make>
  const ExactSurface& exact_surface(std::vector<EdgeId> chain, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = tried_.find(chain); known != tried_.end()) return known->second;
    }
    ExactSurface made = make();
    const std::lock_guard lock(mutex_);
    return tried_.try_emplace(std::move(chain), std::move(made)).first->second;
  }

 private:
  const Model& model_;
  const FaceRoles& roles_;
  std::once_flag has_concave_;
  std::vector<std::uint8_t> is_concave_;  // by edge
  std::mutex mutex_;
  std::map<std::vector<EdgeId>, ExactSurface> tried_;
};

/// How a chain is cut; lengths in the model unit.
struct CutRules {
  std::vector<Vec3> normals;  // of the planes: the first of equally good ones
  std::size_t n_of_ends = 0;  // of these, those that its ends tell
  std::size_t n_axes = 0;     // with those of the model; after them comes the line along the chain
  Vec3 along;                 // from end to end of the chain, unit
  std::vector<EdgeId> rims;   // edges of the chain on planes across that
  double reach = 0;           // how far from a place the cut may begin
  double diagonal = 0;        // reference diagonal
  ChainLine line;             // of the chain

  std::span<const Vec3> of_ends() const { return std::span(normals).first(n_of_ends); }
};

class SurfaceMeasurer {
 public:
  /// All must outlive the object.
  SurfaceMeasurer(const Model& model, const ProfileCutter& cutter, const CutRules& rules)
      : model_(model), cutter_(cutter), rules_(rules) {}

  /// What profiles show; stations and faces may reach into other bodies yet. Where they show too little along the whole
  /// chain, that of its edges with profiles: others may be the rims of a thin tip or root. Else why there is none.
  std::optional<SurfaceDraft> find(const std::vector<WingEdge>& chain, Reason& why) const {
    const std::vector<EdgePlace> places = places_along(model_, chain);
    why = {"no plane cuts the profile of a wing there"};
    if (!is_promising(places)) return std::nullopt;
    std::vector<const Vec3*> axis;
    std::vector<std::optional<Profile>> profiles = best_profiles(places, axis);
    for (std::size_t i = 0; i < places.size(); ++i)  // winglets, and blades along which no axis of the model runs
      if (!profiles[i]) profiles[i] = profile_at(places[i], nullptr);
    drop_outliers(places, profiles);
    const double share = measured_way(places, profiles) / way_of(places);
    if (share < kMeasured) {
      why = {fmt::format("planes cut the profile of a wing on {:.0f} % of its length, half is needed", 100 * share)};
      return find_part(measured_edges(chain, places, profiles), chain, why);
    }
    if (const double way = corner_way(places, profiles); way > kMostCorners * measured_way(places, profiles)) {
      why = {"its profiles end in a corner between straight sides, not in a nose"};
      return std::nullopt;
    }
    drop_oblique(axis, profiles);
    try_other_cuts(places, profiles);
    LiftingSurface surface = assemble(chain, places, profiles);
    if (!is_measured(surface)) return std::nullopt;
    if (const std::vector<WingEdge> part = narrow_edges(chain, surface); part.size() < chain.size()) {
      std::optional<SurfaceDraft> draft =
          find_without(fmt::format("its base is wider than {:g} % of the chord", 100 * kWidestBase), part, why);
      why.may_be_wing = why.may_be_wing || (part.empty() && is_cut_off(surface, profiles));
      return draft;
    }
    if (const std::vector<WingEdge> part = without_rims(chain, surface); part.size() < chain.size())
      return find_without(kRimOfEnd, part, why);
    why = {why_no_wing(surface), false};
    if (why.text.empty() && has_nose_on(surface, surface)) {
      const bool is_no_lens =
          std::ranges::all_of(chain, [](const WingEdge& w) { return w.base != kNone || w.angle <= kSharpNose; });
      why = {"it is its own nose, as the rim of a lens", is_no_lens};  // or nose and trailing edge meet at a tip
      why.is_own_nose = is_no_lens;
    }
    if (!why.text.empty()) return std::nullopt;
    return SurfaceDraft{std::move(surface), std::move(axis)};
  }

  /// Leaves out what is not the wing's own, goes on to the ends of its profiles, and fills in the rest. None where
  /// nothing of it is its own.
  std::optional<LiftingSurface> finish(SurfaceDraft&& draft, std::span<const std::uint8_t> is_concave,
                                       std::span<const std::uint8_t> is_wall) const {
    LiftingSurface& surface = draft.surface;
    keep_own(model_.tables(), is_concave, find_covers(draft, is_concave), surface);
    if (!is_measured(surface)) return std::nullopt;
    is_off_ =
        is_off_ || std::ranges::any_of(wrong_, [&](FaceId f) { return std::ranges::binary_search(surface.faces, f); });
    const std::vector<std::uint8_t> is_own = find_body_faces(model_.tables(), is_concave, is_wall, surface);
    for (std::size_t k = 0; k < surface.trailing.size(); ++k) {
      reach_ends(draft.axis[k], surface.faces, surface.trailing[k]);
      close_gaps({model_, cutter_, rules_.reach, is_own}, draft.axis[k], surface.trailing[k]);
      if (draft.axis[k]) close_crests(*draft.axis[k], surface.faces, surface.trailing[k]);
    }
    for (ChordEdge& edge : surface.trailing) hide_tip(model_, surface, edge);
    measure_chords(surface);
    fill_in(surface);
    return std::move(surface);
  }

  /// Facets left the CAD where a nose was looked for.
  bool is_off() const { return is_off_; }

 private:
  /// None where the part is the whole again: planes may cut an edge on half of its length to rounding.
  std::optional<SurfaceDraft> find_part(const std::vector<WingEdge>& part, const std::vector<WingEdge>& whole,
                                        Reason& why) const {
    if (part.empty() || part.size() == whole.size()) return std::nullopt;
    Reason own;
    std::optional<SurfaceDraft> draft = find(part, own);
    why.is_own_nose = own.is_own_nose;
    return draft;
  }

  /// Where the rest shows no surface either, the reason is that of the rest.
  std::optional<SurfaceDraft> find_without(const std::string& why_not_others, const std::vector<WingEdge>& part,
                                           Reason& why) const {
    std::optional<SurfaceDraft> draft;
    if (!part.empty()) draft = find(part, why);
    if (draft || part.empty()) why = {why_not_others, false};
    return draft;
  }

  static bool is_measured(const LiftingSurface& surface) {
    const auto has_station = [](const ChordEdge& edge) {
      return std::any_of(edge.stations.begin(), edge.stations.end(),
                         [](const ChordStation& s) { return s.is_measured; });
    };
    return std::any_of(surface.trailing.begin(), surface.trailing.end(), has_station);
  }

  /// Without those whose base is too wide for the chord: rims of a thin tip or root, or of a plate.
  static std::vector<WingEdge> narrow_edges(const std::vector<WingEdge>& chain, const LiftingSurface& surface) {
    std::vector<WingEdge> part;
    for (std::size_t k = 0; k < chain.size(); ++k)
      if (surface.trailing[k].base_width <= kWidestBase * surface.median_chord) part.push_back(chain[k]);
    return part;
  }

  /// A profile that is thick before its wide base, as where a wing's tail was cut off.
  static bool is_cut_off(const LiftingSurface& surface, std::span<const std::optional<Profile>> profiles) {
    std::vector<double> thickness;
    for (const auto& p : profiles)
      if (p) thickness.push_back(p->thickness * p->chord);
    double width = 0;
    for (const ChordEdge& edge : surface.trailing) width = std::max(width, edge.base_width);
    return width <= kWidestCut * surface.median_chord && median(thickness) >= kThickBefore * width;
  }

  /// Without rims of planes across the span that run along the chord: skins that meet a tip or a root at a small angle.
  /// Cuts at rims may be oblique: the chord is that at the other edges.
  std::vector<WingEdge> without_rims(const std::vector<WingEdge>& chain, const LiftingSurface& surface) const {
    const auto may_be_rim = [&](EdgeId e) { return std::ranges::count(rules_.rims, e) > 0; };
    LiftingSurface others;
    for (const ChordEdge& edge : surface.trailing)
      if (!may_be_rim(edge.edge)) others.trailing.push_back(edge);
    const LiftingSurface& known = is_measured(others) ? others : surface;
    std::vector<WingEdge> part;
    for (const WingEdge& w : chain)
      if (!may_be_rim(w.edge) || !is_rim(model_, w.edge, known)) part.push_back(w);
    return part.empty() ? chain : part;
  }

  /// Empty for a wing.
  std::string why_no_wing(const LiftingSurface& surface) const {
    if (surface.span < std::min(kLeastSpan * surface.median_chord, kSmallPart * rules_.diagonal))
      return "it is shorter than half of the chord";
    if (surface.span < kShortest * surface.median_chord) return "it is shorter than a fifth of the chord";
    return has_moving_noses(surface) ? "" : "its profiles have one nose, as a body of revolution has";
  }

  std::optional<Profile> profile_at(const EdgePlace& place, const Vec3* axis) const {
    const bool is_of_ends = std::ranges::count(rules_.of_ends(), axis, [](const Vec3& n) { return &n; }) > 0;
    const double least = is_of_ends ? kAlongEnds : kAlongAxis;
    if (axis && std::abs(dot(place.tangent, *axis)) < least) return std::nullopt;
    return cutter_.cut(place.x, axis ? *axis : place.tangent, rules_.reach);
  }

  /// Some of a few places have a profile: spares the many edges of machine parts.
  bool is_promising(const std::vector<EdgePlace>& places) const {
    constexpr std::size_t kTried = 6;
    const std::size_t step = std::max<std::size_t>(1, places.size() / kTried);
    for (std::size_t i = step / 2; i < places.size(); i += step) {
      if (profile_at(places[i], nullptr)) return true;
      for (const Vec3& normal : rules_.normals)
        if (profile_at(places[i], &normal)) return true;
    }
    return false;
  }

  /// How far along the edges profiles were found: in how many pieces they are does not matter.
  static double measured_way(std::span<const EdgePlace> places, std::span<const std::optional<Profile>> profiles) {
    double way = 0;
    for (std::size_t i = 0; i < places.size(); ++i) way += profiles[i] ? places[i].way : 0;
    return way;
  }

  /// Where a wedge was cut off across: a corner that is about square between faces that the cut crosses straight, and
  /// which are no strips of a nose.
  bool ends_in_corner(const Profile& profile) const {
    const std::vector<CutPlace>& beside = profile.beside_nose;
    const auto is_side = [&](const CutPlace& at) {
      return model_.tables().face_width[at.face] >= kNoseStrip * profile.chord &&
             (is_plane(at.face) || is_along_axis(at, profile.nose));
    };
    return beside.size() == 2 &&
           std::abs(dot(normalized(beside[0].x - profile.nose), normalized(beside[1].x - profile.nose))) <
               kSquareCorner &&
           std::ranges::all_of(beside, is_side);
  }

  /// Along a cylinder or a cone, from the nose to a place on it.
  bool is_along_axis(const CutPlace& at, Vec3 nose) const {
    const SurfaceType type = model_.tables().face_type[at.face];
    if (type != SurfaceType::kCylinder && type != SurfaceType::kCone) return false;
    const auto surface = model_.surface(at.face);
    const auto normal_at = [&](Vec3 x) {
      return surface_normal(*surface, closest_point(*surface, x, grid_[at.face]).uv);
    };
    return angle_between(normal_at(nose), normal_at(at.x)) <= kPlaneFace;
  }

  /// Whatever kind of surface describes it.
  bool is_plane(FaceId f) const {
    const auto [known, is_new] = is_plane_.try_emplace(f, model_.tables().face_type[f] == SurfaceType::kPlane);
    if (!is_new || known->second) return known->second;
    const auto surface = model_.surface(f);
    const auto normal_at = [&](int i, int j) {
      return surface_normal(*surface, {surface->u_min() + (surface->u_max() - surface->u_min()) * i / 2,
                                       surface->v_min() + (surface->v_max() - surface->v_min()) * j / 2});
    };
    const Vec3 middle = normal_at(1, 1);
    known->second = true;
    for (int i = 0; i <= 2; ++i)
      for (int j = 0; j <= 2; ++j) known->second &= angle_between(middle, normal_at(i, j)) <= kPlaneFace;
    return known->second;
  }

  /// How far along the edges profiles end in such a corner.
  double corner_way(std::span<const EdgePlace> places, std::span<const std::optional<Profile>> profiles) const {
    double way = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (profiles[i] && ends_in_corner(*profiles[i])) way += places[i].way;
    return way;
  }

  /// Each edge by itself: cranked edges of one wing may run along different axes.
  std::vector<std::optional<Profile>> best_profiles(std::span<const EdgePlace> places,
                                                    std::vector<const Vec3*>& axes) const {
    std::vector<std::optional<Profile>> best;
    while (!places.empty()) {
      const auto is_other = [&](const EdgePlace& place) { return place.edge != places.front().edge; };
      const auto n = std::find_if(places.begin(), places.end(), is_other) - places.begin();
      axes.push_back(nullptr);
      for (std::optional<Profile>& p : profiles_along(places.first(static_cast<std::size_t>(n)), axes.back()))
        best.push_back(std::move(p));
      places = places.subspan(static_cast<std::size_t>(n));
    }
    return best;
  }

  static double way_of(std::span<const EdgePlace> places) {
    double way = 0;
    for (const EdgePlace& place : places) way += place.way;
    return way;
  }

  /// Edges of a chain with profiles along enough of each.
  static std::vector<WingEdge> measured_edges(const std::vector<WingEdge>& chain, const std::vector<EdgePlace>& places,
                                              const std::vector<std::optional<Profile>>& profiles) {
    std::vector<double> way(chain.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i)
      if (profiles[i]) way[places[i].edge] += places[i].way;
    std::vector<WingEdge> part;
    for (std::size_t k = 0; k < chain.size(); ++k)
      if (way[k] >= kMeasured * chain[k].length) part.push_back(chain[k]);
    return part;
  }

  /// Of these the way where the nose is on the chain, too: a cut across a tooth of it, or a lens.
  double way_with_own_nose(std::span<const EdgePlace> places, std::span<const std::optional<Profile>> profiles) const {
    double way = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (profiles[i] && rules_.line.is_near(profiles[i]->nose, kNearNose * profiles[i]->chord)) way += places[i].way;
    return way;
  }

  /// Cut square to the axis of the model that shows most; square to the line along the chain, or to the edge, only
  /// where that shows clearly more.
  std::vector<std::optional<Profile>> profiles_along(std::span<const EdgePlace> places, const Vec3*& best_axis) const {
    std::vector<std::optional<Profile>> best;
    double longest = -1;
    bool has_of_ends = false;
    for (std::size_t k = 0; k <= rules_.normals.size(); ++k) {
      const Vec3* axis = k < rules_.normals.size() ? &rules_.normals[k] : nullptr;
      std::vector<std::optional<Profile>> own;
      for (const EdgePlace& place : places) own.push_back(profile_at(place, axis));
      const double on_itself = way_with_own_nose(places, own);
      double way = measured_way(places, own) - kLens * on_itself;
      const std::vector<std::size_t> long_ones = cuts_along_span(own);
      for (const std::size_t i : long_ones) way -= places[i].way;
      const bool is_clear = k >= rules_.n_axes || (k >= rules_.n_of_ends && has_of_ends);
      if (way <= (is_clear ? kClearlyMore : 1.0) * longest) continue;
      has_of_ends = has_of_ends || (k < rules_.n_of_ends && way > 0);
      longest = way;
      best_axis = axis;
      best = std::move(own);
      if (on_itself == 0 && long_ones.empty() && std::ranges::all_of(best, [](const auto& p) { return p.has_value(); }))
        break;  // none shows more
    }
    return best;
  }

  /// Of one edge: the smaller part of its cuts, at an end, beyond a jump of the chord. Planes square to an axis run
  /// along the span of a wing before a winglet there.
  static std::vector<std::size_t> cuts_along_span(std::span<const std::optional<Profile>> of_edge) {
    std::vector<std::size_t> measured, found;
    for (std::size_t i = 0; i < of_edge.size(); ++i)
      if (of_edge[i]) measured.push_back(i);
    for (int side = 0; side < 2; ++side, std::ranges::reverse(measured))
      for (std::size_t k = 1; k <= measured.size() / 2 && k < measured.size(); ++k)
        if (of_edge[measured[k - 1]]->chord > kJump * of_edge[measured[k]]->chord) {
          found.insert(found.end(), measured.begin(), measured.begin() + static_cast<std::ptrdiff_t>(k));
          break;
        }
    return found;
  }

  /// Cuts that run on into a body or end in a fairing: their chords differ from those of all stations around.
  static void drop_outliers(const std::vector<EdgePlace>& places, std::vector<std::optional<Profile>>& profiles) {
    std::vector<double> all;
    for (const auto& p : profiles)
      if (p) all.push_back(p->chord);
    const double of_all = median(all);
    std::vector<std::size_t> outliers;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      if (!profiles[i]) continue;
      const auto of_edge = std::span(std::as_const(profiles)).subspan(places[i].edge * kStations, kStations);
      const std::vector<double> around = chords_around(of_edge, i % kStations);
      if (is_outlier(profiles[i]->chord, around.size() > 2 ? median(around) : of_all)) outliers.push_back(i);
    }
    const std::vector<std::optional<Profile>> all_profiles = profiles;
    for (const std::size_t i : outliers) profiles[i].reset();
    for (const std::size_t i : outliers) readmit(i, 1, all_profiles[i], profiles);
    for (std::size_t k = outliers.size(); k-- > 0;) readmit(outliers[k], -1, all_profiles[outliers[k]], profiles);
  }

  /// Cuts square to the edge between others that are square to an axis: close_gaps() finds the nose between these.
  static void drop_oblique(std::span<const Vec3* const> axes, std::vector<std::optional<Profile>>& profiles) {
    for (std::size_t k = 0; k < axes.size(); ++k) {
      if (!axes[k]) continue;
      const auto of_edge = std::span(profiles).subspan(k * kStations, kStations);
      std::vector<std::optional<Profile>> straight(of_edge.begin(), of_edge.end());
      for (std::optional<Profile>& p : straight)
        if (p && p->normal != *axes[k]) p.reset();
      for (std::size_t i = 0; i < of_edge.size(); ++i)
        if (!straight[i] && is_between(straight, i)) of_edge[i].reset();
    }
  }

  static bool is_between(std::span<const std::optional<Profile>> of_edge, std::size_t i) {
    const auto is_there = [](const std::optional<Profile>& p) { return p.has_value(); };
    return std::ranges::any_of(of_edge.first(i), is_there) && std::ranges::any_of(of_edge.subspan(i + 1), is_there);
  }

  /// Square to any axis, and half way from the chain to the edge, where cuts square to the best axis show nothing: at
  /// tips, and along edges around them.
  void try_other_cuts(const std::vector<EdgePlace>& places, std::vector<std::optional<Profile>>& profiles) const {
    std::vector<double> all;
    for (const auto& p : profiles)
      if (p) all.push_back(p->chord);
    const double of_all = median(all);
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      const auto of_edge = std::span(std::as_const(profiles)).subspan(places[i].edge * kStations, kStations);
      const std::vector<double> around = chords_around(of_edge, i % kStations);
      if (is_between(of_edge, i % kStations)) continue;  // the nose's surface tells more: close_gaps()
      const double usual = around.empty() ? of_all : median(around);
      std::vector<Vec3> normals = rules_.normals;
      const Vec3 tangent = places[i].tangent;
      normals.push_back(normalized(dot(tangent, rules_.along) < 0 ? rules_.along - tangent : rules_.along + tangent));
      for (std::size_t k = 0; k < normals.size() && !profiles[i]; ++k) {
        profiles[i] = profile_at(places[i], &normals[k]);
        if (profiles[i] && is_outlier(profiles[i]->chord, usual)) profiles[i].reset();
      }
    }
  }

  /// Where an edge's chord goes on as it did at two places before: a tip that becomes short fast. `step`: away from
  /// these.
  static void readmit(std::size_t i, int step, const std::optional<Profile>& own,
                      std::vector<std::optional<Profile>>& profiles) {
    const auto k = static_cast<int>(i % kStations), at = static_cast<int>(i);
    if (k - 2 * step < 0 || k - 2 * step >= kStations || profiles[i]) return;
    const std::optional<Profile>&next = profiles[static_cast<std::size_t>(at - step)],
          &before = profiles[static_cast<std::size_t>(at - 2 * step)];
    if (!next || !before) return;
    const double expected = 2 * next->chord - before->chord;
    if (expected > 0 && !is_outlier(own->chord, expected)) profiles[i] = own;
  }

  LiftingSurface assemble(const std::vector<WingEdge>& chain, const std::vector<EdgePlace>& places,
                          const std::vector<std::optional<Profile>>& profiles) const {
    LiftingSurface surface;
    for (const WingEdge& w : chain) {
      const bool is_half = w.base != kNone && w.mirror != kNone;
      const auto has_same_base = [&](const WingEdge& other) { return other.edge != w.edge && other.base == w.base; };
      const bool is_pair = w.base != kNone && !is_half && std::ranges::any_of(chain, has_same_base);
      surface.trailing.push_back({w.edge, w.base, is_half, w.base == kNone ? 0 : w.size, {}});
      surface.span += is_pair ? 0.5 * w.length : w.length;
      surface.is_blunt = surface.is_blunt || w.base != kNone;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      ChordStation station{places[i].share, places[i].x};
      if (profiles[i]) {
        measure(*profiles[i], station);
        surface.faces.insert(surface.faces.end(), profiles[i]->faces.begin(), profiles[i]->faces.end());
      }
      surface.trailing[places[i].edge].stations.push_back(station);
    }
    sort_once(surface.faces);
    measure_chords(surface);
    return surface;
  }

  /// The nose on the facets may lie on the face beside that of the true one. Facets that leave the CAD show no nose,
  /// and those whose nose inside of a face is none of its surface are wrong there.
  void measure(const Profile& profile, ChordStation& station) const {
    station.nose = profile.nose;
    station.nose_face = profile.nose_face;
    const auto is_near = [&](const CutPlace& place, double most) {
      return closest_point(*model_.surface(place.face), place.x, grid_[place.face]).distance <= most;
    };
    const auto is_inside = [&](const CutPlace& beside) { return beside.face == profile.nose_face; };
    const double most = kOffSurface * rules_.reach, most_beside = std::max(most, kOffBeside * profile.chord);
    const bool is_exact = put_on_surface(profile, station);
    station.is_measured = is_exact || (is_near({profile.nose_face, profile.nose}, most) &&
                                       std::ranges::all_of(profile.beside_nose,
                                                           [&](const CutPlace& p) { return is_near(p, most_beside); }));
    is_off_ = is_off_ || !station.is_measured;
    if (!is_exact && std::ranges::all_of(profile.beside_nose, is_inside)) wrong_.push_back(profile.nose_face);
    station.chord = distance(station.nose, station.trailing);
  }

  /// On the first face that has a nose, the one on facets before others. Faces that meet there may each have one: the
  /// furthest is it, of equal ones the upper, so that numbers of faces do not count. False: no surface that the profile
  /// crosses has a nose there, as where another body cuts it off, or covers it.
  bool put_on_surface(const Profile& profile, ChordStation& station) const {
    std::vector<FaceId> faces = {profile.nose_face};
    faces.insert(faces.end(), profile.faces.begin(), profile.faces.end());
    const auto first =
        std::ranges::find_if(faces, [&](FaceId f) { return put_on(f, profile, guess_[f], nullptr, station); });
    if (first == faces.end()) return false;
    for (const FaceId f : profile.near_nose)
      if (f != *first) put_on(f, profile, second_guess_[f], &station.nose, station);
    return true;
  }

  /// Whether the nose on a face is it, also where there is another one.
  bool put_on(FaceId f, const Profile& profile, std::optional<Vec2>& guess, const Vec3* other,
              ChordStation& station) const {
    const double near = std::max(rules_.reach, kNearNose * profile.chord);
    const auto nose = exact_nose(*model_.surface(f), station.trailing, profile, near, guess, &grid_[f]);
    if (!nose || is_behind_other(*nose, f, profile, near)) return false;
    if (other) {
      const double more = distance(*nose, station.trailing) - distance(*other, station.trailing),
                   clearly = kClearlyFurther * profile.chord;
      const bool is_upper = dot(*nose - *other, kUp) > kApart * profile.chord;
      if (!(more > clearly || (is_upper && more > -clearly))) return false;
    }
    station.nose = *nose;
    station.nose_face = f;
    return true;
  }

  /// Whether a place on the surface of a face is behind another one, as a nose is behind ice on it.
  bool is_behind_other(Vec3 x, FaceId f, const Profile& profile, double near) const {
    const FaceId other = cutter_.nearest_face(x, profile.normal, near);
    return other != f && other != kNone &&
           closest_point(*model_.surface(other), x, grid_[other]).distance > kCovered * profile.chord;
  }

  static void measure_chords(LiftingSurface& surface) {
    std::vector<double> chords;
    for (const ChordEdge& edge : surface.trailing)
      for (const ChordStation& s : edge.stations)
        if (s.is_measured) chords.push_back(s.chord);
    if (!chords.empty()) surface.set_chords(chords);
  }

  /// Adds stations where measured ones end: halves the way to the next one, or to the end of the edge, there until it
  /// is no longer than a length at the nose. So noses run as far as there are profiles, and not on into a fuselage.
  void reach_ends(const Vec3* axis, std::span<const FaceId> own_faces, ChordEdge& edge) const {
    constexpr int kHalvings = 4, kMostHalvings = 12;
    const auto curve = model_.curve(edge.edge);
    const ArcTable arc(*curve);
    std::vector<ChordStation> added;
    const auto reach = [&](const ChordStation& from, double to) {
      const bool is_end = to == 0 || to == 1;
      double known = from.share, chord = from.chord;
      const auto is_wide = [&] { return is_end && std::abs(to - known) * arc.length() > kLeftAtTip * chord; };
      for (int i = 0; i < kHalvings || (i < kMostHalvings && is_wide()); ++i) {
        const double share = 0.5 * (known + to);
        const CurvePoint p = curve->evaluate(arc.parameter_at(share));
        const EdgePlace place{0, share, 0, p.x, normalized(p.d1)};
        std::optional<Profile> own = profile_at(place, axis);
        if (!own && is_end) own = profile_at(place, nullptr);
        const bool is_like = own && !is_outlier(own->chord, chord) &&
                             std::binary_search(own_faces.begin(), own_faces.end(), own->nose_face);
        (is_like ? known : to) = share;
        if (!is_like) continue;
        added.push_back({share, p.x});
        measure(*own, added.back());
        added.back().is_measured ? void(chord = own->chord) : added.pop_back();
      }
    };
    const std::vector<ChordStation>& s = edge.stations;
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (!s[i].is_measured) continue;
      if (i == 0 || !s[i - 1].is_measured) reach(s[i], i == 0 ? 0 : s[i - 1].share);
      if (i + 1 == s.size() || !s[i + 1].is_measured) reach(s[i], i + 1 == s.size() ? 1 : s[i + 1].share);
    }
    edge.stations.insert(edge.stations.end(), added.begin(), added.end());
    std::sort(edge.stations.begin(), edge.stations.end(),
              [](const ChordStation& a, const ChordStation& b) { return a.share < b.share; });
  }

  /// Cut square to the edge, between stations with noses, where it runs across the axis, as at the crest of a loop.
  void close_crests(Vec3 axis, std::span<const FaceId> own_faces, ChordEdge& edge) const {
    const auto begin = std::ranges::find_if(edge.stations, &ChordStation::is_measured);
    const auto end =
        std::find_if(edge.stations.rbegin(), edge.stations.rend(), [](const auto& s) { return s.is_measured; }).base();
    if (std::all_of(begin, end, [](const ChordStation& s) { return s.is_measured || s.is_hidden; })) return;
    const auto curve = model_.curve(edge.edge);
    const ArcTable arc(*curve);
    double chord = begin->chord;
    for (auto s = begin; s != end; ++s) {
      if (s->is_measured) chord = s->chord;
      if (s->is_measured || s->is_hidden) continue;
      const Vec3 tangent = normalized(curve->evaluate(arc.parameter_at(s->share)).d1);
      if (std::abs(dot(tangent, axis)) >= kAlongAxis) continue;
      const std::optional<Profile> own = profile_at({0, s->share, 0, s->trailing, tangent}, nullptr);
      if (own && !is_outlier(own->chord, chord) && std::ranges::binary_search(own_faces, own->nose_face))
        measure(*own, *s);
    }
  }

  /// Faces of other bodies that lie just around own noses, as those of ice.
  std::vector<FaceId> find_covers(const SurfaceDraft& draft, std::span<const std::uint8_t> is_concave) const {
    const std::vector<std::uint8_t> is_own = find_crossed_own_faces(model_.tables(), is_concave, draft.surface);
    std::vector<FaceId> covers;
    for (std::size_t k = 0; k < draft.axis.size(); ++k) {
      const ChordEdge& edge = draft.surface.trailing[k];
      const auto curve = model_.curve(edge.edge);
      const ArcTable arc(*curve);
      for (const ChordStation& s : edge.stations) {
        if (!s.is_measured || is_own[s.nose_face]) continue;
        const Vec3 normal = draft.axis[k] ? *draft.axis[k] : normalized(curve->evaluate(arc.parameter_at(s.share)).d1);
        const auto cut = cutter_.whole_cut(s.trailing, normal, rules_.reach, is_own);
        if (cut && cut->is_covered()) covers.insert(covers.end(), cut->others.begin(), cut->others.end());
      }
    }
    sort_once(covers);
    return covers;
  }

  /// Noses run along the trailing edge: they do not where a body of revolution ends in its apex.
  static bool has_moving_noses(const LiftingSurface& surface) {
    double of_noses = 0, of_edge = 0;
    for (const ChordEdge& edge : surface.trailing) {
      const ChordStation* last = nullptr;
      for (const ChordStation& s : edge.stations) {
        if (!s.is_measured) continue;
        if (last) of_noses += distance(last->nose, s.nose), of_edge += distance(last->trailing, s.trailing);
        last = &s;
      }
    }
    return of_noses >= kLeastNoseWay * of_edge;
  }

  /// Chords where none was measured: that of the nearest station that was; the ends of edges go on as their neighbours.
  void fill_in(LiftingSurface& surface) const {
    std::vector<ChordStation> measured;
    for (const ChordEdge& edge : surface.trailing)
      for (const ChordStation& s : edge.stations)
        if (s.is_measured) measured.push_back(s);
    for (ChordEdge& edge : surface.trailing) {
      const auto curve = model_.curve(edge.edge);
      ChordStation begin{0, curve->point(curve->t_min())}, end{1, curve->point(curve->t_max())};
      begin.is_hidden = edge.stations.front().is_hidden;
      end.is_hidden = edge.stations.back().is_hidden;
      edge.stations.insert(edge.stations.begin(), begin);
      edge.stations.push_back(end);
      for (ChordStation& s : edge.stations) {
        if (s.is_measured) continue;
        const auto nearest = std::min_element(measured.begin(), measured.end(), [&](const auto& a, const auto& b) {
          return distance(a.trailing, s.trailing) < distance(b.trailing, s.trailing);
        });
        s.chord = nearest->chord;
      }
    }
  }

  const Model& model_;
  const ProfileCutter& cutter_;
  const CutRules& rules_;
  mutable bool is_off_ = false;                          // a nose on facets was far from the CAD
  mutable std::vector<FaceId> wrong_;                    // whose facets have a nose where their surface has none
  mutable std::map<FaceId, std::optional<Vec2>> guess_,  // (u,v) of the last nose of each face
      second_guess_;                                     // likewise beside a nose of another one
  mutable std::map<FaceId, SurfaceGrid> grid_;           // of each face on which noses are looked for
  mutable std::map<FaceId, bool> is_plane_;              // of faces beside a corner
};

/// What may be the trailing edge was found from both sides where the nose is sharp, or a narrow face, or a smooth edge:
/// the blunter one is the leading edge, of alike ones the shorter, as that of a part behind a slot.
template <class Bluntness>
void unite_both_sides(std::vector<LiftingSurface>& surfaces, const Bluntness& bluntness_of) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t j = surfaces.size() - 1; j > i; --j) {
      const double way_i = way_with_noses(surfaces[i]), way_j = way_with_noses(surfaces[j]),
                   half = 0.5 * std::min(way_i, way_j);
      if (!(way_with_noses(surfaces[i], &surfaces[j]) > half && way_with_noses(surfaces[j], &surfaces[i]) > half))
        continue;
      const auto of_i = bluntness_of(surfaces[i]), of_j = bluntness_of(surfaces[j]);
      if (of_j < of_i || (of_j == of_i && way_j > way_i)) std::swap(surfaces[i], surfaces[j]);
      for (const ChordEdge& edge : surfaces[j].trailing) surfaces[i].leading.push_back(edge.edge);
      std::sort(surfaces[i].leading.begin(), surfaces[i].leading.end());
      surfaces.erase(surfaces.begin() + static_cast<std::ptrdiff_t>(j));
    }
}

/// Whether some of the noses of a surface are on an edge, or between it and the other edge of its base.
bool runs_along_nose(const Model& model, const WingEdge& w, const LiftingSurface& surface) {
  const double width = w.base == kNone ? 0 : w.size;
  const auto curve = model.curve(w.edge);
  bool is_near = false;
  Vec3 last = curve->point(curve->t_min());
  for (int i = 1; i <= kStations && !is_near; ++i) {
    const Vec3 x = curve->point(curve->t_min() + (curve->t_max() - curve->t_min()) * i / kStations);
    for (const ChordEdge& edge : surface.trailing)
      for (const ChordStation& s : edge.stations)
        is_near = is_near || (s.is_measured && segment_distance(s.nose, last, x) < kNearNose * s.chord + width);
    last = x;
  }
  return is_near;
}

/// The facets and their mirror image; vertices on the plane of `mirror` belong to both.
Facets with_image(const Model& model, Facets facets, FaceId mirror, double on_plane) {
  const MirrorPlane plane(model, mirror);
  std::vector<std::int32_t> image;
  for (std::size_t i = 0, n = facets.xyz.size(); i < n; ++i) {
    const Vec3 x = facets.xyz[i];
    const bool is_on_plane = std::abs(dot(x - plane.x, plane.normal)) <= on_plane;
    image.push_back(static_cast<std::int32_t>(is_on_plane ? i : facets.xyz.size()));
    if (!is_on_plane) facets.xyz.push_back(plane.image_of(x));
  }
  for (std::size_t i = 0, n = facets.triangle.size(); i < n; ++i) {
    const auto t = facets.triangle[i];
    facets.triangle.push_back({image[t[0]], image[t[2]], image[t[1]]});
    facets.face.push_back(facets.face[i]);
  }
  return facets;
}

/// The same on every rank.
bool has_wall_facets(const FaceRoles& roles, double deflection) {
  return roles.own.deflection == deflection &&
         std::ranges::all_of(roles.role, [](FaceRole role) { return role == FaceRole::kWall; });
}

/// Edges of the chain that are none of the surface's trailing edges.
void note_rest(const Model& model, const std::vector<WingEdge>& chain, const std::optional<LiftingSurface>& surface,
               const Reason& why, std::vector<Rest>& rest) {
  Rest own{{}, why}, rims{{}, {kRimOfEnd, false}};
  for (const WingEdge& w : chain) {
    const auto is_same = [&](const ChordEdge& edge) { return edge.edge == w.edge; };
    if (surface && std::any_of(surface->trailing.begin(), surface->trailing.end(), is_same)) continue;
    (surface && is_rim(model, w.edge, *surface) ? rims : own).edges.push_back(w);
  }
  for (Rest* list : {&own, &rims})
    if (!list->edges.empty()) rest.push_back(std::move(*list));
}

/// The plane of symmetry on which a chain lies; kNone: on none.
FaceId mirror_of(const std::vector<WingEdge>& chain) {
  for (const WingEdge& w : chain)
    if (w.mirror != kNone) return w.mirror;
  return kNone;
}

/// Edges at which profiles are cut.
std::vector<WingEdge> possible_tails(std::span<const WingEdge> edges) {
  std::vector<WingEdge> tails;
  for (const WingEdge& w : edges)
    if (w.kind != WingEdgeKind::kLeading || w.is_declared) tails.push_back(w);
  return tails;
}

/// Surfaces of a model. For one thread.
class SurfaceFinder {
 public:
  SurfaceFinder(const Model& model, const FaceRoles& roles, std::span<const WingEdge> edges, const Facets& facets,
                FinderMemory& memory)
      : model_(model), roles_(roles), edges_(edges), facets_(facets), memory_(memory), faces_at_(model.tables()) {
    for (const FaceRole role : roles.role) is_wall_.push_back(role == FaceRole::kWall);
  }

  /// Each chain by itself.
  ChainSurfaces find_along(std::span<const Chain> chains) {
    for (const Chain& chain : chains) find_with_noses(chain.edges);
    return {std::move(surfaces_), std::move(rest_), std::move(ends_)};
  }

  /// All of the model; `found`: along all chains. `ends`: gets those of all cuts.
  std::vector<LiftingSurface> run(ChainSurfaces&& found, std::span<const WingEdge> small, Noseless noseless,
                                  std::vector<UnusedTrailing>* unused, std::vector<CutPlace>& ends) {
    surfaces_ = std::move(found.surfaces);
    rest_ = std::move(found.rest);
    ends_ = std::move(found.ends);
    find_small(small);
    unite_surfaces();
    leave_out_slivers(small);
    add_front_noses(model_, surfaces_);
    const bool has_aircraft = noseless == Noseless::kAll || !surfaces_.empty();
    for (Rest& rest : rest_) explain(rest);
    for (Rest& rest : rest_) find_thin(rest, has_aircraft);
    for (const WingEdge& w : edges_)
      if (w.is_declared && w.kind == WingEdgeKind::kLeading) add_declared_leading(w);
    if (unused)
      for (const Rest& rest : rest_)
        for (const bool is_declared : {false, true}) tell(rest, is_declared, *unused);
    ends = std::move(ends_);
    return std::move(surfaces_);
  }

 private:
  static void tell(const Rest& rest, bool is_declared, std::vector<UnusedTrailing>& unused) {
    UnusedTrailing own{{}, 0, rest.why.text, rest.why.may_be_wing, is_declared};
    for (const WingEdge& w : rest.edges) {
      if (w.is_declared != is_declared) continue;
      own.edges.push_back(w.edge);
      own.length += w.length;
    }
    if (!own.edges.empty()) unused.push_back(std::move(own));
  }

  /// What is no wing's trailing edge for another reason than its profile.
  void explain(Rest& rest) const {
    if (!rest.why.may_be_wing) return;
    const auto are_at_noses_of = [&](const std::vector<LiftingSurface>& surfaces) {
      return std::ranges::all_of(rest.edges, [&](const WingEdge& w) { return is_at_nose_of(surfaces, w); });
    };
    if (are_at_noses_of(slivers_))
      rest.why = {kSliver, false};
    else if (are_at_noses_of(surfaces_))
      rest.why = {"they are at the nose of a lifting surface", false};
    else if (std::ranges::all_of(rest.edges, [&](const WingEdge& w) { return is_rim_of_plate(w); }))
      rest.why = {kRimOfPlate, false};
  }

  bool is_at_nose_of(const std::vector<LiftingSurface>& surfaces, const WingEdge& w) const {
    return std::ranges::any_of(surfaces, [&](const LiftingSurface& s) {
      const auto is_own = [&](FaceId f) { return std::ranges::binary_search(s.faces, f); };
      return std::ranges::any_of(faces_at_[w.edge], is_own) && runs_along_nose(model_, w, s);
    });
  }

  /// Plane sides, parallel at all of its edges: what stands on a plate may make it look like a profile.
  bool is_plate(const std::vector<WingEdge>& chain, const LiftingSurface& surface) const {
    const auto is_own = [&](const WingEdge& w) {
      return std::ranges::any_of(surface.trailing, [&](const ChordEdge& edge) { return edge.edge == w.edge; });
    };
    return std::ranges::all_of(chain, [&](const WingEdge& w) { return !is_own(w) || is_rim_of_plate(w); });
  }

  /// Between sides that are parallel, and plane, or a disc's or a tube's.
  bool is_rim_of_plate(const WingEdge& w) const {
    if (w.base == kNone || w.is_declared || std::abs(w.angle - kPi / 2) > kParallelSides) return false;
    const ModelTables& t = model_.tables();
    const auto e = static_cast<std::size_t>(w.edge);
    if (t.edge_vertices[2 * e] == t.edge_vertices[2 * e + 1]) return true;
    return std::ranges::all_of(faces_at_[w.edge], [&](FaceId f) { return t.face_type[f] == SurfaceType::kPlane; });
  }

  /// What cuts of the CAD leave beside a wing, as of a slat above its cove: a needle whose chord goes to nothing.
  /// Lengths by that chord would be more than those of all wings.
  void leave_out_slivers(std::span<const WingEdge> small) {
    double largest = 0;
    for (const LiftingSurface& s : surfaces_) largest = std::max(largest, s.median_chord);
    const auto is_kept = [&](const LiftingSurface& s) {
      return s.span < kNeedle * s.median_chord || s.largest_chord > kSliverChord * largest ||
             s.least_chord > kRunsOut * s.largest_chord;
    };
    std::vector<LiftingSurface> kept;
    for (LiftingSurface& s : surfaces_) {
      std::vector<WingEdge> own;
      for (const std::span<const WingEdge> edges : {edges_, small})
        std::ranges::copy_if(edges, std::back_inserter(own), [&](const WingEdge& w) {
          return std::ranges::count(s.trailing, w.edge, &ChordEdge::edge) > 0 ||
                 (w.kind != WingEdgeKind::kLeading && std::ranges::count(s.leading, w.edge) > 0);
        });
      const bool is_wing = is_kept(s) || std::ranges::any_of(own, &WingEdge::is_declared);
      if (!is_wing) rest_.push_back({std::move(own), {kSliver, false}});
      (is_wing ? kept : slivers_).push_back(std::move(s));
    }
    surfaces_ = std::move(kept);
  }

  /// A base with corners is no nose, however sharp the other side is, as of wedge fins; a round one may be.
  void unite_surfaces() {
    enum Kind { kBaseWithCorners, kEdge, kRoundBase };
    unite_both_sides(surfaces_, [&](const LiftingSurface& surface) {
      std::pair<Kind, double> bluntness(kEdge, 0);
      for (const ChordEdge& edge : surface.trailing)
        for (const WingEdge& w : edges_) {
          if (w.edge != edge.edge) continue;
          bluntness.second = std::max(bluntness.second, w.size);
          if (w.base != kNone) bluntness.first = w.angle > kRoundCorner ? kRoundBase : kBaseWithCorners;
        }
      return bluntness;
    });
  }

  /// From end to end: a blade's; zero where a chain comes back.
  Vec3 direction_of(const std::vector<WingEdge>& chain) const {
    std::vector<Vec3> ends;
    for (const WingEdge& w : chain) {
      const auto curve = model_.curve(w.edge);
      ends.push_back(curve->point(curve->t_min()));
      ends.push_back(curve->point(curve->t_max()));
    }
    const auto furthest = [&](Vec3 x) {
      return *std::ranges::max_element(ends, {}, [&](Vec3 end) { return norm2(end - x); });
    };
    const Vec3 a = furthest(ends.front()), b = furthest(a);
    return norm2(b - a) > 0 ? normalized(b - a) : Vec3{};
  }

  /// First the normal that plane faces at both ends of a chain have, as tips and roots, and axes of the model near that
  /// of one end. Then those of other ends, since axes of a delta may run along its nose, and the other axes but that
  /// along the chain itself.
  void find_normals(std::span<const FaceId> ends, CutRules& rules) {
    const auto is_near = [](Vec3 a, Vec3 b) { return std::abs(dot(a, b)) > kNearAxis; };
    std::vector<Vec3> of_ends;
    for (const FaceId f : ends) of_ends.push_back(MirrorPlane(model_, f).normal);
    std::vector<Vec3>& normals = rules.normals;
    const auto add = [&](Vec3 n, double same) {
      if (std::ranges::none_of(normals, [&](Vec3 a) { return std::abs(dot(a, n)) > same; })) normals.push_back(n);
    };
    for (std::size_t i = 0; i < of_ends.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (std::abs(dot(of_ends[i], of_ends[j])) > kParallelEnds) add(of_ends[j], kNearAxis);
    const auto& axes = roles_.own.axis;
    const auto is_near_any = [&](Vec3 a, std::span<const Vec3> of) {
      return std::ranges::any_of(of, [&](Vec3 b) { return is_near(a, b); });
    };
    for (const Vec3 axis : axes)
      if (is_near_any(axis, of_ends)) add(axis, kNearAxis);
    rules.n_of_ends = normals.size();
    for (const Vec3 n : of_ends)
      if (!is_near_any(n, axes)) add(n, kNearAxis);
    const auto is_along = [&](Vec3 axis) { return std::abs(dot(axis, rules.along)) > kSameDirection; };
    for (const Vec3 axis : axes)
      if (of_ends.empty() || !is_along(axis)) add(axis, kSameDirection);
    rules.n_axes = normals.size();
  }

  std::vector<EdgeId> rims_of(const std::vector<WingEdge>& chain) const {
    const Vec3 along = direction_of(chain);
    std::vector<EdgeId> rims;
    for (const WingEdge& w : chain) {
      const auto is_across = [&](FaceId f) {
        return model_.tables().face_type[f] == SurfaceType::kPlane &&
               std::abs(dot(MirrorPlane(model_, f).normal, along)) > kAcrossSpan;
      };
      if (!w.is_declared && std::ranges::any_of(faces_at_[w.edge], is_across)) rims.push_back(w.edge);
    }
    return rims;
  }

  /// Plane faces at which a chain ends, and on which none of its edges lies, ascending.
  std::vector<FaceId> planes_at_ends(const std::vector<WingEdge>& chain) {
    const ModelTables& t = model_.tables();
    if (planes_at_.empty()) {
      planes_at_.resize(static_cast<std::size_t>(t.n_vertices()));
      for (FaceId f = 0; f < t.n_faces(); ++f)
        if (t.face_type[f] == SurfaceType::kPlane)
          for (const EdgeId e : t.edges_of(f))
            for (const std::size_t k : {0, 1})
              planes_at_[static_cast<std::size_t>(t.edge_vertices[2 * static_cast<std::size_t>(e) + k])].push_back(f);
    }
    std::vector<FaceId> planes, own;
    std::map<VertexId, int> n_edges;
    for (const WingEdge& w : chain)
      for (const std::size_t k : {0, 1}) ++n_edges[t.edge_vertices[2 * static_cast<std::size_t>(w.edge) + k]];
    for (const auto& [v, n] : n_edges)
      if (n == 1) planes.insert(planes.end(), planes_at_[v].begin(), planes_at_[v].end());
    for (const WingEdge& w : chain) own.insert(own.end(), faces_at_[w.edge].begin(), faces_at_[w.edge].end());
    sort_once(planes);
    std::sort(own.begin(), own.end());
    std::erase_if(planes, [&](FaceId f) { return std::ranges::binary_search(own, f); });
    return planes;
  }

  double reach() const { return 2 * kDeflection * roles_.reference_diagonal; }

  const ProfileCutter& cutter_for(const std::vector<WingEdge>& chain) {
    const FaceId mirror = mirror_of(chain);
    const auto known = cutter_.find(mirror);
    if (known != cutter_.end()) return known->second;
    if (mirror == kNone) return cutter_.try_emplace(mirror, facets_, &ends_).first->second;
    const Facets& whole =
        whole_.emplace(mirror, with_image(model_, facets_, mirror, kOnPlane * roles_.reference_diagonal)).first->second;
    return cutter_.try_emplace(mirror, whole, &ends_).first->second;
  }

  void find_with_noses(const std::vector<WingEdge>& chain) {
    Reason why;
    std::optional<LiftingSurface> surface = surface_at(chain, cutter_for(chain), reach(), why);
    if (why.is_inexact || (surface ? !is_seen(surface, kSeenSmall) : why.may_be_wing))
      try_exact_facets(surface && !is_straight(chain) ? edges_of(*surface, chain) : chain, surface, why);
    const bool is_bent = why.may_be_wing && !is_straight(chain);
    if (surface || !(why.is_own_nose || is_bent) || !find_lines(chain)) keep(chain, surface, why);
  }

  /// Each line of a chain by itself, as luff and leech of a sail, or both edges of a blade that are sharp; false: it
  /// has one.
  bool find_lines(const std::vector<WingEdge>& chain) {
    const std::vector<std::vector<WingEdge>> lines = lines_of(model_, chain);
    if (lines.size() < 2) return false;
    const std::vector<EdgeId> rims = rims_of(chain);
    const auto may_be_rim = [&](const WingEdge& w) { return std::ranges::count(rims, w.edge) > 0; };
    const auto is_across = [&](const std::vector<WingEdge>& line) { return std::ranges::all_of(line, may_be_rim); };
    const std::size_t n = surfaces_.size(), n_rest = rest_.size();
    for (const std::vector<WingEdge>& line : lines)
      if (!is_across(line)) find_with_noses(line);
    const std::span found = std::span(std::as_const(surfaces_)).subspan(n);
    const bool has_noses = !found.empty();
    const auto is_end = [&](const std::vector<WingEdge>& line) {
      return std::ranges::all_of(line, [&](const WingEdge& w) {
        return std::ranges::any_of(found, [&](const LiftingSurface& s) { return is_rim(model_, w.edge, s); });
      });
    };
    std::vector<std::vector<WingEdge>> others;  // ends of a chain around a fin may lie along its trailing edge
    for (const std::vector<WingEdge>& line : lines)
      if (is_across(line) && has_noses && !is_end(line))
        others.push_back(line);
      else if (is_across(line))
        rest_.push_back({line, {kRimOfEnd, false}});
    for (Rest& rest : std::span(rest_).subspan(n_rest))
      if (rest.why.may_be_wing && is_end(rest.edges)) rest.why = {kRimOfEnd, false};
    for (const std::vector<WingEdge>& line : others) find_with_noses(line);
    return true;
  }

  void keep(const std::vector<WingEdge>& chain, std::optional<LiftingSurface>& surface, Reason why) {
    if (surface && is_plate(chain, *surface)) {
      surface.reset();
      why = {kRimOfPlate, false};
    }
    note_rest(model_, chain, surface, why, rest_);
    if (!surface) return;
    surfaces_.push_back(std::move(*surface));
    add_leading(model_, edges_, surfaces_.back());
  }

  /// Planes are square to axes, and to the line along the chain: blades stand around a hub at any angle.
  CutRules rules_for(const std::vector<WingEdge>& chain, double reach) {
    CutRules rules{.normals = {},
                   .along = direction_of(chain),
                   .rims = rims_of(chain),
                   .reach = reach,
                   .diagonal = roles_.reference_diagonal,
                   .line = ChainLine(places_along(model_, chain))};
    find_normals(planes_at_ends(chain), rules);
    const auto is_same = [&](Vec3 n) { return std::abs(dot(n, rules.along)) > kSameDirection; };
    if (norm2(rules.along) > 0 && std::ranges::none_of(rules.normals, is_same)) rules.normals.push_back(rules.along);
    return rules;
  }

  std::optional<LiftingSurface> surface_at(const std::vector<WingEdge>& chain, const ProfileCutter& cutter,
                                           double reach, Reason& why) {
    const CutRules rules = rules_for(chain, reach);
    const SurfaceMeasurer measurer(model_, cutter, rules);
    std::optional<SurfaceDraft> draft = measurer.find(chain, why);
    std::optional<LiftingSurface> surface;
    if (draft) {
      surface = measurer.finish(std::move(*draft), memory_.concave_edges(), is_wall_);
      if (!surface) why = {"its profiles reach into other bodies"};
    }
    why.is_inexact = measurer.is_off();
    return surface;
  }

  /// Without rims.
  static std::vector<WingEdge> edges_of(const LiftingSurface& surface, const std::vector<WingEdge>& chain) {
    std::vector<WingEdge> own;
    for (const WingEdge& w : chain)
      if (std::ranges::count(surface.trailing, w.edge, &ChordEdge::edge) > 0) own.push_back(w);
    return own;
  }

  static bool is_seen(const std::optional<LiftingSurface>& surface, double share) {
    return surface && surface->covered() >= share;
  }

  /// Once more, for edges that span much of the model without turning much, as those of blades and wings do, between
  /// splines: facets between knots may miss the shape of the profile, and those for the model be coarse for a blade.
  /// For edges that are short beside the model, by facets of their own faces, those that no concave edge parts from
  /// them.
  void try_exact_facets(const std::vector<WingEdge>& chain, std::optional<LiftingSurface>& surface, Reason& why) {
    const double extent = extent_of(chain);
    const bool is_small = extent < kLongBlade * roles_.reference_diagonal;
    const bool is_enough = !why.is_inexact && is_seen(surface, kSeen);
    if (!is_straight(chain) || (!is_small && (is_enough || !is_of_spline(chain)))) return;
    const std::optional<FaceRoles> body = is_small ? roles_of_body(chain, kLargeBody * extent) : std::nullopt;
    if (is_small && !body) return;
    const auto& [better, also] = exact_surface(chain, body ? *body : roles_, extent);
    if (!better && !surface && is_small) why = also;
    const auto seen = [](const LiftingSurface& s) { return s.span * s.covered(); };
    const double known = !surface ? 0 : (why.is_inexact ? kSeen : 1) * seen(*surface);
    if (!better || seen(*better) <= known) return;
    if (!surface) why = also;
    surface = better;
  }

  bool is_straight(const std::vector<WingEdge>& chain) const {
    double length = 0;
    for (const WingEdge& w : chain) length += w.base == kNone ? w.length : 0.5 * w.length;
    return extent_of(chain) >= kStraightBlade * length;
  }

  double extent_of(const std::vector<WingEdge>& chain) const {
    Box3 box;
    for (const WingEdge& w : chain) {
      const auto curve = model_.curve(w.edge);
      box.add(curve->point(curve->t_min()));
      box.add(curve->point(curve->t_max()));
    }
    return box.diagonal();
  }

  /// Trailing edges that are too short for facets of the model.
  void find_small(std::span<const WingEdge> small) {
    for (const auto& chain : trailing_chains(model_, small)) {
      Reason why{"it is short, and its faces are large", false};
      std::optional<LiftingSurface> surface;
      try_exact_facets(chain, surface, why);
      keep(chain, surface, why);
    }
  }

  /// Walls are those alone that no concave edge parts from a chain; nullopt: they are larger than `diagonal`.
  std::optional<FaceRoles> roles_of_body(const std::vector<WingEdge>& chain, double diagonal) {
    const ModelTables& t = model_.tables();
    LiftingSurface body;
    body.trailing.resize(chain.size());
    for (std::size_t k = 0; k < chain.size(); ++k) {
      body.trailing[k].edge = chain[k].edge;
      for (const FaceId f : faces_at_[chain[k].edge])
        if (t.face_box[f].diagonal() > diagonal) return std::nullopt;  // spares the search on machine parts
    }
    const std::vector<std::uint8_t> is_own = find_own_faces(t, memory_.concave_edges(), is_wall_, body);
    Box3 box;
    for (std::size_t f = 0; f < is_own.size(); ++f)
      if (is_own[f]) box.add(t.face_box[f]);
    if (box.diagonal() > diagonal) return std::nullopt;
    FaceRoles own = roles_;
    for (std::size_t f = 0; f < is_own.size(); ++f)
      if (!is_own[f]) own.role[f] = FaceRole::kInterface;
    return own;
  }

  const ExactSurface& exact_surface(const std::vector<WingEdge>& chain, const FaceRoles& roles, double extent) {
    std::vector<EdgeId> key;
    for (const WingEdge& w : chain) key.push_back(w.edge);
    return memory_.exact_surface(std::move(key), [&] {
      return make_exact(chain, roles, kDeflection * std::min(extent, roles_.reference_diagonal));
    });
  }

  ExactSurface make_exact(const std::vector<WingEdge>& chain, const FaceRoles& roles, double deflection) {
    ProfileFacets exact(model_, roles, {{.deflection = deflection, .is_exact = true}, 2 * deflection});
    exact.add_along(chain, SerialExecutor());
    const FaceId mirror = mirror_of(chain);
    const Facets whole =
        mirror == kNone ? Facets() : with_image(model_, exact.facets(), mirror, kOnPlane * roles_.reference_diagonal);
    ExactSurface found;
    found.surface =
        surface_at(chain, ProfileCutter(mirror == kNone ? exact.facets() : whole), 2 * deflection, found.why);
    return found;
  }

  /// Splines at its edges, or beyond narrow faces there, as strips of the skin that are plane are.
  bool is_of_spline(const std::vector<WingEdge>& chain) const {
    const ModelTables& t = model_.tables();
    const auto is_spline = [&](FaceId f) {  // extrusions of splines are surfaces of their own kind
      return t.face_type[f] == SurfaceType::kBspline || t.face_type[f] == SurfaceType::kExtrusion;
    };
    const auto is_beyond = [&](FaceId f, double length) {
      return t.face_width[f] < kNarrowStrip * length &&
             std::ranges::any_of(t.edges_of(f), [&](EdgeId e) { return std::ranges::any_of(faces_at_[e], is_spline); });
    };
    return std::ranges::any_of(chain, [&](const WingEdge& w) {
      return std::ranges::any_of(faces_at_[w.edge], [&](FaceId f) { return is_spline(f) || is_beyond(f, w.length); });
    });
  }

  /// Declared edges of the rest, and all of it where it may be a wing's and is thin behind the edge.
  void find_thin(Rest& rest, bool has_aircraft) {
    std::vector<WingEdge> declared, others;
    for (const WingEdge& w : rest.edges) (w.is_declared ? declared : others).push_back(w);
    const auto take = [&](std::vector<WingEdge>& own) {
      if (own.empty()) return;
      const ProfileCutter& cutter = cutter_for(own);
      std::optional<LiftingSurface> surface = find_thin_surface(model_, {roles_.own.axis, cutter, reach()}, own);
      if (!surface) return;
      if (!add_at_nose(own, *surface)) surfaces_.push_back(std::move(*surface));
      own.clear();
    };
    take(declared);
    if (has_aircraft && rest.why.may_be_wing) take(others);
    rest.edges = std::move(others);
    rest.edges.insert(rest.edges.end(), declared.begin(), declared.end());
  }

  /// Gives edges that nobody declared, before the nose of a surface and thin from there to its tail, to that one:
  /// those of ice. False: they are before none.
  bool add_at_nose(const std::vector<WingEdge>& edges, const LiftingSurface& thin) {
    const auto is_nose_of = [&](const LiftingSurface& wing) {
      const auto is_before = [&](const ChordStation& s) {
        const ChordStation* own = wing.nearest_station(s.trailing);
        return own && distance(s.trailing, own->nose) < kBeforeNose * own->chord &&
               distance(s.trailing, own->trailing) > (1 - kNearNose) * own->chord &&
               s.chord > (1 - kNearNose) * own->chord;
      };
      return std::ranges::all_of(thin.trailing,
                                 [&](const ChordEdge& edge) { return std::ranges::all_of(edge.stations, is_before); });
    };
    const auto wing = std::ranges::find_if(surfaces_, is_nose_of);
    if (thin.is_declared || wing == surfaces_.end()) return false;
    for (const WingEdge& w : edges) {
      wing->leading.push_back(w.edge);
      add_lengths_at_nose(w, *wing);
    }
    sort_once(wing->leading);
    return true;
  }

  void add_lengths_at_nose(const WingEdge& w, LiftingSurface& wing) const {
    wing.declared_leading.push_back(
        chords_along(model_, w, [&](const EdgePlace& place) { return wing.nearest_chord(place.x).chord; }));
  }

  void add_declared_leading(const WingEdge& w) {
    const std::vector<WingEdge> own = {w};
    const auto has_edge = [&](const LiftingSurface& s) { return std::ranges::count(s.leading, w.edge) > 0; };
    const auto known = std::ranges::find_if(surfaces_, has_edge);
    if (known != surfaces_.end()) return add_lengths_at_nose(w, *known);
    const ProfileCutter& cutter = cutter_for(own);
    if (std::optional<LiftingSurface> surface = find_thin_surface(model_, {roles_.own.axis, cutter, reach()}, own))
      surfaces_.push_back(std::move(*surface));
    else
      rest_.push_back({own, {"no plane cuts a profile there"}});
  }

  const Model& model_;
  const FaceRoles& roles_;
  std::span<const WingEdge> edges_;
  const Facets& facets_;
  FinderMemory& memory_;
  std::vector<CutPlace> ends_;              // of cuts through the facets
  std::map<FaceId, Facets> whole_;          // by symmetry plane
  std::map<FaceId, ProfileCutter> cutter_;  // of these; kNone: of the facets themselves
  EdgeFaces faces_at_;
  std::vector<std::vector<FaceId>> planes_at_;  // by vertex; empty: not known yet
  std::vector<std::uint8_t> is_wall_;           // by face
  std::vector<LiftingSurface> surfaces_;
  std::vector<LiftingSurface> slivers_;  // that are none of these
  std::vector<Rest> rest_;
};

/// Collective. Rank 0's on every rank; `elsewhere`: keeps those of other ranks.
const Facets& share_facets(const Executor& executor, const Facets& own, Facets& elsewhere) {
  if (!executor.has_listeners()) return own;
  Bytes bytes;
  if (executor.is_root()) bytes = packed(own);
  executor.broadcast(bytes);
  if (executor.is_root()) return own;
  unpack(bytes, elsewhere);
  return elsewhere;
}

/// Collective. What SurfaceFinder::find_along() finds along all chains, on rank 0. `chains`, and what the finders see:
/// the same on every rank.
template <class MakeFinder>
ChainSurfaces find_along_chains(const std::vector<Chain>& chains, const MakeFinder& make_finder,
                                const Executor& executor) {
  std::vector<double> work;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    if (i % kChainsPerTask == 0) work.push_back(0);
    work.back() += static_cast<double>(chains[i].edges.size());
  }
  std::vector<ChainSurfaces> parts(work.size());
  executor.run_tasks(
      static_cast<std::int32_t>(work.size()), heaviest_first(work),
      [&](std::int32_t task) {
        const std::span rest = std::span(chains).subspan(kChainsPerTask * static_cast<std::size_t>(task));
        return packed(make_finder().find_along(rest.first(std::min(rest.size(), kChainsPerTask))));
      },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, parts[static_cast<std::size_t>(task)]); });
  ChainSurfaces all;
  const auto append = [](auto&& part, auto& to) {
    to.insert(to.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  };
  for (ChainSurfaces& part : parts) {
    append(part.surfaces, all.surfaces);
    append(part.rest, all.rest);
    append(part.ends, all.ends);
  }
  return all;
}

}  // namespace

void add_leading(const Model& model, std::span<const WingEdge> edges, LiftingSurface& surface) {
  for (const WingEdge& w : edges)
    if (w.kind == WingEdgeKind::kLeading && runs_along_nose(model, w, surface)) surface.leading.push_back(w.edge);
}

double ChordEdge::chord_at(double share) const {
  const auto next = std::lower_bound(stations.begin() + 1, stations.end() - 1, share,
                                     [](const ChordStation& s, double at) { return s.share < at; });
  const ChordStation &a = *(next - 1), &b = *next;
  const double part = std::clamp((share - a.share) / (b.share - a.share), 0.0, 1.0);
  return a.chord + part * (b.chord - a.chord);
}

const ChordStation* LiftingSurface::nearest_station(Vec3 x) const {
  const ChordStation* nearest = nullptr;
  double least = 0;
  for (const ChordEdge& edge : trailing)
    for (const ChordStation& s : edge.stations) {
      if (!s.is_measured) continue;
      const double d = segment_distance(x, s.trailing, s.nose);
      if (nearest && d >= least) continue;
      nearest = &s;
      least = d;
    }
  return nearest;
}

void LiftingSurface::set_chords(const std::vector<double>& chords) {
  median_chord = median(chords);
  const auto [least, most] = std::minmax_element(chords.begin(), chords.end());
  least_chord = *least;
  largest_chord = *most;
}

double LiftingSurface::covered() const {
  double covered = 0, all = 0;
  for (const ChordEdge& edge : trailing)
    for (std::size_t i = 1; i < edge.stations.size(); ++i) {
      const ChordStation &a = edge.stations[i - 1], &b = edge.stations[i];
      const double half = 0.5 * distance(a.trailing, b.trailing);
      for (const ChordStation* s : {&a, &b}) {
        all += s->is_hidden ? 0 : half;
        covered += s->is_measured ? half : 0;
      }
    }
  return all > 0 ? covered / all : 0;
}

NearestChord LiftingSurface::nearest_chord(Vec3 x) const {
  if (const ChordStation* nearest = nearest_station(x))
    return {nearest->chord, segment_distance(x, nearest->trailing, nearest->nose)};
  NearestChord nearest{median_chord, std::numeric_limits<double>::infinity()};
  for (const std::vector<ChordEdge>* edges : {&trailing, &declared_leading})
    for (const ChordEdge& edge : *edges)
      for (const ChordStation& s : edge.stations)
        if (const double d = distance(x, s.trailing); d < nearest.distance) nearest = {s.chord, d};
  return nearest;
}

std::vector<LiftingSurface> find_lifting_surfaces(const Model& model, const FaceRoles& roles,
                                                  std::span<const WingEdge> edges, const Executor& executor,
                                                  std::vector<UnusedTrailing>* unused, Noseless noseless,
                                                  std::span<const WingEdge> small) {
  std::vector<WingEdge> all(edges.begin(), edges.end());
  std::vector<Chain> chains;
  for (std::vector<WingEdge>& chain : trailing_chains(model, all)) chains.push_back({std::move(chain)});
  const std::vector<WingEdge> tails = possible_tails(edges);
  bool has_edges = !tails.empty() || !small.empty();
  share(executor, has_edges, all, chains);
  if (!has_edges) return {};
  const double deflection = kDeflection * roles.reference_diagonal;
  ProfileFacets own(model, roles, {{.deflection = deflection}, 2 * deflection});
  const bool has_all = has_wall_facets(roles, deflection);
  if (!has_all) own.add_along(tails, executor);
  FinderMemory memory(model, roles);
  while (true) {
    Facets elsewhere;
    const Facets& facets = share_facets(executor, has_all ? roles.own.facets : own.facets(), elsewhere);
    const auto make_finder = [&] { return SurfaceFinder(model, roles, all, facets, memory); };
    ChainSurfaces found = find_along_chains(chains, make_finder, executor);
    std::vector<CutPlace> ends;
    std::vector<LiftingSurface> surfaces;
    std::vector<UnusedTrailing> rest;
    if (executor.is_root())
      surfaces = make_finder().run(std::move(found), small, noseless, unused ? &rest : nullptr, ends);
    if (!has_all && own.add_beyond(ends, executor)) continue;  // a cut between the places crosses more
    if (unused) *unused = std::move(rest);
    return surfaces;
  }
}

}  // namespace st
