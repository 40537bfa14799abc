#include "features/front_noses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/boxes.h"
#include "features/edge_places.h"
#include "features/profile.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr double kStep = 0.05;        // of the chord: from one nose to the next
constexpr double kSame = 0.02;        // of the chord: noses no further apart across the span are one
constexpr double kBeside = 0.25;      // of a step: how far beyond its end a trailing edge is behind
constexpr double kBehind = 0.35;      // of the chord: from where a trailing edge would be to one, as that of a flap
constexpr double kAcross = 0.7;       // cosine between a gap in a trailing edge and the span, at least
constexpr double kLeastGap = 0.002;   // of the chord: a nose ahead that is nearer goes on from this one
constexpr double kNosesApart = 0.01;  // of the chord: of both edges of a base, before a thick one as of a slot
constexpr double kSeam = 0.002;       // of the chord: an edge along the nose is no nearer to the end of its face
constexpr int kLoopSides = 64;        // of each edge of a face, even
constexpr int kMostSteps = 2000;      // of one nose
constexpr int kHalvings = 4;          // of the last step
constexpr std::size_t kMissed = 2;    // stations without noses over which a nose goes on anyway, as st-raster has it

/// A piece of a trailing edge, or of a gap in one.
struct Piece {
  Vec3 a, b;

  Vec3 nearest(Vec3 x) const {
    const Vec3 way = b - a;
    return norm2(way) > 0 ? a + std::clamp(dot(x - a, way) / norm2(way), 0.0, 1.0) * way : a;
  }
};

/// Where a nose is followed.
struct Walk {
  Vec3 nose, along;  // along: unit
  Vec3 chord;        // from the nose to what is behind it
  Vec3 normal;       // of the planes, unit
  FaceId face;
};

class FrontFinder {
 public:
  FrontFinder(const Model& model, std::span<const LiftingSurface> all, const LiftingSurface& own)
      : model_(model), all_(all), own_(own) {}

  std::vector<ChordEdge> run() {
    for (const ChordEdge& edge : own_.trailing) {
      if (edge.is_inside) continue;
      std::vector<const ChordStation*> s;
      std::vector<std::size_t> at;  // of these among all stations
      for (std::size_t i = 0; i < edge.stations.size(); ++i)
        if (edge.stations[i].is_measured) s.push_back(&edge.stations[i]), at.push_back(i);
      const std::size_t n = s.size();
      for (std::size_t i = 1; i < n; ++i) {
        const bool is_last = i + 1 == n, is_apart = !is_last && at[i + 1] > at[i] + kMissed + 1;
        if (is_last ? is_end(edge, 1) : is_apart || jumps(*s[i - 1], *s[i], *s[i + 1])) follow(edge, *s[i - 1], *s[i]);
        const std::size_t k = n - 1 - i;  // likewise against the edge
        const bool is_first = k == 0, is_apart_before = !is_first && at[k] > at[k - 1] + kMissed + 1;
        if (is_first ? is_end(edge, 0) : is_apart_before || jumps(*s[k + 1], *s[k], *s[k - 1]))
          follow(edge, *s[k + 1], *s[k]);
      }
    }
    return std::move(front_);
  }

 private:
  VertexId vertex(EdgeId e, std::size_t k) const { return model_.tables().edge_vertices[2 * e + k]; }

  /// Whether no other of its trailing edges goes on there.
  bool is_end(const ChordEdge& edge, std::size_t side) const {
    std::ptrdiff_t n = 0;
    for (const ChordEdge& other : own_.trailing)
      for (const std::size_t k : {0, 1}) n += vertex(other.edge, k) == vertex(edge.edge, side);
    return n == 1;
  }

  static Walk walk_from(const ChordStation& before, const ChordStation& from) {
    const Vec3 chord = from.trailing - from.nose, along = normalized(from.nose - before.nose);
    const Vec3 forward = normalized(chord);
    return {from.nose, along, chord, normalized(along - dot(along, forward) * forward), from.nose_face};
  }

  /// Whether the nose goes on as it did, and the next station has another one.
  bool jumps(const ChordStation& before, const ChordStation& from, const ChordStation& next) {
    const double way = distance(before.trailing, from.trailing);
    if (!(way > 0)) return false;
    const Vec3 guess = from.nose + distance(from.trailing, next.trailing) / way * (from.nose - before.nose);
    if (distance(guess, next.nose) <= kSame * from.chord) return false;
    Walk walk = walk_from(before, from);
    if (!(norm2(walk.normal) > 0)) return false;
    const std::optional<Vec3> x = nose_at(walk, guess, next.trailing);
    return x && distance(*x, next.nose) > kSame * from.chord;
  }

