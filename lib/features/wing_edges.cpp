#include "features/wing_edges.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>

#include "base/disjoint_sets.h"
#include "base/packer.h"
#include "base/share.h"
#include "features/certain_wing_edges.h"
#include "features/edge_places.h"
#include "features/strip.h"
#include "geometry/model/face_coedge.h"

namespace st {
namespace {

constexpr std::size_t kEdgesPerTask = 64;
constexpr int kStations = 9;
constexpr int kAgreeing = 6;                                         // of the stations
constexpr double kSharpest = radians(60);                            // material of a sharp trailing edge at most
constexpr double kSmooth = radians(30);                              // kink at a leading edge at most
constexpr double kBluntMin = radians(50), kBluntMax = radians(140);  // material at either edge of a blunt trailing edge
constexpr double kLookAway = -0.5;          // cosine between normals on both sides of a blunt trailing edge at most
constexpr double kBluntWidth = 0.05;        // of its length, at most
constexpr double kLargerThanRing = 5;       // likewise of those beside a ring
constexpr double kSquareRing = radians(1);  // of a ring, from square to its sides
constexpr double kLargerThanRound = 2;      // area of the faces beside a round trailing edge over its own, at least
constexpr std::size_t kFlanks = 6;          // of teeth without another trailing edge: three teeth
constexpr double kNoseTurn = radians(45);   // of the normal to either side of a leading edge, at least
constexpr double kFlattened = 0.7;  // curvature there over the largest, at most: a circle stays at 1, a parabola falls
                                    // to 0.35
constexpr double kLargestNose = 0.02;        // of the reference diagonal: radius
constexpr double kNosePerLength = 0.25;      // radius of a leading edge over its length, at most
constexpr double kStep = 0.125, kReach = 4;  // of the nose radius: steps and way to either side
constexpr double kShortestChain = 0.005;     // of the reference diagonal
constexpr double kSmallestChain = 0.0005;    // likewise: shorter ones are no small blade's, either

/// Where a coedge runs, and which way its face lies.
struct Side {
  FaceId face;
  Vec2 uv;
  Vec3 normal;  // unit, out of the material
  Vec3 inward;  // unit, tangent to the face, away from the edge
};

/// Both sides of an edge at one place.
struct Station {
  Vec3 x;
  std::array<Side, 2> sides;
  double angle = kPi;  // of the material, radians in (0, 2 pi)
};

class WingEdgeFinder {
 public:
  /// `diagonal`: bounds of the reference diagonal.
  WingEdgeFinder(const Model& model, const FaceRoles& roles, std::span<const Strip> strips, LengthBounds diagonal)
      : model_(model), t_(model.tables()), roles_(roles), strips_(strips), diagonal_(diagonal) {
    is_turned_ = is_material_ahead(t_, roles);
    uses_.resize(static_cast<std::size_t>(t_.n_edges()));
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      for (const LoopId l : t_.loops(f))
        for (const CoedgeId c : t_.loop_coedges(l)) uses_[t_.coedge_edge[c]].push_back({f, c});
  }

  std::vector<WingEdge> run(const Executor& executor) {
    std::vector<WingEdge> found = find(executor);
    bool is_done = !found.empty() || t_.volume.has_value();
    share(executor, is_done);
    if (is_done) return found;
    is_turned_ = !is_turned_;  // nothing tells on which side of an open surface the material is
    return find(executor);
  }

  /// Whether every diagonal within the bounds gives what was found.
  bool is_certain() const { return is_certain_; }
  /// Trailing edges that the last search left out as too short.
  const std::vector<WingEdge>& small() const { return small_; }
  /// Whether the last search saw edges that were trailing edges if the material were on the other side. On rank 0.
  bool has_hollow() const { return has_hollow_; }

