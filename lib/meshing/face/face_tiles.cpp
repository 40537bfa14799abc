#include "meshing/face/face_tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>

#include "base/axis.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "meshing/face/coarse_face.h"

namespace st {
namespace {

constexpr double kCoarsePerTile = 24;  // triangles of the coarse mesh for each tile, at least
constexpr int kSamplesPerNode = 4;     // of a cut, to space its nodes
constexpr int kMaxSamples = 1 << 14;
constexpr int kProbes = 16;  // along u and v: where sizes are asked whether they are stretched

using Corners = std::pair<std::int32_t, std::int32_t>;

/// The triangles of a coarse mesh in parts of about equal weight.
class CoarseParts {
 public:
  /// A side of a coarse triangle, from corner a to corner b.
  struct Side {
    std::int32_t a, b, triangle;
    auto operator<=>(const Side&) const = default;
  };

  /// As many parts as tiles of so many triangles take. The references outlive it.
  CoarseParts(const CoarseFace& coarse, const SizeField& field, double tile_triangles) : coarse_(coarse) {
    find_sides();
    weigh(field);
    part_.assign(static_cast<std::size_t>(coarse_.n_triangles()), 0);
    std::vector<std::int32_t> all(part_.size());
    std::iota(all.begin(), all.end(), 0);
    const double total = std::accumulate(weight_.begin(), weight_.end(), 0.0);
    n_parts_ = static_cast<std::int32_t>(std::ceil(total / tile_triangles));
    if (n_parts_ < 2) return;
    bisect(all, 0, n_parts_);
    join_poles();
    join_spikes();
  }

  std::int32_t n_parts() const { return n_parts_; }
  std::int32_t part(std::int32_t triangle) const { return part_[triangle]; }
  /// kNone: there is no such pole.
  std::int32_t part_of_pole(std::int32_t id) const {
    const auto it = part_of_pole_.find(id);
    return it == part_of_pole_.end() ? kNone : it->second;
  }
  /// Triangles that are expected in a coarse one.
  double weight(std::int32_t triangle) const { return weight_[triangle]; }
  const std::vector<Side>& sides() const { return sides_; }
  /// The triangle that has the side from a to b.
  std::int32_t left_of(std::int32_t a, std::int32_t b) const {
    const auto it = std::lower_bound(sides_.begin(), sides_.end(), Side{a, b, 0});
    return it == sides_.end() || it->a != a || it->b != b ? kNone : it->triangle;
  }

 private:
  void find_sides() {
    for (std::int32_t t = 0; t < coarse_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) sides_.push_back({coarse_.corner(t, k), coarse_.corner(t, (k + 1) % 3), t});
    std::sort(sides_.begin(), sides_.end());
    beyond_.assign(coarse_.corners().size(), kNone);
    for (std::int32_t t = 0; t < coarse_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) beyond_[3 * t + k] = left_of(coarse_.corner(t, (k + 1) % 3), coarse_.corner(t, k));
  }

  void weigh(const SizeField& field) {
    int hint = 0;
    for (std::int32_t t = 0; t < coarse_.n_triangles(); ++t) {
      const FaceNode &a = coarse_.node(coarse_.corner(t, 0)), &b = coarse_.node(coarse_.corner(t, 1)),
                     &c = coarse_.node(coarse_.corner(t, 2));
      middle_.push_back((a.x + b.x + c.x) / 3);
      const double h = field.size(middle_.back(), hint);
      weight_.push_back(kTrianglesPerWeight * 0.5 * norm(cross(b.x - a.x, c.x - a.x)) / (h * h));
    }
  }

  /// Parts [first, first + n) of about equal weight, across the longest extent.
  void bisect(std::vector<std::int32_t>& triangles, std::int32_t first, std::int32_t n) {
    if (n == 1 || triangles.size() < 2) {
      for (const std::int32_t t : triangles) part_[t] = first;
      return;
    }
    Box3 box;
    double total = 0;
    for (const std::int32_t t : triangles) {
      box.add(middle_[t]);
      total += weight_[t];
    }
    const int axis = longest_axis(box);
    std::vector<std::pair<double, std::int32_t>> order;
    for (const std::int32_t t : triangles) order.push_back({component(middle_[t], axis), t});
    std::sort(order.begin(), order.end());
    std::transform(order.begin(), order.end(), triangles.begin(), [](const auto& place) { return place.second; });
    const std::int32_t n_low = n / 2;
    const double wanted = total * n_low / n;
    double sum = 0;
    std::size_t end = 0;
    while (end + 1 < triangles.size() && (end == 0 || sum + 0.5 * weight_[triangles[end]] < wanted))
      sum += weight_[triangles[end++]];
    std::vector<std::int32_t> high(triangles.begin() + static_cast<std::ptrdiff_t>(end), triangles.end());
    triangles.resize(end);
    bisect(triangles, first, n_low);
    bisect(high, first + n_low, n - n_low);
  }

