#include "sizing/wing_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/log.h"
#include "base/sort_once.h"
#include "features/arc_table.h"
#include "features/front_noses.h"
#include "features/ridge_noses.h"
#include "features/rim_edges.h"
#include "geometry/shape/projection.h"
#include "sizing/end_stretch.h"
#include "sizing/smooth_piece.h"

namespace st {
namespace {

constexpr int kMaxBoxes = 100000;       // along one edge
constexpr int kGap = 2;                 // stations: noses further apart are not joined
constexpr double kNose = 0.9;           // of the length asked for: s / (exp(s) - 1) for a slope s of 0.2
constexpr double kBentTail = 0.5;       // of the length asked for: curvature of round tails asks for no less
constexpr double kDefaultTail = 0.003;  // of the chord: likewise of this length at most
constexpr double kAtEnd = 0.01;         // of the chord: noses that end nearer to tip or root end there
constexpr double kBefore = 5;           // lengths: noses that end further before their face does
constexpr double kFlat = 1;             // of the chord: asks for nothing
constexpr double kTrailing = 0.95;      // likewise, along edges, where lengths along are exact

/// Lengths at a place of a wing, by its local chord.
class LocalLengths {
 public:
  LocalLengths(const LiftingSurface& wing, const WingSizes& sizes) : span_(wing.span), sizes_(sizes) {}

  double floor(double chord) const { return sizes_.least ? resolved(*sizes_.least, "--lmin", chord) : 0; }
  double asked(double chord) const { return resolved(sizes_.edge_size, "--edge-size", chord); }
  double resolved(const LengthSpec& size, const char* option, double chord) const {
    return resolve_length(size, reference_of(chord), option);
  }

 private:
  LengthReference reference_of(double chord) const {
    LengthReference reference = sizes_.reference;
    reference.chord = chord;
    reference.span = span_;
    return reference;
  }

  double span_;
  const WingSizes& sizes_;
};

class WingRaster {
 public:
  WingRaster(const Model& model, const LiftingSurface& wing, const WingSizes& sizes, std::vector<RasterBox>& boxes)
      : model_(model), wing_(wing), sizes_(sizes), boxes_(boxes), rims_(model) {}

  void add_edge(const ChordEdge& trailing) {
    const auto curve = model_.curve(trailing.edge);
    const ArcTable arc(*curve);
    walk(arc.length(), pack_cause(CauseKind::kEdge, trailing.edge), ends_of(trailing), [&](double share) {
      return reduced(sizes_.stretch.max_aspect > 1 ? kNose : kTrailing, curve->point(arc.parameter_at(share)),
                     trailing.chord_at(share));
    });
  }

  void add_noses(const ChordEdge& trailing) { add_inside(trailing, &ChordStation::nose, &ChordStation::nose_face); }

  /// Along a trailing edge inside faces.
  void add_tails(const ChordEdge& trailing) { add_inside(trailing, &ChordStation::trailing, &ChordStation::tail_face); }

  /// All over the base, by the chords of one of its long edges; `strip` is measured from the other one, perhaps.
  void add_base(const Strip& strip, const ChordEdge& trailing) {
    const double way = ArcTable(*model_.curve(trailing.edge)).length();
    const bool is_turned = strip.is_opposed && strip.edges[1] == trailing.edge;
    const std::vector<VertexId>& vertices = model_.tables().edge_vertices;
    const bool is_ring = vertices[2 * strip.edges[0]] == vertices[2 * strip.edges[0] + 1];
    walk(way, pack_cause(CauseKind::kFace, strip.face), ends_of(trailing), [&](double share) {
      const Strip::Station station = strip.at(is_turned ? 1 - share : share);
      const double chord = is_ring ? chord_beside(trailing, station.middle()) : trailing.chord_at(share);
      const double edge = length_of(chord);
      const double width = (trailing.is_half ? 2 : 1) * station.width();
      return Place{station.middle(), std::max(length_across(sizes_.base_cells, width, edge), floor_of(chord)),
                   0.5 * station.across};
    });
  }

