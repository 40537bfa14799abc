#include "meshing/face/blunt_swaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/corner_uv.h"
#include "meshing/face/face_patch.h"
#include "meshing/face/flaw_mending.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr int kMostSweeps = 6;
constexpr double kLeastGain = 0.02;  // of the negative cosine of the largest angle
constexpr double kFlatEnough = 0.5;  // cosine between the normals of neighbours that do no harm

/// Negative cosine of the largest angle.
double bluntness(const std::array<Vec3, 3>& x) {
  double most = -1;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = x[(k + 1) % 3] - x[k], b = x[(k + 2) % 3] - x[k];
    most = std::max(most, -dot(a, b) / std::sqrt(std::max(norm2(a) * norm2(b), 1e-300)));
  }
  return most;
}

class BluntSwaps {
 public:
  BluntSwaps(std::span<const FaceNode> nodes, std::vector<Triangle>& triangles, double above)
      : nodes_(nodes), blunt_(-std::cos(above)), triangles_(triangles), origin_(triangles.size()) {
    std::iota(origin_.begin(), origin_.end(), 0);
  }

  int run() {
    int n_changes = 0;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      if (std::ranges::none_of(triangles_, [&](const Triangle& t) { return is_blunt(t); })) break;
      find_neighbours();
      const int before = n_changes;
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (!is_changed_[t] && is_blunt(triangles_[t])) {
          const auto own = static_cast<TriangleId>(t);
          n_changes += swap_at(own) || merge_at(own);
        }
      drop_removed();
      if (n_changes == before) break;
    }
    return n_changes;
  }

  /// [triangles] Before all changes; kNone: of those that changed.
  const std::vector<TriangleId>& origin() const { return origin_; }

 private:
  /// Both triangles of an edge, and what they become.
  struct Swap {
    Triangle first, second;
    double bluntness = 0;
  };

  Vec3 x(NodeId n) const { return nodes_[n].x; }
  Vec3 normal(const Triangle& t) const { return normalized(cross(x(t.n[1]) - x(t.n[0]), x(t.n[2]) - x(t.n[0]))); }
  double bluntness(const Triangle& t) const { return st::bluntness({x(t.n[0]), x(t.n[1]), x(t.n[2])}); }
  bool has_pole(const Triangle& t) const {
    return std::ranges::any_of(t.n, [&](NodeId n) { return nodes_[n].is_pole; });
  }
  bool is_blunt(const Triangle& t) const { return !has_pole(t) && bluntness(t) > blunt_; }

  void find_neighbours() {
    beyond_.assign(3 * triangles_.size(), kNone);
    is_changed_.assign(triangles_.size(), 0);
    EdgeTable(triangles_, static_cast<std::int64_t>(nodes_.size()))
        .for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
          if (sides.size() != 2 || run_alike(triangles_, sides[0], sides[1])) return;
          beyond_[sides[0]] = sides[1];
          beyond_[sides[1]] = sides[0];
        });
  }

  /// Those of a triangle and its neighbours that changed in this sweep wait for the next.
  bool is_known(TriangleId t) const {
    if (is_changed_[t]) return false;
    for (SideId s = 3 * t; s < 3 * t + 3; ++s)
      if (beyond_[s] != kNone && is_changed_[beyond_[s] / 3]) return false;
    return true;
  }

  bool swap_at(TriangleId t) {
    if (!is_known(t)) return false;
    Swap best;
    TriangleId with = kNone;
    for (SideId side = 3 * t; side < 3 * t + 3; ++side) {
      if (beyond_[side] == kNone || !is_known(beyond_[side] / 3)) continue;
      const TriangleId other = beyond_[side] / 3;
      const double before = std::max(bluntness(triangles_[t]), bluntness(triangles_[other]));
      const Swap swap = swap_of(side);
      if (swap.bluntness > before - kLeastGain || (with != kNone && swap.bluntness >= best.bluntness)) continue;
      if (!may_swap(side, swap)) continue;
      best = swap;
      with = other;
    }
    if (with == kNone) return false;
    change(t, best.first);
    change(with, best.second);
    return true;
  }

  void change(TriangleId t, const Triangle& becomes) {
    triangles_[t] = becomes;
    origin_[t] = kNone;
    is_changed_[t] = 1;
  }

  Swap swap_of(SideId side) const {
    const SideId back = beyond_[side];
    const NodeId a = corner(side, 0), b = corner(side, 1), c = corner(side, 2), d = corner(back, 2);
    Swap swap{{{c, a, d}}, {{c, d, b}}};
    swap.bluntness = std::max(bluntness(swap.first), bluntness(swap.second));
    return swap;
  }
  /// From the side's first node on around its triangle.
  NodeId corner(SideId side, int k) const { return triangles_[side / 3].n[(side + k) % 3]; }
  /// Side `k` from this one on, in the same triangle.
  static SideId next(SideId side, int k) { return side / 3 * 3 + (side + k) % 3; }

  bool may_swap(SideId side, const Swap& swap) const {
    const NodeId c = swap.first.n[0], d = swap.first.n[2];
    if (are_one(c, d) || has_pole(swap.first) || has_pole(swap.second) || are_joined(c, d)) return false;
    const SideId back = beyond_[side];
    const Vec3 own = normal(triangles_[side / 3]), other = normal(triangles_[back / 3]);
    const Vec3 first = normal(swap.first), second = normal(swap.second);
    const std::array around{beyond_normal(next(side, 2), first), beyond_normal(next(back, 1), first),
                            beyond_normal(next(side, 1), second), beyond_normal(next(back, 2), second)};
    const double before = std::min(
        {dot(own, other), dot(own, around[0]), dot(own, around[2]), dot(other, around[1]), dot(other, around[3])});
    const double after = std::min({dot(first, second), dot(first, around[0]), dot(first, around[1]),
                                   dot(second, around[2]), dot(second, around[3])});
    return may_be_sharp(after, before, std::max(bluntness(triangles_[side / 3]), bluntness(triangles_[back / 3])));
  }
  /// Cosines of the sharpest edges. Where the surface turns at once, triangles with angles above kFarAngle are worse
  /// than edges that are sharp and not folded.
  static bool may_be_sharp(double after, double before, double blunt) {
    return after >= std::min(before, kFlatEnough) ||
           (blunt > -std::cos(kFarAngle) && before < kFlatEnough && after > kFoldedCosine);
  }
  /// Of the triangle there; `none`: where there is none.
  Vec3 beyond_normal(SideId side, Vec3 none) const {
    return beyond_[side] == kNone ? none : normal(triangles_[beyond_[side] / 3]);
  }

  /// Puts an inner node of the triangle onto one beside it, with all of its triangles but two.
  bool merge_at(TriangleId t) {
    Ring best;
    double best_after = 2;
    for (SideId side = 3 * t; side < 3 * t + 3; ++side) {
      Ring ring = ring_of(side);
      const double before = bluntness(ring.before);
      for (ring.onto = 0; ring.onto < ring.nodes.size(); ++ring.onto) {
        const double after = bluntness(after_merge(ring));
        if (after > std::min(before - kLeastGain, best_after) || !may_merge(ring)) continue;
        best_after = after;
        best = ring;
      }
    }
    if (best.nodes.empty()) return false;
    const std::vector<Triangle> after = after_merge(best);
    const std::size_t n = best.nodes.size();
    for (std::size_t i = 0; i + 2 < n; ++i) change(best.triangle((best.onto + 1 + i) % n), after[i]);
    for (const std::size_t i : {best.onto, (best.onto + n - 1) % n}) change(best.triangle(i), {{kNone, kNone, kNone}});
    return true;
  }

  /// About an inner node.
  struct Ring {
    std::vector<NodeId> nodes;
    std::vector<SideId> outer;     // side i from node i to node i + 1
    std::vector<Triangle> before;  // likewise
    std::size_t onto = 0;          // the node goes onto this one
    TriangleId triangle(std::size_t i) const { return outer[i] / 3; }
  };

  /// About the side's first node; none: it is not inside, or what is about it has changed.
  Ring ring_of(SideId side) const {
    Ring ring;
    if (nodes_[corner(side, 0)].id != kNone) return ring;
    SideId at = side;
    do {
      if (!is_known(at / 3)) return {};
      ring.nodes.push_back(corner(at, 1));
      ring.outer.push_back(next(at, 1));
      ring.before.push_back(triangles_[at / 3]);
      at = beyond_[next(at, 2)];
    } while (at != kNone && at != side);
    return at == kNone || ring.nodes.size() < 3 ? Ring() : ring;
  }

  /// From the one behind the node that stays on.
  static std::vector<Triangle> after_merge(const Ring& ring) {
    const std::size_t n = ring.nodes.size();
    std::vector<Triangle> after;
    for (std::size_t i = 1; i + 1 < n; ++i)
      after.push_back({{ring.nodes[ring.onto], ring.nodes[(ring.onto + i) % n], ring.nodes[(ring.onto + i + 1) % n]}});
    return after;
  }

  double bluntness(const std::vector<Triangle>& triangles) const {
    double most = -1;
    for (const Triangle& t : triangles) most = std::max(most, bluntness(t));
    return most;
  }

  bool may_merge(const Ring& ring) const {
    const std::vector<Triangle> after = after_merge(ring);
    const NodeId onto = ring.nodes[ring.onto];
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (has_pole(after[i])) return false;
      if (i > 0 && (are_one(onto, after[i].n[1]) || are_joined(onto, after[i].n[1]))) return false;
    }
    const std::size_t n = ring.nodes.size();
    Fit before, now;
    for (std::size_t i = 0; i < n; ++i) {
      before.add(*this, ring.before[i], ring.before[(i + 1) % n]);
      add_beyond(ring.outer[i], ring.before[i], before);
      const std::size_t last = after.size() - 1, behind = (i + n - ring.onto) % n;  // of the node that stays
      add_beyond(ring.outer[i], after[behind == 0 ? 0 : std::min(behind - 1, last)], now);
    }
    for (std::size_t i = 1; i < after.size(); ++i) now.add(*this, after[i - 1], after[i]);
    return may_be_sharp(now.cosine, before.cosine, bluntness(ring.before)) &&
           now.growth <= std::max(before.growth, kMostGrowth);
  }

  /// How well neighbours fit.
  struct Fit {
    double cosine = 1;  // least, between normals
    double growth = 1;  // largest root of the ratio of areas
    void add(const BluntSwaps& all, const Triangle& a, const Triangle& b) {
      cosine = std::min(cosine, dot(all.normal(a), all.normal(b)));
      const double one = all.area(a), two = all.area(b);
      growth = std::max(growth, std::sqrt(std::max(one, two) / std::max(std::min(one, two), 1e-300)));
    }
  };
  void add_beyond(SideId side, const Triangle& own, Fit& fit) const {
    if (beyond_[side] != kNone) fit.add(*this, own, triangles_[beyond_[side] / 3]);
  }
  double area(const Triangle& t) const { return norm(cross(x(t.n[1]) - x(t.n[0]), x(t.n[2]) - x(t.n[0]))); }

  void drop_removed() {
    std::size_t n = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (triangles_[t].n[0] == kNone) continue;
      triangles_[n] = triangles_[t];
      origin_[n++] = origin_[t];
    }
    triangles_.resize(n);
    origin_.resize(n);
  }

  bool are_one(NodeId a, NodeId b) const { return a == b || (nodes_[a].id != kNone && nodes_[a].id == nodes_[b].id); }
  bool are_joined(NodeId a, NodeId b) const {
    return std::ranges::any_of(triangles_, [&](const Triangle& t) {
      return std::ranges::find(t.n, a) != std::end(t.n) && std::ranges::find(t.n, b) != std::end(t.n);
    });
  }

  const std::span<const FaceNode> nodes_;
  const double blunt_;  // as bluntness(): more is mended
  std::vector<Triangle>& triangles_;
  std::vector<SideId> beyond_;    // [sides] the same edge's other one; kNone: the face ends
  std::vector<char> is_changed_;  // [triangles] in this sweep
  std::vector<TriangleId> origin_;
};

}  // namespace