  /// All triangles about a pole belong to one part: that of the first.
  void join_poles() {
    for (std::int32_t t = 0; t < coarse_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        const FaceNode& n = coarse_.node(coarse_.corner(t, k));
        if (n.is_pole) part_[t] = part_of_pole_.try_emplace(n.id, part_[t]).first->second;
      }
  }

  bool touches_pole(std::int32_t t) const {
    return coarse_.node(coarse_.corner(t, 0)).is_pole || coarse_.node(coarse_.corner(t, 1)).is_pole ||
           coarse_.node(coarse_.corner(t, 2)).is_pole;
  }

  /// A triangle with two neighbours in one other part joins them.
  void join_spikes() {
    for (int pass = 0; pass < 2; ++pass)
      for (std::int32_t t = 0; t < coarse_.n_triangles(); ++t) {
        if (touches_pole(t)) continue;
        std::array<std::int32_t, 3> beyond;
        for (int k = 0; k < 3; ++k) {
          const std::int32_t o = beyond_[3 * t + k];
          beyond[k] = o == kNone ? kNone : part_[o];
        }
        for (int k = 0; k < 3; ++k)
          if (beyond[k] != kNone && beyond[k] == beyond[(k + 1) % 3]) part_[t] = beyond[k];
      }
  }

  const CoarseFace& coarse_;
  std::vector<Side> sides_;           // sorted
  std::vector<std::int32_t> beyond_;  // [3*n_coarse] triangle across each side, kNone: none
  std::vector<double> weight_;        // of the coarse triangles: triangles expected in each
  std::vector<Vec3> middle_;
  std::vector<std::int32_t> part_;
  std::int32_t n_parts_ = 0;
  std::map<std::int32_t, std::int32_t> part_of_pole_;  // by id
};

class TileCutter {
 public:
  TileCutter(const Surface& surface, const SurfaceMaker& make_surface, const FaceBoundary& boundary,
             std::span<const BoundaryPlace> places, const SizeField& field, double tile_triangles)
      : surface_(surface),
        make_surface_(make_surface),
        boundary_(boundary),
        field_(field),
        tile_triangles_(tile_triangles),
        n_boundary_(static_cast<std::int32_t>(boundary.nodes.size())),
        coarse_(surface, boundary, places, field) {}

  TileCut run() {
    if (has_long_edges(surface_, boundary_, field_)) return {};
    const auto widest = static_cast<unsigned>(std::max(1.0, std::sqrt(tile_triangles_ / kCoarsePerTile)));
    for (unsigned step = std::bit_floor(widest); step >= 1; step /= 2)
      if (coarse_.make(static_cast<std::int32_t>(step))) return cut();
    return {};
  }

 private:
  TileCut cut() {
    const CoarseParts parts(coarse_, field_, tile_triangles_);
    if (parts.n_parts() < 2) return {};
    result_.tiles.resize(static_cast<std::size_t>(parts.n_parts()));
    for (std::int32_t t = 0; t < coarse_.n_triangles(); ++t) result_.tiles[parts.part(t)].weight += parts.weight(t);
    if (!add_boundary(parts)) return {};
    add_cuts(parts);
    std::erase_if(result_.tiles, [](const Tile& tile) { return tile.segments.empty(); });
    return std::move(result_);
  }

  /// The corner that stands for a coarse boundary node in the triangles: itself, or its twin nearby.
  std::int32_t standing_for(std::int32_t c, const std::vector<std::uint8_t>& is_used) const {
    if (is_used[c]) return c;
    std::int32_t nearest = kNone;
    for (std::int32_t other = 0; other < coarse_.n_on_boundary(); ++other) {
      if (!is_used[other] || coarse_.node(other).id != coarse_.node(c).id) continue;
      if (nearest == kNone ||
          norm(coarse_.node(other).uv - coarse_.node(c).uv) < norm(coarse_.node(nearest).uv - coarse_.node(c).uv))
        nearest = other;
    }
    return nearest;
  }