  void add_rim(const EdgeWithChord& rim, const LengthSpec& size) {
    const auto curve = model_.curve(rim.edge);
    const ArcTable arc(*curve);
    const double length =
        std::max(LocalLengths(wing_, sizes_).resolved(size, "--end-size", rim.chord), floor_of(rim.chord));
    walk(arc.length(), pack_cause(CauseKind::kEdge, rim.edge), {}, [&](double share) {
      return Place{curve->point(arc.parameter_at(share)), length};
    });
  }

  const std::optional<RaisedLength>& most_raised() const { return most_raised_; }

 private:
  struct Place {
    Vec3 x;
    double length;     // of the field there
    Vec3 across = {};  // half the width over which it holds
    double asked = 0;  // of the triangles; 0: as that of the field
  };

  double floor_of(double chord) const { return LocalLengths(wing_, sizes_).floor(chord); }
  double length_of(double chord) const { return std::max(LocalLengths(wing_, sizes_).asked(chord), floor_of(chord)); }

  /// Beside a place near the edge: both edges of a ring may begin anywhere.
  static double chord_beside(const ChordEdge& trailing, Vec3 x) {
    double chord = 0, nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < trailing.stations.size(); ++i) {
      const ChordStation &a = trailing.stations[i - 1], &b = trailing.stations[i];
      const Vec3 way = b.trailing - a.trailing;
      const double share = norm2(way) > 0 ? std::clamp(dot(x - a.trailing, way) / norm2(way), 0.0, 1.0) : 0;
      const double d = distance(x, a.trailing + share * way);
      if (d >= nearest) continue;
      nearest = d;
      chord = a.chord + share * (b.chord - a.chord);
    }
    return chord;
  }

  /// Of the two ends of a way: length along over that across, at most; 0: it goes on.
  using Ends = std::array<double, 2>;

  VertexId vertex(const ChordEdge& trailing, std::size_t k) const {
    return model_.tables().edge_vertices[2 * static_cast<std::size_t>(trailing.edge) + k];
  }

  /// Where no other trailing edge of the wing goes on: at tip or root.
  Ends ends_of(const ChordEdge& trailing) const {
    if (trailing.edge == kNone) return {};
    const auto most_at = [&](std::size_t k) {
      std::ptrdiff_t n = 0;
      for (const ChordEdge& other : wing_.trailing)
        for (const std::size_t side : {0, 1}) n += other.edge != kNone && vertex(other, side) == vertex(trailing, k);
      return n != 1 ? 0 : end_aspect(model_, sizes_.is_material_ahead, trailing, k);
    };
    return {most_at(0), most_at(1)};
  }

  /// Of noses or tails in a row that come to a tip, or to a root so oblique that their face goes on without them.
  Ends ends_of_run(std::span<const ChordStation* const> run, const ChordEdge& trailing, Vec3 ChordStation::*place,
                   FaceId ChordStation::*face) const {
    const Ends of_edge = ends_of(trailing);
    if (of_edge == Ends{}) return {};
    const double way = ArcTable(*model_.curve(trailing.edge)).length();
    const auto most_at = [&](std::size_t k, const ChordStation& s, double share) {
      if (!(of_edge[k] > 0 && share * way <= kAtEnd * s.chord)) return 0.0;
      const double reach = kBefore * kNose * length_of(s.chord);
      if (is_tip(model_, sizes_.is_material_ahead, trailing, k)) return kEndAspect;
      return ends_inside(model_, s.*face, s.*place, reach) ? kEndAspect : 0;
    };
    return {most_at(0, *run.front(), run.front()->share), most_at(1, *run.back(), 1 - run.back()->share)};
  }

  /// At tip and root lengths along are near those across: triangles beyond are as short.
  StretchLimits stretch_at(double share, Ends most) const {
    StretchLimits limits = sizes_.stretch;
    for (const std::size_t k : {0, 1})
      if (most[k] > 0 && (k == 0 ? share <= 0 : share >= 1)) limits.max_aspect = std::min(limits.max_aspect, most[k]);
    return limits;
  }

