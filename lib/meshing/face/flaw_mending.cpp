#include "meshing/face/flaw_mending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "meshing/face/swap_quad.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr int kMostSweeps = 4;        // what mends one may flaw its neighbour
constexpr double kLeastGain = 0.02;   // of the cost: less is no change
constexpr double kSteepCosine = 0.5;  // between the normals of a triangle and of the surface: no change makes less
// costs: squares of what is above, in these units
constexpr double kAngleFrom = 0.75;  // of the negative cosine of the largest angle
constexpr double kAngleUnit = 0.1;
constexpr double kGrowthFrom = 2.1;  // of steps of size
constexpr double kGrowthUnit = 0.4;
constexpr double kFlawCost = 0.5;                  // more where an angle or a step is above what is asked for
constexpr double kMostCost = 10;                   // of one angle or step
constexpr std::array<double, 2> kSteps{0.5, 0.2};  // of the way to a node beside, or to the middle of all

double cost_above(double value, double from, double unit) {
  const double above = std::max(0.0, (value - from) / unit);
  return std::min(kMostCost, above * above);
}

class FlawMending {
 public:
  explicit FlawMending(FaceWork& work) : w_(work), m_(work.mesh) {}

  void run() {
    is_due_.assign(m_.triangles.size(), 1);
    bool changes = true;
    for (int sweep = 0; sweep < kMostSweeps && changes; ++sweep) {
      changes = false;
      for (std::size_t i = 0; i < m_.triangles.size(); ++i) {
        const auto t = static_cast<std::int32_t>(i);
        if (!std::exchange(is_due_[i], 0) || !is_flawed(t)) continue;
        is_due_[i] = 1;  // what others change may help
        changes |= mend(t);
      }
    }
  }

 private:
  using Corners = std::array<std::int32_t, 3>;
  struct Change {
    double gain = kLeastGain;
    int edge = -1;                // that is swapped, or:
    std::int32_t node = kNone;    // that moves
    MeshNode moved = MeshNode();  // there
  };

  Vec3 x(std::int32_t node) const { return m_.nodes[node].x; }
  static Corners corners(const PlaneTriangle& t) { return {t.v[0], t.v[1], t.v[2]}; }
  double area(const Corners& c) const { return norm(cross(x(c[1]) - x(c[0]), x(c[2]) - x(c[0]))); }
  /// 0: outside, or none.
  double area(std::int32_t t) const {
    if (t == kNone || m_.triangles[t].state == kOutside || m_.triangles[t].state == kDead) return 0;
    return area(corners(m_.triangles[t]));
  }

  /// Negative cosine of the largest angle in space.
  double bluntness(const Corners& c) const {
    const Vec3 side[3] = {x(c[1]) - x(c[0]), x(c[2]) - x(c[1]), x(c[0]) - x(c[2])};
    const double n[3] = {norm2(side[0]), norm2(side[1]), norm2(side[2])};
    const int k = n[0] >= n[1] && n[0] >= n[2] ? 0 : n[1] >= n[2] ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
    return dot(side[i], side[j]) / std::sqrt(std::max(n[i] * n[j], 1e-300));
  }
  /// 1 where one of the areas is none.
  static double growth(double a, double b) { return a > 0 && b > 0 ? std::sqrt(std::max(a, b) / std::min(a, b)) : 1; }
  static double angle_cost(double bluntness) {
    return cost_above(bluntness, kAngleFrom, kAngleUnit) + (is_blunt(bluntness) ? kFlawCost : 0);
  }
  static double growth_cost(double a, double b) {
    const double ratio = growth(a, b);
    return cost_above(ratio, kGrowthFrom, kGrowthUnit) + (ratio > kMostGrowth ? kFlawCost : 0);
  }
  static bool is_blunt(double bluntness) { return bluntness > -std::cos(kMostAngle); }

  bool is_flawed(std::int32_t t) const {
    const double own = area(t);
    if (!(own > 0)) return false;
    if (is_blunt(bluntness(corners(m_.triangles[t])))) return true;
    for (const std::int32_t other : m_.triangles[t].n)
      if (growth(own, area(other)) > kMostGrowth) return true;
    return false;
  }

  /// Of these triangles as they are, and of their steps.
  double cost(std::span<const std::int32_t> triangles) const {
    double sum = 0;
    for (const std::int32_t t : triangles) {
      const double own = area(t);
      if (!(own > 0)) continue;
      sum += angle_cost(bluntness(corners(m_.triangles[t])));
      for (const std::int32_t other : m_.triangles[t].n) sum += growth_cost(own, area(other));
    }
    return sum;
  }

