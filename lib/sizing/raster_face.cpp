#include "sizing/raster_face.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace st {
namespace {

constexpr double kFill = 0.9;         // largest extent of a patch over the edge of its raster box
constexpr double kProbeReach = 2;     // lengths per patch, however large the raster boxes: three probes cannot see more
constexpr int kMaxSplits = 60;        // of a patch, in both directions together
constexpr int kFirstSplits = 2;       // per direction and break interval, on surfaces whose curvature varies freely
constexpr int kDoubts = 6;            // splits (two per halving) granted to a curvature that no angle confirms
constexpr double kConfirmed = 2;      // a curvature up to this times the largest angle per distance around counts as confirmed
constexpr double kAngleNoise = 1e-3;  // angles below this times alpha say nothing
constexpr double kBreakInset = 1e-7;  // of the interval: probes stay on their side of a crease
constexpr double kSingular2 = 1e-20;  // squared sine of the angle between du and dv at a singular point
constexpr double kCollapsed = 1e-9;   // derivative over the other one, scaled to the ranges, where a side has collapsed

struct Probe {
  Vec3 x;
  Vec3 normal;           // unit; zero at a singular point
  double curvature = 0;  // largest absolute principal curvature; zero at a singular point
};

/// A rectangle in (u,v) with its probes, row by row in v: probe[3 * row + column].
struct Patch {
  double u[3], v[3];
  std::array<Probe, 9> probe;
  int n_splits = 0, n_doubts = 0;
  bool is_cut = false;  // sides of the loops meet it
};

struct PatchSize {
  Vec3 center;
  double extent = 0;                // largest side of its bounding box
  double along_u = 0, along_v = 0;  // longest row, longest column
};

class FaceRaster {
 public:
  FaceRaster(const Surface& surface, const LoopPolygons& loops, const SamplingLimits& limits, std::int32_t cause,
             std::vector<RasterBox>& boxes)
      : surface_(surface), loops_(loops), limits_(limits), cause_(cause), boxes_(boxes) {
    range_u_ = surface.u_max() - surface.u_min();
    range_v_ = surface.v_max() - surface.v_min();
    const SurfaceType type = surface.type();
    is_free_ = !(type == SurfaceType::kPlane || type == SurfaceType::kCylinder || type == SurfaceType::kCone ||
                 type == SurfaceType::kSphere || type == SurfaceType::kTorus);
  }

  FaceRasterReport run() {
    std::vector<std::int32_t> all_sides(loops_.sides().size());
    for (std::size_t i = 0; i < all_sides.size(); ++i) all_sides[i] = static_cast<std::int32_t>(i);
    const std::vector<double> us = grid_lines(surface_.u_min(), surface_.u_max(), creases(surface_.u_breaks(), Direction::kU));
    const std::vector<double> vs = grid_lines(surface_.v_min(), surface_.v_max(), creases(surface_.v_breaks(), Direction::kV));
    for (std::size_t j = 0; j + 1 < vs.size(); ++j)
      for (std::size_t i = 0; i + 1 < us.size(); ++i) start_interval(us, i, vs, j, all_sides);
    return report_;
  }

 private:
  enum class Direction { kU, kV };

  // --- creases
  // -------------------------------------------------------------------------------------------------------------------------------

  /// Breaks across which the normal jumps by more than alpha somewhere. Weaker ones are sampled like a smooth surface.
  std::vector<double> creases(const std::vector<double>& breaks, Direction direction) {
    std::vector<double> result;
    const bool across_u = direction == Direction::kU;
    const double range = across_u ? range_u_ : range_v_;
    for (const double b : breaks) {
      bool is_crease = false;
      for (int k = 0; k < 5 && !is_crease; ++k) {
        const double other = across_u ? surface_.v_min() + range_v_ * (k + 0.5) / 5 : surface_.u_min() + range_u_ * (k + 0.5) / 5;
        const Vec3 before = normal_at(across_u ? Vec2{b - kBreakInset * range, other} : Vec2{other, b - kBreakInset * range});
        const Vec3 after = normal_at(across_u ? Vec2{b + kBreakInset * range, other} : Vec2{other, b + kBreakInset * range});
        is_crease = angle_between(before, after) > limits_.alpha;
      }
      if (is_crease) result.push_back(b);
    }
    return result;
  }