  void declare(std::span<const DeclaredEdge> declared, std::vector<WingEdge>& edges) const {
    std::vector<std::optional<WingEdge>> found(uses_.size());
    for (const WingEdge& w : edges) found[w.edge] = w;
    for (const DeclaredEdge& d : declared)
      d.meaning == EdgeMeaning::kNoTrailing ? take_out(d.edge, found) : add(d, found);
    edges.clear();
    for (const auto& w : found)
      if (w) edges.push_back(*w);
  }

 private:
  using FoundEdges = std::vector<std::optional<WingEdge>>;

  /// A comparison that holds from some diagonal on, or up to it.
  template <class Comparison>
  bool is_of_diagonal(const Comparison& holds) const {
    const bool at_least = holds(diagonal_.least);
    if (at_least != holds(diagonal_.most)) is_certain_ = false;
    return at_least;
  }

  static void take_out(EdgeId e, FoundEdges& found) {
    if (!found[e] || found[e]->kind == WingEdgeKind::kLeading) return;
    const FaceId base = found[e]->base;
    for (std::optional<WingEdge>& w : found)
      if (w && w->kind != WingEdgeKind::kLeading && (w->edge == e || (base != kNone && w->base == base))) w.reset();
  }

  void add(const DeclaredEdge& d, FoundEdges& found) const {
    const bool is_leading = d.meaning == EdgeMeaning::kLeading;
    const bool is_sharp = found[d.edge] && found[d.edge]->kind == WingEdgeKind::kSharpTrailing;
    const Strip* base = is_leading || (is_sharp && d.base == kNone) ? nullptr : base_at(d);
    for (const EdgeId e : base ? std::vector<EdgeId>{base->edges[0], base->edges[1]} : std::vector<EdgeId>{d.edge}) {
      if (base && mirror_of(e)) continue;  // half a base: the other edge is there twice
      const bool is_known = found[e] && (found[e]->kind == WingEdgeKind::kLeading) == is_leading &&
                            found[e]->base == (base ? base->face : kNone);
      if (!is_known) found[e] = make_declared(e, is_leading, base);
      found[e]->is_declared = true;
    }
  }

  /// The base at a trailing edge; nullptr: the edge is sharp.
  const Strip* base_at(const DeclaredEdge& d) const {
    const auto at = std::find_if(strips_.begin(), strips_.end(), [&](const Strip& s) {
      if (d.base != kNone) return s.face == d.base;
      return (s.edges[0] == d.edge || s.edges[1] == d.edge) && is_narrow(s, median_width(s)) && has_corners(s);
    });
    return at == strips_.end() ? nullptr : &*at;
  }

  /// Whether a face ends in corners along both long edges, as a base does; a strip of the skin does not.
  bool has_corners(const Strip& strip) const {
    return std::all_of(std::begin(strip.edges), std::end(strip.edges), [&](EdgeId e) {
      if (uses_[e].size() != 2) return false;
      if (mirror_of(e)) return true;
      const std::vector<Station> places = stations(e, surfaces_of(e));
      return std::ranges::count_if(places, is_corner) >= kAgreeing;
    });
  }
  static bool is_corner(const Station& s) { return s.angle >= kBluntMin && s.angle <= kBluntMax; }
  static bool is_smooth(const Station& s) { return std::abs(s.angle - kPi) <= kSmooth; }
  static bool is_narrow(const Strip& strip, double width) {
    return width <= kBluntWidth * std::max(strip.length, strip.row);
  }

  static double median_width(const Strip& strip) {
    std::vector<double> widths;
    for (const auto& station : strip.stations) widths.push_back(station.width());
    return median(widths);
  }

  WingEdge make_declared(EdgeId e, bool is_leading, const Strip* base) const {
    WingEdge own{.edge = e, .kind = is_leading ? WingEdgeKind::kLeading : WingEdgeKind::kSharpTrailing};
    if (uses_[e].size() == 2) own = make(e, own.kind, stations(e, surfaces_of(e)), 0);
    const auto curve = model_.curve(e);
    own.middle = curve->point(0.5 * (curve->t_min() + curve->t_max()));
    own.length = t_.edge_length[e];
    if (!base) return own;
    own.kind = WingEdgeKind::kBluntTrailing;
    own.base = base->face;
    own.mirror = mirror_face(base->edges[base->edges[0] == e ? 1 : 0]);
    own.size = (own.mirror == kNone ? 1 : 2) * median_width(*base);
    return own;
  }

