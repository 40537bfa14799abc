#include "meshing/face/flaw_mending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "meshing/face/swap_quad.h"
#include "meshing/face/triangle_shape.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr int kMostSweeps = 4;         // what mends one may flaw its neighbour
constexpr double kLeastGain = 0.02;    // of the cost: less is no change
constexpr double kSteepCosine = 0.5;   // between the normals of a triangle and of the surface: no change makes less
constexpr double kAlongCosine = 0.95;  // likewise of two nodes, if the third has a wrong one
// costs: squares of what is above, in these units
constexpr double kAngleFrom = 0.75;  // of the negative cosine of the largest angle
constexpr double kAngleUnit = 0.1;
constexpr double kGrowthFrom = 2.1;  // of steps of size
constexpr double kGrowthUnit = 0.2;
constexpr double kLackFrom = 0.134;  // of what a triangle's quality lacks of 1: half a square
constexpr double kLackUnit = 0.1;
constexpr double kMostLack = 0.15;                 // triangles outside rows that lack more are flawed
constexpr double kNodeCost = 0.3;                  // of a node more
constexpr double kFlawCost = 1;                    // more where an angle or a step is above what is asked for
constexpr double kMostCost = 10;                   // of one angle or step
constexpr std::array<double, 2> kSteps{0.5, 0.2};  // of the way to a node beside, or to the middle of all
// where a node goes onto one beside it
constexpr double kLongEdge = 1.45;  // of the lengths asked for: no such edge comes where there is none
constexpr double kPoor = 0.4;       // quality: what comes is no worse, or no worse than what was there