  /// Of the plane through `trailing`, near `guess`; sets the face. nullopt: the model has none there.
  std::optional<Vec3> nose_at(Walk& walk, Vec3 guess, Vec3 trailing) {
    const double chord = distance(guess, trailing), reach = kStep * chord;
    const auto find_on = [&](FaceId f) {
      const Profile near{.normal = walk.normal, .nose = guess, .nose_face = f, .chord = chord};
      std::optional<Vec2> uv;
      std::optional<Vec3> x = exact_nose(*model_.surface(f), trailing, near, reach, uv);
      if (x && !has_place(f, *uv, walk.normal, kSeam * chord)) x.reset();
      if (x) walk.face = f;
      return x;
    };
    std::optional<Vec3> x = find_on(walk.face);
    const FaceId last = walk.face;
    for (std::size_t i = 0; i < own_.faces.size() && !x; ++i)
      if (own_.faces[i] != last && contains(model_.tables().face_box[own_.faces[i]], guess, reach))
        x = find_on(own_.faces[i]);
    return x;
  }

  /// Whether a place on a face's surface is on the face, or beside it in the plane of the profile: an edge along a nose
  /// is on either of its faces.
  bool has_place(FaceId f, Vec2 uv, Vec3 normal, double beside) {
    const auto [known, is_new] = loops_.try_emplace(f);
    if (is_new) known->second = loops_of(model_, f);
    const SurfacePoint2 p = model_.surface(f)->evaluate2(uv);
    const std::optional<Vec2> step = tangent_step(p.du, p.dv, beside * normalized(cross(cross(p.du, p.dv), normal)));
    return known->second.contains(uv) ||
           (step && (known->second.contains(uv + *step) || known->second.contains(uv - *step)));
  }

  /// What is behind a nose would be at `x`.
  std::optional<Vec3> behind(Vec3 x, Vec3 normal, double chord, double step) {
    if (pieces_.empty()) find_pieces();
    std::optional<Vec3> best;
    for (const Piece& piece : pieces_) {
      const Vec3 own = piece.nearest(x);
      if (distance(own, x) > kBehind * chord || std::abs(dot(own - x, normal)) > kBeside * step) continue;
      if (!best || distance(own, x) < distance(*best, x)) best = own;
    }
    return best;
  }

  void find_pieces() {
    std::vector<Piece> ends;  // of the own edges: a to b runs outward
    for (const LiftingSurface& surface : all_)
      for (const ChordEdge& edge : surface.trailing) {
        const std::vector<ChordStation>& s = edge.stations;
        for (std::size_t i = 1; i < s.size(); ++i)
          if (!s[i - 1].is_hidden && !s[i].is_hidden) pieces_.push_back({s[i - 1].trailing, s[i].trailing});
        if (&surface != &own_ || edge.is_inside || s.size() < 2) continue;
        if (is_end(edge, 0)) ends.push_back({s[1].trailing, s[0].trailing});
        if (is_end(edge, 1)) ends.push_back({s[s.size() - 2].trailing, s.back().trailing});
      }
    for (const Piece& end : ends) {
      const Vec3 out = normalized(end.b - end.a);
      const Piece* next = nullptr;
      for (const Piece& other : ends)
        if (dot(normalized(other.b - end.b), out) > kAcross && dot(normalized(other.b - other.a), out) < -kAcross &&
            (!next || distance(other.b, end.b) < distance(next->b, end.b)))
          next = &other;
      if (next) pieces_.push_back({end.b, next->b});
    }
  }

  /// The nearest nose of a station ahead, no further than a step; of the other edge of the base there is none.
  const ChordStation* arrival(const ChordEdge& edge, const Walk& walk, double step) const {
    const ChordStation* best = nullptr;
    const double chord = norm(walk.chord);
    double least = step;
    for (const ChordEdge& other : own_.trailing) {
      if (other.edge != edge.edge && other.base != kNone && other.base == edge.base) continue;
      for (const ChordStation& s : other.stations) {
        const Vec3 way = s.nose - walk.nose;
        const double ahead = dot(way, walk.along);
        if (!s.is_measured || is_outlier(s.chord, chord) || ahead <= kLeastGap * chord || ahead > least ||
            norm(way - ahead * walk.along) > kSame * chord)
          continue;
        best = &s, least = ahead;
      }
    }
    return best;
  }

  bool is_known(Vec3 x, double near) const {
    return std::ranges::any_of(front_, [&](const ChordEdge& edge) {
      for (std::size_t i = 1; i < edge.stations.size(); ++i)
        if (segment_distance(x, edge.stations[i - 1].nose, edge.stations[i].nose) < near) return true;
      return false;
    });
  }

