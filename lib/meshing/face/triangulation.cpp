#include "meshing/face/triangulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/limits.h"
#include "base/morton.h"
#include "base/predicates.h"
#include "base/radix_sort.h"

namespace st {
namespace {

constexpr int kNext[3] = {1, 2, 0};
constexpr int kPrev[3] = {2, 0, 1};

/// Position along a Z-order of the quantised plane.
std::uint64_t morton_key(Vec2 p, Vec2 lo, double scale) {
  const auto quantised = [&](double x) {
    return static_cast<std::uint32_t>(std::clamp(x * scale, 0.0, 1.0) * (kCoordinateEnd - 1));
  };
  return morton::encode({quantised(p.x - lo.x), quantised(p.y - lo.y), 0});
}

}  // namespace

void Triangulation::start_box() {
  Vec2 lo = nodes[0].p, hi = lo;
  for (const MeshNode& n : nodes) {
    lo = {std::min(lo.x, n.p.x), std::min(lo.y, n.p.y)};
    hi = {std::max(hi.x, n.p.x), std::max(hi.y, n.p.y)};
  }
  const double margin = 3 * std::max({hi.x - lo.x, hi.y - lo.y, 1e-12});
  const Vec2 corners[4] = {{lo.x - margin, lo.y - margin},
                           {hi.x + margin, lo.y - margin},
                           {hi.x + margin, hi.y + margin},
                           {lo.x - margin, hi.y + margin}};
  const std::int32_t c = n_boundary;
  for (Vec2 corner : corners) {
    MeshNode n;
    n.p = corner;
    nodes.push_back(n);
  }
  triangles.clear();
  triangles.push_back({{c, c + 1, c + 2}, {kNone, kNone, 1}, 0, 0, kOutside});
  triangles.push_back({{c, c + 2, c + 3}, {0, kNone, kNone}, 0, 0, kOutside});
  node_triangle_.assign(nodes.size(), kNone);
  for (int k = 0; k < 3; ++k) node_triangle_[c + k] = 0;
  node_triangle_[c + 3] = 1;
}

std::vector<LoopConflict> Triangulation::build(const std::vector<std::pair<std::int32_t, std::int32_t>>& segments) {
  n_boundary = checked_id(nodes.size(), "nodes on the boundary of one face", kMaxTriangles / 4);
  std::vector<LoopConflict> conflicts;
  for (std::int32_t i = 0; i < n_boundary; ++i)  // a place that is no number has no side of a line
    if (!std::isfinite(nodes[i].p.x) || !std::isfinite(nodes[i].p.y)) conflicts.push_back({i, i, i, i});
  if (!conflicts.empty()) return conflicts;
  start_box();
  Vec2 lo = nodes[n_boundary].p, hi = nodes[n_boundary + 2].p;
  const double scale = 1.0 / std::max(hi.x - lo.x, hi.y - lo.y);
  std::vector<std::pair<std::uint64_t, std::int32_t>> order(n_boundary);
  for (std::int32_t i = 0; i < n_boundary; ++i) order[i] = {morton_key(nodes[i].p, lo, scale), i};
  std::sort(order.begin(), order.end());
  std::int32_t hint = 0;
  const auto insert = [&](std::size_t at) {
    const std::int32_t i = order[at].second;
    if (!insert_boundary_node(i, hint)) conflicts.push_back({i, i, i, i});
  };
  // in rounds, each of as many nodes as there are already, between these: cavities stay small (Amenta, Choi, Rote 2003)
  if (!order.empty()) insert(0);
  for (std::size_t step = std::bit_floor(order.size()); step > 0; step /= 2)
    for (std::size_t at = step; at < order.size(); at += 2 * step) insert(at);
  if (!conflicts.empty()) return conflicts;
  for (const auto& [a, b] : segments)
    if (const auto conflict = insert_segment(a, b)) conflicts.push_back(*conflict);
  if (conflicts.empty()) classify();
  return conflicts;
}

std::int32_t Triangulation::locate(Vec2 p, std::int32_t start) const {
  std::int32_t t = start, from = kNone;
  for (std::size_t step = 0; step < triangles.size() + 8; ++step) {
    const PlaneTriangle& r = triangles[t];
    int exit = -1;
    for (int k = 0; k < 3; ++k) {
      if (r.n[k] == from && from != kNone) continue;
      if (orient2d(nodes[r.v[k]].p, nodes[r.v[kNext[k]]].p, p) < 0) {
        exit = k;
        if (!(r.constrained >> k & 1)) break;
      }
    }
    if (exit < 0) return t;
    if ((r.constrained >> exit & 1) || r.n[exit] == kNone) return kNone;
    from = t;
    t = r.n[exit];
  }
  return kNone;
}

std::int32_t Triangulation::seen_from(std::int32_t node, Vec2 p) const {
  const std::int32_t t = triangle_towards(node, p);
  return t == kNone ? kNone : go_straight(nodes[node].p, p, t, kNext[index_of(t, node)]);
}

std::int32_t Triangulation::seen_left_of(std::int32_t a, std::int32_t b, Vec2 from, Vec2 p) const {
  int k = 0;
  const std::int32_t t = find_edge(a, b, k);
  if (t == kNone) return kNone;
  const bool is_apex_left = orient2d(from, p, nodes[triangles[t].v[kPrev[k]]].p) > 0;
  return go_straight(from, p, t, is_apex_left ? kNext[k] : kPrev[k]);
}

std::pair<std::int32_t, std::int32_t> Triangulation::side_met(std::int32_t node, Vec2 p) const {
  std::pair<std::int32_t, std::int32_t> met{kNone, kNone};
  const std::int32_t t = triangle_towards(node, p);
  if (t != kNone) go_straight(nodes[node].p, p, t, kNext[index_of(t, node)], &met);
  return met;
}

/// From triangle t on, which the way leaves across its edge `exit`, if it does; `met`: the edge that must stay there.
std::int32_t Triangulation::go_straight(Vec2 from, Vec2 p, std::int32_t t, int exit,
                                        std::pair<std::int32_t, std::int32_t>* met) const {
  for (std::size_t step = 0; step < triangles.size(); ++step) {
    const PlaneTriangle& r = triangles[t];
    if (orient2d(nodes[r.v[exit]].p, nodes[r.v[kNext[exit]]].p, p) >= 0) return t;
    const std::int32_t o = r.n[exit];
    if ((r.constrained >> exit & 1) || o == kNone) {
      if (met) *met = {r.v[exit], r.v[kNext[exit]]};
      return kNone;
    }
    const int entry = neighbour_index(o, t);
    t = o;
    exit = orient2d(from, p, nodes[triangles[o].v[kPrev[entry]]].p) > 0 ? kNext[entry] : kPrev[entry];
  }
  return kNone;  // p is no place
}

std::int32_t Triangulation::triangle_towards(std::int32_t node, Vec2 p) const {
  const Vec2 a = nodes[node].p;
  const std::int32_t first = node_triangle_[node];
  std::int32_t t = first;
  do {
    const PlaneTriangle& r = triangles[t];
    const int k = index_of(t, node);
    if (orient2d(a, nodes[r.v[kNext[k]]].p, p) >= 0 && orient2d(a, p, nodes[r.v[kPrev[k]]].p) > 0) return t;
    t = r.n[kPrev[k]];
  } while (t != first && t != kNone);
  return kNone;
}

// Each node is seen from p once, and each product of two such sights is computed once. The circles are plain doubles:
// validity never rests on them.
bool Triangulation::find_cavity(Vec2 p, const Metric& metric, std::int32_t start) {
  cavity_.clear();
  ring_.clear();
  stack_.clear();
  cavity_.push_back(start);
  Vec2 seen[3];
  double seen2[3];
  for (int k = 0; k < 3; ++k) {
    seen[k] = nodes[triangles[start].v[k]].p - p;
    seen2[k] = metric.length2(seen[k]);
  }
  for (int k = 2; k >= 0; --k) {
    const int l = kNext[k];
    stack_.push_back({start, k, seen[k], seen[l], seen2[k], seen2[l], cross(seen[l], seen[k])});
  }
  while (!stack_.empty()) {
    CavitySide side = stack_.back();
    stack_.pop_back();
    for (;;) {  // over the triangles that join, along the first of their two other sides
      const PlaneTriangle& r = triangles[side.t];
      const int k = side.k;
      const std::int32_t a = r.v[k], b = r.v[kNext[k]], other = r.n[k];
      const bool constrained = r.constrained >> k & 1, may_join = !constrained && other != kNone;
      const bool must_join = side.t == start && orient2d_between(side.a, side.b, nodes[a].p, nodes[b].p, p) <= 0;
      if (must_join && !may_join) return false;
      const int j = other == kNone ? 0 : neighbour_index(other, side.t);
      if (may_join) {
        const Vec2& apex = nodes[triangles[other].v[kPrev[j]]].p;
        const Vec2 c = apex - p;
        const double c2 = metric.length2(c), a_by_c = cross(side.a, c), b_by_c = cross(side.b, c);
        // the circle through b, a and the apex holds p, and both other sides are strictly seen from p
        if ((must_join || side.b2 * a_by_c - side.a2 * b_by_c + c2 * side.b_by_a > 0) &&
            orient2d_between(side.a, c, nodes[a].p, apex, p) > 0 &&
            orient2d_between(c, side.b, apex, nodes[b].p, p) > 0) {
          cavity_.push_back(other);
          stack_.push_back({other, kPrev[j], c, side.b, c2, side.b2, b_by_c});
          side = {other, kNext[j], side.a, c, side.a2, c2, -a_by_c};
          continue;
        }
        if (must_join) return false;
      }
      ring_.push_back({a, b, other, static_cast<std::int8_t>(j), constrained, (r.toggles >> k & 1) != 0});
      break;
    }
  }
  return true;
}

void Triangulation::fill_cavity(std::int32_t node) {
  const std::size_t n = ring_.size();
  fan_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i < cavity_.size()) {
      fan_[i] = cavity_[i];
    } else {
      fan_[i] = static_cast<std::int32_t>(triangles.size());
      triangles.emplace_back();
    }
  }
  const std::uint8_t state = triangles[cavity_[0]].state;
  for (std::size_t i = 0; i < n; ++i) {
    const RingEdge& e = ring_[i];
    PlaneTriangle& r = triangles[fan_[i]];
    r = {{e.a, e.b, node},
         {e.outer, fan_[i + 1 == n ? 0 : i + 1], fan_[i == 0 ? n - 1 : i - 1]},
         static_cast<std::uint8_t>(e.constrained ? 1 : 0),
         static_cast<std::uint8_t>(e.toggles ? 1 : 0),
         state == kOutside ? static_cast<std::uint8_t>(kOutside) : static_cast<std::uint8_t>(kUnfinished)};
    if (e.outer != kNone) triangles[e.outer].n[e.outer_side] = fan_[i];
    node_triangle_[e.a] = fan_[i];
  }
  node_triangle_[node] = fan_[0];
}

