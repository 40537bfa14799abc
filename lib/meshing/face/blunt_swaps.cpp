#include "meshing/face/blunt_swaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "mesh/adjacency.h"
#include "mesh/corner_uv.h"
#include "meshing/face/flaw_mending.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr int kMostSweeps = 6;
constexpr double kLeastGain = 0.02;  // of the negative cosine of the largest angle
constexpr double kFlatEnough = 0.5;  // cosine between the normals of neighbours that do no harm

class BluntSwaps {
 public:
  BluntSwaps(std::span<const FaceNode> nodes, std::vector<Triangle>& triangles)
      : nodes_(nodes), triangles_(triangles) {}

  int run() {
    int n_swaps = 0;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      if (std::ranges::none_of(triangles_, [&](const Triangle& t) { return is_blunt(t); })) break;
      find_neighbours();
      const int before = n_swaps;
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (is_blunt(triangles_[t])) n_swaps += mend(static_cast<TriangleId>(t));
      if (n_swaps == before) break;
    }
    return n_swaps;
  }

 private:
  /// Both triangles of an edge, and what they become.
  struct Swap {
    Triangle first, second;
    double bluntness = 0;
  };

  Vec3 x(NodeId n) const { return nodes_[n].x; }
  Vec3 normal(const Triangle& t) const { return normalized(cross(x(t.n[1]) - x(t.n[0]), x(t.n[2]) - x(t.n[0]))); }
  /// Negative cosine of the largest angle.
  double bluntness(const Triangle& t) const {
    double most = -1;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = x(t.n[(k + 1) % 3]) - x(t.n[k]), b = x(t.n[(k + 2) % 3]) - x(t.n[k]);
      most = std::max(most, -dot(a, b) / std::sqrt(std::max(norm2(a) * norm2(b), 1e-300)));
    }
    return most;
  }
  bool has_pole(const Triangle& t) const {
    return std::ranges::any_of(t.n, [&](NodeId n) { return nodes_[n].is_pole; });
  }
  bool is_blunt(const Triangle& t) const { return !has_pole(t) && bluntness(t) > -std::cos(kMostAngle); }

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

  bool mend(TriangleId t) {
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
    triangles_[t] = best.first;
    triangles_[with] = best.second;
    is_changed_[t] = is_changed_[with] = 1;
    return true;
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
    if (c == d || (nodes_[c].id != kNone && nodes_[c].id == nodes_[d].id) || has_pole(swap.first) ||
        has_pole(swap.second) || are_joined(c, d))
      return false;
    const SideId back = beyond_[side];
    const Vec3 own = normal(triangles_[side / 3]), other = normal(triangles_[back / 3]);
    const Vec3 first = normal(swap.first), second = normal(swap.second);
    const std::array around{beyond_normal(next(side, 2), first), beyond_normal(next(back, 1), first),
                            beyond_normal(next(side, 1), second), beyond_normal(next(back, 2), second)};
    const double before = std::min(
        {dot(own, other), dot(own, around[0]), dot(own, around[2]), dot(other, around[1]), dot(other, around[3])});
    const double after = std::min({dot(first, second), dot(first, around[0]), dot(first, around[1]),
                                   dot(second, around[2]), dot(second, around[3])});
    return after >= std::min(before, kFlatEnough);
  }
  /// Of the triangle there; `none`: where there is none.
  Vec3 beyond_normal(SideId side, Vec3 none) const {
    return beyond_[side] == kNone ? none : normal(triangles_[beyond_[side] / 3]);
  }
  bool are_joined(NodeId a, NodeId b) const {
    return std::ranges::any_of(triangles_, [&](const Triangle& t) {
      return std::ranges::find(t.n, a) != std::end(t.n) && std::ranges::find(t.n, b) != std::end(t.n);
    });
  }

  const std::span<const FaceNode> nodes_;
  std::vector<Triangle>& triangles_;
  std::vector<SideId> beyond_;    // [sides] the same edge's other one; kNone: the face ends
  std::vector<char> is_changed_;  // [triangles] in this sweep
};

}  // namespace

int swap_blunt(std::span<const FaceNode> nodes, std::vector<Triangle>& triangles) {
  return BluntSwaps(nodes, triangles).run();
}

int swap_blunt(std::span<const Vec3> xyz, FacePatch& patch) {
  const std::vector<Vec2> uv = corner_uvs(patch);
  std::map<std::tuple<NodeId, double, double>, NodeId> known;  // a node of a seam is there twice
  std::vector<FaceNode> nodes;
  std::vector<Triangle> triangles(patch.triangles.size());
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const NodeId n = patch.triangles[i / 3].n[i % 3];
    const auto [at, is_new] = known.try_emplace({n, uv[i].x, uv[i].y}, static_cast<NodeId>(nodes.size()));
    if (is_new) nodes.push_back({.uv = uv[i], .x = xyz[n], .id = n});
    triangles[i / 3].n[i % 3] = at->second;
  }
  const int n_swaps = swap_blunt(nodes, triangles);
  if (n_swaps == 0) return 0;
  std::vector<Vec2> after;
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const FaceNode& n = nodes[triangles[i / 3].n[i % 3]];
    after.push_back(n.uv);
    if (patch.triangles[i / 3].n[i % 3] != n.id && !patch.triangle_previous.empty())
      patch.triangle_previous[i / 3] = kNone;
    patch.triangles[i / 3].n[i % 3] = n.id;
  }
  set_corner_uvs(after, patch);
  return n_swaps;
}

}  // namespace st