  /// Each coarse segment of the loops, as the segments of the face, to the tile on its left. False: a segment has none.
  bool add_boundary(const CoarseParts& parts) {
    std::vector<std::uint8_t> is_used(coarse_.n_on_boundary(), 0);
    for (const std::int32_t c : coarse_.corners())
      if (c < coarse_.n_on_boundary()) is_used[c] = 1;
    for (const CoarseFace::Part& loop_part : coarse_.parts()) {
      const std::int32_t a = loop_part.from, b = loop_part.to;
      const std::int32_t from = standing_for(a, is_used), to = standing_for(b, is_used);
      std::int32_t part = kNone;
      if (coarse_.node(a).is_pole && coarse_.node(a).id == coarse_.node(b).id) {
        part = parts.part_of_pole(coarse_.node(a).id);
      } else if (from != kNone && to != kNone && parts.left_of(from, to) != kNone) {
        part = parts.part(parts.left_of(from, to));
        is_boundary_.insert({from, to});
      }
      if (part == kNone) return false;
      coarse_.for_each_segment(loop_part, [&](std::int32_t i, std::int32_t j) {
        result_.tiles[part].segments.push_back({i, j});
      });
    }
    return true;
  }

  /// Edges of the coarse mesh between two parts, cut into segments, to the tiles on both sides.
  void add_cuts(const CoarseParts& parts) {
    constexpr std::size_t kPerPiece = 128;
    std::vector<CoarseParts::Side> cuts;
    for (const CoarseParts::Side& side : parts.sides()) {
      const auto& [a, b, t] = side;
      if (a > b) continue;
      const std::int32_t o = parts.left_of(b, a);
      if (o != kNone && parts.part(t) != parts.part(o) && !is_boundary_.contains({a, b})) cuts.push_back(side);
    }
    std::vector<std::vector<FaceNode>> inside(cuts.size());
    parallel_for(cuts.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      const std::unique_ptr<Surface> own = make_surface_ ? make_surface_() : nullptr;
      for (std::size_t i = begin; i < end; ++i) inside[i] = cut_nodes(own ? *own : surface_, cuts[i].a, cuts[i].b);
    });
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const auto& [a, b, t] = cuts[i];
      std::vector<std::int32_t> chain{end_node(a)};
      for (const FaceNode& n : inside[i]) chain.push_back(add_node(n));
      chain.push_back(end_node(b));
      const std::int32_t o = parts.left_of(b, a);
      for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        result_.tiles[parts.part(t)].segments.push_back({chain[k], chain[k + 1]});
        result_.tiles[parts.part(o)].segments.push_back({chain[k + 1], chain[k]});
      }
    }
  }

  /// The node of the face at a corner of the coarse mesh.
  std::int32_t end_node(std::int32_t c) {
    if (c < coarse_.n_on_boundary()) return coarse_.boundary_node(c);
    const auto [it, is_new] = junction_.try_emplace(c, kNone);
    if (is_new) it->second = add_node(node_at(surface_, coarse_.node(c).uv));
    return it->second;
  }

  FaceNode node_at(const Surface& surface, Vec2 uv) const {
    int hint = 0;
    const Vec3 x = surface.point(uv);
    return {uv, x, field_.size(x, hint), kNone, false};
  }

  std::int32_t add_node(FaceNode n) {
    if (result_.nodes.empty())
      for (const FaceNode& other : boundary_.nodes) last_id_ = std::max(last_id_, other.id);
    n.id = ++last_id_;
    result_.nodes.push_back(n);
    return n_boundary_ + static_cast<std::int32_t>(result_.nodes.size()) - 1;
  }

  /// Nodes between corners a and b, straight in (u,v), spaced by the integral of 1/h.
  std::vector<FaceNode> cut_nodes(const Surface& surface, std::int32_t a, std::int32_t b) const {
    int hint = 0;
    const Vec2 from = coarse_.node(a).uv, to = coarse_.node(b).uv;
    const double h = std::min(field_.size(coarse_.node(a).x, hint), field_.size(coarse_.node(b).x, hint));
    const int n_samples = static_cast<int>(std::clamp(
        kSamplesPerNode * distance(coarse_.node(a).x, coarse_.node(b).x) / h, 16.0, static_cast<double>(kMaxSamples)));
    std::vector<double> sum{0};
    Vec3 last = surface.point(from);
    for (int i = 1; i <= n_samples; ++i) {
      const Vec3 x = surface.point(from + (static_cast<double>(i) / n_samples) * (to - from));
      sum.push_back(sum.back() + distance(last, x) / field_.size(0.5 * (last + x), hint));
      last = x;
    }
    const int n = std::max(1, static_cast<int>(std::lround(sum.back())));
    std::vector<FaceNode> nodes;
    for (int k = 1, i = 0; k < n; ++k) {
      const double wanted = sum.back() * k / n;
      while (sum[static_cast<std::size_t>(i) + 1] < wanted) ++i;
      const double share = (wanted - sum[i]) / (sum[i + 1] - sum[i]);
      nodes.push_back(node_at(surface, from + ((i + share) / n_samples) * (to - from)));
    }
    return nodes;
  }

  const Surface& surface_;
  const SurfaceMaker& make_surface_;
  const FaceBoundary& boundary_;
  const SizeField& field_;
  const double tile_triangles_;
  const std::int32_t n_boundary_;
  CoarseFace coarse_;
  std::set<Corners> is_boundary_;
  std::map<std::int32_t, std::int32_t> junction_;  // cut node at an inner corner of the coarse mesh
  std::int32_t last_id_ = 0;
  TileCut result_;
};