int mend_blunt(std::span<const FaceNode> nodes, std::vector<Triangle>& triangles, double above) {
  return BluntSwaps(nodes, triangles, above).run();
}

int mend_blunt(std::span<const Vec3> xyz, FacePatch& patch, double above) {
  const auto is_blunt = [&, blunt = -std::cos(above)](const Triangle& t) {
    return bluntness({xyz[t.n[0]], xyz[t.n[1]], xyz[t.n[2]]}) > blunt;
  };
  if (std::ranges::none_of(patch.triangles, is_blunt)) return 0;
  const std::vector<Vec2> uv = corner_uvs(patch);
  std::map<std::tuple<NodeId, double, double>, NodeId> known;  // a node of a seam is there twice
  std::vector<FaceNode> nodes;
  std::vector<NodeId> number;  // [nodes] in the patch
  std::vector<Triangle> triangles(patch.triangles.size());
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const NodeId n = patch.triangles[i / 3].n[i % 3];
    const auto [at, is_new] = known.try_emplace({n, uv[i].x, uv[i].y}, static_cast<NodeId>(nodes.size()));
    if (is_new) {
      nodes.push_back({.uv = uv[i], .x = xyz[n], .id = n < patch.n_boundary ? n : kNone});
      number.push_back(n);
    }
    triangles[i / 3].n[i % 3] = at->second;
  }
  BluntSwaps mending(nodes, triangles, above);
  const int n_changes = mending.run();
  if (n_changes == 0) return 0;
  std::vector<Vec2> after;
  std::vector<TriangleId> previous;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const TriangleId origin = mending.origin()[t];
    if (!patch.triangle_previous.empty()) previous.push_back(origin == kNone ? kNone : patch.triangle_previous[origin]);
    for (NodeId& n : triangles[t].n) {
      after.push_back(nodes[n].uv);
      n = number[n];
    }
  }
  patch.triangles = std::move(triangles);
  patch.triangle_previous = std::move(previous);
  set_corner_uvs(after, patch);
  drop_unused_nodes(patch);
  return n_changes;
}

}  // namespace st
