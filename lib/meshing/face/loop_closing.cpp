#include "meshing/face/loop_closing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/finite.h"
#include "mesh/adjacency.h"
#include "mesh/quality.h"
#include "meshing/face/face_check.h"
#include "meshing/face/least_area.h"

namespace st {
namespace {

constexpr std::size_t kMostCorners = 600;  // of a polygon that is triangulated at once; its cost is cubic
constexpr double kRepeated = 1e3;          // squared perimeters of the polygon: cost of a side that exists already
constexpr double kLong = 1.4;              // times the request: sides that are split
constexpr int kPasses = 40;                // of splitting, swapping and smoothing
constexpr std::size_t kMostInner = 200'000;
constexpr double kNear = 0.1;     // of the longest side of a triangle: its distance from the surface
constexpr double kSteep = 2;      // over the cosine of 60 degrees to the surface a triangle is as good as its shape
constexpr double kBetter = 1e-6;  // least gain in quality of a swap or a move

using Polygon = std::vector<std::int32_t>;  // node indices, the face on the left

class LoopClosing {
 public:
  LoopClosing(const Surface* surface, const FaceBoundary& boundary, const SizeField& field)
      : surface_(surface), field_(field), nodes_(boundary.nodes), first_inner_(nodes_.size()) {
    if (!std::ranges::all_of(nodes_, [](const FaceNode& n) { return is_finite(n.uv); })) surface_ = nullptr;
    for (const auto& [a, b] : boundary.segments) fixed_.insert(ids(a, b));
  }

  bool run(const FaceBoundary& boundary, bool splits) {
    std::vector<Polygon> loops = find_loops(boundary);
    if (loops.empty() || !triangulate(joined(std::move(loops)))) return false;
    split_repeated();
    most_inner_ = splits ? expected_inner() : 0;
    for (int pass = 0; splits && pass < kPasses; ++pass) {
      const bool has_split = split_long();
      for (int sweep = 0; sweep < 4 && swap_sides(); ++sweep) {
      }
      smooth();
      if (!has_split) break;
    }
    return true;
  }

  /// Returns whether a triangle is turned over.
  bool store(double allowed, ClosedFace& result) const {
    bool has_turned = false;
    result.mesh.inner.assign(nodes_.begin() + static_cast<std::ptrdiff_t>(first_inner_), nodes_.end());
    for (const Triangle& t : triangles_) {
      result.mesh.corners.insert(result.mesh.corners.end(), t.n, t.n + 3);
      if (!surface_) continue;
      const Vec3 a = nodes_[t.n[0]].x, b = nodes_[t.n[1]].x, c = nodes_[t.n[2]].x, middle = (a + b + c) / 3;
      const Vec2 uv = middle_uv(t.n[0], t.n[1], t.n[2]);
      const auto foot = project_near(*surface_, middle, uv);
      const double off = distance(middle, surface_->point(foot.value_or(uv)));
      const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
      const double height = norm(cross(b - a, c - a)) / longest;
      const bool is_turned = quality(t.n[0], t.n[1], t.n[2]) < 0 && height > allowed;
      result.deviation = std::max(result.deviation, off);
      result.is_near = result.is_near && !is_turned && (off <= allowed || off <= kNear * longest);
      has_turned = has_turned || is_turned;
    }
    result.is_near = result.is_near && surface_;
    return has_turned;
  }

 private:
  using IdPair = std::pair<std::int64_t, std::int64_t>;

  std::int64_t id(std::int32_t node) const {
    return nodes_[node].id == kNone ? (std::int64_t{1} << 31) + node : nodes_[node].id;
  }
  IdPair ids(std::int32_t a, std::int32_t b) const { return std::minmax({id(a), id(b)}); }

  /// Cycles of segments without steps of no length, and without ways to and fro.
  std::vector<Polygon> find_loops(const FaceBoundary& boundary) const {
    std::map<std::int32_t, std::int32_t> next(boundary.segments.begin(), boundary.segments.end());
    std::vector<Polygon> loops;
    while (!next.empty()) {
      Polygon loop;
      for (auto at = next.begin(); at != next.end();) {
        const std::int32_t to = at->second;
        next.erase(at);
        if (loop.empty() || id(to) != id(loop.back())) loop.push_back(to);
        at = next.find(to);
      }
      while (remove_spike(loop)) {
      }
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
  }

  bool remove_spike(Polygon& loop) const {
    for (std::size_t i = 0; loop.size() > 1 && i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size(), k = (i + 2) % loop.size();
      const bool is_step = id(loop[i]) == id(loop[j]);
      if (!is_step && id(loop[i]) != id(loop[k])) continue;
      if (is_step || loop.size() > 2) loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(j));
      if (loop.size() == 2 && !is_step) loop.clear();
      return true;
    }
    return false;
  }