  std::vector<WingEdge> find(const Executor& executor) {
    std::vector<std::optional<WingEdge>> found(uses_.size());
    std::vector<EdgeId> candidates;
    has_hollow_ = false;
    if (executor.is_root()) {
      for (const Strip& strip : strips_) try_blunt(strip, found);
      std::vector<std::uint8_t> is_base(static_cast<std::size_t>(t_.n_faces()));
      for (const auto& w : found)
        if (w && w->base != kNone) is_base[w->base] = 1;
      const auto ends_base = [&](const FaceCoedge& use) { return is_base[use.face] != 0; };
      for (EdgeId e = 0; e < t_.n_edges(); ++e)
        if (!found[e] && is_candidate(e) && std::ranges::none_of(uses_[e], ends_base)) candidates.push_back(e);
    }
    share(executor, candidates);
    classify_all(candidates, executor, found);
    std::vector<WingEdge> result;
    if (!executor.is_root()) return result;
    add_flanks(found);
    drop_short_chains(found);
    for (const auto& w : found)
      if (w) result.push_back(*w);
    return result;
  }

  /// `found`: on rank 0.
  void classify_all(std::span<const EdgeId> edges, const Executor& executor,
                    std::vector<std::optional<WingEdge>>& found) {
    const std::size_t n_tasks = (edges.size() + kEdgesPerTask - 1) / kEdgesPerTask;
    executor.run_tasks(
        static_cast<std::int32_t>(n_tasks), heaviest_first(std::vector<double>(n_tasks, 1)),
        [&](std::int32_t task) {
          const auto rest = edges.subspan(kEdgesPerTask * static_cast<std::size_t>(task));
          std::vector<WingEdge> own;
          bool is_hollow = false;
          for (const EdgeId e : rest.first(std::min(rest.size(), kEdgesPerTask)))
            if (const std::optional<WingEdge> w = classify(e, is_hollow)) own.push_back(*w);
          return packed(own, is_hollow);
        },
        [&](std::int32_t, Bytes&& bytes) {
          std::vector<WingEdge> some;
          bool is_hollow = false;
          unpack(bytes, some, is_hollow);
          has_hollow_ |= is_hollow;
          for (const WingEdge& w : some) found[w.edge] = w;
        });
  }

  /// Between two walls, or a wall and a symmetry plane.
  bool is_candidate(EdgeId e) const {
    if (t_.edge_is_degenerate[e] || uses_[e].size() != 2) return false;
    const auto n_walls = std::count_if(uses_[e].begin(), uses_[e].end(),
                                       [&](const FaceCoedge& u) { return roles_.role[u.face] == FaceRole::kWall; });
    return n_walls == 2 || (n_walls == 1 && mirror_of(e));
  }

  /// The use by the symmetry plane on which an edge lies; nullptr: on none.
  const FaceCoedge* mirror_of(EdgeId e) const {
    const auto use = std::find_if(uses_[e].begin(), uses_[e].end(), [&](const FaceCoedge& u) {
      return roles_.role[u.face] == FaceRole::kSymmetry && t_.face_type[u.face] == SurfaceType::kPlane;
    });
    return use == uses_[e].end() ? nullptr : &*use;
  }
  FaceId mirror_face(EdgeId e) const {
    const FaceCoedge* mirror = mirror_of(e);
    return mirror ? mirror->face : kNone;
  }

  static Side mirrored(const Side& side, Vec3 plane) {
    const auto turn = [&](Vec3 v) { return v - 2 * dot(v, plane) * plane; };
    return {side.face, side.uv, turn(side.normal), turn(side.inward)};
  }