bool Triangulation::insert_boundary_node(std::int32_t node, std::int32_t& hint) {
  const Vec2 p = nodes[node].p;
  const std::int32_t t = locate(p, hint);
  if (t == kNone) return false;
  for (std::int32_t v : triangles[t].v)
    if (nodes[v].p == p) return false;
  if (!find_cavity(p, Metric{}, t)) return false;
  fill_cavity(node);
  hint = fan_[0];
  return true;
}

std::int32_t Triangulation::find_edge(std::int32_t a, std::int32_t b, int& k) const {
  const std::int32_t first = node_triangle_[a];
  const auto has_it = [&](std::int32_t t) {
    k = index_of(t, a);
    return triangles[t].v[kNext[k]] == b;
  };
  std::int32_t t = first;
  do {  // counter-clockwise about a
    if (has_it(t)) return t;
    t = triangles[t].n[kPrev[k]];
  } while (t != first && t != kNone);
  if (t == first) return kNone;
  for (t = first; t != kNone; t = triangles[t].n[k])  // a corner of the box: those clockwise from the first, too
    if (has_it(t)) return t;
  return kNone;
}

void Triangulation::mark(std::int32_t t, int k) {
  triangles[t].constrained |= static_cast<std::uint8_t>(1 << k);
  triangles[t].toggles ^= static_cast<std::uint8_t>(1 << k);
  const std::int32_t o = triangles[t].n[k];
  if (o == kNone) return;
  const int j = neighbour_index(o, t);
  triangles[o].constrained |= static_cast<std::uint8_t>(1 << j);
  triangles[o].toggles ^= static_cast<std::uint8_t>(1 << j);
}

