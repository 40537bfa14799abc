#include "geometry/brep/loop_crossing.h"

#include <algorithm>
#include <numeric>

#include "base/predicates.h"

namespace st::occt {
namespace {

/// A side of the sampled loops.
struct Side {
  Vec2 a, b;
  const CoedgeUv* coedge;
  int loop, position;  ///< number of the side along its loop
  double s_a, s_b;     ///< along the coedge, 0 to 1
};

struct Polygons {
  std::vector<Side> sides;
  std::vector<int> n_sides;  ///< per loop
};

Polygons sides_of(const FaceDomain& d) {
  Polygons result;
  for (std::size_t l = 0; l < d.loops.size(); ++l) {
    const LoopUv& loop = d.loops[l];
    const std::size_t first = result.sides.size();
    for (const CoedgeUv& c : loop.coedges)
      for (std::size_t k = 0; k < c.polygon.size(); ++k)
        result.sides.push_back({c.polygon[k],
                                {},
                                &c,
                                static_cast<int>(l),
                                static_cast<int>(result.sides.size() - first),
                                double(k) / c.polygon.size(),
                                double(k + 1) / c.polygon.size()});
    const std::size_t n = result.sides.size() - first;
    for (std::size_t k = 0; k < n; ++k) result.sides[first + k].b = result.sides[first + (k + 1) % n].a;
    result.n_sides.push_back(static_cast<int>(n));
  }
  return result;
}

/// Both cross each other inside; touching is not crossing.
bool cross_inside(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0;
}

Vec2 crossing_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double p = orient2d(c, d, a), q = orient2d(c, d, b);
  return a + (p / (p - q)) * (b - a);
}

/// The piece of trimming curve that a side stands for, sampled finely.
std::vector<Vec2> refined(const Side& side) {
  if (side.coedge->is_line) return {side.a, side.b};
  constexpr int kPieces = 16;
  std::vector<Vec2> p;
  const auto at = [&](double s) {
    const gp_Pnt2d x =
        side.coedge->curve->Value(side.coedge->t_start + s * (side.coedge->t_end - side.coedge->t_start));
    return Vec2{x.X(), x.Y()};
  };
  for (int k = 0; k <= kPieces; ++k) p.push_back(at(side.s_a + (side.s_b - side.s_a) * k / kPieces));
  return p;
}

/// The crossing of the finely sampled pieces of two sides: chords may cross where the curves do not.
std::optional<Vec2> confirm(const Side& s, const Side& t) {
  const std::vector<Vec2> p = refined(s), q = refined(t);
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = 0; j + 1 < q.size(); ++j)
      if (cross_inside(p[i], p[i + 1], q[j], q[j + 1])) return crossing_point(p[i], p[i + 1], q[j], q[j + 1]);
  return std::nullopt;
}

/// How far the shorter way along the loop from one side to the other leaves the crossing; of two loops: of the smaller
/// one.
double cut_off(const FaceDomain& d, const Polygons& polygons, const Side& s, const Side& t, Vec3 x) {
  const auto extent = [&](int loop, int from, int n_steps) {
    double largest = 0;
    int first = 0;
    for (int l = 0; l < loop; ++l) first += polygons.n_sides[l];
    for (int k = 0; k < n_steps; ++k)
      largest = std::max(largest,
                         distance(x, d.surface->point(polygons.sides[first + (from + k) % polygons.n_sides[loop]].a)));
    return largest;
  };
  if (s.loop != t.loop)
    return std::min(extent(s.loop, 0, polygons.n_sides[s.loop]), extent(t.loop, 0, polygons.n_sides[t.loop]));
  const int n = polygons.n_sides[s.loop], forward = (t.position - s.position + n) % n;
  return std::min(extent(s.loop, s.position + 1, forward), extent(s.loop, t.position + 1, n - forward));
}

}  // namespace

std::optional<LoopCrossing> find_loop_crossing(const FaceDomain& domain, double tolerance) {
  const Polygons polygons = sides_of(domain);
  const std::vector<Side>& sides = polygons.sides;
  std::vector<int> order(sides.size());
  std::iota(order.begin(), order.end(), 0);
  const auto left = [&](int i) { return std::min(sides[i].a.x, sides[i].b.x); };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return left(i) != left(j) ? left(i) < left(j) : i < j; });
  std::optional<LoopCrossing> worst;
  for (std::size_t m = 0; m < order.size(); ++m) {
    const Side& s = sides[order[m]];
    const double right = std::max(s.a.x, s.b.x), low = std::min(s.a.y, s.b.y), high = std::max(s.a.y, s.b.y);
    for (std::size_t k = m + 1; k < order.size() && left(order[k]) <= right; ++k) {
      const Side& t = sides[order[k]];
      if (std::min(t.a.y, t.b.y) > high || std::max(t.a.y, t.b.y) < low || !cross_inside(s.a, s.b, t.a, t.b)) continue;
      const std::optional<Vec2> uv = confirm(s, t);
      if (!uv) continue;
      const Vec3 x = domain.surface->point(*uv);
      const double size = cut_off(domain, polygons, s, t, x);
      if (size > tolerance && (!worst || size > worst->size)) worst = LoopCrossing{x, size};
    }
  }
  return worst;
}

}  // namespace st::occt
