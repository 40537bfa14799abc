#include "features/lifting_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "features/arc_table.h"
#include "features/profile.h"

namespace st {
namespace {

constexpr int kStations = 24;           // measured on each edge
constexpr double kMeasured = 0.5;       // of the stations of a surface, at least
constexpr double kLeastSpan = 0.5;      // of the median chord
constexpr double kWidestBase = 0.06;    // of the median chord
constexpr double kAlongAxis = 0.5;      // cosine between edge and axis at least, to cut square to the axis
constexpr double kDeflection = 1e-3;    // of the reference diagonal: of the facets
constexpr std::size_t kAround = 4;      // stations to either side whose chords are compared
constexpr double kOutlier = 1.4;        // chord over the median around
constexpr double kFarOutlier = 4;       // chord over the median of the surface: wings taper less
constexpr double kLeastNoseWay = 0.25;  // of the way along the trailing edge: way along the noses
constexpr double kOnPlane = 1e-6;       // of the reference diagonal: from a plane of symmetry
constexpr double kNearNose = 0.05;      // of the chord: between nose and leading edge at most

constexpr std::array<Vec3, 3> kAxes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// Trailing edges that hang together at vertices or across their base.
std::vector<std::vector<WingEdge>> trailing_chains(const ModelTables& t, std::span<const WingEdge> edges) {
  std::vector<WingEdge> trailing;
  for (const WingEdge& w : edges)
    if (w.kind != WingEdgeKind::kLeading) trailing.push_back(w);
  std::vector<std::size_t> parent(trailing.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto hang_together = [&](const WingEdge& a, const WingEdge& b) {
    if (a.base != kNone && a.base == b.base) return true;
    const VertexId* va = &t.edge_vertices[2 * static_cast<std::size_t>(a.edge)];
    const VertexId* vb = &t.edge_vertices[2 * static_cast<std::size_t>(b.edge)];
    return va[0] == vb[0] || va[0] == vb[1] || va[1] == vb[0] || va[1] == vb[1];
  };
  for (std::size_t i = 0; i < trailing.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (hang_together(trailing[i], trailing[j])) {
        const std::size_t a = root(i), b = root(j);
        parent[std::max(a, b)] = std::min(a, b);
      }
  std::vector<std::vector<WingEdge>> chains(trailing.size());
  for (std::size_t i = 0; i < trailing.size(); ++i) chains[root(i)].push_back(trailing[i]);
  std::erase_if(chains, [](const auto& chain) { return chain.empty(); });
  return chains;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

/// A place on an edge, before anything is measured there.
struct EdgePlace {
  std::size_t edge;  // of the chain
  double share;
  Vec3 x, tangent;
};

class SurfaceMeasurer {
 public:
  SurfaceMeasurer(const Model& model, const ProfileCutter& cutter, double reach)
      : model_(model), cutter_(cutter), reach_(reach) {}

  std::optional<LiftingSurface> run(const std::vector<WingEdge>& chain) const {
    const std::vector<EdgePlace> places = places_along(chain);
    if (!is_promising(places)) return std::nullopt;
    std::vector<std::optional<Profile>> profiles = best_profiles(places);
    drop_outliers(places, profiles);
    const auto n = static_cast<std::size_t>(
        std::count_if(profiles.begin(), profiles.end(), [](const auto& p) { return p.has_value(); }));
    if (static_cast<double>(n) < kMeasured * static_cast<double>(places.size())) return std::nullopt;
    LiftingSurface surface = assemble(chain, places, profiles);
    const bool is_wide = std::any_of(chain.begin(), chain.end(), [&](const WingEdge& w) {
      return w.base != kNone && w.size > kWidestBase * surface.median_chord;
    });
    return !is_wide && surface.span >= kLeastSpan * surface.median_chord && has_moving_noses(surface)
               ? std::optional(std::move(surface))
               : std::nullopt;
  }

 private:
  std::vector<EdgePlace> places_along(const std::vector<WingEdge>& chain) const {
    std::vector<EdgePlace> places;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const auto curve = model_.curve(chain[k].edge);
      const ArcTable arc(*curve);
      for (int i = 0; i < kStations; ++i) {
        const double share = (i + 0.5) / kStations;
        const CurvePoint p = curve->evaluate(arc.parameter_at(share));
        places.push_back({k, share, p.x, normalized(p.d1)});
      }
    }
    return places;
  }

  std::optional<Profile> profile_at(const EdgePlace& place, const Vec3* axis) const {
    if (axis && std::abs(dot(place.tangent, *axis)) < kAlongAxis) return std::nullopt;
    return cutter_.cut(place.x, axis ? *axis : place.tangent, reach_);
  }

  /// Some of a few places have a profile: spares the many edges of machine parts.
  bool is_promising(const std::vector<EdgePlace>& places) const {
    constexpr std::size_t kTried = 6;
    const std::size_t step = std::max<std::size_t>(1, places.size() / kTried);
    for (std::size_t i = step / 2; i < places.size(); i += step) {
      if (profile_at(places[i], nullptr)) return true;
      for (const Vec3& axis : kAxes)
        if (profile_at(places[i], &axis)) return true;
    }
    return false;
  }

  std::vector<std::optional<Profile>> best_profiles(const std::vector<EdgePlace>& places) const {
    std::vector<std::optional<Profile>> best;
    std::ptrdiff_t n_best = -1;
    for (const Vec3* axis : {kAxes.data(), kAxes.data() + 1, kAxes.data() + 2, static_cast<const Vec3*>(nullptr)}) {
      std::vector<std::optional<Profile>> own;
      for (const EdgePlace& place : places) own.push_back(profile_at(place, axis));
      const auto n = std::count_if(own.begin(), own.end(), [](const auto& p) { return p.has_value(); });
      if (n <= n_best) continue;
      n_best = n;
      best = std::move(own);
    }
    return best;
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
      std::vector<double> around;
      for (std::size_t j = i < kAround ? 0 : i - kAround; j < std::min(i + kAround + 1, profiles.size()); ++j)
        if (profiles[j] && places[j].edge == places[i].edge) around.push_back(profiles[j]->chord);
      const double own = profiles[i]->chord, usual = around.size() > 2 ? median(around) : of_all;
      if (own > kOutlier * usual || own * kOutlier < usual || own > kFarOutlier * of_all || own * kFarOutlier < of_all)
        outliers.push_back(i);
    }
    for (const std::size_t i : outliers) profiles[i].reset();
  }

  LiftingSurface assemble(const std::vector<WingEdge>& chain, const std::vector<EdgePlace>& places,
                          const std::vector<std::optional<Profile>>& profiles) const {
    LiftingSurface surface;
    for (const WingEdge& w : chain) {
      const bool is_half = w.base != kNone && w.mirror != kNone;
      surface.trailing.push_back({w.edge, w.base, is_half, {}});
      surface.span += w.base == kNone || is_half ? w.length : 0.5 * w.length;
      surface.is_blunt = surface.is_blunt || w.base != kNone;
    }
    std::vector<double> chords;
    for (std::size_t i = 0; i < places.size(); ++i) {
      ChordStation station{places[i].share, places[i].x};
      if (profiles[i]) {
        station.is_measured = true;
        station.chord = profiles[i]->chord;
        station.nose = profiles[i]->nose;
        station.nose_face = profiles[i]->nose_face;
        chords.push_back(station.chord);
        surface.faces.insert(surface.faces.end(), profiles[i]->faces.begin(), profiles[i]->faces.end());
      }
      surface.trailing[places[i].edge].stations.push_back(station);
    }
    std::sort(surface.faces.begin(), surface.faces.end());
    surface.faces.erase(std::unique(surface.faces.begin(), surface.faces.end()), surface.faces.end());
    surface.median_chord = median(chords);
    const auto [least, most] = std::minmax_element(chords.begin(), chords.end());
    surface.least_chord = *least;
    surface.largest_chord = *most;
    fill_in(surface);
    return surface;
  }

  /// Noses run along the trailing edge: they do not where a body of revolution ends in its apex.
  static bool has_moving_noses(const LiftingSurface& surface) {
    double of_noses = 0, of_edge = 0;
    for (const TrailingEdge& edge : surface.trailing) {
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
    for (const TrailingEdge& edge : surface.trailing)
      for (const ChordStation& s : edge.stations)
        if (s.is_measured) measured.push_back(s);
    for (TrailingEdge& edge : surface.trailing) {
      const auto curve = model_.curve(edge.edge);
      edge.stations.insert(edge.stations.begin(), {0, curve->point(curve->t_min())});
      edge.stations.push_back({1, curve->point(curve->t_max())});
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
  const double reach_;
};

/// Leading edges along the noses of a surface.
void add_leading(const Model& model, std::span<const WingEdge> edges, LiftingSurface& surface) {
  for (const WingEdge& w : edges) {
    if (w.kind != WingEdgeKind::kLeading) continue;
    const auto curve = model.curve(w.edge);
    const CurvePoint a = curve->evaluate(curve->t_min());
    bool is_near = false;
    Vec3 last = a.x;
    for (int i = 1; i <= kStations && !is_near; ++i) {
      const Vec3 x = curve->point(curve->t_min() + (curve->t_max() - curve->t_min()) * i / kStations);
      for (const TrailingEdge& edge : surface.trailing)
        for (const ChordStation& s : edge.stations)
          is_near = is_near || (s.is_measured && segment_distance(s.nose, last, x) < kNearNose * s.chord);
      last = x;
    }
    if (is_near) surface.leading.push_back(w.edge);
  }
}

/// The facets and their mirror image; vertices on the plane of `mirror` belong to both.
Facets with_image(const Model& model, Facets facets, FaceId mirror, double on_plane) {
  const auto surface = model.surface(mirror);
  const SurfacePoint at =
      surface->evaluate({0.5 * (surface->u_min() + surface->u_max()), 0.5 * (surface->v_min() + surface->v_max())});
  const Vec3 normal = normalized(cross(at.du, at.dv));
  std::vector<std::int32_t> image;
  for (std::size_t i = 0, n = facets.xyz.size(); i < n; ++i) {
    const Vec3 x = facets.xyz[i];
    const double height = dot(x - at.x, normal);
    image.push_back(static_cast<std::int32_t>(std::abs(height) <= on_plane ? i : facets.xyz.size()));
    if (std::abs(height) > on_plane) facets.xyz.push_back(x - 2 * height * normal);
  }
  for (std::size_t i = 0, n = facets.triangle.size(); i < n; ++i) {
    const auto t = facets.triangle[i];
    facets.triangle.push_back({image[t[0]], image[t[2]], image[t[1]]});
    facets.face.push_back(facets.face[i]);
  }
  return facets;
}

/// The plane of symmetry on which a chain lies; kNone: on none.
FaceId mirror_of(const std::vector<WingEdge>& chain) {
  for (const WingEdge& w : chain)
    if (w.mirror != kNone) return w.mirror;
  return kNone;
}

}  // namespace

double TrailingEdge::chord_at(double share) const {
  const auto next = std::lower_bound(stations.begin() + 1, stations.end() - 1, share,
                                     [](const ChordStation& s, double at) { return s.share < at; });
  const ChordStation &a = *(next - 1), &b = *next;
  const double part = std::clamp((share - a.share) / (b.share - a.share), 0.0, 1.0);
  return a.chord + part * (b.chord - a.chord);
}

NearestChord LiftingSurface::nearest_chord(Vec3 x) const {
  NearestChord nearest{median_chord, -1};
  for (const TrailingEdge& edge : trailing)
    for (const ChordStation& s : edge.stations) {
      if (!s.is_measured) continue;
      const double d = segment_distance(x, s.trailing, s.nose);
      if (nearest.distance < 0 || d < nearest.distance) nearest = {s.chord, d};
    }
  return nearest;
}

std::vector<LiftingSurface> find_lifting_surfaces(const Model& model, const FaceRoles& roles,
                                                  std::span<const WingEdge> edges) {
  const std::vector<std::vector<WingEdge>> chains = trailing_chains(model.tables(), edges);
  std::vector<LiftingSurface> surfaces;
  if (chains.empty()) return surfaces;
  std::vector<std::uint8_t> is_wall;
  for (const FaceRole role : roles.role) is_wall.push_back(role == FaceRole::kWall);
  const double deflection = kDeflection * roles.reference_diagonal;
  const Facets facets = make_facets(model, is_wall, {.deflection = deflection});
  std::map<FaceId, Facets> whole;  // by symmetry plane
  for (const auto& chain : chains) {
    const FaceId mirror = mirror_of(chain);
    if (mirror != kNone && !whole.contains(mirror))
      whole.emplace(mirror, with_image(model, facets, mirror, kOnPlane * roles.reference_diagonal));
    const ProfileCutter cutter(mirror == kNone ? facets : whole.at(mirror));
    std::optional<LiftingSurface> surface = SurfaceMeasurer(model, cutter, 2 * deflection).run(chain);
    if (!surface) continue;
    add_leading(model, edges, *surface);
    surfaces.push_back(std::move(*surface));
  }
  return surfaces;
}

}  // namespace st