std::optional<LoopConflict> Triangulation::insert_segment(std::int32_t a, std::int32_t b) {
  if (auto conflict = force_edge(a, b)) return conflict;
  int k = 0;
  const std::int32_t t = find_edge(a, b, k);
  mark(t, k);
  return std::nullopt;
}

bool Triangulation::force_side(std::int32_t a, std::int32_t b) {
  if (force_edge(a, b)) return false;
  int k = 0;
  const std::int32_t t = find_edge(a, b, k);
  constrain(t, k);
  return true;
}

bool Triangulation::is_fixed(std::int32_t a, std::int32_t b) const {
  int k = 0;
  const std::int32_t t = find_edge(a, b, k);
  return t != kNone && (triangles[t].constrained >> k & 1);
}

void Triangulation::release_side(std::int32_t a, std::int32_t b) {
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    int k = 0;
    const std::int32_t t = find_edge(from, to, k);
    if (t != kNone) triangles[t].constrained &= static_cast<std::uint8_t>(~(1 << k));
  }
}

std::pair<std::int32_t, std::int32_t> Triangulation::left_of(std::int32_t a, std::int32_t b) const {
  int k = 0;
  const std::int32_t t = find_edge(a, b, k);
  return t == kNone ? std::pair{kNone, kNone} : std::pair{t, triangles[t].v[kPrev[k]]};
}