  Vec3 normal_at(Vec2 uv) {
    ++report_.n_evaluations;
    const SurfacePoint p = surface_.evaluate(uv);
    return normalized(cross(p.du, p.dv));
  }

  static std::vector<double> grid_lines(double lo, double hi, const std::vector<double>& inner) {
    std::vector<double> lines{lo};
    for (const double x : inner)
      if (x > lines.back() && x < hi) lines.push_back(x);
    lines.push_back(hi);
    return lines;
  }

  // --- the walk
  // ------------------------------------------------------------------------------------------------------------------------------

  void start_interval(const std::vector<double>& us, std::size_t i, const std::vector<double>& vs, std::size_t j,
                      const std::vector<std::int32_t>& sides) {
    const auto inset = [](const std::vector<double>& x, std::size_t k, double& lo, double& hi) {
      const double width = x[k + 1] - x[k];
      lo = x[k] + (k > 0 ? kBreakInset * width : 0);
      hi = x[k + 1] - (k + 2 < x.size() ? kBreakInset * width : 0);
    };
    double u0, u1, v0, v1;
    inset(us, i, u0, u1);
    inset(vs, j, v0, v1);
    const int n = is_free_ ? 1 << kFirstSplits : 1;
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) {
        Patch patch;
        set_lines(patch.u, u0 + (u1 - u0) * a / n, u0 + (u1 - u0) * (a + 1) / n);
        set_lines(patch.v, v0 + (v1 - v0) * b / n, v0 + (v1 - v0) * (b + 1) / n);
        for (std::size_t k = 0; k < 9; ++k) patch.probe[k] = probe({patch.u[k % 3], patch.v[k / 3]});
        visit(patch, sides);
      }
  }

  static void set_lines(double (&x)[3], double lo, double hi) {
    x[0] = lo;
    x[1] = 0.5 * (lo + hi);
    x[2] = hi;
  }

  Probe probe(Vec2 uv) {
    ++report_.n_evaluations;
    const SurfacePoint2 p = surface_.evaluate2(uv);
    const Vec3 n = cross(p.du, p.dv);
    const double du2 = norm2(p.du), dv2 = norm2(p.dv), n2 = norm2(n);
    const double lu2 = du2 * range_u_ * range_u_, lv2 = dv2 * range_v_ * range_v_;
    if (!(n2 > kSingular2 * du2 * dv2) || lu2 < kCollapsed * kCollapsed * lv2 || lv2 < kCollapsed * kCollapsed * lu2) return {p.x, {}, 0};
    return {p.x, n / std::sqrt(n2), std::abs(principal_curvature(p).k1)};
  }

  /// Decides what becomes of a patch: dropped, split, or made a raster box. `sides`: sides of the loops that may meet it.
  void visit(Patch& patch, const std::vector<std::int32_t>& parent_sides) {
    std::vector<std::int32_t> sides;
    for (const std::int32_t s : parent_sides)
      if (meets(patch, loops_.sides()[static_cast<std::size_t>(s)])) sides.push_back(s);
    patch.is_cut = !sides.empty();
    if (!patch.is_cut && !loops_.contains({patch.u[1], patch.v[1]})) return;
    std::array<bool, 9> is_inside;
    const int n_inside = classify(patch, is_inside);
    const PatchSize size = measure(patch);
    bool is_doubtful = false;
    const double curvature = n_inside > 0 ? patch_curvature(patch, is_inside, is_doubtful) : boundary_curvature(patch, sides);
    const double length = allowed_length(curvature);
    if (patch.n_splits < kMaxSplits && must_split(patch, size, length, is_doubtful)) {
      patch.n_doubts += is_doubtful;
      return split(patch, size.along_u >= size.along_v ? Direction::kU : Direction::kV, sides);
    }
    add_box(patch, size, length, is_inside);
  }