  Side side_at(const Surface& surface, const FaceCoedge& use, Vec2 uv, Vec3 tangent) const {
    const Vec3 n = surface_normal(surface, uv);
    const Vec3 along = t_.coedge_is_reversed[use.coedge] ? -tangent : tangent;
    return {use.face, uv, (t_.face_is_reversed[use.face] != 0) != is_turned_ ? -n : n, normalized(cross(n, along))};
  }

  std::vector<Station> stations(EdgeId e, const std::array<std::unique_ptr<Surface>, 2>& surfaces) const {
    const auto curve = model_.curve(e);
    std::array<std::unique_ptr<Curve2d>, 2> pcurves;
    for (std::size_t k = 0; k < 2; ++k) pcurves[k] = model_.pcurve(uses_[e][k].face, uses_[e][k].coedge);
    std::vector<Station> result;
    for (int i = 0; i < kStations; ++i) {
      const double t = curve->t_min() + (curve->t_max() - curve->t_min()) * (i + 0.5) / kStations;
      const CurvePoint p = curve->evaluate(t);
      Station s{p.x, {}, kPi};
      for (std::size_t k = 0; k < 2; ++k)
        s.sides[k] = side_at(*surfaces[k], uses_[e][k], pcurves[k]->point(t), normalized(p.d1));
      for (std::size_t k = 0; k < 2; ++k)
        if (mirror_of(e) == &uses_[e][k]) s.sides[k] = mirrored(s.sides[1 - k], s.sides[k].normal);
      const double between = angle_between(s.sides[0].inward, s.sides[1].inward);
      s.angle = dot(s.sides[0].inward, s.sides[1].normal) < 0 ? between : 2 * kPi - between;
      result.push_back(s);
    }
    return result;
  }

  std::array<std::unique_ptr<Surface>, 2> surfaces_of(EdgeId e) const {
    return {model_.surface(uses_[e][0].face), model_.surface(uses_[e][1].face)};
  }

  WingEdge make(EdgeId e, WingEdgeKind kind, const std::vector<Station>& stations, double size,
                FaceId base = kNone) const {
    std::vector<double> angles;
    for (const Station& s : stations) angles.push_back(s.angle);
    return {e, kind, stations[kStations / 2].x, t_.edge_length[e], median(angles), size, base, mirror_face(e)};
  }

  /// `is_hollow` becomes true at a sharp trailing edge of a hole.
  std::optional<WingEdge> classify(EdgeId e, bool& is_hollow) const {
    const auto surfaces = surfaces_of(e);
    const std::vector<Station> places = stations(e, surfaces);
    int n_sharp = 0, n_hollow = 0;
    std::vector<double> radii;
    for (const Station& s : places) {
      n_sharp += s.angle <= kSharpest;
      n_hollow += s.angle >= 2 * kPi - kSharpest;
      if (!is_smooth(s)) continue;
      const double radius = nose_radius(e, s, surfaces);
      if (radius > 0 && radius <= kNosePerLength * t_.edge_length[e]) radii.push_back(radius);
    }
    is_hollow |= n_hollow >= kAgreeing;
    if (n_sharp >= kAgreeing) return make(e, WingEdgeKind::kSharpTrailing, places, 0);
    if (static_cast<int>(radii.size()) >= kAgreeing) return make(e, WingEdgeKind::kLeading, places, median(radii));
    return std::nullopt;
  }

  // --- noses

  /// Curvature of the surface in a direction along it, positive where it bends away from `normal`.
  static double bend(const SurfacePoint2& p, Vec3 normal, Vec2 direction) {
    const double a = direction.x, b = direction.y;
    return -dot(a * a * p.duu + 2 * a * b * p.duv + b * b * p.dvv, normal);
  }

  /// Rates of u and v for a way along `direction`, tangent to the surface; zero at a singular point.
  static Vec2 rates(const SurfacePoint2& p, Vec3 direction) {
    return tangent_step(p.du, p.dv, direction, 1e-20).value_or(Vec2{});
  }

