#include "features/base_strips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "base/box_tree.h"
#include "base/disjoint_sets.h"
#include "features/cut_bases.h"
#include "features/smooth_edges.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

constexpr double kSmooth = radians(20);  // between the normals of strips that are one
constexpr double kNarrow = 0.05;         // of the length: strips beside each other, altogether
constexpr double kAlike = 2;             // between the widths of strips end to end
constexpr double kStraight = 0.7;        // extent of a row over its length: rims turn around their plate

double width_of(const Strip& strip) { return strip.stations[strip.stations.size() / 2].width(); }

class BaseStripFinder {
 public:
  BaseStripFinder(const Model& model, std::span<const Strip> strips)
      : model_(model),
        t_(model.tables()),
        strips_(strips),
        faces_at_(t_),
        is_smooth_(static_cast<std::size_t>(t_.n_edges())) {
    for (std::size_t i = 0; i < strips.size(); ++i) index_[strips[i].face] = i;
  }

  std::vector<Strip> run() {
    std::vector<Strip> all = united();
    add_cut_bases(all);
    add_short_pieces(all);
    measure_rows(all);
    for (Strip& ring : find_rings(model_)) all.push_back(std::move(ring));
    std::ranges::stable_sort(all, {}, &Strip::face);
    return all;
  }

 private:
  /// The other strip of which an edge is a long one; nothing where the surface has a corner there.
  const Strip* beyond(const Strip& strip, EdgeId e) const {
    for (const FaceId f : faces_at_[e]) {
      const auto own = index_.find(f);
      if (f == strip.face || own == index_.end()) continue;
      const Strip& other = strips_[own->second];
      if ((other.edges[0] == e || other.edges[1] == e) && is_smooth(e)) return &other;
    }
    return nullptr;
  }

  /// Asked several times of most edges.
  bool is_smooth(EdgeId e) const {
    std::optional<bool>& known = is_smooth_[e];
    if (!known) known = is_smooth_half_way(model_, e, faces_at_[e], kSmooth);
    return *known;
  }

  void add_cut_bases(std::vector<Strip>& all) const {
    std::vector<std::uint8_t> is_strip(static_cast<std::size_t>(t_.n_faces()), 0);
    for (const Strip& strip : all) {
      is_strip[strip.face] = 1;
      for (const FaceId f : strip.others) is_strip[f] = 1;
    }
    for (Strip& cut : find_cut_bases(model_))
      if (!is_strip[cut.face]) all.push_back(std::move(cut));
  }