  /// Against the surface's normals, or nearly.
  bool is_steep(const Corners& c) const {
    const Vec3 n = cross(x(c[1]) - x(c[0]), x(c[2]) - x(c[0]));
    return std::ranges::any_of(c,
                               [&](std::int32_t i) { return !(dot(n, m_.nodes[i].normal) > kSteepCosine * norm(n)); });
  }

  bool mend(std::int32_t t) {
    Change best;
    for (int k = 0; k < 3; ++k) {
      consider_swap(t, k, best);
      consider_moves(m_.triangles[t].v[k], best);
    }
    if (best.edge >= 0) {
      const std::int32_t other = m_.triangles[t].n[best.edge];
      m_.swap(t, best.edge);
      look_again_at(t);
      look_again_at(other);
    } else if (best.node != kNone) {
      m_.nodes[best.node] = best.moved;
      m_.ring_of(best.node, around_, tris_);
      for (const std::int32_t r : tris_) look_again_at(r);
    }
    return best.edge >= 0 || best.node != kNone;
  }

  /// A triangle that changed, and those whose steps to it did.
  void look_again_at(std::int32_t t) {
    is_due_[t] = 1;
    for (const std::int32_t other : m_.triangles[t].n)
      if (other != kNone) is_due_[other] = 1;
  }

  void consider_swap(std::int32_t t, int k, Change& best) const {
    SwapQuad q;
    if (!quad_at(m_, t, k, q)) return;
    const PlaneTriangle &r = m_.triangles[t], &s = m_.triangles[q.o];
    const int j = s.n[0] == t ? 0 : s.n[1] == t ? 1 : 2;
    const Corners first{q.c, q.a, q.d}, second{q.c, q.d, q.b};
    const double one = area(first), two = area(second);
    const double after = angle_cost(bluntness(first)) + angle_cost(bluntness(second)) + 2 * growth_cost(one, two) +
                         growth_cost(one, area(r.n[(k + 2) % 3])) + growth_cost(two, area(r.n[(k + 1) % 3])) +
                         growth_cost(one, area(s.n[(j + 1) % 3])) + growth_cost(two, area(s.n[(j + 2) % 3]));
    const double gain = cost(std::array{t, q.o}) - after;
    if (gain <= best.gain || is_steep(first) || is_steep(second) || !may_swap<true>(w_, q, k)) return;
    best = {.gain = gain, .edge = k};
  }

  void consider_moves(std::int32_t node, Change& best) {
    if (node < m_.n_boundary + 4 || m_.nodes[node].is_laid || !m_.ring_of(node, around_, tris_)) return;
    const double before = cost(tris_);
    if (before <= best.gain) return;
    Vec2 middle{};
    for (const std::int32_t i : around_) middle = middle + m_.nodes[i].p;
    consider_move(node, 1.0 / static_cast<double>(around_.size()) * middle, before, best);
    for (const std::int32_t i : around_) consider_move(node, m_.nodes[i].p, before, best);
  }

  void consider_move(std::int32_t node, Vec2 towards, double before, Change& best) {
    const MeshNode old = m_.nodes[node];
    for (const double part : kSteps) {
      MeshNode moved = old;
      moved.p = old.p + part * (towards - old.p);
      if (!is_valid_at(moved.p)) continue;
      w_.evaluate(moved);
      m_.nodes[node] = moved;
      const double gain = before - cost(tris_);
      const bool is_sound = gain > best.gain && std::ranges::none_of(tris_, [&](std::int32_t t) {
                              return is_steep(corners(m_.triangles[t]));
                            });
      m_.nodes[node] = old;
      if (is_sound) best = {.gain = gain, .edge = -1, .node = node, .moved = moved};
    }
  }

  bool is_valid_at(Vec2 p) const {
    const std::size_t n = around_.size();
    for (std::size_t i = 0; i < n; ++i)
      if (orient2d(p, m_.nodes[around_[i]].p, m_.nodes[around_[i + 1 == n ? 0 : i + 1]].p) <= 0) return false;
    return true;
  }

  FaceWork& w_;
  Triangulation& m_;
  std::vector<std::int32_t> around_, tris_;
  std::vector<char> is_due_;  // [triangles] may be flawed
};

}  // namespace

void mend_flaws(FaceWork& work) { FlawMending(work).run(); }

}  // namespace st