  /// One step on; false: there is no nose, or nothing behind it.
  bool advance(Walk& walk, double step) {
    const Vec3 guess = walk.nose + step * walk.along;
    const double chord = norm(walk.chord);
    const std::optional<Vec3> tail = behind(guess + walk.chord, walk.normal, chord, step);
    if (!tail) return false;
    const Vec3 in_plane = *tail - guess - dot(*tail - guess, walk.normal) * walk.normal;
    const std::optional<Vec3> x = nose_at(walk, guess, guess + in_plane);
    if (!x || is_outlier(norm(in_plane), chord) || !(dot(*x - walk.nose, walk.along) > 0.5 * step)) return false;
    walk.along = normalized(*x - walk.nose);
    walk.nose = *x;
    walk.chord = in_plane;
    return true;
  }

  /// The nose alone.
  static ChordStation alone(ChordStation s) {
    s.trailing = s.nose;
    s.tail_face = s.nose_face;
    return s;
  }

  void follow(const ChordEdge& edge, const ChordStation& before, const ChordStation& from) {
    Walk walk = walk_from(before, from);
    if (!(norm2(walk.normal) > 0)) return;
    double step = kStep * from.chord;
    if (!arrival(edge, walk, step) &&
        !behind(walk.nose + step * walk.along + walk.chord, walk.normal, from.chord, step))
      return;  // as most noses do: they end with their trailing edge
    const ChordStation* end = nullptr;
    ChordEdge run;
    run.is_inside = true;
    run.stations.push_back(alone(from));
    for (int n = 0, halvings = 0; n < kMostSteps && !end && halvings <= kHalvings; ++n) {
      end = arrival(edge, walk, step);
      if (!advance(walk, end ? 0.5 * dot(end->nose - walk.nose, walk.along) : step)) {
        end = nullptr;
        ++halvings;
        step *= 0.5;
        continue;
      }
      if (is_known(walk.nose, kSame * from.chord)) return;
      ChordStation s;
      s.nose = walk.nose, s.nose_face = walk.face, s.chord = norm(walk.chord), s.is_measured = true;
      run.stations.push_back(alone(s));
    }
    if (end) run.stations.push_back(alone(*end));
    if (end || distance(run.stations.back().nose, from.nose) >= kLeastGap * from.chord) keep(std::move(run));
  }

  void keep(ChordEdge&& run) {
    double way = 0;
    for (std::size_t i = 1; i < run.stations.size(); ++i)
      run.stations[i].share = way += distance(run.stations[i - 1].nose, run.stations[i].nose);
    for (ChordStation& s : run.stations) s.share /= way;
    front_.push_back(std::move(run));
  }

  const Model& model_;
  std::span<const LiftingSurface> all_;
  const LiftingSurface& own_;
  std::vector<Piece> pieces_;  // trailing edges with noses, and gaps; empty: not known yet
  std::map<FaceId, LoopPolygons> loops_;
  std::vector<ChordEdge> front_;
};

}  // namespace

LoopPolygons loops_of(const Model& model, FaceId face) {
  const ModelTables& t = model.tables();
  std::vector<LoopSide> sides;
  for (const CoedgeId c : t.coedges(face)) {
    const auto curve = model.pcurve(face, c);
    const double from = t.edge_range[2 * t.coedge_edge[c]], to = t.edge_range[2 * t.coedge_edge[c] + 1];
    Vec2 last = curve->point(from);
    for (int i = 1; i <= kLoopSides; ++i) {
      const Vec2 next = curve->point(from + (to - from) * i / kLoopSides);
      sides.push_back({last, next});
      last = next;
    }
  }
  return LoopPolygons(std::move(sides));
}

bool has_other_noses(const LiftingSurface& wing, const ChordEdge& second) {
  return std::ranges::any_of(second.stations, [&](const ChordStation& s) {
    double least = std::numeric_limits<double>::infinity();
    for (const ChordEdge& first : wing.trailing) {
      if (first.base != second.base || first.edge == second.edge) continue;
      for (std::size_t i = 1; i < first.stations.size(); ++i)
        if (const ChordStation& a = first.stations[i - 1], &b = first.stations[i]; a.is_measured && b.is_measured)
          least = std::min(least, segment_distance(s.nose, a.nose, b.nose));
    }
    return s.is_measured && std::isfinite(least) && least > kNosesApart * s.chord;
  });
}

void add_front_noses(const Model& model, std::span<LiftingSurface> surfaces) {
  for (LiftingSurface& surface : surfaces) surface.front = FrontFinder(model, surfaces, surface).run();
}

}  // namespace st