// Forces the edge a-b by swapping the edges it crosses (Sloan 1993).
std::optional<LoopConflict> Triangulation::force_edge(std::int32_t a, std::int32_t b) {
  int k;
  if (find_edge(a, b, k) != kNone) return std::nullopt;
  const Vec2 pa = nodes[a].p, pb = nodes[b].p;
  std::vector<std::pair<std::int32_t, std::int32_t>> crossing;
  // first triangle about a whose far edge the segment crosses
  std::int32_t t = node_triangle_[a];
  const std::int32_t first = t;
  for (;;) {
    const int i = index_of(t, a);
    const std::int32_t r = triangles[t].v[kNext[i]], l = triangles[t].v[kPrev[i]];
    const double side_r = orient2d(pa, pb, nodes[r].p), side_l = orient2d(pa, pb, nodes[l].p);
    if (side_r == 0 && dot(nodes[r].p - pa, pb - pa) > 0) return LoopConflict{a, b, r, r};
    if (side_r < 0 && side_l > 0) break;
    t = triangles[t].n[kPrev[i]];
    if (t == first || t == kNone) return LoopConflict{a, b, a, a};
  }
  int edge = kNext[index_of(t, a)];
  for (;;) {
    const PlaneTriangle& r = triangles[t];
    const std::int32_t v = r.v[edge], w = r.v[kNext[edge]];
    if (r.constrained >> edge & 1) return LoopConflict{a, b, v, w};
    crossing.push_back({v, w});
    const std::int32_t o = r.n[edge];
    const int j = neighbour_index(o, t);
    const std::int32_t apex = triangles[o].v[kPrev[j]];
    if (apex == b) break;
    const double side = orient2d(pa, pb, nodes[apex].p);
    if (side == 0) return LoopConflict{a, b, apex, apex};
    t = o;
    edge = side > 0 ? kNext[j] : kPrev[j];  // leave across the edge whose ends lie on both sides
  }
  std::size_t guard = 0;
  const std::size_t limit = 64 + 16 * crossing.size() * (1 + crossing.size() / 16);
  for (std::size_t head = 0; head < crossing.size(); ++head) {
    if (++guard > limit) return LoopConflict{a, b, crossing[head].first, crossing[head].second};
    const auto [v, w] = crossing[head];
    const std::int32_t s = find_edge(v, w, k);
    if (s == kNone) continue;
    if (!can_swap(s, k)) {
      crossing.push_back({v, w});
      continue;
    }
    const std::int32_t c = triangles[s].v[kPrev[k]];
    const std::int32_t o = triangles[s].n[k];
    const std::int32_t d = triangles[o].v[kPrev[neighbour_index(o, s)]];
    swap(s, k);
    if (c == a || c == b || d == a || d == b) continue;
    if ((orient2d(pa, pb, nodes[c].p) > 0) != (orient2d(pa, pb, nodes[d].p) > 0)) crossing.push_back({c, d});
  }
  if (find_edge(a, b, k) == kNone) return LoopConflict{a, b, a, b};
  return std::nullopt;
}