  /// Smallest radius of the nose at the edge; 0: no nose.
  double nose_radius(EdgeId e, const Station& s, const std::array<std::unique_ptr<Surface>, 2>& surfaces) const {
    const auto is_wall = [&](std::size_t k) { return mirror_of(e) != &uses_[e][k]; };
    double largest = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!is_wall(k)) continue;
      const SurfacePoint2 p = surfaces[k]->evaluate2(s.sides[k].uv);
      largest = std::max(largest, bend(p, s.sides[k].normal, rates(p, s.sides[k].inward)));
    }
    const auto is_small = [first = largest](double diagonal) { return first * kLargestNose * diagonal > 1; };
    if (!is_small(diagonal_.most)) return 0;
    std::array<double, 2> flattened = {0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
      if (!is_wall(k)) continue;
      const std::optional<double> end = walk(*surfaces[k], s.sides[k], 1 / largest, largest);
      if (!end) return 0;
      flattened[k] = *end;
    }
    if (!(std::max(flattened[0], flattened[1]) <= kFlattened * largest)) return 0;
    return is_of_diagonal(is_small) ? 1 / largest : 0;
  }

  /// Walks away from the edge, raises `largest` to the largest curvature met, and returns the curvature where the
  /// normal has turned by kNoseTurn; nullopt when it never does, or the face ends before.
  static std::optional<double> walk(const Surface& surface, const Side& side, double radius, double& largest) {
    Vec2 uv = side.uv;
    Vec3 direction = side.inward, normal = side.normal;
    const double over_u = 1e-6 * (surface.u_max() - surface.u_min()),
                 over_v = 1e-6 * (surface.v_max() - surface.v_min());
    for (int i = 0; i < static_cast<int>(kReach / kStep); ++i) {
      const SurfacePoint2 p = surface.evaluate2(uv);
      const Vec3 n = normalized(cross(p.du, p.dv));
      normal = dot(n, normal) < 0 ? -n : n;
      direction = normalized(direction - dot(direction, normal) * normal);
      const Vec2 step = rates(p, direction);
      if (step == Vec2{}) return std::nullopt;
      const double curvature = bend(p, normal, step);
      largest = std::max(largest, curvature);
      if (angle_between(normal, side.normal) >= kNoseTurn) return curvature;
      uv = uv + kStep * radius * step;
      if (uv.x < surface.u_min() - over_u || uv.x > surface.u_max() + over_u || uv.y < surface.v_min() - over_v ||
          uv.y > surface.v_max() + over_v)
        return std::nullopt;
    }
    return std::nullopt;
  }

  // --- blunt trailing edges

  using Places = std::array<std::vector<Station>, 2>;

  /// Both long edges of a strip, where the faces beyond look away from each other. Where one of them lies on a symmetry
  /// plane, the strip is half a base, and the other edge is there twice.
  void try_blunt(const Strip& strip, std::vector<std::optional<WingEdge>>& found) {
    if (!is_candidate(strip.edges[0]) || !is_candidate(strip.edges[1])) return;
    const std::array<FaceId, 2> mirror = {mirror_face(strip.edges[0]), mirror_face(strip.edges[1])};
    if (mirror[0] != kNone && mirror[1] != kNone) return;
    const bool is_half = mirror[0] != kNone || mirror[1] != kNone;
    const double width = (is_half ? 2 : 1) * median_width(strip);
    if (!is_narrow(strip, width)) return;
    Places places;
    for (std::size_t k = 0; k < 2; ++k) places[k] = stations(strip.edges[k], surfaces_of(strip.edges[k]));
    if (is_half) complete(strip, places);
    has_hollow_ = has_hollow_ || (is_hollow_base(places[0]) && is_hollow_base(places[1]));
    if (count_blunt(strip, places) < kAgreeing || is_rim(strip, places)) return;
    for (std::size_t k = 0; k < (strip.cut_side ? 1 : 2); ++k) {
      if (mirror[k] != kNone) continue;
      found[strip.edges[k]] = make(strip.edges[k], WingEdgeKind::kBluntTrailing, places[k], width, strip.face);
      found[strip.edges[k]]->mirror = mirror[1 - k];
    }
  }