  bool must_split(const Patch& patch, const PatchSize& size, double length, bool is_doubtful) const {
    if (size.extent > kFill * std::min(limits_.cell_per_length, kProbeReach) * length) return true;
    if (is_free_ && size.extent > limits_.max_length) return true;
    return is_doubtful && patch.n_doubts < kDoubts && size.extent > limits_.min_length;
  }

  void split(const Patch& patch, Direction direction, const std::vector<std::int32_t>& sides) {
    const bool along_u = direction == Direction::kU;
    const double(&old)[3] = along_u ? patch.u : patch.v;
    for (int half = 0; half < 2; ++half) {
      Patch child = patch;
      ++child.n_splits;
      set_lines(along_u ? child.u : child.v, old[half], old[half + 1]);
      for (std::size_t k = 0; k < 3; ++k) {  // across: two lines of probes are the parent's, the middle one is new
        const auto at = [&](std::size_t line) { return along_u ? 3 * k + line : 3 * line + k; };
        child.probe[at(0)] = patch.probe[at(static_cast<std::size_t>(half))];
        child.probe[at(2)] = patch.probe[at(static_cast<std::size_t>(half) + 1)];
        child.probe[at(1)] = probe({child.u[at(1) % 3], child.v[at(1) / 3]});
      }
      visit(child, sides);
    }
  }

  // --- a patch against the loops
  // -------------------------------------------------------------------------------------------------------------

  static bool meets(const Patch& patch, const LoopSide& s) {
    if (std::max(s.a.x, s.b.x) < patch.u[0] || std::min(s.a.x, s.b.x) > patch.u[2] || std::max(s.a.y, s.b.y) < patch.v[0] ||
        std::min(s.a.y, s.b.y) > patch.v[2])
      return false;
    // the four corners on one side of the line?
    const Vec2 d = s.b - s.a;
    int n_left = 0;
    for (int k = 0; k < 4; ++k) n_left += cross(d, Vec2{patch.u[k & 1 ? 2 : 0], patch.v[k & 2 ? 2 : 0]} - s.a) > 0;
    return d == Vec2{} || (n_left != 0 && n_left != 4);
  }

  int classify(const Patch& patch, std::array<bool, 9>& is_inside) const {
    int n = 0;
    for (std::size_t k = 0; k < 9; ++k) {
      is_inside[k] = !patch.is_cut || loops_.contains({patch.u[k % 3], patch.v[k / 3]});
      n += is_inside[k];
    }
    return n;
  }

  // --- sizes
  // ---------------------------------------------------------------------------------------------------------------------------------