void Triangulation::adopt(std::int32_t n_fixed, std::vector<MeshNode> part,
                          const std::vector<std::array<std::int32_t, 3>>& corners) {
  nodes = std::move(part);
  nodes.insert(nodes.begin() + n_fixed, 4, MeshNode());
  n_boundary = n_fixed;
  node_triangle_.assign(nodes.size(), kNone);
  triangles.clear();
  std::vector<std::array<std::int32_t, 4>> sides;  // lower and higher node, triangle, side
  for (const auto& own : corners) {
    const auto t = static_cast<std::int32_t>(triangles.size());
    PlaneTriangle& fresh = triangles.emplace_back(PlaneTriangle{{}, {kNone, kNone, kNone}, 0, 0, kFinished});
    for (int k = 0; k < 3; ++k) fresh.v[k] = own[k] < n_fixed ? own[k] : own[k] + 4;
    for (int k = 0; k < 3; ++k) {
      node_triangle_[fresh.v[k]] = t;
      const auto [low, high] = std::minmax({fresh.v[k], fresh.v[kNext[k]]});
      sides.push_back({low, high, t, k});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& [low, high, t, k] = sides[i];
    if (i + 1 < sides.size() && sides[i + 1][0] == low && sides[i + 1][1] == high) {
      const auto& [low2, high2, t2, k2] = sides[++i];
      triangles[t].n[k] = t2;
      triangles[t2].n[k2] = t;
    } else {
      triangles[t].constrained |= static_cast<std::uint8_t>(1 << k);
    }
  }
}

void Triangulation::constrain(std::int32_t t, int k) {
  triangles[t].constrained |= static_cast<std::uint8_t>(1 << k);
  const std::int32_t o = triangles[t].n[k];
  if (o != kNone) triangles[o].constrained |= static_cast<std::uint8_t>(1 << neighbour_index(o, t));
}

bool Triangulation::can_swap(std::int32_t t, int k) const {
  const PlaneTriangle& r = triangles[t];
  if ((r.constrained >> k & 1) || r.n[k] == kNone) return false;
  const PlaneTriangle& o = triangles[r.n[k]];
  const Vec2 a = nodes[r.v[k]].p, b = nodes[r.v[kNext[k]]].p, c = nodes[r.v[kPrev[k]]].p;
  const Vec2 d = nodes[o.v[kPrev[neighbour_index(r.n[k], t)]]].p;
  return orient2d(c, a, d) > 0 && orient2d(c, d, b) > 0;
}

void Triangulation::swap(std::int32_t t, int k) {
  const std::int32_t o = triangles[t].n[k];
  const int j = neighbour_index(o, t);
  const PlaneTriangle r = triangles[t], s = triangles[o];
  const std::int32_t a = r.v[k], b = r.v[kNext[k]], c = r.v[kPrev[k]], d = s.v[kPrev[j]];
  const auto bit = [](std::uint8_t bits, int i) { return bits >> i & 1; };
  const int kn = kNext[k], kp = kPrev[k], jn = kNext[j], jp = kPrev[j];
  // t = (c, a, d), o = (c, d, b); edges: t: c-a (old r.kp), a-d (old s.jn), d-c; o: c-d, d-b (old s.jp), b-c (old r.kn)
  triangles[t] = {{c, a, d},
                  {r.n[kp], s.n[jn], o},
                  static_cast<std::uint8_t>(bit(r.constrained, kp) | bit(s.constrained, jn) << 1),
                  static_cast<std::uint8_t>(bit(r.toggles, kp) | bit(s.toggles, jn) << 1),
                  r.state};
  triangles[o] = {{c, d, b},
                  {t, s.n[jp], r.n[kn]},
                  static_cast<std::uint8_t>(bit(s.constrained, jp) << 1 | bit(r.constrained, kn) << 2),
                  static_cast<std::uint8_t>(bit(s.toggles, jp) << 1 | bit(r.toggles, kn) << 2),
                  s.state};
  if (s.n[jn] != kNone) triangles[s.n[jn]].n[neighbour_index(s.n[jn], o)] = t;
  if (r.n[kn] != kNone) triangles[r.n[kn]].n[neighbour_index(r.n[kn], t)] = o;
  node_triangle_[a] = t;
  node_triangle_[b] = o;
  node_triangle_[c] = t;
  node_triangle_[d] = t;
}

void Triangulation::classify() {
  std::vector<std::int32_t> stack{node_triangle_[n_boundary]};
  std::vector<char> seen(triangles.size(), 0);
  seen[stack[0]] = 1;
  triangles[stack[0]].state = kOutside;
  while (!stack.empty()) {
    const std::int32_t t = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const std::int32_t o = triangles[t].n[k];
      if (o == kNone || seen[o]) continue;
      seen[o] = 1;
      const bool toggles = triangles[t].toggles >> k & 1;
      triangles[o].state = (triangles[t].state == kOutside) != toggles ? kOutside : kUnfinished;
      stack.push_back(o);
    }
  }
}

