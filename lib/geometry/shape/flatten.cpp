#include "geometry/shape/flatten.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "base/eigen.h"
#include "base/sparse.h"
#include "geometry/shape/rim_pinches.h"

namespace st {
namespace {

constexpr double kPlane = 1e-9;             // of the diagonal: a patch that leaves a plane by less lies in it
constexpr double kProjected = 0.5;          // cosine of 60 degrees: a projection stretches by 2 at most
constexpr int kMostSteps = 30;              // of the minimisation
constexpr double kEnough = 1e-3;            // relative fall of the energy in a step that ends it
constexpr double kLeastHeight = 1e-3;       // of the longest side: flatter triangles are taken to be so high
constexpr double kFlipShare = 0.8;          // of the way to the first flip: the longest step
constexpr double kMostDepth = 0.35;         // area over squared length of the rim: 0.08 of a disc, 0.16 of a hemisphere
constexpr double kTubeRim = 0.5;            // of the outer rim: a hole so long makes a tube of the patch
constexpr double kMostTube = 1;             // logarithm of a tube's stretch when it is made a ring
constexpr std::size_t kMostSolved = 20000;  // triangles
constexpr double kMostTurn = 0.9;           // of a round, of the triangles around a rim node
constexpr double kMostWholeTurn = 0.98;     // the same of a patch that is not to be cut: notches at wing roots
constexpr double kProximal = 1e-6;          // weight of the places before a step: two translations and a turn are free

using Places = std::vector<Vec2>;

double twice_area(const Corners& c, std::span<const Vec2> p) { return cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]); }

bool has_flips(std::span<const Corners> corners, std::span<const Vec2> p) {
  return std::any_of(corners.begin(), corners.end(), [&](const Corners& c) { return !(twice_area(c, p) > 0); });
}

bool touch(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) return false;
  return cross(b - a, c - a) * cross(b - a, d - a) <= 0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0;
}

/// Whether rim sides without a common node touch each other, by a sweep along x.
bool rim_crosses(const PatchTopology& topology, std::span<const Vec2> p) {
  struct RimSide {
    std::int32_t a, b;
  };
  std::vector<RimSide> sides;
  for (const auto& loop : topology.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      sides.push_back(p[a].x <= p[b].x ? RimSide{a, b} : RimSide{b, a});
    }
  std::stable_sort(sides.begin(), sides.end(), [&](RimSide s, RimSide t) { return p[s.a].x < p[t.a].x; });
  std::vector<RimSide> open;
  for (const RimSide& s : sides) {
    std::erase_if(open, [&](RimSide o) { return p[o.b].x < p[s.a].x; });
    for (const RimSide& o : open)
      if (o.a != s.a && o.a != s.b && o.b != s.a && o.b != s.b && touch(p[o.a], p[o.b], p[s.a], p[s.b])) return true;
    open.push_back(s);
  }
  return false;
}

double angle_between(Vec2 a, Vec2 b) { return std::atan2(std::abs(cross(a, b)), dot(a, b)); }

/// Whether the triangles around a rim node turn by more than `most` of a round: its two rim sides would fold over each
/// other next.
bool rim_folds(std::span<const Corners> corners, const PatchTopology& topology, std::span<const Vec2> p, double most) {
  std::vector<double> turn(p.size(), 0);
  for (const Corners& c : corners)
    for (int k = 0; k < 3; ++k) turn[c[k]] += angle_between(p[c[(k + 1) % 3]] - p[c[k]], p[c[(k + 2) % 3]] - p[c[k]]);
  for (const auto& loop : topology.loops)
    for (const std::int32_t n : loop)
      if (turn[n] > most * 2 * kPi) return true;
  return false;
}