  /// Puts the mirror image of the other edge where one lies on a symmetry plane.
  void complete(const Strip& strip, Places& places) const {
    const std::size_t k = mirror_of(strip.edges[0]) ? 0 : 1;
    const FaceCoedge& plane = *mirror_of(strip.edges[k]);
    const auto surface = model_.surface(plane.face);
    const Vec3 normal =
        surface_normal(*surface, model_.pcurve(plane.face, plane.coedge)->point(t_.edge_range[2 * strip.edges[k]]));
    places[k] = places[1 - k];
    if (strip.is_opposed) std::reverse(places[k].begin(), places[k].end());
    for (Station& s : places[k])
      for (Side& side : s.sides) side = mirrored(side, normal);
  }

  /// Places where the faces beyond look away from each other, out of the material, across corners, or across a round
  /// whose neighbours are clearly larger than it.
  int count_blunt(const Strip& strip, const Places& places) const {
    int n_agree = 0;
    for (int i = 0; i < kStations; ++i) {
      const Station &a = places[0][i], &b = across_from(a, i, strip, places[1]);
      const Side &from = beyond(a, strip), &to = beyond(b, strip);
      if (dot(from.normal, to.normal) > kLookAway) continue;
      const bool is_round =
          is_smooth(a) && is_smooth(b) && dot(b.x - a.x, from.normal) < 0 &&
          std::min(t_.face_area[from.face], t_.face_area[to.face]) > kLargerThanRound * t_.face_area[strip.face];
      n_agree += is_round || (is_corner(a) && is_corner(b));
    }
    return n_agree;
  }

  /// Corners along an edge of a hole, not square as those of a groove.
  static bool is_hollow_base(const std::vector<Station>& places) {
    return std::ranges::count_if(places, [](const Station& s) {
             const double angle = 2 * kPi - s.angle;  // of what fills the hole
             return angle >= kBluntMin && angle <= kBluntMax && std::abs(angle - kPi / 2) >= kSquareRing;
           }) >= kAgreeing;
  }

  /// A ring square to both sides, or hardly smaller than these: the end of a tube, the rim of a disc, a chamfer.
  bool is_rim(const Strip& strip, const Places& places) const {
    const EdgeId e = strip.edges[0];
    if (t_.edge_vertices[2 * e] != t_.edge_vertices[2 * e + 1]) return false;
    const auto is_square = [](const Station& s) { return std::abs(s.angle - kPi / 2) < kSquareRing; };
    const double area =
        std::min(t_.face_area[beyond(places[0][0], strip).face], t_.face_area[beyond(places[1][0], strip).face]);
    return area < kLargerThanRing * t_.face_area[strip.face] ||
           (std::ranges::all_of(places[0], is_square) && std::ranges::all_of(places[1], is_square));
  }

  /// Closed edges and those of sides in pieces may begin anywhere.
  const Station& across_from(const Station& a, int i, const Strip& strip, const std::vector<Station>& other) const {
    const EdgeId e = strip.edges[1];
    if (!strip.cut_side && t_.edge_vertices[2 * e] != t_.edge_vertices[2 * e + 1])
      return other[strip.is_opposed ? kStations - 1 - i : i];
    return *std::ranges::min_element(other, {}, [&](const Station& s) { return distance(s.x, a.x); });
  }

  static const Side& beyond(const Station& s, const Strip& strip) {
    const FaceId f = s.sides[0].face;
    return s.sides[f == strip.face || std::ranges::count(strip.others, f) > 0 ? 1 : 0];
  }

  // --- flanks of teeth

  /// A base that is wider than a trailing edge's alone may be.
  using Flank = std::array<WingEdge, 2>;

