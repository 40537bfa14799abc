#include "geometry/shape/flatten_coarse.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lists_by_key.h"
#include "geometry/shape/coarse_patch.h"
#include "geometry/shape/flatten.h"

namespace st {
namespace {

constexpr std::size_t kCoarse = 2000;  // triangles that are solved together
constexpr int kSweeps = 2;             // over all nodes, when they are back
constexpr int kMostHalvings = 12;
constexpr double kLeastHeight = 1e-3;  // of the longest side: flatter triangles are taken to be so high
constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Places = std::vector<Vec2>;

/// A triangle around a node whose two other nodes stay, in terms of the node's place p: the Jacobian is
/// p gradient^T + rest.
struct StarTriangle {
  Vec2 gradient;      ///< of the node's hat function in the triangle's own plane
  Vec2 row_x, row_y;  ///< of `rest`
  double area;
};

/// The triangle (node, a, b) in space, a and b at pa and pb in the plane.
StarTriangle make_star_triangle(Vec3 node, Vec3 a, Vec3 b, Vec2 pa, Vec2 pb) {
  const Vec3 side = b - a, to = node - a;
  const double longest = std::sqrt(std::max({norm2(side), norm2(to), norm2(node - b)}));
  const double base = std::max(norm(side), kLeastHeight * longest), along = dot(to, side) / base;
  const double height = std::max(norm(cross(side, to)) / base, kLeastHeight * longest);
  // in the frame of the side: a is (0, 0), b is (base, 0), the node is (along, height)
  const Vec2 ga{-1 / base, (along / base - 1) / height}, gb{1 / base, -along / (base * height)}, gn{0, 1 / height};
  return {gn, pa.x * ga + pb.x * gb, pa.y * ga + pb.y * gb, 0.5 * base * height};
}

/// The symmetric Dirichlet energy of the triangles around a node, by its place.
class StarEnergy {
 public:
  void clear() { triangles_.clear(); }
  void add(const StarTriangle& t) { triangles_.push_back(t); }

  /// Infinite where a triangle is flipped.
  double operator()(Vec2 p) const {
    double sum = 0;
    for (const StarTriangle& t : triangles_) {
      const Vec2 jx = p.x * t.gradient + t.row_x, jy = p.y * t.gradient + t.row_y;
      const double det = cross(jx, jy);
      if (!(det > 0)) return kInfinite;
      sum += t.area * (dot(jx, jx) + dot(jy, jy)) * (1 + 1 / (det * det));
    }
    return sum;
  }

  /// Towards the lowest energy, by a step of Newton with what makes its matrix positive.
  Vec2 direction(Vec2 p) const {
    Vec2 g{};
    double hxx = 0, hxy = 0, hyy = 0;
    for (const StarTriangle& t : triangles_) {
      const Vec2 jx = p.x * t.gradient + t.row_x, jy = p.y * t.gradient + t.row_y;
      const double det = cross(jx, jy), f = dot(jx, jx) + dot(jy, jy), d = 1 / (det * det), d1 = -2 * d / det,
                   d2 = 6 * d * d;
      const Vec2 df{2 * dot(jx, t.gradient), 2 * dot(jy, t.gradient)};
      const Vec2 q{cross(t.gradient, jy), -cross(t.gradient, jx)};  // of the determinant
      g = g + t.area * ((1 + d) * df + (f * d1) * q);
      const double own = 2 * (1 + d) * dot(t.gradient, t.gradient);
      hxx += t.area * (own + f * d2 * q.x * q.x);
      hxy += t.area * f * d2 * q.x * q.y;
      hyy += t.area * (own + f * d2 * q.y * q.y);
    }
    const double det = hxx * hyy - hxy * hxy;
    return {-(hyy * g.x - hxy * g.y) / det, -(hxx * g.y - hxy * g.x) / det};
  }

 private:
  std::vector<StarTriangle> triangles_;
};

/// Moves a node that has a place without flips down in energy.
void improve(const StarEnergy& energy, Vec2& p) {
  const Vec2 way = energy.direction(p);
  const double before = energy(p);
  double share = 1;
  for (int i = 0; i < kMostHalvings; ++i, share *= 0.5)
    if (const Vec2 q = p + share * way; energy(q) < before) {
      p = q;
      return;
    }
}

class Refinement {
 public:
  Refinement(std::span<const Vec3> x, const CoarsePatch& coarse, const Places& coarse_places)
      : x_(x), coarse_(coarse), p_(x.size()) {
    for (std::size_t i = 0; i < coarse.node.size(); ++i) p_[coarse.node[i]] = coarse_places[i];
  }

  std::optional<Places> run(std::span<const Corners> corners) {
    for (std::size_t i = coarse_.removed.size(); i-- > 0;)
      if (!put_back(coarse_.removed[i])) return std::nullopt;
    even_out(corners);
    return std::move(p_);
  }