  static PatchSize measure(const Patch& patch) {
    PatchSize size;
    Box3 box;
    for (const Probe& p : patch.probe) box.add(p.x);
    const Vec3 e = box.hi - box.lo;
    size.center = box.center();
    size.extent = std::max({e.x, e.y, e.z});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = patch.probe;
      size.along_u = std::max(size.along_u, distance(p[3 * k].x, p[3 * k + 1].x) + distance(p[3 * k + 1].x, p[3 * k + 2].x));
      size.along_v = std::max(size.along_v, distance(p[k].x, p[3 + k].x) + distance(p[3 + k].x, p[6 + k].x));
    }
    return size;
  }

  double allowed_length(double curvature) const {
    const double length = curvature * limits_.max_length > limits_.alpha ? limits_.alpha / curvature : limits_.max_length;
    return std::max(length, limits_.min_length);
  }

  /// Largest curvature that the probes inside the loops show: the larger of curvature at a point and angle per distance between neighbours.
  double patch_curvature(const Patch& patch, const std::array<bool, 9>& is_inside, bool& is_doubtful) const {
    std::array<double, 9> turning{}, steepest{};  // of the pairs at each probe: largest angle, largest angle per distance
    for_each_pair([&](std::size_t a, std::size_t b) {
      if (!is_inside[a] || !is_inside[b]) return;
      const double angle = probe_angle(patch.probe[a], patch.probe[b]);
      const double d = distance(patch.probe[a].x, patch.probe[b].x) * (1 + angle * angle / 24);  // arc from chord
      const double rate = angle > kAngleNoise * limits_.alpha && d > 0 ? angle / d : 0;
      for (const std::size_t k : {a, b}) {
        turning[k] = std::max(turning[k], angle);
        steepest[k] = std::max(steepest[k], rate);
      }
    });
    double curvature = 0;
    for (std::size_t k = 0; k < 9; ++k) {
      if (!is_inside[k]) continue;
      double own = patch.probe[k].curvature;
      const double confirmed = kConfirmed * steepest[k];
      if (is_free_ && own > confirmed && turning[k] < 0.5 * limits_.alpha && own * limits_.max_length > limits_.alpha) {
        is_doubtful = true;
        own = confirmed;
      }
      curvature = std::max({curvature, own, steepest[k]});
    }
    return curvature;
  }

  static double probe_angle(const Probe& a, const Probe& b) {
    if (a.normal == Vec3{} || b.normal == Vec3{}) return 0;
    return 2 * std::asin(std::min(1.0, 0.5 * distance(a.normal, b.normal)));
  }

  template <class F>
  static void for_each_pair(F&& f) {
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column) {
        const std::size_t k = 3 * row + column;
        if (column < 2) f(k, k + 1);
        if (row < 2) f(k, k + 3);
        if (column < 2 && row < 2) {
          f(k, k + 4);
          f(k + 1, k + 3);
        }
      }
  }

  /// Largest curvature at the middles of the loop sides in a patch without a probe inside the loops.
  double boundary_curvature(const Patch& patch, const std::vector<std::int32_t>& sides) {
    constexpr std::size_t kMaxProbes = 4;
    double curvature = 0;
    const std::size_t step = (sides.size() + kMaxProbes - 1) / kMaxProbes;
    for (std::size_t i = 0; i < sides.size(); i += step) {
      const LoopSide& s = loops_.sides()[static_cast<std::size_t>(sides[i])];
      const Vec2 middle = 0.5 * (s.a + s.b);
      const Probe p = probe({std::clamp(middle.x, patch.u[0], patch.u[2]), std::clamp(middle.y, patch.v[0], patch.v[2])});
      curvature = std::max(curvature, p.curvature);
    }
    return curvature;
  }

  // --- the result
  // ----------------------------------------------------------------------------------------------------------------------------

  void add_box(const Patch& patch, const PatchSize& size, double length, const std::array<bool, 9>& is_inside) {
    const double area = inside_area(patch, is_inside);
    boxes_.push_back({size.center, static_cast<float>(0.5 * limits_.cell_per_length * length), static_cast<float>(length),
                      static_cast<float>(area), cause_});
    report_.area += area;
    ++report_.n_patches;
  }

  /// Area of the four quarters of a patch, times the share of their corners inside the loops.
  static double inside_area(const Patch& patch, const std::array<bool, 9>& is_inside) {
    double area = 0;
    for (const std::size_t k : {0u, 1u, 3u, 4u}) {
      const auto& p = patch.probe;
      const double quarter = 0.5 * norm(cross(p[k + 4].x - p[k].x, p[k + 3].x - p[k + 1].x));
      area += 0.25 * quarter * (is_inside[k] + is_inside[k + 1] + is_inside[k + 3] + is_inside[k + 4]);
    }
    return area;
  }

  const Surface& surface_;
  const LoopPolygons& loops_;
  const SamplingLimits& limits_;
  const std::int32_t cause_;
  std::vector<RasterBox>& boxes_;
  FaceRasterReport report_;
  double range_u_ = 1, range_v_ = 1;
  bool is_free_ = true;  // curvature varies freely: not a plane, cylinder, cone, sphere or torus
};

}  // namespace

FaceRasterReport raster_face(const Surface& surface, const LoopPolygons& loops, const SamplingLimits& limits, std::int32_t cause,
                             std::vector<RasterBox>& boxes) {
  return FaceRaster(surface, loops, limits, cause, boxes).run();
}

}  // namespace st