  /// Those between trailing edges and each other, end to end, as a serrated trailing edge has them. What lies around a
  /// tip ends at the nose.
  void add_flanks(std::vector<std::optional<WingEdge>>& found) const {
    std::vector<Flank> flanks;
    for (const Strip& strip : strips_)
      if (std::optional<Flank> own = flank_of(strip, found)) flanks.push_back(*own);
    if (flanks.empty()) return;
    std::vector<std::vector<std::int32_t>> at(static_cast<std::size_t>(t_.n_vertices()));  // bases, and sharp edges
    for (const auto& w : found)
      if (w && w->kind != WingEdgeKind::kLeading) note_at_ends(*w, at);
    for (const Flank& flank : flanks)
      for (const WingEdge& w : flank) note_at_ends(w, at);
    const auto is_open = [&](const Flank& flank) {
      return std::ranges::any_of(flank, [&](const WingEdge& w) {
        return std::ranges::any_of(ends_of(w),
                                   [&](std::int32_t v) { return at[static_cast<std::size_t>(v)].size() < 2; });
      });
    };
    for (auto open = std::ranges::find_if(flanks, is_open); open != flanks.end();
         open = std::ranges::find_if(flanks, is_open)) {
      for (const WingEdge& w : *open)
        for (const std::int32_t v : ends_of(w)) std::erase(at[static_cast<std::size_t>(v)], member_of(w));
      flanks.erase(open);
    }
    keep_with_trailing(found, flanks);
    for (const Flank& flank : flanks)
      for (const WingEdge& w : flank) found[w.edge] = w;
  }

  /// One number for a base, and for a sharp edge.
  std::int32_t member_of(const WingEdge& w) const { return w.base != kNone ? w.base : t_.n_faces() + w.edge; }
  std::array<std::int32_t, 2> ends_of(const WingEdge& w) const {
    const auto e = 2 * static_cast<std::size_t>(w.edge);
    return {t_.edge_vertices[e], t_.edge_vertices[e + 1]};
  }
  void note_at_ends(const WingEdge& w, std::vector<std::vector<std::int32_t>>& at) const {
    for (const std::int32_t v : ends_of(w)) {
      auto& own = at[static_cast<std::size_t>(v)];
      if (std::ranges::count(own, member_of(w)) == 0) own.push_back(member_of(w));
    }
  }

  /// Those that hang together with a trailing edge, or are the flanks of several teeth.
  void keep_with_trailing(const std::vector<std::optional<WingEdge>>& found, std::vector<Flank>& flanks) const {
    DisjointSets vertices(t_.n_vertices());
    const auto join = [&](const WingEdge& w) { vertices.join(ends_of(w)[0], ends_of(w)[1]); };
    std::map<std::int32_t, std::size_t> n_flanks;
    for (const auto& w : found)
      if (w && w->kind != WingEdgeKind::kLeading) join(*w);
    for (const Flank& flank : flanks)
      for (const WingEdge& w : flank) join(w);
    for (const auto& w : found)
      if (w && w->kind != WingEdgeKind::kLeading) n_flanks[vertices.find(ends_of(*w)[0])] = kFlanks;
    const auto own_set = [&](const Flank& flank) { return vertices.find(ends_of(flank[0])[0]); };
    for (const Flank& flank : flanks) ++n_flanks[own_set(flank)];
    std::erase_if(flanks, [&](const Flank& flank) { return n_flanks[own_set(flank)] < kFlanks; });
  }