  /// Boxes one length apart; `place_at` takes a share of the way.
  template <class PlaceAt>
  void walk(double way, std::int32_t cause, Ends most, const PlaceAt& place_at) {
    const double least = sizes_.given.of(cause);
    double share = 0;
    for (int n = 0; n < kMaxBoxes; ++n) {
      Place place = place_at(std::min(share, 1.0));
      if (place.length < least) {
        note_raised({std::max(place.length, place.asked), least}, most_raised_);
        place.length = least;
      }
      const double step = std::clamp(place.length / way, 1.0 / kMaxBoxes, 2.0);  // noses at one place: no way
      boxes_.push_back({place.x,
                        static_cast<float>(0.5 * sizes_.cell_per_length * place.length),
                        static_cast<float>(place.length),
                        cause,
                        {},
                        stretch_along([&](double at) { return place_at(at).x; }, std::min(share, 1.0), way,
                                      place.length, stretch_at(share, most)),
                        reach_of(0.5 * (place_at(std::min(share + 0.5 * step, 1.0)).x -
                                        place_at(std::clamp(share - 0.5 * step, 0.0, 1.0)).x),
                                 place.across)});
      if (share >= 1) return;
      share += step;
    }
  }

  /// At a nose or an edge. The first triangles beside it have the length asked for: theirs grows along them.
  Place reduced(double share, Vec3 x, double chord) const {
    const double asked = length_of(chord);
    return {x, std::max(share * asked, std::min(asked, floor_of(chord))), {}, asked};
  }

  void add_inside(const ChordEdge& trailing, Vec3 ChordStation::*place, FaceId ChordStation::*face) {
    std::vector<const ChordStation*> run;
    int n_missed = 0;
    for (const ChordStation& s : trailing.stations) {
      if (!s.is_measured) {
        if (++n_missed > kGap) end_run(run, trailing, place, face);
        continue;
      }
      n_missed = 0;
      run.push_back(&s);
    }
    end_run(run, trailing, place, face);
  }

  /// Along the noses or tails of stations in a row.
  void end_run(std::vector<const ChordStation*>& run, const ChordEdge& trailing, Vec3 ChordStation::*place,
               FaceId ChordStation::*face) {
    if (run.empty()) return;
    const Ends most = ends_of_run(run, trailing, place, face);
    const bool is_tail = face == &ChordStation::tail_face;
    std::vector<Vec3> x;
    for (const ChordStation* s : run) x.push_back(s->*place);
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const ChordStation &a = *run[i], &b = *run[i + 1];
      const bool is_stretched = sizes_.stretch.max_aspect > 1, is_apart = is_stretched && jumps(a, b);
      const SmoothPiece piece(x, i);
      std::optional<CurvePiece> edge;  // where noses turn so far, or run along the chord
      if (is_stretched && !is_tail && (is_apart || piece.has_kink())) edge = rims_.between(a, b);
      if (is_apart && !edge) continue;
      const double bent_a = is_tail ? bent_at_tail(a) : kFlat, bent_b = is_tail ? bent_at_tail(b) : kFlat;
      const double way = edge ? edge->length() : distance(x[i], x[i + 1]);
      const Ends ends{i == 0 ? most[0] : 0, i + 2 == run.size() ? most[1] : 0};
      walk(way, pack_cause(CauseKind::kFace, a.*face), ends, [&](double share) {
        const double chord = a.chord + share * (b.chord - a.chord), bent = bent_a + share * (bent_b - bent_a);
        Place own = reduced(kNose, edge ? edge->at(share) : piece.at(share), chord);
        own.length = std::min(own.length, std::max(bent * chord, floor_of(chord)));
        return own;
      });
    }
    run.clear();
  }