bool Triangulation::ring_of(std::int32_t node, std::vector<std::int32_t>& around,
                            std::vector<std::int32_t>& tris) const {
  around.clear();
  tris.clear();
  return visit_ring(node, [&](std::int32_t next, std::int32_t t) {
    around.push_back(next);
    tris.push_back(t);
  });
}

void Triangulation::collapse(std::int32_t node, int target_index, const std::vector<std::int32_t>& around,
                             const std::vector<std::int32_t>& tris) {
  const int n = static_cast<int>(around.size());
  const std::int32_t target = around[target_index];
  // the two triangles at the edge (node, target) vanish: tris[target_index] and the one before it
  const int gone[2] = {target_index, (target_index + n - 1) % n};
  for (int g : gone) {
    const std::int32_t t = tris[g];
    const PlaneTriangle r = triangles[t];
    const int i = index_of(t, node);
    const int j = index_of(t, target);
    // across the edge opposite to the node, and across the edge opposite to the target
    const int edge_far = kNext[i];   // opposite to node
    const int edge_near = kNext[j];  // opposite to target
    const std::int32_t far = r.n[edge_far], near = r.n[edge_near];
    const bool constrained = r.constrained >> edge_far & 1, toggles = r.toggles >> edge_far & 1;
    if (near != kNone) {
      const int q = neighbour_index(near, t);
      triangles[near].n[q] = far;
      if (constrained) triangles[near].constrained |= static_cast<std::uint8_t>(1 << q);
      if (toggles) triangles[near].toggles |= static_cast<std::uint8_t>(1 << q);
    }
    if (far != kNone) triangles[far].n[neighbour_index(far, t)] = near;
    const std::int32_t third = r.v[3 - i - j];
    node_triangle_[third] = near;
    triangles[t].state = kDead;
  }
  for (int q = 0; q < n; ++q) {
    if (q == gone[0] || q == gone[1]) continue;
    triangles[tris[q]].v[index_of(tris[q], node)] = target;
    node_triangle_[target] = tris[q];
  }
  node_triangle_[node] = kNone;
}

