#include "features/rotor_blades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/boxes.h"
#include "base/similarity.h"
#include "base/sort_once.h"
#include "features/arc_table.h"
#include "features/edge_places.h"
#include "features/turn_axis.h"
#include "geometry/model/edge_faces.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr std::size_t kPlaces = 5;    // along an edge, its ends included
constexpr double kSameLength = 1e-3;  // of an edge's length: to that of its image
constexpr double kOff = 2e-3;         // of an edge's length: a place from that of its image
constexpr double kOffNose = 0.02;     // of the chord: a nose from the box of its face
constexpr double kOnNose = 0.01;      // of the chord: the middle nose of an edge from the surface it comes to
constexpr double kUp = 1e-6;          // of unit vectors across an edge: too short for a direction
constexpr double kNearlyAll = 0.9;    // of the way of the best: others have too few chords to compare

using Places = std::array<Vec3, kPlaces>;

/// From end to end of its trailing edges, unit.
Vec3 span_direction(const LiftingSurface& wing) {
  const auto furthest_from = [&](Vec3 x) {
    Vec3 best = x;
    for (const ChordEdge& edge : wing.trailing)
      for (const ChordStation& s : edge.stations)
        if (distance(s.trailing, x) > distance(best, x)) best = s.trailing;
    return best;
  };
  const Vec3 end = furthest_from(wing.trailing.front().stations.front().trailing);
  return normalized(furthest_from(end) - end);
}

/// How far along its trailing edges a surface is measured, oblique chords by what they are square to the span; model
/// unit. Of copies that are cut along different axes those count most that are cut along their own span.
double straight_way(const LiftingSurface& wing) {
  const Vec3 span = span_direction(wing);
  double way = 0;
  for (const ChordEdge& edge : wing.trailing)
    for (std::size_t i = 1; i < edge.stations.size(); ++i)
      for (const ChordStation* s : {&edge.stations[i - 1], &edge.stations[i]}) {
        if (!s->is_measured) continue;
        const double half = 0.5 * distance(edge.stations[i - 1].trailing, edge.stations[i].trailing);
        way += half * norm(cross(span, normalized(s->nose - s->trailing)));
      }
  return way;
}

/// Largest over least chord; those cut along a foreign axis have tiny ones at their ends.
double spread_of(const LiftingSurface& wing) { return wing.largest_chord / wing.least_chord; }

class BladeFinder {
 public:
  BladeFinder(const Model& model, std::span<const std::uint8_t> is_excluded, std::vector<LiftingSurface>& wings)
      : model_(model),
        t_(model.tables()),
        is_excluded_(is_excluded),
        wings_(wings),
        is_done_(wings.size(), 0),
        faces_at_(t_),
        places_(t_.n_edges()) {
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      if (!t_.edge_is_degenerate[e]) by_length_.push_back(e);
    std::ranges::stable_sort(by_length_, {}, [&](EdgeId e) { return t_.edge_length[e]; });
  }

  bool run() {
    bool has_changed = false;
    for (std::size_t i = 0; i < wings_.size(); ++i)
      if (!is_done_[i] && is_whole(wings_[i])) has_changed = liken_those_around(i) || has_changed;
    return has_changed;
  }

 private:
  /// Neither the user's, nor half of a blade.
  static bool is_whole(const LiftingSurface& wing) {
    return !wing.is_declared && wing.declared_leading.empty() && !wing.trailing.empty() &&
           std::ranges::none_of(wing.trailing, &ChordEdge::is_half);
  }

  EdgeId longest_edge(const LiftingSurface& wing) const {
    return std::ranges::max_element(wing.trailing, {}, [&](const ChordEdge& e) { return t_.edge_length[e.edge]; })
        ->edge;
  }

  const Places& places_of(EdgeId e) {
    if (places_[e]) return *places_[e];
    const auto curve = model_.curve(e);
    const ArcTable arc(*curve);
    Places& own = places_[e].emplace();
    for (std::size_t i = 0; i < kPlaces; ++i)
      own[i] = curve->point(arc.parameter_at(static_cast<double>(i) / (kPlaces - 1)));
    return own;
  }

