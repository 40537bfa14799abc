#include "features/cut_bases.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "features/arc_table.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr double kNarrow = 0.05;         // of its length: wider faces are no bases
constexpr double kCorner = radians(45);  // between edges, at the ends of a side
constexpr double kEnds = 0.1;            // of the loop: ends together at most
constexpr double kAlike = 0.8;           // length of the shorter side over that of the longer one, at least
constexpr std::size_t kMostEdges = 400;  // of a face
constexpr int kStations = 16;            // intervals of an edge

/// An edge of the loop in its direction.
struct Piece {
  EdgeId edge = kNone;
  Vec3 begin, end;  // directions of the loop there, unit
};

using Side = std::vector<Piece>;

class CutBaseFinder {
 public:
  explicit CutBaseFinder(const Model& model) : model_(model), t_(model.tables()) {
    uses_.assign(static_cast<std::size_t>(t_.n_edges()), 0);
    for (const EdgeId e : t_.coedge_edge) ++uses_[e];
  }

  std::vector<Strip> run() const {
    std::vector<Strip> found;
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      const std::vector<Side> sides = long_sides(f);
      if (sides.size() != 2 || (sides[0].size() == 1 && sides[1].size() == 1)) continue;
      for (const int k : {0, 1})
        for (const Piece& piece : sides[static_cast<std::size_t>(k)])
          found.push_back(strip_at(f, piece.edge, k, sides));
    }
    return found;
  }

 private:
  double length_of(const Side& side) const {
    double length = 0;
    for (const Piece& piece : side) length += t_.edge_length[piece.edge];
    return length;
  }

  /// Empty where the face is none.
  std::vector<Side> long_sides(FaceId f) const {
    if (t_.loops(f).size() != 1) return {};
    const auto edges = t_.edges_of(f);
    if (edges.size() < 3 || edges.size() > kMostEdges) return {};
    double around = 0;
    for (const EdgeId e : edges) {
      if (t_.edge_is_degenerate[e] || uses_[e] != 2 || t_.edge_vertices[2 * e] == t_.edge_vertices[2 * e + 1])
        return {};
      around += t_.edge_length[e];
    }
    if (t_.face_area[f] > kNarrow * 0.25 * around * around) return {};
    std::vector<Side> sides = sides_of(f);
    std::ranges::stable_sort(sides, [&](const Side& a, const Side& b) { return length_of(a) > length_of(b); });
    if (sides.size() < 2) return {};
    sides.resize(2);
    const double a = length_of(sides[0]), b = length_of(sides[1]);
    return b >= kAlike * a && around - a - b <= kEnds * around ? sides : std::vector<Side>();
  }

  /// Pieces of the loop between corners.
  std::vector<Side> sides_of(FaceId f) const {
    std::vector<Piece> loop;
    for (const CoedgeId c : t_.coedges(f)) {
      const auto curve = model_.curve(t_.coedge_edge[c]);
      const Vec3 from = normalized(curve->evaluate(curve->t_min()).d1),
                 to = normalized(curve->evaluate(curve->t_max()).d1);
      loop.push_back(t_.coedge_is_reversed[c] ? Piece{t_.coedge_edge[c], -to, -from}
                                              : Piece{t_.coedge_edge[c], from, to});
    }
    const auto is_corner = [&](std::size_t i) {  // before it
      return angle_between(loop[(i + loop.size() - 1) % loop.size()].end, loop[i].begin) > kCorner;
    };
    std::size_t first = 0;
    while (first < loop.size() && !is_corner(first)) ++first;
    if (first == loop.size()) return {};
    std::vector<Side> sides;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t at = (first + i) % loop.size();
      if (is_corner(at)) sides.emplace_back();
      sides.back().push_back(loop[at]);
    }
    return sides;
  }

  Strip strip_at(FaceId f, EdgeId e, int own_side, const std::vector<Side>& sides) const {
    const Side& other = sides[static_cast<std::size_t>(1 - own_side)];
    Strip strip;
    strip.face = f;
    strip.cut_side = own_side;
    strip.length = t_.edge_length[e];
    strip.row = length_of(sides[static_cast<std::size_t>(own_side)]);
    const auto curve = model_.curve(e);
    const ArcTable arc(*curve);
    for (int i = 0; i <= kStations; ++i) {
      const Vec3 x = curve->point(arc.parameter_at(static_cast<double>(i) / kStations));
      const auto [edge, foot] = nearest_on(other, x);
      strip.stations.push_back({x, foot - x});
      if (i != kStations / 2) continue;
      strip.edges[0] = e;
      strip.edges[1] = edge;
    }
    return strip;
  }

  std::pair<EdgeId, Vec3> nearest_on(const Side& side, Vec3 x) const {
    std::pair<EdgeId, Vec3> best{kNone, x};
    double nearest = std::numeric_limits<double>::infinity();
    for (const Piece& piece : side) {
      const Vec3 foot = closest_point(*model_.curve(piece.edge), x).x;
      if (const double d = distance(x, foot); d < nearest) nearest = d, best = {piece.edge, foot};
    }
    return best;
  }

  const Model& model_;
  const ModelTables& t_;
  std::vector<int> uses_;  // [n_edges] coedges of any face
};

}  // namespace

std::vector<Strip> find_cut_bases(const Model& model) { return CutBaseFinder(model).run(); }

}  // namespace st