/// Whether a triangle's sides and area are nearly the same in the plane.
bool is_like(std::span<const Vec3> x, std::span<const Vec2> p, const Corners& c) {
  constexpr double kAlike = 1.25;
  const auto is_near = [](double a, double b) { return a <= kAlike * b && b <= kAlike * a; };
  for (int k = 0; k < 3; ++k)
    if (!is_near(distance(x[c[k]], x[c[(k + 1) % 3]]), norm(p[c[k]] - p[c[(k + 1) % 3]]))) return false;
  return is_near(norm(cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]])), cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]));
}

bool is_clear_up_to(double most_turn, std::span<const Vec3> x, std::span<const Corners> corners,
                    const PatchTopology& topology, std::span<const Vec2> p) {
  return !has_flips(corners, p) && !rim_folds(corners, topology, p, most_turn) && !rim_crosses(topology, p) &&
         !rim_pinches(x, topology, p);
}

std::optional<Places> project(std::span<const Vec3> x, std::span<const Corners> corners,
                              const PatchTopology& topology) {
  Vec3 sum{};
  const auto normal = [&](const Corners& c) { return cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]); };
  for (const Corners& c : corners) sum += normal(c);
  const Vec3 mean = normalized(sum);
  for (const Corners& c : corners) {
    const Vec3 n = normal(c);
    if (!(dot(n, mean) > kProjected * norm(n))) return std::nullopt;
  }
  const Vec3 far = std::abs(mean.x) <= std::min(std::abs(mean.y), std::abs(mean.z)) ? Vec3{1, 0, 0}
                   : std::abs(mean.y) <= std::abs(mean.z)                           ? Vec3{0, 1, 0}
                                                                                    : Vec3{0, 0, 1};
  const Vec3 u = normalized(cross(far, mean)), v = cross(mean, u);
  Places p;
  Box3 box;
  double aside = 0;
  for (const Vec3 q : x) {
    p.push_back({dot(q - x[0], u), dot(q - x[0], v)});
    box.add(q);
    aside = std::max(aside, std::abs(dot(q - x[0], mean)));
  }
  const bool is_plane = aside <= kPlane * box.diagonal();  // its places are those of space: however sharp its corners
  if (is_plane ? has_flips(corners, p) : !is_clear(x, corners, topology, p)) return std::nullopt;
  return p;
}

/// Triangles laid into the plane one by one across their sides, the longest side first: exact where the patch is bent
/// in one direction only, however narrow its triangles are.
std::optional<Places> unfold(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology) {
  const std::vector<Corners> neighbours = find_neighbours(corners);
  const auto side = [&](std::int32_t t, int k) { return distance(x[corners[t][k]], x[corners[t][(k + 1) % 3]]); };
  Places p(x.size());
  std::vector<std::uint8_t> is_laid(x.size(), 0);
  const auto lay = [&](std::int32_t t, int k) {
    const std::int32_t a = corners[t][k], b = corners[t][(k + 1) % 3], c = corners[t][(k + 2) % 3];
    if (std::exchange(is_laid[c], 1) != 0) return;
    const double length = distance(x[a], x[b]), along = dot(x[c] - x[a], x[b] - x[a]) / (length * length),
                 height = norm(cross(x[b] - x[a], x[c] - x[a])) / (length * length);
    const Vec2 way = p[b] - p[a];
    p[c] = p[a] + along * way + height * Vec2{-way.y, way.x};
  };
  std::priority_queue<std::tuple<double, std::int32_t, int>> next;  // length, triangle, its side that is laid
  std::vector<std::uint8_t> is_done(corners.size(), 0);
  const auto add_neighbours = [&](std::int32_t t) {
    is_done[t] = 1;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t o = neighbours[t][k];
      if (o == kNone || is_done[o] != 0) continue;
      const auto at = std::ranges::find(corners[o], corners[t][(k + 1) % 3]) - corners[o].begin();
      next.emplace(side(t, k), o, static_cast<int>(at));
    }
  };
  p[corners[0][1]] = {side(0, 0), 0};
  is_laid[corners[0][0]] = is_laid[corners[0][1]] = 1;
  lay(0, 0);
  add_neighbours(0);
  while (!next.empty()) {
    const auto [length, t, k] = next.top();
    next.pop();
    if (is_done[t] != 0 || !(length > 0)) continue;
    lay(t, k);
    if (!is_like(x, p, corners[t])) return std::nullopt;
    add_neighbours(t);
  }
  if (!std::ranges::all_of(is_laid, [](std::uint8_t laid) { return laid != 0; })) return std::nullopt;
  for (std::size_t t = 0; t < corners.size(); ++t)
    if (!is_like(x, p, corners[t])) return std::nullopt;
  if (!is_clear(x, corners, topology, p)) return std::nullopt;
  return p;
}