 private:
  /// False where rounding leaves no place.
  bool put_back(const RemovedNode& r) {
    const auto ring = coarse_.ring_of(r);
    const std::size_t n_sides = r.is_rim ? ring.size() - 1 : ring.size();
    energy_.clear();
    for (std::size_t k = 0; k < n_sides; ++k) {
      const std::int32_t a = ring[k], b = ring[(k + 1) % ring.size()];
      energy_.add(make_star_triangle(x_[r.node], x_[a], x_[b], p_[a], p_[b]));
    }
    const Vec2 from = p_[r.is_from_end ? ring.back() : ring.front()];
    Vec2 way = guess(r.node, ring, r.is_rim) - from;
    Vec2& p = p_[r.node];
    for (const bool is_safe : {false, true}) {
      if (is_safe) way = safe_way(ring, r);
      double share = 1;
      for (int i = 0; i < kMostHalvings; ++i, share *= 0.5) {
        p = from + share * way;
        if (!(energy_(p) < kInfinite)) continue;
        improve(energy_, p);
        return true;
      }
    }
    return false;
  }

  /// Mean values of the ring (Floater 2003), on the rim the share between both neighbours.
  Vec2 guess(std::int32_t node, std::span<const std::int32_t> ring, bool is_rim) const {
    if (is_rim) {
      const double a = distance(x_[node], x_[ring.front()]), b = distance(x_[node], x_[ring.back()]);
      return (b / (a + b)) * p_[ring.front()] + (a / (a + b)) * p_[ring.back()];
    }
    double sum = 0;
    Vec2 place{};
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::int32_t ra = ring[k], rb = ring[(k + 1) % ring.size()];
      const Vec3 a = x_[ra] - x_[node], b = x_[rb] - x_[node];
      const double la = norm(a), lb = norm(b), half = norm(cross(a, b)) / (la * lb + dot(a, b));  // tan of half
      place = place + (half / la) * p_[ra] + (half / lb) * p_[rb];
      sum += half / la + half / lb;
    }
    return (1 / sum) * place;
  }

  /// A way from where the fan starts into it: near there all the ring is seen. On the rim it is at most a right angle
  /// away from the only side of the fan that binds.
  Vec2 safe_way(std::span<const std::int32_t> ring, const RemovedNode& r) const {
    const std::size_t n = ring.size(), at = r.is_from_end ? n - 1 : 0;
    const Vec2 from = p_[ring[at]], first = p_[ring[(at + 1) % n]] - from, last = p_[ring[(at + n - 1) % n]] - from;
    double turn = std::atan2(cross(first, last), dot(first, last));
    if (turn < 0) turn += 2 * kPi;
    const double own = r.is_rim ? std::min(turn, 0.5 * kPi) : 0.5 * turn;
    const double length = std::min(norm(first), norm(last));
    const auto turned = [&](Vec2 side, double angle) {
      const double c = std::cos(angle), s = std::sin(angle);
      return (length / norm(side)) * Vec2{c * side.x - s * side.y, s * side.x + c * side.y};
    };
    return r.is_from_end ? turned(last, -own) : turned(first, own);
  }

  void even_out(std::span<const Corners> corners) {
    const ListsByKey<> star(x_.size(), [&](const auto& visit) {
      for (std::size_t i = 0; i < 3 * corners.size(); ++i) visit(corners[i / 3][i % 3], static_cast<std::int32_t>(i));
    });
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (std::size_t n = 0; n < x_.size(); ++n) {
        energy_.clear();
        for (const std::int32_t i : star[n]) {
          const Corners& c = corners[i / 3];
          const std::int32_t a = c[(i + 1) % 3], b = c[(i + 2) % 3];
          energy_.add(make_star_triangle(x_[n], x_[a], x_[b], p_[a], p_[b]));
        }
        improve(energy_, p_[n]);
      }
  }

  std::span<const Vec3> x_;
  const CoarsePatch& coarse_;
  Places p_;
  StarEnergy energy_;
};

}  // namespace

std::optional<std::vector<Vec2>> flatten_coarse(std::span<const Vec3> x, std::span<const Corners> corners,
                                                const PatchTopology& topology) {
  if (!is_disc_with_holes(topology)) return std::nullopt;
  if (auto p = unroll(x, corners, topology)) return p;
  if (!is_shallow(x, corners, topology)) return std::nullopt;
  const CoarsePatch coarse = coarsen(x, corners, topology, kCoarse);
  const auto places = flatten(coarse.x, coarse.corners, find_topology(coarse.x, coarse.corners));
  if (!places) return std::nullopt;
  auto p = Refinement(x, coarse, *places).run(corners);
  if (!p || !(largest_stretch(x, corners, *p) <= kMostStretch) || !is_clear(x, corners, topology, *p))
    return std::nullopt;
  return p;
}

}  // namespace st