  /// What the curvature across a round trailing edge asks for, over the chord, as the samples of its face have it:
  /// these are too far apart along it.
  double bent_at_tail(const ChordStation& s) const {
    const auto surface = model_.surface(s.tail_face);
    const double k = std::abs(principal_curvature(surface->evaluate2(closest_point(*surface, s.trailing).uv)).k1);
    const double least = kBentTail * std::min(length_of(s.chord) / s.chord, kDefaultTail);
    return k > 0 ? std::max(sizes_.stretch.alpha / (k * s.chord), least) : kFlat;
  }

  const Model& model_;
  const LiftingSurface& wing_;
  const WingSizes& sizes_;
  std::vector<RasterBox>& boxes_;
  RimEdges rims_;
  std::optional<RaisedLength> most_raised_;  // by a rule
};

}  // namespace

double length_along(const LiftingSurface& wing, const WingSizes& sizes, const ChordEdge& edge, double chord) {
  const LocalLengths lengths(wing, sizes);
  const double given = edge.is_inside ? 0 : sizes.given.of(pack_cause(CauseKind::kEdge, edge.edge));
  return std::max({lengths.asked(chord), lengths.floor(chord), given});
}

void note_raised(const RaisedLength& own, std::optional<RaisedLength>& most) {
  if (own.floor > own.asked && (!most || own.floor * most->asked > most->floor * own.asked)) most = own;
}

std::optional<RaisedLength> raster_wing(const Model& model, const LiftingSurface& wing, const WingSizes& sizes,
                                        std::span<const Strip> strips, std::span<const std::uint8_t> is_left_out,
                                        std::vector<RasterBox>& boxes) {
  const auto is_ruled = [&](EdgeId e) { return is_left_out[e] != 0; };
  const bool has_noses = std::none_of(wing.leading.begin(), wing.leading.end(), is_ruled);
  WingRaster raster(model, wing, sizes, boxes);
  for (const ChordEdge& leading : wing.declared_leading)
    if (!is_ruled(leading.edge)) raster.add_edge(leading);
  for (const ChordEdge& trailing : wing.trailing) {
    if (trailing.is_inside)
      raster.add_tails(trailing);
    else if (!is_ruled(trailing.edge))
      raster.add_edge(trailing);
    const auto strip = std::find_if(strips.begin(), strips.end(), [&](const Strip& s) {
      return s.face == trailing.base && (!s.cut_side || s.edges[0] == trailing.edge);
    });
    const bool has_base = trailing.base != kNone && strip != strips.end();
    const bool is_second =
        has_base && !trailing.is_half && (strip->cut_side ? *strip->cut_side == 1 : strip->edges[1] == trailing.edge);
    if (has_noses && (!is_second || has_other_noses(wing, trailing))) raster.add_noses(trailing);
    if (has_base && !is_ruled(strip->edges[0]) && !is_ruled(strip->edges[1])) raster.add_base(*strip, trailing);
  }
  for (const ChordEdge& front : wing.front)
    if (has_noses) raster.add_noses(front);
  if (sizes.end_size) {
    const std::vector<EdgeWithChord> rims = find_end_rims(model, wing);
    for (const EdgeWithChord& rim : rims)
      if (!is_ruled(rim.edge)) raster.add_rim(rim, *sizes.end_size);
    if (rims.empty() && !wing.trailing.empty())
      log_warning("--end-size: no edge runs around the tip or root of the lifting surface at edge " +
                  std::to_string(wing.trailing.front().edge + 1));
  }
  return raster.most_raised();
}

std::optional<RaisedLength> most_raised(const LiftingSurface& wing, const WingSizes& sizes) {
  const LocalLengths lengths(wing, sizes);
  std::optional<RaisedLength> most;
  for (const ChordEdge& trailing : wing.trailing)
    for (const ChordStation& s : trailing.stations) {
      if (!s.is_measured) continue;
      note_raised({lengths.asked(s.chord), lengths.floor(s.chord)}, most);
    }
  return most;
}