  /// Corners along both edges of a strip that is no trailing edge by itself.
  std::optional<Flank> flank_of(const Strip& strip, const std::vector<std::optional<WingEdge>>& found) const {
    if (strip.cut_side || found[strip.edges[0]] || found[strip.edges[1]]) return std::nullopt;
    const double width = median_width(strip);
    if (is_narrow(strip, width)) return std::nullopt;
    Places places;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!is_candidate(strip.edges[k]) || mirror_of(strip.edges[k])) return std::nullopt;
      places[k] = stations(strip.edges[k], surfaces_of(strip.edges[k]));
      if (std::ranges::count_if(places[k], is_corner) < kAgreeing) return std::nullopt;
    }
    const auto is_square = [](const Station& s) { return std::abs(s.angle - kPi / 2) < kSquareRing; };
    const bool is_plate = std::ranges::all_of(places[0], is_square) && std::ranges::all_of(places[1], is_square);
    if (is_plate || count_blunt(strip, places) < kAgreeing || is_rim(strip, places)) return std::nullopt;
    const auto edge = [&](std::size_t k) {
      return make(strip.edges[k], WingEdgeKind::kBluntTrailing, places[k], width, strip.face);
    };
    return Flank{edge(0), edge(1)};
  }

  // --- chains

  void drop_short_chains(std::vector<std::optional<WingEdge>>& found) {
    constexpr std::int32_t kKinds = 2;  // trailing, leading
    const auto chain_kind = [](const WingEdge& w) { return w.kind == WingEdgeKind::kLeading ? 1 : 0; };
    const std::int32_t n = kKinds * t_.n_vertices();
    DisjointSets chains(n);
    const auto node = [&](const WingEdge& w, std::size_t end) {
      return chains.find(chain_kind(w) * t_.n_vertices() +
                         t_.edge_vertices[2 * static_cast<std::size_t>(w.edge) + end]);
    };
    for (const auto& w : found)
      if (w) chains.join(node(*w, 0), node(*w, 1));
    std::vector<double> length(n, 0.0);
    for (const auto& w : found)
      if (w) length[node(*w, 0)] += w->length;
    small_.clear();
    for (auto& w : found) {
      if (!w) continue;
      const double own = length[node(*w, 0)];
      if (is_of_diagonal([&](double diagonal) { return own >= kShortestChain * diagonal; })) continue;
      const bool is_tiny = is_of_diagonal([&](double diagonal) { return own < kSmallestChain * diagonal; });
      if (w->kind != WingEdgeKind::kLeading && !is_tiny) small_.push_back(*w);
      w.reset();
    }
  }

  const Model& model_;
  const ModelTables& t_;
  const FaceRoles& roles_;
  std::span<const Strip> strips_;
  const LengthBounds diagonal_;
  mutable std::atomic<bool> is_certain_ = true;
  bool is_turned_ = false;  // normals point into the material
  std::vector<std::vector<FaceCoedge>> uses_;
  std::vector<WingEdge> small_;  // of the last search
  bool has_hollow_ = false;      // likewise
};

}  // namespace

std::vector<WingEdge> find_wing_edges(const Model& model, const FaceRoles& roles, std::span<const Strip> strips,
                                      const Executor& executor, std::vector<WingEdge>* small, bool* has_hollow) {
  WingEdgeFinder finder(model, roles, strips, {roles.reference_diagonal, roles.reference_diagonal});
  std::vector<WingEdge> found = finder.run(executor);
  if (small) *small = finder.small();
  if (has_hollow) *has_hollow = finder.has_hollow();
  return found;
}

std::optional<std::vector<WingEdge>> find_certain_wing_edges(const Model& model, const FaceRoles& roles,
                                                             std::span<const Strip> strips, LengthBounds diagonal) {
  WingEdgeFinder finder(model, roles, strips, diagonal);
  std::vector<WingEdge> found = finder.run(SerialExecutor());
  return finder.is_certain() ? std::optional(std::move(found)) : std::nullopt;
}

void declare_edges(const Model& model, const FaceRoles& roles, std::span<const Strip> strips,
                   std::span<const DeclaredEdge> declared, std::vector<WingEdge>& edges) {
  if (declared.empty()) return;
  WingEdgeFinder(model, roles, strips, {roles.reference_diagonal, roles.reference_diagonal}).declare(declared, edges);
}

}  // namespace st