  double length(const Polygon& loop) const {
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += distance(nodes_[loop[i]].x, nodes_[loop[(i + 1) % loop.size()]].x);
    return sum;
  }

  /// The shortest way from the polygon to a loop that is not in it yet.
  struct Way {
    double length2 = std::numeric_limits<double>::infinity();
    std::int32_t from = kNone;  // node of the polygon
    std::size_t to = 0;         // place in the loop
  };

  void shorten(Way& way, const Polygon& from, const Polygon& loop) const {
    for (const std::int32_t node : from)
      for (std::size_t j = 0; j < loop.size(); ++j)
        if (const double d = norm2(nodes_[node].x - nodes_[loop[j]].x); d < way.length2) way = {d, node, j};
  }

  /// One polygon: from the longest loop to the nearest node of another one and back, until all are in it. Quadratic in
  /// the nodes.
  Polygon joined(std::vector<Polygon> loops) const {
    const auto longest = std::max_element(loops.begin(), loops.end(),
                                          [&](const Polygon& a, const Polygon& b) { return length(a) < length(b); });
    Polygon all = std::move(*longest), latest = all;
    loops.erase(longest);
    std::vector<Way> ways(loops.size());
    while (!loops.empty()) {
      for (std::size_t l = 0; l < loops.size(); ++l) shorten(ways[l], latest, loops[l]);
      const auto nearest =
          std::min_element(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.length2 < b.length2; });
      const auto loop = loops.begin() + (nearest - ways.begin());
      latest = *loop;
      Polygon& added = *loop;
      std::rotate(added.begin(), added.begin() + static_cast<std::ptrdiff_t>(nearest->to), added.end());
      if (id(nearest->from) != id(added[0])) {  // there, around, and back
        added.push_back(added[0]);
        added.push_back(nearest->from);
      } else {
        std::rotate(added.begin(), added.begin() + 1, added.end());
      }
      all.insert(std::find(all.begin(), all.end(), nearest->from) + 1, added.begin(), added.end());
      loops.erase(loop);
      ways.erase(nearest);
    }
    return all;
  }

  /// Appends triangles; a polygon of many nodes by some of them first, then the rest between neighbours of these.
  bool triangulate(const Polygon& polygon) {
    const std::size_t n = polygon.size(), n_coarse = std::min(n, kMostCorners);
    std::vector<std::size_t> corner;
    for (std::size_t i = 0; i < n_coarse; ++i) {
      std::size_t at = i * n / n_coarse;
      while (!corner.empty() && at < n && (id(polygon[at]) == id(polygon[corner.back()]) || at <= corner.back())) ++at;
      if (at < n) corner.push_back(at);
    }
    while (corner.size() > 3 && id(polygon[corner.back()]) == id(polygon[0])) corner.pop_back();
    Polygon coarse;
    for (const std::size_t c : corner) coarse.push_back(polygon[c]);
    if (!triangulate_coarse(coarse)) return false;
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const std::size_t end = i + 1 < corner.size() ? corner[i + 1] : n;
      if (end - corner[i] < 2) continue;
      Polygon run;
      for (std::size_t at = corner[i]; at <= end; ++at) run.push_back(polygon[at % n]);
      if (!triangulate(run)) return false;
    }
    return true;
  }

  bool triangulate_coarse(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    std::vector<Vec3> x, middle(n * n);
    std::vector<std::int32_t> same;
    std::vector<double> side_cost(n * n, 0);
    const double repeated = kRepeated * length(polygon) * length(polygon);
    std::map<std::int64_t, std::int32_t> number;
    for (const std::int32_t p : polygon) {
      x.push_back(nodes_[p].x);
      same.push_back(number.emplace(id(p), static_cast<std::int32_t>(number.size())).first->second);
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        middle[i * n + j] = middle_of(polygon[i], polygon[j]).x;
        const bool is_side = j == i + 1 || (i == 0 && j == n - 1);
        if (!is_side && fixed_.contains(ids(polygon[i], polygon[j]))) side_cost[i * n + j] = repeated;
      }
    const auto triples = triangulate_least_area(std::move(x), std::move(same), std::move(middle), std::move(side_cost));
    for (const auto& [i, j, k] : triples) triangles_.push_back({{polygon[i], polygon[j], polygon[k]}});
    return triples.size() + 2 == n;
  }