  std::vector<Strip> united() const {
    std::vector<std::uint8_t> is_done(strips_.size(), 0);
    std::vector<Strip> all;
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      if (is_done[i]) continue;
      std::array<EdgeId, 2> outer = {strips_[i].edges[0], strips_[i].edges[1]};
      std::vector<const Strip*> own = {&strips_[i]};
      for (EdgeId& e : outer) go_on(e, is_done, own);
      double area = 0;
      for (const Strip* s : own) area += t_.face_area[s->face];
      const double length = strips_[i].length;
      if (own.size() == 1 || area > kNarrow * length * length || outer[0] == outer[1]) {
        all.push_back(strips_[i]);
        continue;
      }
      all.push_back(measured_strip(model_, strips_[i].face, outer[0], outer[1]));
      for (const Strip* s : own) {
        is_done[index_.at(s->face)] = 1;
        if (s != own.front()) all.back().others.push_back(s->face);
      }
    }
    return all;
  }

  /// A face of four edges, seen from one of them.
  struct Quad {
    FaceId face;
    EdgeId beyond;  // across from that edge
    std::array<EdgeId, 2> sides;
  };

  /// Beyond an edge of a face, whether there is a corner or not; nothing where it is much wider or narrower on.
  std::optional<Quad> quad_beyond(FaceId from, EdgeId e) const {
    if (faces_at_[e].size() != 2 || t_.edge_is_degenerate[e]) return std::nullopt;
    const FaceId f = faces_at_.beyond(e, from);
    const auto loop = t_.edges_of(f);
    if (f == from || t_.loops(f).size() != 1 || loop.size() != 4) return std::nullopt;
    const auto at = static_cast<std::size_t>(std::ranges::find(loop, e) - loop.begin());
    const Quad quad{f, loop[(at + 2) % 4], {loop[(at + 1) % 4], loop[(at + 3) % 4]}};
    const auto is_side = [&](EdgeId side) {
      return !t_.edge_is_degenerate[side] && faces_at_[side].size() == 2 &&
             t_.edge_vertices[2 * side] != t_.edge_vertices[2 * side + 1];
    };
    const double a = t_.edge_length[e], b = t_.edge_length[quad.beyond];
    return std::ranges::all_of(quad.sides, is_side) && quad.sides[0] != quad.sides[1] && a <= kAlike * b &&
                   b <= kAlike * a
               ? std::optional(quad)
               : std::nullopt;
  }

  /// Between two strips of a row may be pieces that are too short for strips, or strips across it.
  void add_short_pieces(std::vector<Strip>& all) const {
    constexpr std::size_t kMost = 16;  // one after another
    std::map<FaceId, std::array<EdgeId, 2>> sides;
    for (const Strip& s : all)
      if (s.others.empty() && !s.cut_side) sides[s.face] = {s.edges[0], s.edges[1]};
    const auto goes_on = [&](const Quad& quad) {
      const auto own = sides.find(quad.face);
      return own != sides.end() && std::ranges::count(own->second, quad.beyond) == 0;
    };
    std::map<FaceId, Quad> found;
    for (const auto& [face, own] : sides)
      for (const EdgeId end : t_.edges_of(face)) {
        if (std::ranges::count(own, end) > 0) continue;
        std::vector<Quad> pieces;
        std::vector<EdgeId> crossed = {end};
        std::optional<Quad> next = quad_beyond(face, end);
        for (; next && !goes_on(*next) && pieces.size() < kMost; next = quad_beyond(next->face, next->beyond)) {
          pieces.push_back(*next);
          crossed.push_back(next->beyond);
        }
        if (!pieces.empty() && next && goes_on(*next) &&  // the costly question last
            std::ranges::all_of(crossed, [this](EdgeId e) { return is_smooth(e); }))
          for (const Quad& piece : pieces) found.emplace(piece.face, piece);
      }
    std::erase_if(all, [&](const Strip& s) { return s.others.empty() && !s.cut_side && found.contains(s.face); });
    for (const auto& [face, piece] : found) all.push_back(measured_strip(model_, face, piece.sides[0], piece.sides[1]));
  }

  /// From strip to strip, as far as it is smooth and they are none of another one; `e` becomes the edge at the end.
  void go_on(EdgeId& e, std::span<const std::uint8_t> is_done, std::vector<const Strip*>& own) const {
    constexpr std::size_t kMost = 16;
    const Strip* from = own.front();
    while (own.size() < kMost) {
      const Strip* next = beyond(*from, e);
      if (!next || is_done[index_.at(next->face)] || std::ranges::count(own, next) > 0) return;
      own.push_back(next);
      e = next->edges[0] == e ? next->edges[1] : next->edges[0];
      from = next;
    }
  }

  /// Strips that hang together at their ends; those of one base in pieces are one.
  void measure_rows(std::vector<Strip>& all) const {
    DisjointSets rows(static_cast<std::int64_t>(all.size()));
    const auto root = [&](std::size_t i) { return static_cast<std::size_t>(rows.find(static_cast<std::int32_t>(i))); };
    std::map<EdgeId, std::size_t> at_end, at_face, is_side;
    for (const Strip& s : all)
      for (const EdgeId e : s.edges) is_side[e] = 1;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].others.empty()) continue;
      const auto [first, is_first] = at_face.emplace(all[i].face, i);
      if (!is_first) rows.join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(first->second));
      for (const EdgeId e : t_.edges_of(all[i].face)) {
        if (is_side.contains(e)) continue;
        const auto [known, is_new] = at_end.emplace(e, i);
        const double a = width_of(all[i]), b = width_of(all[known->second]);
        if (!is_new && a <= kAlike * b && b <= kAlike * a)
          rows.join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(known->second));
      }
    }
    std::vector<double> length(all.size(), 0);
    std::vector<Box3> box(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].cut_side != 1) length[root(i)] += all[i].length;
      box[root(i)].add(all[i].stations.front().x);
      box[root(i)].add(all[i].stations.back().x);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      if (box[root(i)].diagonal() >= kStraight * length[root(i)]) all[i].row = std::max(all[i].row, length[root(i)]);
  }

  const Model& model_;
  const ModelTables& t_;
  std::span<const Strip> strips_;
  std::map<FaceId, std::size_t> index_;
  EdgeFaces faces_at_;
  mutable std::vector<std::optional<bool>> is_smooth_;  // [n_edges] once asked
};

}  // namespace

std::vector<Strip> find_base_strips(const Model& model, std::span<const Strip> strips) {
  return BaseStripFinder(model, strips).run();
}

}  // namespace st