constexpr double kUnsound = 1e9;  // cost: above all others

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
        changes |= mend(t) || mend_at_pole(t);
      }
    }
  }

 private:
  using Corners = std::array<std::int32_t, 3>;
  struct Change {
    double gain = kLeastGain;
    int edge = -1;                // that is swapped, or:
    std::int32_t node = kNone;    // that moves
    MeshNode moved = MeshNode();  // there, or:
    int onto = -1;                // goes onto this one of its ring
    bool is_new = false;          // `moved` is one more, in the triangle
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
  double shape_cost(const Corners& c) const {
    return angle_cost(bluntness(c)) + cost_above(1 - quality(c), kLackFrom, kLackUnit);
  }
  static bool is_blunt(double bluntness) { return bluntness > -std::cos(kMostAngle); }

  bool is_flawed(std::int32_t t) const {
    const double own = area(t);
    if (!(own > 0)) return false;
    const Corners c = corners(m_.triangles[t]);
    if (is_blunt(bluntness(c)) || (m_.triangles[t].state != kLaid && 1 - quality(c) > kMostLack)) return true;
    for (const std::int32_t other : m_.triangles[t].n)
      if (growth(own, area(other)) > kMostGrowth) return true;
    return false;
  }

  /// Of these triangles as they are, and of their steps; where it is above `most`, of the first ones alone.
  double cost(std::span<const std::int32_t> triangles, double most = kUnsound) const {
    double sum = 0;
    for (const std::int32_t t : triangles) {
      if (sum > most) return sum;
      const double own = area(t);
      if (!(own > 0)) continue;
      sum += shape_cost(corners(m_.triangles[t]));
      for (const std::int32_t other : m_.triangles[t].n) sum += growth_cost(own, area(other));
    }
    return sum;
  }

  /// Against the surface's normals, or nearly. One of these may be wrong, as where the parametrisation is singular.
  bool is_steep(const Corners& c) const {
    const Vec3 n = cross(x(c[1]) - x(c[0]), x(c[2]) - x(c[0]));
    std::array<double, 3> along;
    std::ranges::transform(c, along.begin(), [&](std::int32_t i) { return dot(n, m_.nodes[i].normal); });
    std::ranges::sort(along);
    return !(along[0] > kSteepCosine * norm(n) || along[1] > kAlongCosine * norm(n));
  }

  bool mend(std::int32_t t) {
    Change best;
    for (int k = 0; k < 3; ++k) {
      consider_swap(t, k, best);
      consider_moves(m_.triangles[t].v[k], best);
      consider_collapses(m_.triangles[t].v[k], best);
    }
    consider_nodes(t, best);
    if (best.is_new) return insert(best.moved, t), true;
    if (best.edge >= 0) {
      const std::int32_t other = m_.triangles[t].n[best.edge];
      m_.swap(t, best.edge);
      look_again_at(t);
      look_again_at(other);
    } else if (best.node != kNone) {
      m_.ring_of(best.node, around_, tris_);
      for (const std::int32_t r : tris_) look_again_at(r);
      if (best.onto < 0)
        m_.nodes[best.node] = best.moved;
      else
        m_.collapse(best.node, best.onto, around_, tris_);
    }
    return best.edge >= 0 || best.node != kNone;
  }

  void insert(const MeshNode& node, std::int32_t t) {
    m_.find_cavity(node.p, metric_of(node), t);
    m_.nodes.push_back(node);
    m_.added_node();
    m_.fill_cavity(static_cast<std::int32_t>(m_.nodes.size()) - 1);
    is_due_.resize(m_.triangles.size());
    for (const std::int32_t fresh : m_.new_triangles()) {
      m_.triangles[fresh].state = kFinished;
      look_again_at(fresh);
    }
  }

  /// A triangle of no area, between two nodes of a pole, may part it from the one to swap with. It goes to the other
  /// side first.
  bool mend_at_pole(std::int32_t t) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t o = m_.triangles[t].n[k];
      if (o == kNone || !is_between_poles(o) || is_between_poles(t)) continue;
      if ((m_.triangles[t].constrained >> k & 1) || !m_.can_swap(t, k)) continue;
      m_.swap(t, k);
      const std::int32_t own = is_between_poles(t) ? o : t;
      if (mend(own)) return true;
      for (int i = 0; i < 3; ++i)
        if (m_.triangles[own].n[i] == (own == t ? o : t)) return m_.swap(own, i), false;
    }
    return false;
  }
  bool is_between_poles(std::int32_t t) const {
    const Corners c = corners(m_.triangles[t]);
    const auto are_one = [&](int i, int k) { return are_one_pole(m_.nodes[c[i]], m_.nodes[c[k]]); };
    return are_one(0, 1) || are_one(1, 2) || are_one(2, 0);
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
    const double after = shape_cost(first) + shape_cost(second) + 2 * growth_cost(one, two) +
                         growth_cost(one, area(r.n[(k + 2) % 3])) + growth_cost(two, area(r.n[(k + 1) % 3])) +
                         growth_cost(one, area(s.n[(j + 1) % 3])) + growth_cost(two, area(s.n[(j + 2) % 3]));
    const double gain = cost(std::array{t, q.o}) - after;
    if (gain <= best.gain || is_steep(first) || is_steep(second) || !may_swap<true>(w_, q, k)) return;
    best = {.gain = gain, .edge = k};
  }

  /// One more in the middle of the triangle, or of a side of it.
  void consider_nodes(std::int32_t t, Change& best) {
    if (m_.triangles[t].state == kLaid) return;
    const Corners c = corners(m_.triangles[t]);
    const auto p = [&](int k) { return m_.nodes[c[k % 3]].p; };
    for (int k = 0; k < 3; ++k) consider_node(t, 0.5 * (p(k) + p(k + 1)), best);
    consider_node(t, 1.0 / 3 * (p(0) + p(1) + p(2)), best);
  }

  void consider_node(std::int32_t t, Vec2 p, Change& best) {
    MeshNode node;
    node.p = p;
    w_.evaluate(node);
    w_.ask_sizes(node);
    if (!std::isfinite(norm2(node.x)) || !m_.find_cavity(p, metric_of(node), t)) return;
    for (const std::int32_t i : m_.cavity())
      if (m_.triangles[i].state == kOutside || m_.triangles[i].state == kLaid) return;
    const double before = cost(m_.cavity());
    if (before - kNodeCost <= best.gain) return;
    m_.nodes.push_back(node);
    const auto added = static_cast<std::int32_t>(m_.nodes.size()) - 1;
    const double gain = before - kNodeCost - cost_of_fan(added, before - kNodeCost - best.gain);
    m_.nodes.pop_back();
    if (gain > best.gain) best = {.gain = gain, .moved = node, .is_new = true};
  }

  /// As cost() of the cavity's triangles about this node; much where one of them is not sound.
  double cost_of_fan(std::int32_t node, double most) const {
    const auto& ring = m_.ring();
    const auto corners_at = [&](std::size_t i) { return Corners{ring[i].a, ring[i].b, node}; };
    double sum = 0, last = area(corners_at(ring.size() - 1));
    for (std::size_t i = 0; i < ring.size() && !(sum > most); ++i) {
      const Corners c = corners_at(i);
      if (is_steep(c) || orient2d(m_.nodes[c[0]].p, m_.nodes[c[1]].p, m_.nodes[node].p) <= 0) return kUnsound;
      const double here = area(c);
      sum += shape_cost(c) + growth_cost(here, area(ring[i].outer)) + 2 * growth_cost(here, last);
      last = here;
    }
    return sum;
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
      const double gain = before - cost(tris_, before - best.gain);
      const bool is_sound = gain > best.gain && std::ranges::none_of(tris_, [&](std::int32_t t) {
                              return is_steep(corners(m_.triangles[t]));
                            });
      m_.nodes[node] = old;
      if (is_sound) best = {.gain = gain, .edge = -1, .node = node, .moved = moved};
    }
  }

  void consider_collapses(std::int32_t node, Change& best) {
    const MeshNode& n = m_.nodes[node];
    if (node < m_.n_boundary + 4 || n.is_laid || n.is_kept || !m_.ring_of(node, around_, tris_)) return;
    if (std::ranges::any_of(around_, [&](std::int32_t i) { return m_.nodes[i].is_pole; })) return;
    const double before = cost(tris_);
    longest_ = before > best.gain ? longest_about(node) : 0;
    for (int onto = 0; onto < std::ssize(around_) && before > best.gain; ++onto) {
      const double gain = before - cost_after(onto, before - best.gain);
      if (gain > best.gain && may_collapse(onto)) best = {.gain = gain, .edge = -1, .node = node, .onto = onto};
    }
  }

  /// Of the ring, the one that lies so many steps behind a node of it.
  std::size_t behind(int onto, std::size_t steps) const { return (onto + steps) % around_.size(); }
  /// Likewise of the triangles that are left where the ring's node goes there: the first has one step.
  Corners left(int onto, std::size_t i) const {
    return {around_[onto], around_[behind(onto, i)], around_[behind(onto, i + 1)]};
  }
  double area_outside(std::size_t ring_side) const {
    const PlaneTriangle& t = m_.triangles[tris_[ring_side]];
    for (int k = 0; k < 3; ++k)
      if (t.v[k] == around_[ring_side]) return area(t.n[k]);
    return 0;
  }

  /// As cost() of what is left of the ring.
  double cost_after(int onto, double most) const {
    const std::size_t n_left = around_.size() - 2;
    double sum = 0, last = area_outside(onto);
    for (std::size_t i = 1; i <= n_left && !(sum > most); ++i) {
      const Corners own = left(onto, i);
      const double here = area(own);
      const bool is_inside = i > 1;
      sum += shape_cost(own) + growth_cost(here, area_outside(behind(onto, i)));
      sum += (is_inside ? 2 : 1) * growth_cost(here, last);
      last = here;
    }
    return sum + growth_cost(last, area_outside(behind(onto, n_left + 1)));
  }

  bool may_collapse(int onto) const {
    const MeshNode& target = m_.nodes[around_[onto]];
    double worst_before = kPoor, worst = kPoor;
    for (const std::int32_t t : tris_) worst_before = std::min(worst_before, quality(corners(m_.triangles[t])));
    for (std::size_t i = 1; i + 1 < around_.size(); ++i) {
      const Corners c = left(onto, i);
      if (orient2d(target.p, m_.nodes[c[1]].p, m_.nodes[c[2]].p) <= 0 || is_steep(c)) return false;
      worst = std::min(worst, quality(c));
      if (i > 1 && !may_join(around_[onto], c[1])) return false;
    }
    return worst >= worst_before;
  }
  double quality(const Corners& c) const { return metric_quality(m_.nodes[c[0]], m_.nodes[c[1]], m_.nodes[c[2]]); }
  /// Of the lengths asked for.
  double relative_length(std::int32_t i, std::int32_t j) const {
    return std::sqrt(w_.edge_length2<true>(i, j)) / (0.5 * (m_.nodes[i].h + m_.nodes[j].h));
  }
  double longest_about(std::int32_t node) const {
    double longest = kLongEdge;
    for (std::size_t i = 0; i < around_.size(); ++i)
      longest = std::max(
          {longest, relative_length(node, around_[i]), relative_length(around_[i], around_[behind(0, i + 1)])});
    return longest;
  }
  /// May there be an edge?
  bool may_join(std::int32_t i, std::int32_t j) const {
    const MeshNode &a = m_.nodes[i], &b = m_.nodes[j];
    if (a.id != kNone && a.id == b.id) return false;
    return relative_length(i, j) <= longest_ && dot(a.normal, b.normal) > std::cos(w_.max_turning);
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
  double longest_ = 0;        // sides about the node that may go, of the lengths asked for
  std::vector<char> is_due_;  // [triangles] may be flawed
};

}  // namespace

void mend_flaws(FaceWork& work) { FlawMending(work).run(); }

}  // namespace st
