#include "geometry/brep/loop_crossing.h"

#include <algorithm>

#include "base/predicates.h"
#include "geometry/shape/loop_polygons.h"

namespace st::occt {
namespace {

/// Where a side of the sampled loops lies.
struct Place {
  const CoedgeUv* coedge;
  int loop, position;  ///< number of the side along its loop
  double s_a, s_b;     ///< along the coedge, 0 to 1
};

struct Polygons {
  std::vector<LoopSide> sides;
  std::vector<Place> places;  ///< [sides]
  std::vector<int> n_sides;   ///< per loop
};

Polygons sides_of(const FaceDomain& d) {
  Polygons result;
  for (std::size_t l = 0; l < d.loops.size(); ++l) {
    const LoopUv& loop = d.loops[l];
    const std::size_t first = result.sides.size();
    for (const CoedgeUv& c : loop.coedges)
      for (std::size_t k = 0; k < c.polygon.size(); ++k) {
        result.places.push_back({&c, static_cast<int>(l), static_cast<int>(result.sides.size() - first),
                                 double(k) / c.polygon.size(), double(k + 1) / c.polygon.size()});
        result.sides.push_back({c.polygon[k], {}});
      }
    const std::size_t n = result.sides.size() - first;
    for (std::size_t k = 0; k < n; ++k) result.sides[first + k].b = result.sides[first + (k + 1) % n].a;
    result.n_sides.push_back(static_cast<int>(n));
  }
  return result;
}

Vec2 crossing_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double p = orient2d(c, d, a), q = orient2d(c, d, b);
  return a + (p / (p - q)) * (b - a);
}

/// The piece of trimming curve that a side stands for, sampled finely.
std::vector<Vec2> refined(const LoopSide& s, const Place& side) {
  if (side.coedge->is_line) return {s.a, s.b};
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
std::optional<Vec2> confirm(const Polygons& polygons, int s, int t) {
  const std::vector<Vec2> p = refined(polygons.sides[s], polygons.places[s]),
                          q = refined(polygons.sides[t], polygons.places[t]);
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = 0; j + 1 < q.size(); ++j)
      if (cross_properly({p[i], p[i + 1]}, {q[j], q[j + 1]})) return crossing_point(p[i], p[i + 1], q[j], q[j + 1]);
  return std::nullopt;
}

/// How far the shorter way along the loop from one side to the other leaves the crossing; of two loops: of the smaller
/// one.
double cut_off(const FaceDomain& d, const Polygons& polygons, const Place& s, const Place& t, Vec3 x) {
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
  std::optional<LoopCrossing> worst;
  for (const auto& [s, t] : crossing_sides(polygons.sides)) {
    const std::optional<Vec2> uv = confirm(polygons, s, t);
    if (!uv) continue;
    const Vec3 x = domain.surface->point(*uv);
    const double size = cut_off(domain, polygons, polygons.places[s], polygons.places[t], x);
    if (size > tolerance && (!worst || size > worst->size)) worst = LoopCrossing{x, size};
  }
  return worst;
}

}  // namespace st::occt