/// The patch with its holes filled, by a node in the middle of each.
struct Filled {
  std::vector<Vec3> x;
  std::vector<Corners> corners;
};

Filled fill_holes(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology) {
  Filled f{{x.begin(), x.end()}, {corners.begin(), corners.end()}};
  for (std::size_t l = 0; l < topology.loops.size(); ++l) {
    if (l == topology.outer_loop()) continue;
    const auto& loop = topology.loops[l];
    const auto middle = static_cast<std::int32_t>(f.x.size());
    Vec3 sum{};
    for (const std::int32_t n : loop) sum += x[n];
    f.x.push_back(sum / static_cast<double>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i)
      f.corners.push_back({loop[(i + 1) % loop.size()], loop[i], middle});  // the other way round than the rim
  }
  return f;
}

/// Mean-value equations of a node that is not on the rim: each row has a diagonal of one.
class MeanValues {
 public:
  explicit MeanValues(const Filled& f) : f_(f), fixed_(f.x.size(), 0), right_(f.x.size()), sum_(f.x.size(), 0) {}

  void fix(std::int32_t node, Vec2 place) {
    fixed_[node] = 1;
    right_[node] = place;
  }

  std::optional<Places> solve() {
    for (const Corners& c : f_.corners)
      for (int k = 0; k < 3; ++k)
        if (!fixed_[c[k]]) add_corner(c[k], c[(k + 1) % 3], c[(k + 2) % 3]);
    for (SparseEntry& e : entries_) e.value /= sum_[e.row];
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(fixed_.size()); ++n) {
      if (!fixed_[n]) right_[n] = (1 / sum_[n]) * right_[n];
      entries_.push_back({n, n, 1});
    }
    return solve_sparse(entries_, right_);
  }

 private:
  void add_corner(std::int32_t at, std::int32_t next, std::int32_t last) {
    const Vec3 a = f_.x[next] - f_.x[at], b = f_.x[last] - f_.x[at];
    const double half = std::tan(0.5 * std::max(angle_between(a, b), 1e-9));
    for (const auto& [to, d] : {std::pair{next, norm(a)}, std::pair{last, norm(b)}}) {
      const double weight = half / std::max(d, std::numeric_limits<double>::min());
      sum_[at] += weight;
      if (fixed_[to])
        right_[at] = right_[at] + weight * right_[to];
      else
        entries_.push_back({at, to, -weight});
    }
  }

  const Filled& f_;
  std::vector<std::uint8_t> fixed_;
  Places right_;
  std::vector<double> sum_;
  std::vector<SparseEntry> entries_;
};

std::optional<Places> map_to_circle(std::span<const Vec3> x, std::span<const Corners> corners,
                                    const PatchTopology& topology) {
  const Filled filled = fill_holes(x, corners, topology);
  MeanValues equations(filled);
  const auto& rim = topology.loops[topology.outer_loop()];
  const double length = topology.loop_length[topology.outer_loop()];
  double along = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const double angle = 2 * kPi * along / length;
    equations.fix(rim[i], {std::cos(angle), std::sin(angle)});
    along += distance(x[rim[i]], x[rim[(i + 1) % rim.size()]]);
  }
  auto p = equations.solve();
  if (!p) return std::nullopt;
  p->resize(x.size());
  if (has_flips(corners, *p)) return std::nullopt;
  return p;
}