  /// Edges about as long as one.
  std::span<const EdgeId> as_long_as(EdgeId e) const {
    const double length = t_.edge_length[e];
    const auto own = [&](EdgeId other) { return t_.edge_length[other]; };
    const auto begin = std::ranges::lower_bound(by_length_, (1 - kSameLength) * length, {}, own);
    return {begin, std::ranges::upper_bound(begin, by_length_.end(), (1 + kSameLength) * length, {}, own)};
  }

  struct EdgeImage {
    EdgeId edge = kNone;
    int way = 1;  // -1: runs the other way round
  };

  /// The edge that runs through the places of another one after a turn, the nearest of those within `reach`: both edges
  /// of a thin base are.
  EdgeImage image_of(EdgeId e, const Similarity& turn, double reach) {
    Places x = places_of(e);
    for (Vec3& p : x) p = turn(p);
    EdgeImage image;
    for (const EdgeId other : as_long_as(e)) {
      const Places& own = places_of(other);
      if (distance(own[kPlaces / 2], x[kPlaces / 2]) > reach) continue;  // most are
      for (const int way : {1, -1}) {
        double off = 0;
        for (std::size_t i = 0; i < kPlaces; ++i)
          off = std::max(off, distance(own[way > 0 ? i : kPlaces - 1 - i], x[i]));
        if (off > reach) continue;
        reach = off;
        image = {other, way};
      }
    }
    return image;
  }

  /// At the middle of an edge: its direction, and the normals of the faces there, unit.
  struct EdgeFrame {
    Vec3 x, tangent;
    std::vector<Vec3> normals;
  };

  EdgeFrame frame_of(EdgeId e) const {
    const auto curve = model_.curve(e);
    const double t = ArcTable(*curve).parameter_at(0.5);
    const CurvePoint p = curve->evaluate(t);
    EdgeFrame frame{p.x, normalized(p.d1), {}};
    for (const FaceId f : faces_at_[e]) {
      for (const CoedgeId c : t_.coedges(f)) {
        if (t_.coedge_edge[c] != e) continue;
        const Vec3 n = surface_normal(*model_.surface(f), model_.pcurve(f, c)->point(t));
        frame.normals.push_back(t_.face_is_reversed[f] ? -n : n);
      }
    }
    return frame;
  }

  /// Moves the middle of one edge onto that of another, with direction and normal.
  static std::optional<Similarity> motion_between(const EdgeFrame& a, Vec3 normal_a, const EdgeFrame& b, Vec3 tangent_b,
                                                  Vec3 normal_b) {
    const Vec3 up_a = cross(a.tangent, normal_a), up_b = cross(tangent_b, normal_b);
    if (norm(up_a) < kUp || norm(up_b) < kUp) return std::nullopt;
    const std::array<Vec3, 3> from = {a.tangent, normalized(up_a), cross(a.tangent, normalized(up_a))};
    const std::array<Vec3, 3> to = {tangent_b, normalized(up_b), cross(tangent_b, normalized(up_b))};
    Similarity motion;
    const auto row = [&](double Vec3::*part) {
      return to[0].*part * from[0] + to[1].*part * from[1] + to[2].*part * from[2];
    };
    motion.rotation = {row(&Vec3::x), row(&Vec3::y), row(&Vec3::z)};
    motion.translation = b.x - motion.rotated(a.x);
    return motion;
  }

  /// Axes about which an edge may turn onto another one.
  std::vector<TurnAxis> axes_between(EdgeId a, EdgeId b) {
    std::vector<TurnAxis> axes;
    const EdgeFrame from = frame_of(a), to = frame_of(b);
    const double length = t_.edge_length[a];
    for (const Vec3 normal : to.normals)
      for (const double sign : {1.0, -1.0}) {
        const auto motion = motion_between(from, from.normals.front(), to, sign * to.tangent, normal);
        if (!motion) continue;
        const auto axis = axis_of(*motion, kOff * length);
        if (axis && image_of(a, *motion, kOff * length).edge == b) axes.push_back(*axis);
      }
    return axes;
  }

  /// The face that has most of the images of a face's edges.
  FaceId image_of_face(FaceId f, const Similarity& turn, double reach) {
    std::map<FaceId, int> n_edges;
    for (const EdgeId e : t_.edges_of(f)) {
      const EdgeId image = t_.edge_is_degenerate[e] ? kNone : image_of(e, turn, reach).edge;
      if (image == kNone) continue;
      for (const FaceId g : faces_at_[image]) ++n_edges[g];
    }
    const auto most = std::ranges::max_element(n_edges, {}, [](const auto& own) { return own.second; });
    return most == n_edges.end() ? kNone : most->first;
  }