WingRecord record_wing(const LiftingSurface& wing, const WingSizes& sizes, std::span<const std::uint8_t> is_left_out,
                       std::span<const Strip> strips) {
  WingRecord record;
  record.span = wing.span;
  record.has_noses = wing.has_noses;
  record.covered = wing.covered();
  record.faces = wing.faces;
  for (const ChordEdge& edge : wing.edges()) {
    record.edges.push_back(edge.edge);
    if (edge.base != kNone) record.bases.push_back(edge.base);
    for (const Strip& strip : strips)
      if (edge.base != kNone && strip.face == edge.base)
        record.bases.insert(record.bases.end(), strip.others.begin(), strip.others.end());
    if (edge.base != kNone && !is_left_out[edge.edge]) record.base_cells = (edge.is_half ? 0.5 : 1) * sizes.base_cells;
    for (const ChordStation& s : edge.stations) {
      if (wing.has_noses && !s.is_measured) continue;
      WingRecord::Station own{s.nose, s.trailing, s.chord};
      if (edge.is_inside || !is_left_out[edge.edge]) own.asked = length_along(wing, sizes, edge, s.chord);
      record.stations.push_back(own);
    }
  }
  for (const ChordEdge& front : wing.front)
    for (const ChordStation& s : front.stations) {
      if (!s.is_measured) continue;
      record.stations.push_back({s.nose, s.nose, s.chord, length_along(wing, sizes, front, s.chord)});
      record.faces.push_back(s.nose_face);
    }
  sort_once(record.faces);
  sort_once(record.bases);
  std::erase_if(record.faces, [&](FaceId f) { return std::ranges::binary_search(record.bases, f); });
  return record;
}

ChordLimit::ChordLimit(std::span<const ChordLine> lines, std::int32_t wing, int chord_cells)
    : chord_cells_(chord_cells) {
  Box3 box;
  for (const ChordLine& line : lines) {
    if (line.wing != wing) continue;
    lines_.push_back(
        {0.5 * (line.nose + line.trailing), 0.5 * distance(line.nose, line.trailing), 0, lines_.size(), line});
    box.add(lines_.back().center);
    least_ = std::min(least_, line.chord / chord_cells_);
    largest_radius_ = std::max(largest_radius_, lines_.back().radius);
  }
  if (lines_.empty()) return;
  const Vec3 side = box.hi - box.lo, unit = side.x >= side.y && side.x >= side.z ? Vec3{1, 0, 0}
                                            : side.y >= side.z                   ? Vec3{0, 1, 0}
                                                                                 : Vec3{0, 0, 1};
  axis_ = unit;
  for (Line& line : lines_) line.place = dot(line.center, axis_);
  std::stable_sort(lines_.begin(), lines_.end(), [](const Line& a, const Line& b) { return a.place < b.place; });
}

ChordLimit::Answer ChordLimit::answer(Vec3 x) const {
  constexpr double kAbove = 1 + 1e-12;  // rounding shall leave no line out
  if (lines_.empty()) return {};
  const double place = dot(x, axis_);
  const Line* best = &lines_[last_];  // of the last place, which is near mostly
  double nearest = segment_distance(x, best->line.nose, best->line.trailing);
  const auto ask = [&](const Line& line) {  // false: those further on along the axis are further away
    const double reach = kAbove * (nearest + line.radius);
    if (norm2(x - line.center) > reach * reach)
      return std::abs(line.place - place) <= kAbove * (nearest + largest_radius_);
    const double d = segment_distance(x, line.line.nose, line.line.trailing);
    if (d < nearest || (d == nearest && line.rank < best->rank)) {
      nearest = d;
      best = &line;
    }
    return true;
  };
  const auto from = std::lower_bound(lines_.begin(), lines_.end(), place,
                                     [](const Line& line, double at) { return line.place < at; });
  for (auto line = from; line != lines_.end() && ask(*line); ++line) {
  }
  for (auto line = from; line != lines_.begin() && ask(*std::prev(line)); --line) {
  }
  last_ = static_cast<std::size_t>(best - lines_.data());
  return {best->line.chord / chord_cells_, normalized(best->line.trailing - best->line.nose)};
}

}  // namespace st