/// Lowers the symmetric Dirichlet energy of a map without flips: least squares on the rotations nearest to its
/// Jacobians, with weights that have the energy's own gradient.
class Relaxation {
 public:
  Relaxation(std::span<const Vec3> x, std::span<const Corners> corners) : corners_(corners) {
    for (const Corners& c : corners) {
      const Vec3 a = x[c[1]] - x[c[0]], b = x[c[2]] - x[c[0]];
      const double longest = std::sqrt(std::max({norm2(a), norm2(b), norm2(b - a)}));
      const double base = std::max(norm(a), kLeastHeight * longest), along = dot(a, b) / base;
      const double height = std::max(norm(cross(a, b)) / base, kLeastHeight * longest);
      // gradients of the corners' hat functions in the triangle's own plane
      rest_.push_back({{Vec2{-1 / base, (along / base - 1) / height}, Vec2{1 / base, -along / (base * height)},
                        Vec2{0, 1 / height}},
                       0.5 * base * height});
      area_ += rest_.back().area;
    }
  }

  double area() const { return area_; }

  double energy(std::span<const Vec2> p) const {
    double sum = 0;
    for (std::size_t t = 0; t < rest_.size(); ++t) {
      const Eigen::Matrix2d j = jacobian(t, p);
      const double det = j.determinant();
      if (!(det > 0)) return std::numeric_limits<double>::infinity();
      sum += rest_[t].area * j.squaredNorm() * (1 + 1 / (det * det));
    }
    return sum;
  }

  /// One step with a lower energy, to places that are allowed; nullopt when there is none.
  template <class IsAllowed>
  std::optional<Places> step(std::span<const Vec2> p, double energy_before, const IsAllowed& is_allowed) {
    const auto to = solve_step(p);
    if (!to) return std::nullopt;
    Places way;
    for (std::size_t i = 0; i < p.size(); ++i) way.push_back(Vec2{(*to)[2 * i], (*to)[2 * i + 1]} - p[i]);
    double share = std::min(1.0, kFlipShare * first_flip(p, way));
    constexpr int kMostHalvings = 10;
    for (int attempt = 0; attempt < kMostHalvings; ++attempt, share *= 0.5) {
      Places q(p.begin(), p.end());
      for (std::size_t i = 0; i < p.size(); ++i) q[i] = p[i] + share * way[i];
      if (energy(q) < energy_before && is_allowed(q)) return q;
    }
    return std::nullopt;
  }

 private:
  struct Rest {
    std::array<Vec2, 3> gradient;
    double area;
  };

  Eigen::Matrix2d jacobian(std::size_t t, std::span<const Vec2> p) const {
    Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
    for (int k = 0; k < 3; ++k) j += to_eigen(p[corners_[t][k]]) * to_eigen(rest_[t].gradient[k]).transpose();
    return j;
  }

  /// The rotation nearest to `j`, and the weights of what differs from it.
  static std::pair<Eigen::Matrix2d, Eigen::Matrix2d> target(const Eigen::Matrix2d& j) {
    // polar decomposition: the rotation by the angle of (j00 + j11, j10 - j01), and the symmetric rest
    const double c = j(0, 0) + j(1, 1), s = j(1, 0) - j(0, 1), length = std::hypot(c, s);
    const Eigen::Matrix2d rotation = (Eigen::Matrix2d() << c, -s, s, c).finished() / length;
    const Eigen::Matrix2d stretch = j * rotation.transpose();  // symmetric
    const double mean = 0.5 * stretch.trace(), half = 0.5 * (stretch(0, 0) - stretch(1, 1)),
                 off = 0.5 * (stretch(0, 1) + stretch(1, 0)), root = std::hypot(half, off);
    const auto weight = [](double value) {
      constexpr double kLeastStretch = 1e-6, kNearOne = 1e-5;
      const double v = std::max(value, kLeastStretch);
      return std::abs(v - 1) < kNearOne ? 4.0 : (v - 1 / (v * v * v)) / (v - 1);
    };
    const double high = weight(mean + root), low = weight(mean - root);
    if (!(root > 0)) return {rotation, high * Eigen::Matrix2d::Identity()};
    const double middle = 0.5 * (high + low), turn = 0.5 * (high - low) / root;
    return {rotation, symmetric(middle + turn * half, turn * off, middle - turn * half)};
  }

