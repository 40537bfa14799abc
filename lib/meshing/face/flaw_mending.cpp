#include "meshing/face/flaw_mending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "meshing/face/flaw_costs.h"
#include "meshing/face/swap_quad.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr int kMostSweeps = 4;                     // what mends one may flaw its neighbour
constexpr double kLeastGain = 0.02;                // of the cost: less is no change
constexpr double kNodeCost = 0.3;                  // of a node more
constexpr double kRowCost = 0.1;                   // of a quadrilateral of a row less
constexpr std::array<double, 2> kSteps{0.5, 0.2};  // of the way to a node beside, or to the middle of all
// where a node goes onto one beside it
constexpr double kLongEdge = 1.45;  // of the lengths asked for: no such edge comes where there is none
constexpr double kPoor = 0.4;       // quality: what comes is no worse, or no worse than what was there

class FlawMending : FlawCosts {
 public:
  explicit FlawMending(FaceWork& work) : FlawCosts(work.mesh), w_(work), m_(work.mesh) {}

  void run() {
    ask_again();
    tried_.assign(m_.triangles.size(), 0);
    touched_.assign(m_.nodes.size(), 0);
    bool changes = true;
    for (int sweep = 0; sweep < kMostSweeps && changes; ++sweep) {
      changes = false;
      for (std::size_t i = 0; i < m_.triangles.size(); ++i) {
        const auto t = static_cast<std::int32_t>(i);
        if (!is_due(t)) continue;
        tried_[i] = ++clock_;
        if (!is_flawed(t)) continue;
        changes |= mend(t) || mend_at_pole(t);
      }
    }
  }

 private:
  struct Change {
    double gain = kLeastGain;
    int edge = -1;                // that is swapped, or:
    std::int32_t node = kNone;    // that moves
    MeshNode moved = MeshNode();  // there, or:
    int onto = -1;                // goes onto this one of its ring
    bool is_new = false;          // `moved` is one more, in the triangle
  };

  /// Rows have given their nodes the lengths that were laid. They are judged by those asked for.
  void ask_again() {
    for (MeshNode& n : m_.nodes)
      if (n.is_laid) n.h = n.request;
    for (const auto& [node, squeeze] : w_.shortened) m_.nodes[node].squeeze = squeeze;
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
      release(t, best.edge);
      m_.triangles[t].state = m_.triangles[other].state = kFinished;
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
    tried_.resize(m_.triangles.size());
    touched_.resize(m_.nodes.size());
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

  /// Not tried yet, or not since something about it changed.
  bool is_due(std::int32_t t) const {
    return tried_[t] == 0 ||
           std::ranges::any_of(m_.triangles[t].v, [&](std::int32_t i) { return touched_[i] >= tried_[t]; });
  }
  /// A triangle that changed, and all that have corners with it.
  void look_again_at(std::int32_t t) {
    for (const std::int32_t i : m_.triangles[t].v) touched_[i] = clock_;
  }

  void consider_swap(std::int32_t t, int k, Change& best) {
    SwapQuad q;
    const double broken = release(t, k);
    if (quad_at(m_, t, k, q)) consider_swap(q, k, broken, best);
    if (broken > 0) hold(t, k);
  }

  /// Cost of what else of rows is none any more where this side is no side of a row: 0 where it is none, or stays one.
  double release(std::int32_t t, int k) {
    PlaneTriangle& r = m_.triangles[t];
    const std::int32_t o = r.n[k];
    if (!(r.constrained >> k & 1) || o == kNone || (r.v[k] < m_.n_boundary && r.v[(k + 1) % 3] < m_.n_boundary))
      return 0;
    double broken = kRowCost;
    for (const std::int32_t i : {t, o}) {
      const std::int32_t partner = beyond_longest(i);
      if (partner != t && partner != o && is_in_row(i)) broken += kRowCost + lack_cost(corners(m_.triangles[partner]));
    }
    r.constrained &= static_cast<std::uint8_t>(~(1 << k));
    PlaneTriangle& s = m_.triangles[o];
    s.constrained &= static_cast<std::uint8_t>(~(1 << neighbour(s, t)));
    return broken;
  }
  void hold(std::int32_t t, int k) {
    PlaneTriangle& r = m_.triangles[t];
    r.constrained |= static_cast<std::uint8_t>(1 << k);
    PlaneTriangle& s = m_.triangles[r.n[k]];
    s.constrained |= static_cast<std::uint8_t>(1 << neighbour(s, t));
  }
  static int neighbour(const PlaneTriangle& s, std::int32_t t) { return s.n[0] == t ? 0 : s.n[1] == t ? 1 : 2; }

  void consider_swap(const SwapQuad& q, int k, double broken, Change& best) const {
    const std::int32_t t = q.t;
    const PlaneTriangle &r = m_.triangles[t], &s = m_.triangles[q.o];
    const int j = s.n[0] == t ? 0 : s.n[1] == t ? 1 : 2;
    const Corners first{q.c, q.a, q.d}, second{q.c, q.d, q.b};
    const double one = area(first), two = area(second);
    const double after = shape_cost(first) + shape_cost(second) + 2 * growth_cost(one, two) +
                         growth_cost(one, area(r.n[(k + 2) % 3])) + growth_cost(two, area(r.n[(k + 1) % 3])) +
                         growth_cost(one, area(s.n[(j + 1) % 3])) + growth_cost(two, area(s.n[(j + 2) % 3]));
    const double gain = cost(std::array{t, q.o}) - after - broken;
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
    const bool is_of_line = m_.nodes[node].is_laid && m_.nodes[node].is_kept;
    if (node < m_.n_boundary + 4 || is_of_line || !m_.ring_of(node, around_, tris_)) return;
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
    if (node < m_.n_boundary + 4 || n.is_kept || !m_.ring_of(node, around_, tris_)) return;
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
  double longest_ = 0;                  // sides about the node that may go, of the lengths asked for
  std::uint32_t clock_ = 0;             // counts the triangles that were tried
  std::vector<std::uint32_t> tried_;    // [triangles] when
  std::vector<std::uint32_t> touched_;  // [nodes] when something about them changed last
};

}  // namespace

void mend_flaws(FaceWork& work) { FlawMending(work).run(); }

}  // namespace st