  /// A node between two others, on the surface where that is near their chord.
  FaceNode middle_of(std::int32_t a, std::int32_t b) const {
    FaceNode n;
    n.uv = 0.5 * (nodes_[a].uv + nodes_[b].uv);
    n.x = surface_ ? surface_->point(n.uv) : 0.5 * (nodes_[a].x + nodes_[b].x);
    return n;
  }

  /// Sides inside that join the nodes of a segment, or of another side, get a node of their own.
  void split_repeated() {
    std::map<IdPair, int> n_sides;
    std::set<std::pair<NodeId, NodeId>> repeated;
    EdgeTable(triangles_, n_nodes()).for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> sides) {
      n_sides[ids(a, b)] += std::max(1, static_cast<int>(sides.size()) - 1);
      if (sides.size() > 1) repeated.insert({a, b});
    });
    std::erase_if(repeated, [&](const auto& side) { return n_sides[ids(side.first, side.second)] == 1; });
    while (split([&](NodeId a, NodeId b) { return repeated.contains({a, b}) ? 1 : 0; })) {
    }
  }

  /// Twice what the areas of the triangles and the lengths there explain, and as many as on the boundary.
  std::size_t expected_inner() {
    double n = static_cast<double>(first_inner_);
    for (const Triangle& t : triangles_) {
      const Vec3 a = nodes_[t.n[0]].x, b = nodes_[t.n[1]].x, c = nodes_[t.n[2]].x;
      const double h = std::max(1e-300, field_.size((a + b + c) / 3, hint_));
      n += 2 * norm(cross(b - a, c - a)) / (std::sqrt(3.0) * h * h);  // two triangles to a node
    }
    return static_cast<std::size_t>(std::min(static_cast<double>(kMostInner), n));
  }

  bool split_long() {
    if (nodes_.size() - first_inner_ > most_inner_) return false;
    return split([&](NodeId a, NodeId b) {
      const double ratio =
          distance(nodes_[a].x, nodes_[b].x) / std::max(1e-300, field_.size(0.5 * (nodes_[a].x + nodes_[b].x), hint_));
      return ratio > kLong ? ratio : 0;
    });
  }

  /// Splits sides inside, those of the largest `rank` first, each triangle once; 0: it stays. False when none was.
  template <class Rank>
  bool split(const Rank& rank) {
    struct Side {
      double rank;
      SideId a, b;
    };
    std::vector<Side> sides;
    EdgeTable(triangles_, n_nodes()).for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> uses) {
      if (uses.size() < 2) return;
      std::size_t other = 1;  // of the other direction
      while (other < uses.size() && run_alike(triangles_, uses[0], uses[other])) ++other;
      if (other == uses.size()) return;
      if (const double r = rank(a, b); r > 0) sides.push_back({r, uses[0], uses[other]});
    });
    std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.rank > b.rank; });
    std::vector<char> is_done(triangles_.size(), 0);
    for (const Side& s : sides) {
      if (is_done[s.a / 3] || is_done[s.b / 3]) continue;
      is_done[s.a / 3] = is_done[s.b / 3] = 1;
      split_side(s.a, s.b);
    }
    return !sides.empty();
  }

  void split_side(SideId one, SideId other) {
    const NodeId a = corner(one, 0), b = corner(one, 1);
    FaceNode middle = middle_of(a, b);
    middle.h = field_.size(middle.x, hint_);
    const auto m = static_cast<NodeId>(nodes_.size());
    nodes_.push_back(middle);
    for (const SideId side : {one, other}) {
      const NodeId from = corner(side, 0), to = corner(side, 1), apex = corner(side, 2);
      triangles_[side / 3] = {{from, m, apex}};
      triangles_.push_back({{m, to, apex}});
    }
  }

  Vec2 middle_uv(NodeId a, NodeId b, NodeId c) const {
    return (1.0 / 3) * (nodes_[a].uv + nodes_[b].uv + nodes_[c].uv);
  }
  NodeId corner(SideId side, int k) const { return triangles_[side / 3].n[(side % 3 + k) % 3]; }
  std::int64_t n_nodes() const { return static_cast<std::int64_t>(nodes_.size()); }

  /// 1: equilateral; less where it is steep to the surface, below 0 where it is turned over, in space or in (u,v).
  double quality(NodeId a, NodeId b, NodeId c) const {
    const FaceNode &p = nodes_[a], &q = nodes_[b], &r = nodes_[c];
    const double shape = triangle_quality(p.x, q.x, r.x);
    if (!surface_) return shape;
    const Vec3 normal = normalized(cross(q.x - p.x, r.x - p.x));
    const double steepness = dot(normal, surface_normal(*surface_, middle_uv(a, b, c)));
    if (cross(q.uv - p.uv, r.uv - p.uv) < 0) return -shape;
    return shape * std::min(1.0, kSteep * steepness);
  }

  bool swap_sides() {
    std::vector<IdPair> existing(fixed_.begin(), fixed_.end());  // pairs of nodes with a side
    std::set<IdPair> added;
    std::vector<std::pair<SideId, SideId>> inside;
    EdgeTable(triangles_, n_nodes()).for_each_edge([&](NodeId a, NodeId b, std::span<const SideId> uses) {
      existing.push_back(ids(a, b));
      if (uses.size() == 2) inside.push_back({uses[0], uses[1]});
    });
    std::sort(existing.begin(), existing.end());
    const auto is_side = [&](IdPair p) {
      return added.contains(p) || std::binary_search(existing.begin(), existing.end(), p);
    };
    std::vector<char> is_done(triangles_.size(), 0);
    bool has_swapped = false;
    for (const auto& [one, other] : inside) {
      if (is_done[one / 3] || is_done[other / 3]) continue;
      const NodeId a = corner(one, 0), b = corner(one, 1), c = corner(one, 2), d = corner(other, 2);
      if (id(c) == id(d) || is_side(ids(c, d))) continue;
      if (std::min(quality(c, a, d), quality(d, b, c)) <= std::min(quality(a, b, c), quality(b, a, d)) + kBetter)
        continue;
      if (!surface_ && bends_more(a, b, c, d)) continue;
      triangles_[one / 3] = {{c, a, d}};
      triangles_[other / 3] = {{d, b, c}};
      added.insert(ids(c, d));
      is_done[one / 3] = is_done[other / 3] = 1;
      has_swapped = true;
    }
    return has_swapped;
  }

  /// Without a surface to compare with: would the swap fold what was flatter?
  bool bends_more(NodeId a, NodeId b, NodeId c, NodeId d) const {
    const auto normal = [&](NodeId i, NodeId j, NodeId k) {
      return normalized(cross(nodes_[j].x - nodes_[i].x, nodes_[k].x - nodes_[i].x));
    };
    return dot(normal(c, a, d), normal(d, b, c)) < std::min(0.5, dot(normal(a, b, c), normal(b, a, d)));
  }

  /// Nodes inside move to the middle of their neighbours where the worst triangle around becomes better.
  void smooth() {
    std::vector<std::vector<std::int32_t>> around(nodes_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (const NodeId n : triangles_[t].n)
        if (n >= static_cast<NodeId>(first_inner_)) around[n].push_back(static_cast<std::int32_t>(t));
    for (std::size_t n = first_inner_; n < nodes_.size(); ++n) {
      Vec2 uv;
      Vec3 x;
      double count = 0;
      for (const std::int32_t t : around[n])
        for (const NodeId o : triangles_[t].n)
          if (o != static_cast<NodeId>(n)) uv = uv + nodes_[o].uv, x += nodes_[o].x, ++count;
      if (count == 0) continue;
      const FaceNode before = nodes_[n];
      const double worst = worst_of(around[n]);
      nodes_[n].uv = (1 / count) * uv;
      nodes_[n].x = surface_ ? surface_->point(nodes_[n].uv) : x / count;
      if (worst_of(around[n]) <= worst + kBetter) nodes_[n] = before;
    }
  }

  double worst_of(const std::vector<std::int32_t>& triangles) const {
    double worst = 1;
    for (const std::int32_t t : triangles) {
      const NodeId* n = triangles_[t].n;
      worst = std::min(worst, quality(n[0], n[1], n[2]));
    }
    return worst;
  }

  const Surface* surface_;
  const SizeField& field_;
  std::vector<FaceNode> nodes_;  // of the boundary, then inside
  const std::size_t first_inner_;
  std::set<IdPair> fixed_;  // segments of the loops
  std::vector<Triangle> triangles_;
  std::size_t most_inner_ = 0;  // nodes
  int hint_ = 0;
};

}  // namespace

ClosedFace close_loops(const Surface* surface, const FaceBoundary& boundary, const SizeField& field, double allowed) {
  ClosedFace result;
  for (const bool splits : {true, false}) {  // what is turned over is not made finer
    result = {};
    LoopClosing closing(surface, boundary, field);
    if (!closing.run(boundary, splits)) {
      result.mesh.cause = FailureCause::kShortLoops;
      return result;
    }
    if (!closing.store(allowed, result)) break;
  }
  check_edges(boundary, result.mesh);
  return result;
}

}  // namespace st