  std::optional<std::vector<double>> solve_step(std::span<const Vec2> p) {
    std::vector<SparseEntry> entries;
    entries.reserve(rest_.size() * 24 + 2 * p.size());
    std::vector<double> right(2 * p.size(), 0);
    double diagonal = 0;
    for (std::size_t t = 0; t < rest_.size(); ++t) {
      const auto [rotation, weight] = target(jacobian(t, p));
      const auto& g = rest_[t].gradient;
      const Corners& c = corners_[t];
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d f = rest_[t].area * (weight * (rotation * to_eigen(g[k])));
        right[2 * static_cast<std::size_t>(c[k])] += f[0];
        right[2 * static_cast<std::size_t>(c[k]) + 1] += f[1];
        for (int l = 0; l < 3; ++l) {
          if (c[l] > c[k]) continue;  // the solver takes what is below the diagonal
          const double s = rest_[t].area * dot(g[k], g[l]);
          for (int i = 0; i < 2; ++i)
            for (int q = 0; q < 2; ++q) entries.push_back({2 * c[k] + i, 2 * c[l] + q, s * weight(i, q)});
        }
        diagonal += rest_[t].area * dot(g[k], g[k]);
      }
    }
    const double hold = kProximal * diagonal / static_cast<double>(p.size());
    for (std::size_t i = 0; i < 2 * p.size(); ++i) {
      const auto at = static_cast<std::int32_t>(i);
      entries.push_back({at, at, hold});
      right[i] += hold * (i % 2 == 0 ? p[i / 2].x : p[i / 2].y);
    }
    return solver_.solve(entries, right);
  }

  /// The share of the way at which the first triangle has no area any more.
  double first_flip(std::span<const Vec2> p, std::span<const Vec2> way) const {
    double first = std::numeric_limits<double>::infinity();
    for (const Corners& c : corners_) {
      const Vec2 a = p[c[1]] - p[c[0]], b = p[c[2]] - p[c[0]], da = way[c[1]] - way[c[0]], db = way[c[2]] - way[c[0]];
      const double q2 = cross(da, db), q1 = cross(a, db) + cross(da, b), q0 = cross(a, b);
      const double discriminant = q1 * q1 - 4 * q2 * q0;  // of the area along the way
      if (discriminant < 0) continue;
      const double half = -0.5 * (q1 + std::copysign(std::sqrt(discriminant), q1));
      for (const double share : {half / q2, q0 / half})
        if (share > 0) first = std::min(first, share);  // false for what is not a number
    }
    return first;
  }

  std::span<const Corners> corners_;
  std::vector<Rest> rest_;
  double area_ = 0;
  SymmetricSolver solver_;
};

template <class IsAllowed>
void relax(std::span<const Vec3> x, std::span<const Corners> corners, Places& p, const IsAllowed& is_allowed) {
  Relaxation relaxation(x, corners);
  const double scale = std::sqrt(relaxation.area() / kPi);
  for (Vec2& q : p) q = scale * q;
  double energy = relaxation.energy(p);
  for (int i = 0; i < kMostSteps; ++i) {
    auto next = relaxation.step(p, energy, is_allowed);
    if (!next) return;
    p = std::move(*next);
    const double before = std::exchange(energy, relaxation.energy(p));
    if (before - energy < kEnough * energy) return;
  }
}

}  // namespace

bool is_disc_with_holes(const PatchTopology& t) {
  return t.n_components == 1 && t.genus == 0 && !t.loops.empty() && t.is_manifold;
}