  /// Whether the middle one of the noses before an edge is on the CAD: edges of elements of one span look alike.
  bool has_nose(const ChordEdge& edge) const {
    std::vector<const ChordStation*> measured;
    for (const ChordStation& s : edge.stations)
      if (s.is_measured) measured.push_back(&s);
    if (measured.empty()) return true;
    const ChordStation& s = *measured[measured.size() / 2];
    return closest_point(*model_.surface(s.nose_face), s.nose).distance <= kOnNose * s.chord;
  }

  /// The surface where a turn takes it; none where the model lacks one of its edges, or the face that a nose comes to.
  std::optional<LiftingSurface> image_of_wing(const LiftingSurface& wing, const Similarity& turn) {
    const double reach = kOff * t_.edge_length[longest_edge(wing)];
    std::map<FaceId, FaceId> faces{{kNone, kNone}};
    const auto image = [&](FaceId f) {
      const auto [known, is_new] = faces.try_emplace(f, kNone);
      if (is_new) known->second = image_of_face(f, turn, reach);
      return known->second;
    };
    LiftingSurface own = wing;
    for (ChordEdge& edge : own.trailing) {
      const auto [e, way] = image_of(edge.edge, turn, reach);
      if (e == kNone || is_excluded_[e] || (edge.base != kNone && image(edge.base) == kNone)) return std::nullopt;
      edge.edge = e;
      edge.base = image(edge.base);
      for (ChordStation& s : edge.stations) {
        if (s.is_measured && (image(s.nose_face) == kNone || (edge.is_inside && image(s.tail_face) == kNone)))
          return std::nullopt;
        if (way < 0) s.share = 1 - s.share;
        s.trailing = turn(s.trailing);
        s.nose = turn(s.nose);
        s.nose_face = image(s.nose_face);
        s.tail_face = image(s.tail_face);
        if (s.is_measured && !contains(t_.face_box[s.nose_face], s.nose, kOffNose * s.chord)) return std::nullopt;
      }
      if (way < 0) std::ranges::reverse(edge.stations);
      if (!has_nose(edge)) return std::nullopt;
    }
    std::ranges::sort(own.trailing, {}, &ChordEdge::edge);
    if (std::ranges::adjacent_find(own.trailing, {}, &ChordEdge::edge) != own.trailing.end()) return std::nullopt;
    for (FaceId& f : own.faces) f = image(f);
    sort_once(own.faces);
    std::erase(own.faces, kNone);
    for (EdgeId& e : own.leading) e = image_of(e, turn, reach).edge;
    sort_once(own.leading);
    std::erase(own.leading, kNone);
    return own;
  }

  /// All places where turns about an axis take a surface, its own first.
  std::vector<LiftingSurface> images_of(const LiftingSurface& wing, const TurnAxis& axis) {
    const EdgeId lead = longest_edge(wing);
    const Vec3 middle = places_of(lead)[kPlaces / 2];
    const double reach = kOff * t_.edge_length[lead];
    std::vector<LiftingSurface> images{wing};
    if (axis.radius(middle) <= reach) return images;
    for (const EdgeId e : as_long_as(lead)) {
      const Vec3 x = places_of(e)[kPlaces / 2];
      if (e == lead || std::abs(axis.height(x) - axis.height(middle)) > reach ||
          std::abs(axis.radius(x) - axis.radius(middle)) > reach)
        continue;
      const auto own = image_of_wing(wing, axis.turn(axis.azimuth(x) - axis.azimuth(middle)));
      if (own && std::ranges::none_of(images, [&](const auto& other) { return share_edges(*own, other); }))
        images.push_back(*own);
    }
    return images;
  }

  static bool share_edges(const LiftingSurface& a, const LiftingSurface& b) {
    return std::ranges::any_of(a.trailing, [&](const ChordEdge& own) {
      return std::ranges::count(b.trailing, own.edge, &ChordEdge::edge) > 0;
    });
  }

  /// Surfaces at these places, ascending.
  std::vector<std::size_t> members_of(std::span<const LiftingSurface> images) const {
    std::vector<std::size_t> members;
    for (std::size_t k = 0; k < wings_.size(); ++k)
      if (std::ranges::any_of(images, [&](const LiftingSurface& own) { return share_edges(own, wings_[k]); }))
        members.push_back(k);
    return members;
  }