void Triangulation::sort_along_curve() {
  renumber_nodes(order_along_curve());
  renumber_triangles();
}

/// Of the inner nodes.
std::vector<std::int32_t> Triangulation::order_along_curve() const {
  constexpr std::uint32_t kCells = 1024;  // along a side: keys are short, and few nodes have a common one
  const Vec2 lo = nodes[n_boundary].p, hi = nodes[n_boundary + 2].p;
  const double scale = kCells / std::max(hi.x - lo.x, hi.y - lo.y);
  struct Place {
    std::uint64_t key;
    std::int32_t node;
  };
  std::vector<Place> places, other;
  for (auto i = static_cast<std::size_t>(n_boundary) + 4; i < nodes.size(); ++i) {
    const auto cell = [&](double d) { return static_cast<std::uint32_t>(d * scale); };
    const Vec2 d = nodes[i].p - lo;
    places.push_back({morton::encode({cell(d.x), cell(d.y), 0}), static_cast<std::int32_t>(i)});
  }
  radix_sort(places, other, [](const Place& p) { return p.key; });
  std::vector<std::int32_t> order;
  for (const Place& p : places) order.push_back(p.node);
  return order;
}

void Triangulation::renumber_nodes(const std::vector<std::int32_t>& order) {
  const std::int32_t first = n_boundary + 4;
  std::vector<std::int32_t> number(nodes.size());
  std::iota(number.begin(), number.end(), 0);
  std::vector<MeshNode> sorted(nodes.begin(), nodes.begin() + first);
  sorted.reserve(nodes.size());
  for (const std::int32_t node : order) {
    number[node] = static_cast<std::int32_t>(sorted.size());
    sorted.push_back(nodes[node]);
  }
  nodes = std::move(sorted);
  std::vector<std::int32_t> triangle_at(node_triangle_.size());
  for (std::size_t i = 0; i < number.size(); ++i) triangle_at[number[i]] = node_triangle_[i];
  node_triangle_ = std::move(triangle_at);
  for (PlaneTriangle& t : triangles)
    for (std::int32_t& v : t.v) v = number[v];
}

/// By the least inner node.
void Triangulation::renumber_triangles() {
  std::vector<std::int32_t> number(triangles.size(), kNone);
  std::vector<PlaneTriangle> sorted;
  sorted.reserve(triangles.size());
  const auto take = [&](std::int32_t t) {
    if (number[t] != kNone) return;
    number[t] = static_cast<std::int32_t>(sorted.size());
    sorted.push_back(triangles[t]);
  };
  for (std::int32_t i = n_boundary + 4; i < static_cast<std::int32_t>(nodes.size()); ++i)
    visit_ring(i, [&](std::int32_t, std::int32_t t) { take(t); });
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(number.size()); ++t) take(t);
  for (PlaneTriangle& t : sorted)
    for (std::int32_t& n : t.n)
      if (n != kNone) n = number[n];
  for (std::int32_t& t : node_triangle_)
    if (t != kNone) t = number[t];
  triangles = std::move(sorted);
}

}  // namespace st