bool is_clear(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology,
              std::span<const Vec2> p) {
  return is_clear_up_to(kMostTurn, x, corners, topology, p);
}

// On a circle the inside of what is deep, and the end of a tube, shrink to nothing.
bool is_shallow(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology) {
  double area = 0;
  for (const Corners& c : corners) area += 0.5 * norm(cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]));
  const std::size_t outer = topology.outer_loop();
  const double rim = topology.loop_length[outer], share = area / (rim * rim);
  bool is_tube = false;
  for (std::size_t l = 0; l < topology.loops.size(); ++l)
    is_tube = is_tube || (l != outer && topology.loop_length[l] > kTubeRim * rim);
  return share <= kMostDepth && !(is_tube && 2 * kPi * share > kMostTube);
}

double largest_stretch(std::span<const Vec3> x, std::span<const Corners> corners, std::span<const Vec2> uv) {
  double largest = 1;
  for (const Corners& c : corners) {
    const Vec3 a = x[c[1]] - x[c[0]], b = x[c[2]] - x[c[0]];
    const Vec2 pa = uv[c[1]] - uv[c[0]], pb = uv[c[2]] - uv[c[0]];
    const double det = cross(pa, pb);
    if (!(det > 0)) return std::numeric_limits<double>::infinity();
    if (norm(cross(a, b)) <= kLeastHeight * std::max({norm2(a), norm2(b), norm2(b - a)})) continue;
    const Vec3 du = (pb.y * a - pa.y * b) / det, dv = (pa.x * b - pb.x * a) / det;
    const double e = norm2(du), f = dot(du, dv), g = norm2(dv), mean = 0.5 * (e + g);
    const double root = std::hypot(0.5 * (e - g), f);
    largest = std::max(largest, std::sqrt((mean + root) / std::max(mean - root, std::numeric_limits<double>::min())));
  }
  return largest;
}

std::array<Vec2, 3> lay_triangle(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a;
  const double least = kLeastHeight * std::sqrt(std::max({norm2(ab), norm2(ac), norm2(ac - ab)}));
  const double base = std::max(norm(ab), least);
  return {Vec2{0, 0}, Vec2{base, 0}, Vec2{dot(ab, ac) / base, std::max(norm(cross(ab, ac)) / base, least)}};
}

std::optional<std::vector<Vec2>> unroll(std::span<const Vec3> x, std::span<const Corners> corners,
                                        const PatchTopology& topology) {
  if (auto p = project(x, corners, topology)) return p;
  return unfold(x, corners, topology);
}

namespace {

/// Steps that `is_allowed` refuses are not taken; the last places have to be clear.
template <class IsAllowed>
std::optional<Places> solve(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology,
                            double most_turn, const IsAllowed& is_allowed) {
  if (corners.size() > kMostSolved || !is_shallow(x, corners, topology)) return std::nullopt;
  auto p = map_to_circle(x, corners, topology);
  if (!p) return std::nullopt;
  relax(x, corners, *p, is_allowed);
  if (!(largest_stretch(x, corners, *p) <= kMostStretch) || !is_clear_up_to(most_turn, x, corners, topology, *p))
    return std::nullopt;
  return p;
}

}  // namespace

std::optional<std::vector<Vec2>> flatten(std::span<const Vec3> x, std::span<const Corners> corners,
                                         const PatchTopology& topology) {
  if (!is_disc_with_holes(topology)) return std::nullopt;
  if (auto p = unroll(x, corners, topology)) return p;
  return solve(x, corners, topology, kMostTurn, [&](const Places& q) { return is_clear(x, corners, topology, q); });
}

std::optional<std::vector<Vec2>> flatten_whole(std::span<const Vec3> x, std::span<const Corners> corners,
                                               const PatchTopology& topology) {
  if (auto p = flatten(x, corners, topology)) return p;
  if (!is_disc_with_holes(topology)) return std::nullopt;
  return solve(x, corners, topology, kMostWholeTurn, [](const Places&) { return true; });
}

}  // namespace st