  /// The axis about which most images of a surface stand.
  std::optional<TurnAxis> best_axis(std::size_t i) {
    std::optional<TurnAxis> best;
    std::size_t most = 1;
    for (std::size_t k = 0; k < wings_.size(); ++k) {
      if (k == i || !is_whole(wings_[k])) continue;
      for (const ChordEdge& other : wings_[k].trailing) {
        const auto alike = as_long_as(longest_edge(wings_[i]));
        if (std::ranges::count(alike, other.edge) == 0) continue;
        for (const TurnAxis& axis : axes_between(longest_edge(wings_[i]), other.edge)) {
          const std::size_t n = images_of(wings_[i], axis).size();
          if (n <= most) continue;
          most = n;
          best = axis;
          if (n >= alike.size()) return best;
        }
      }
    }
    return best;
  }

  bool liken_those_around(std::size_t i) {
    const auto axis = best_axis(i);
    if (!axis) return false;
    const std::vector<LiftingSurface> own = images_of(wings_[i], *axis);
    std::vector<std::size_t> members = members_of(own);
    std::ranges::stable_sort(members, std::greater(), [&](std::size_t k) { return straight_way(wings_[k]); });
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : members)
      if (straight_way(wings_[k]) >= kNearlyAll * straight_way(wings_[members.front()]))
        least = std::min(least, spread_of(wings_[k]));
    for (const std::size_t k : members) {
      if (!is_whole(wings_[k]) || straight_way(wings_[k]) == 0 || spread_of(wings_[k]) > kOutlier * least) continue;
      std::vector<LiftingSurface> images = images_of(wings_[k], *axis);
      if (images.size() < own.size()) continue;
      put_in(images);
      return true;
    }
    return false;
  }

  /// Each in the place of those that have one of its edges.
  void put_in(std::span<LiftingSurface> images) {
    for (LiftingSurface& image : images) {
      const std::vector<std::size_t> members = members_of({&image, 1});
      if (std::ranges::any_of(members, [&](std::size_t k) { return !is_whole(wings_[k]); })) continue;
      for (std::size_t i = members.size(); i-- > 1;) {
        wings_.erase(wings_.begin() + static_cast<std::ptrdiff_t>(members[i]));
        is_done_.erase(is_done_.begin() + static_cast<std::ptrdiff_t>(members[i]));
      }
      const std::size_t place = members.empty() ? wings_.size() : members.front();
      if (members.empty()) {
        wings_.emplace_back();
        is_done_.push_back(0);
      }
      wings_[place] = std::move(image);
      is_done_[place] = 1;
    }
  }

  const Model& model_;
  const ModelTables& t_;
  std::span<const std::uint8_t> is_excluded_;
  std::vector<LiftingSurface>& wings_;
  std::vector<std::uint8_t> is_done_;  // by surface: is alike with its sisters
  EdgeFaces faces_at_;
  std::vector<EdgeId> by_length_;              // not degenerate, the shortest first
  std::vector<std::optional<Places>> places_;  // by edge; made when first asked
};

/// Takes out trailing edges that belong to a surface.
void take_used(const ModelTables& t, std::span<const LiftingSurface> wings, std::vector<UnusedTrailing>& unused) {
  std::vector<std::uint8_t> is_used(static_cast<std::size_t>(t.n_edges()), 0);
  for (const LiftingSurface& wing : wings) {
    for (const ChordEdge& edge : wing.trailing) is_used[edge.edge] = 1;
    for (const EdgeId e : wing.leading) is_used[e] = 1;
  }
  for (UnusedTrailing& own : unused)
    std::erase_if(own.edges, [&](EdgeId e) {
      if (is_used[e]) own.length -= t.edge_length[e];
      return is_used[e] != 0;
    });
  std::erase_if(unused, [](const UnusedTrailing& own) { return own.edges.empty(); });
}

}  // namespace

void liken_blades(const Model& model, std::span<const std::uint8_t> is_excluded, std::vector<LiftingSurface>& wings,
                  std::vector<UnusedTrailing>& unused) {
  if (wings.size() < 2) return;
  if (BladeFinder(model, is_excluded, wings).run()) take_used(model.tables(), wings, unused);
}

}  // namespace st