/// Boundary nodes of the face that several tiles have, ascending.
std::vector<std::int32_t> shared_nodes(const std::vector<Tile>& tiles, std::int32_t n_boundary) {
  std::vector<std::int32_t> all, shared;
  for (const Tile& tile : tiles)
    for (const std::int32_t n : nodes_of(tile))
      if (n < n_boundary) all.push_back(n);
  std::sort(all.begin(), all.end());
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] == all[i - 1] && (shared.empty() || shared.back() != all[i])) shared.push_back(all[i]);
  return shared;
}

/// Of the boundary nodes' ids among all of these, ascending.
std::vector<std::int32_t> numbers_of(const FaceBoundary& boundary) {
  std::vector<std::int32_t> ids, numbers;
  for (const FaceNode& n : boundary.nodes) ids.push_back(n.id);
  sort_once(ids);
  for (const FaceNode& n : boundary.nodes)
    numbers.push_back(static_cast<std::int32_t>(std::lower_bound(ids.begin(), ids.end(), n.id) - ids.begin()));
  return numbers;
}

}  // namespace

BoundaryPlace place_on_edge(std::int32_t id, const BoundaryNumbering& numbering) {
  const BoundaryNumbering::Entity own = numbering.entity(id);
  if (own.dim == EntityDim::kVertex) return {};
  return {own.index, std::min(own.index, numbering.edges.n_nodes(own.entity) - 1 - own.index)};
}

std::vector<BoundaryPlace> boundary_places(const FaceBoundary& boundary, const BoundaryNumbering& numbering) {
  std::vector<BoundaryPlace> places;
  for (const FaceNode& n : boundary.nodes) places.push_back(place_on_edge(n.id, numbering));
  return places;
}

bool has_long_edges(const Surface& surface, const FaceBoundary& boundary, const SizeField& field) {
  if (!field.is_stretched()) return false;
  if (field.has_metrics()) return true;  // cuts do not know their plane
  int hint = 0;
  const auto is_long_at = [&](Vec3 x) {
    const LocalSize size = field.local(x, hint);
    return size.along > size.length;
  };
  if (std::ranges::any_of(boundary.nodes, [&](const FaceNode& n) { return is_long_at(n.x); })) return true;
  const double u_step = (surface.u_max() - surface.u_min()) / kProbes, v0 = surface.v_min();
  const double v_step = (surface.v_max() - v0) / kProbes;
  for (int i = 0; i < kProbes; ++i)
    for (int k = 0; k < kProbes; ++k)
      if (is_long_at(surface.point({surface.u_min() + (i + 0.5) * u_step, v0 + (k + 0.5) * v_step}))) return true;
  return false;
}

TileCut cut_face(const Surface& surface, const SurfaceMaker& make_surface, const FaceBoundary& boundary,
                 std::span<const BoundaryPlace> places, const SizeField& field, double tile_triangles) {
  TileCut cut = TileCutter(surface, make_surface, boundary, places, field, tile_triangles).run();
  cut.n_boundary = static_cast<std::int32_t>(boundary.nodes.size());
  cut.shared = shared_nodes(cut.tiles, cut.n_boundary);
  cut.number = numbers_of(boundary);
  return cut;
}

std::vector<std::int32_t> nodes_of(const Tile& tile) {
  std::vector<std::int32_t> nodes;
  for (const auto& [a, b] : tile.segments) nodes.insert(nodes.end(), {a, b});
  sort_once(nodes);
  return nodes;
}

FaceBoundary tile_boundary(const FaceBoundary& boundary, const TileCut& cut, const Tile& tile) {
  const auto n_boundary = static_cast<std::int32_t>(boundary.nodes.size());
  const std::vector<std::int32_t> nodes = nodes_of(tile);
  FaceBoundary own;
  for (const std::int32_t n : nodes)
    own.nodes.push_back(n < n_boundary ? boundary.nodes[n] : cut.nodes[n - n_boundary]);
  const auto local = [&](std::int32_t n) {
    return static_cast<std::int32_t>(std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin());
  };
  for (const auto& [a, b] : tile.segments) own.segments.push_back({local(a), local(b)});
  return own;
}

}  // namespace st
