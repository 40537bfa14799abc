#include "sizing/raster_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "geometry/shape/analytic.h"
#include "geometry/shape/bspline.h"
#include "geometry/shape/chart_surface.h"
#include "geometry/shape/composite_surface.h"
#include "sizing/cones.h"
#include "sizing/patch_walk.h"

namespace st {
namespace {

const Frame kRasterFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const SamplingLimits kRasterLimits{0.01, 1, radians(10), 2};

/// A surface by formula, derivatives by differences, of a type whose curvature varies freely.
class FormulaSurface : public Surface {
 public:
  FormulaSurface(std::function<Vec3(double, double)> x, double u0, double u1, double v0, double v1) : x_(std::move(x)) {
    u_min_ = u0, u_max_ = u1, v_min_ = v0, v_max_ = v1;
    type_ = SurfaceType::kBspline;
  }
  Vec3 point(Vec2 p) const override { return x_(p.x, p.y); }
  SurfacePoint evaluate(Vec2 p) const override {
    const SurfacePoint2 q = evaluate2(p);
    return {q.x, q.du, q.dv};
  }
  SurfacePoint2 evaluate2(Vec2 p) const override {
    const double u = p.x, v = p.y, a = 1e-4 * (u_max_ - u_min_), b = 1e-4 * (v_max_ - v_min_);
    const Vec3 c = x_(u, v), l = x_(u - a, v), r = x_(u + a, v), d = x_(u, v - b), t = x_(u, v + b);
    return {c,
            (r - l) / (2 * a),
            (t - d) / (2 * b),
            (l + r - 2 * c) / (a * a),
            (x_(u + a, v + b) - x_(u - a, v + b) - x_(u + a, v - b) + x_(u - a, v - b)) / (4 * a * b),
            (d + t - 2 * c) / (b * b)};
  }

 private:
  std::function<Vec3(double, double)> x_;
};

bool contains(const RasterBox& b, Vec3 x) {
  const double half = b.half * (1 + 1e-6);
  return std::abs(x.x - b.center.x) <= half && std::abs(x.y - b.center.y) <= half && std::abs(x.z - b.center.z) <= half;
}

struct Sampling {
  std::vector<RasterBox> boxes;
  FaceRasterReport report;

  /// Smallest length of the boxes at x; 0 where there is none.
  double length_at(Vec3 x) const {
    double length = 0;
    for (const RasterBox& b : boxes)
      if (contains(b, x) && (length == 0 || b.length < length)) length = b.length;
    return length;
  }
  double smallest() const {
    double length = 1e300;
    for (const RasterBox& b : boxes) length = std::min<double>(length, b.length);
    return length;
  }
};

Sampling sample(const Surface& surface, const LoopPolygons& loops = {}, const SamplingLimits& limits = kRasterLimits) {
  Sampling s;
  s.report = raster_face(surface, loops, limits, pack_cause(CauseKind::kFace, 9), s.boxes);
  return s;
}

/// Calls f(uv) on an n x n grid of the surface, ends included.
template <class F>
void for_grid(const Surface& s, int n, F&& f) {
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      f(Vec2{s.u_min() + (s.u_max() - s.u_min()) * i / n, s.v_min() + (s.v_max() - s.v_min()) * j / n});
}

void expect_everywhere(const Surface& surface, const Sampling& sampling, double length, double tolerance) {
  for_grid(surface, 60, [&](Vec2 uv) {
    ASSERT_NEAR(sampling.length_at(surface.point(uv)), length, tolerance * length) << uv.x << " " << uv.y;
  });
}

LoopPolygons polygon(const std::vector<std::vector<Vec2>>& loops) {
  std::vector<LoopSide> sides;
  for (const std::vector<Vec2>& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) sides.push_back({loop[i], loop[(i + 1) % loop.size()]});
  return LoopPolygons(std::move(sides));
}

TEST(RasterFace, gives_a_sphere_its_radius_times_alpha_everywhere) {
  for (const double radius : {0.3, 2.0}) {
    const AxialSurface sphere(SurfaceType::kSphere, kRasterFrame, radius, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
    const Sampling s = sample(sphere);
    expect_everywhere(sphere, s, radius * kRasterLimits.alpha, 0.02);
    EXPECT_NEAR(s.report.area, 4 * kPi * radius * radius, 0.01 * 4 * kPi * radius * radius);
  }
}

TEST(RasterFace, keeps_a_chord_error_where_it_asks_for_less_than_the_angle) {
  const AxialSurface sphere(SurfaceType::kSphere, kRasterFrame, 2, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  SamplingLimits limits = kRasterLimits;
  limits.chord = 0.0005;
  expect_everywhere(sphere, sample(sphere, {}, limits), std::sqrt(8 * 2 * limits.chord), 0.02);
  limits.chord = 0.1;
  expect_everywhere(sphere, sample(sphere, {}, limits), 2 * limits.alpha, 0.02);
}

TEST(RasterFace, gives_a_free_form_sphere_the_same_through_its_poles_and_stretched_lines) {
  // iso-lines crowd by u^3 around one meridian, and the poles are singular
  const FormulaSurface sphere(
      [](double u, double v) {
        return Vec3{std::cos(v) * std::cos(kPi * u * u * u), std::cos(v) * std::sin(kPi * u * u * u), std::sin(v)};
      },
      -1, 1, -kPi / 2, kPi / 2);
  expect_everywhere(sphere, sample(sphere), kRasterLimits.alpha, 0.03);
}

TEST(RasterFace, gives_a_cylinder_its_radius_times_alpha_everywhere) {
  const AxialSurface cylinder(SurfaceType::kCylinder, kRasterFrame, 1, 0, 0, 2 * kPi, 0, 30);
  const Sampling s = sample(cylinder);
  expect_everywhere(cylinder, s, kRasterLimits.alpha, 0.02);
  EXPECT_NEAR(s.report.area, 2 * kPi * 30, 0.01 * 2 * kPi * 30);
}

TEST(RasterFace, gives_a_plane_the_largest_length_for_few_evaluations) {
  const PlaneSurface plane(kRasterFrame, 0, 20, 0, 10);
  const Sampling s = sample(plane);
  expect_everywhere(plane, s, kRasterLimits.max_length, 1e-6);
  EXPECT_LT(s.boxes.size(), 300u);
  EXPECT_NEAR(s.report.area, 200, 1e-6);
}

TEST(RasterFace, follows_a_cone_towards_its_apex_without_a_spike) {
  const double half_angle = radians(30);
  const AxialSurface cone(SurfaceType::kCone, kRasterFrame, 0, half_angle, 0, 2 * kPi, 0, 4);
  const Sampling s = sample(cone);
  for_grid(cone, 50, [&](Vec2 uv) {
    const double radius = uv.y * std::tan(half_angle);  // smallest principal radius at distance v from the apex
    const double expected =
        std::clamp(radius * kRasterLimits.alpha, kRasterLimits.min_length, kRasterLimits.max_length);
    const double length = s.length_at(cone.point(uv));
    // a box reaches one length further than its patch, where the cone is narrower
    ASSERT_LE(length, 1.02 * expected);
    ASSERT_GE(length, std::max(kRasterLimits.min_length, 0.75 * expected) * 0.999);
  });
}

TEST(RasterFace, gives_a_torus_its_smallest_principal_radius_times_alpha) {
  const AxialSurface torus(SurfaceType::kTorus, kRasterFrame, 3, 0.5, 0, 2 * kPi, 0, 2 * kPi);
  expect_everywhere(torus, sample(torus), 0.5 * kRasterLimits.alpha, 0.02);
}

TEST(RasterFace, follows_the_principal_curvatures_of_an_ellipsoid) {
  const double a = 3, b = 1.5, c = 1;
  const FormulaSurface ellipsoid(
      [=](double u, double v) {
        return Vec3{a * std::cos(v) * std::cos(u), b * std::cos(v) * std::sin(u), c * std::sin(v)};
      },
      0, 2 * kPi, -kPi / 2, kPi / 2);
  const Sampling s = sample(ellipsoid);
  double worst_low = 1, worst_high = 1;
  for_grid(ellipsoid, 41, [&](Vec2 uv) {
    if (std::abs(std::abs(uv.y) - kPi / 2) < 0.01) return;
    const double radius = 1 / std::abs(principal_curvature(ellipsoid.evaluate2(uv)).k1);
    const double ratio = s.length_at(ellipsoid.point(uv)) / (radius * kRasterLimits.alpha);
    worst_low = std::min(worst_low, ratio);
    worst_high = std::max(worst_high, ratio);
  });
  EXPECT_GT(worst_low, 0.55);   // curvature changes within a box
  EXPECT_LT(worst_high, 1.02);  // never longer than curvature allows
}

TEST(RasterFace, gives_what_is_too_small_for_alpha_the_smallest_length) {
  const double radius = 0.5 * kRasterLimits.min_length / kRasterLimits.alpha;
  const AxialSurface cylinder(SurfaceType::kCylinder, kRasterFrame, radius, 0, 0, 2 * kPi, 0, 0.3);
  expect_everywhere(cylinder, sample(cylinder), kRasterLimits.min_length, 1e-6);
  const AxialSurface sphere(SurfaceType::kSphere, kRasterFrame, radius, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  expect_everywhere(sphere, sample(sphere), kRasterLimits.min_length, 1e-6);
}

TEST(RasterFace, has_no_spike_at_the_pole_of_a_revolution) {
  // the paraboloid z = r^2 / 2: radius 1 at its pole, where all u are one point
  const FormulaSurface bowl(
      [](double u, double v) {
        return Vec3{v * std::cos(u), v * std::sin(u), 0.5 * v * v};
      },
      0, 2 * kPi, 0, 2);
  const Sampling s = sample(bowl);
  for_grid(bowl, 41, [&](Vec2 uv) {
    const double expected = std::sqrt(1 + uv.y * uv.y) * kRasterLimits.alpha;  // across the meridian the smaller radius
    const double length = s.length_at(bowl.point(uv));
    ASSERT_LE(length, 1.02 * expected) << uv.y;
    ASSERT_GE(length, 0.75 * expected) << uv.y << ": a box reaches one length further than its patch";
  });
  EXPECT_GT(s.smallest(), 0.98 * kRasterLimits.alpha);
}

TEST(RasterFace, finds_a_narrow_fillet_inside_one_surface) {
  // flat, a bend of 60 degrees with radius 0.03, flat: 0.0314 long in a surface of 4
  const double radius = 0.03, bend = radians(60), middle = 1.37;
  const FormulaSurface fillet(
      [=](double u, double v) {
        const double s = u - middle, angle = std::clamp(s / radius, 0.0, bend), over = std::max(0.0, s - radius * bend);
        return Vec3{std::min(s, 0.0) + radius * std::sin(angle) + over * std::cos(bend), v,
                    radius * (1 - std::cos(angle)) + over * std::sin(bend)};
      },
      0, 4, 0, 2);
  const Sampling s = sample(fillet, {}, {0.001, 1, radians(10), 2});
  for (double v = 0.02; v < 2; v += 0.05)
    EXPECT_LT(s.length_at(fillet.point({middle + 0.5 * radius * bend, v})), 1.2 * radius * kRasterLimits.alpha);
  EXPECT_GT(s.length_at(fillet.point({0.2, 1})), 0.5);
  EXPECT_GT(s.smallest(), 0.7 * radius * kRasterLimits.alpha);
}

TEST(RasterFace, does_not_refine_along_a_crease_between_smooth_parts) {
  // a ridge of 40 degrees, announced as a break
  class Ridge : public Surface {
   public:
    Ridge() {
      u_min_ = -2, u_max_ = 2, v_min_ = 0, v_max_ = 2;
      type_ = SurfaceType::kBspline;
      u_breaks_ = {0};
    }
    Vec3 point(Vec2 p) const override { return {p.x, p.y, -kRise * std::abs(p.x)}; }
    SurfacePoint evaluate(Vec2 p) const override { return {point(p), {1, 0, p.x < 0 ? kRise : -kRise}, {0, 1, 0}}; }
    SurfacePoint2 evaluate2(Vec2 p) const override { return {point(p), evaluate(p).du, {0, 1, 0}, {}, {}, {}}; }
    const double kRise = std::tan(radians(20));
  };
  const Ridge ridge;
  const Sampling s = sample(ridge);
  EXPECT_NEAR(s.smallest(), kRasterLimits.max_length, 1e-6);
  expect_everywhere(ridge, s, kRasterLimits.max_length, 1e-6);
}

TEST(RasterFace, covers_exactly_the_trimmed_part) {
  // a plane with an outer loop far smaller than its bounds, and a hole
  const PlaneSurface plane(kRasterFrame, -50, 50, -50, 50);
  std::vector<Vec2> outer, hole;
  for (int i = 0; i < 200; ++i) {
    const double t = 2 * kPi * i / 200;
    outer.push_back({10 * std::cos(t), 6 * std::sin(t)});
    hole.push_back({3 * std::cos(t), -3 * std::sin(t)});
  }
  const LoopPolygons loops = polygon({outer, hole});
  const Sampling s = sample(plane, loops);
  EXPECT_NEAR(s.report.area, kPi * (60 - 9), 0.05 * kPi * 51);
  EXPECT_EQ(s.length_at({0, 0, 0}), 0);
  EXPECT_EQ(s.length_at({13, 0, 0}), 0);
  for (double x = -10; x <= 10; x += 0.1)
    for (double y = -6; y <= 6; y += 0.1)
      if (loops.contains({x, y})) {
        ASSERT_GT(s.length_at({x, y, 0}), 0) << x << " " << y;
      }
}

/// Least distance of x from the rectangles of the samples, over their lengths.
double lengths_away(const Sampling& s, Vec3 x) {
  double least = 1e300;
  for (const RasterBox& b : s.boxes)
    least = std::min(least, norm(Cone({b.center, b.length, b.cause, {}, {}, b.reach}, 1, {}).way_to(x)) / b.length);
  return least;
}

TEST(RasterFace, asks_for_its_lengths_on_rectangles_that_cover_it_and_hardly_more) {
  const PlaneSurface plane(kRasterFrame, -50, 50, -50, 50);
  const LoopPolygons loops = polygon({{{-7.3, -4.1}, {9.2, -2.2}, {8.7, 6.6}, {-6.1, 5.3}}});
  const Sampling s = sample(plane, loops, {0.01, 4, radians(10), 4});
  double least_outside = 1e300;
  for (double x = -12; x <= 12; x += 0.1)
    for (double y = -9; y <= 9; y += 0.1) {
      if (loops.contains({x, y}))
        ASSERT_LT(lengths_away(s, plane.point({x, y})), 1e-3) << x << " " << y;
      else if (std::abs(x) > 11 || std::abs(y) > 8)
        least_outside = std::min(least_outside, lengths_away(s, plane.point({x, y})));
    }
  EXPECT_GT(least_outside, 0.3) << "as far as the loops, not as far as the pieces into which the surface was cut";
  const AxialSurface sphere(SurfaceType::kSphere, kRasterFrame, 2, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  const Sampling round = sample(sphere);
  for_grid(sphere, 40, [&](Vec2 uv) { ASSERT_LT(lengths_away(round, sphere.point(uv)), 0.25); });
}

TEST(RasterFace, has_places_in_patches_without_width) {
  Patch<CurvePoint> patch;
  for (std::size_t k = 0; k < 3; ++k) {
    patch.u[k] = 1;
    patch.v[k] = 0.5 * static_cast<double>(k);
  }
  for (std::size_t k = 0; k < 9; ++k) patch.probe[k].x = {3, patch.uv(k).y, 0};
  patch.is_inside.fill(true);
  const PatchPart part = part_inside(patch, LoopPolygons());
  EXPECT_EQ(part.center, (Vec3{3, 0.5, 0}));
  EXPECT_EQ(part.along_u, Vec3{});
  EXPECT_EQ(part.along_v, (Vec3{0, 0.5, 0}));
}

TEST(RasterFace, covers_a_sliver_thinner_than_any_probe_distance) {
  const PlaneSurface plane(kRasterFrame, 0, 20, 0, 20);
  const LoopPolygons loops = polygon({{{0.3, 0.7}, {19.1, 12.2}, {19.1, 12.201}, {0.3, 0.701}}});
  const Sampling s = sample(plane, loops);
  for (double t = 0; t <= 1; t += 0.001) ASSERT_GT(s.length_at({0.3 + 18.8 * t, 0.7005 + 11.5 * t, 0}), 0) << t;
}

/// Where a cut along a nose leaves one row of probes, that does not turn.
TEST(RasterFace, sees_a_nose_of_which_a_cut_leaves_a_sliver) {
  constexpr double kRadius = 0.1, kSpan = 10;
  const FormulaSurface nose(
      [](double u, double v) {
        return Vec3{kRadius * (1 - std::cos(u / kRadius)), v, kRadius * std::sin(u / kRadius)};
      },
      0, 0.3, 0, kSpan);
  const Vec2 a{0, 0}, b{0.02, 0}, c{0, kSpan};
  const Sampling s = sample(nose, LoopPolygons({{a, b}, {b, c}, {c, a}}));
  for (const double v : {2., 5., 8.}) {
    EXPECT_NEAR(s.length_at(nose.point({0, v})), kRadius * kRasterLimits.alpha, 0.1 * kRadius * kRasterLimits.alpha)
        << v;
  }
}

TEST(RasterFace, stretches_pieces_whose_middle_the_loops_cut_off) {
  const AxialSurface cylinder(SurfaceType::kCylinder, kRasterFrame, 1, 0, 0, 2 * kPi, 0, 30);
  SamplingLimits limits = kRasterLimits;
  limits.max_aspect = 8;
  const LoopPolygons loops = polygon({{{0.1, 0.2}, {6.1, 9.3}, {0.1, 9.31}}});
  const Sampling s = sample(cylinder, loops, limits);
  for (const RasterBox& b : s.boxes) {
    ASSERT_GT(b.stretch.along, 0.99) << b.center.z;
    ASSERT_GT(std::abs(Vec3(b.stretch.direction).z), 0.99) << b.center.z;
  }
}

double least_aspect(const Sampling& s) {
  double least = 1e300;
  for (const RasterBox& b : s.boxes) least = std::min<double>(least, b.stretch.along / b.length);
  return least;
}

TEST(RasterFace, sees_straight_lines_where_those_of_the_parameters_run_aslant) {
  // a cone whose lines v = const run about 45 degrees off its circles
  const FormulaSurface cone(
      [](double u, double v) {
        const double s = v + u;
        return Vec3{s * std::cos(u), s * std::sin(u), s};
      },
      0, 1, 0.5, 2);
  SamplingLimits limits = kRasterLimits;
  limits.max_aspect = 6;
  limits.max_along = 10;
  EXPECT_GT(least_aspect(sample(cone, {}, limits)), 5.9);
}

TEST(RasterFace, sees_where_the_surface_begins_to_bend_beside_its_probes) {
  // a round nose that bends from 4.915 on; the loops leave a strip before that with one row of probes
  const auto nose = [](double bend) {
    return FormulaSurface(
        [bend](double u, double v) {
          return Vec3{0.1 * std::cos(u) + bend * std::pow(std::max(v - 4.915, 0.0), 2), 0.1 * std::sin(u), v};
        },
        -0.5, 0.5, 0, 10);
  };
  SamplingLimits limits = kRasterLimits;
  limits.max_aspect = 50;
  limits.max_along = 10;
  const LoopPolygons strip = polygon({{{-0.5, 4.911}, {0.5, 4.911}, {0.5, 4.913}, {-0.5, 4.913}}});
  EXPECT_GT(least_aspect(sample(nose(0), strip, limits)), 49);
  EXPECT_LT(least_aspect(sample(nose(30), strip, limits)), 5);
}

TEST(RasterFace, takes_no_length_from_outside_the_loops) {
  // the surface bends sharply where it is trimmed away
  const FormulaSurface bend(
      [](double u, double v) {
        return Vec3{u, v, u > 3 ? 0.2 * std::pow(u - 3, 3) * 40 : 0.0};
      },
      0, 4, 0, 2);
  const LoopPolygons loops = polygon({{{0, 0}, {2.5, 0}, {2.5, 2}, {0, 2}}});
  EXPECT_NEAR(sample(bend, loops).smallest(), kRasterLimits.max_length, 1e-6);
}

TEST(RasterFace, cuts_a_curvature_that_no_angle_confirms) {
  // one probe of a flat surface reports an absurd second derivative, as noisy parametrisations do
  class Noisy : public PlaneSurface {
   public:
    Noisy() : PlaneSurface(kRasterFrame, 0, 4, 0, 4) { type_ = SurfaceType::kBspline; }
    SurfacePoint2 evaluate2(Vec2 uv) const override {
      SurfacePoint2 p = PlaneSurface::evaluate2(uv);
      if (uv.x == 2 && uv.y == 2) p.duu = {0, 0, 1e6};
      return p;
    }
  };
  EXPECT_NEAR(sample(Noisy()).smallest(), kRasterLimits.max_length, 1e-6);
}

TEST(RasterFace, ends_on_a_surface_without_extent) {
  const FormulaSurface point([](double, double) { return Vec3{1, 2, 3}; }, 0, 1, 0, 1);
  const Sampling s = sample(point);
  EXPECT_GT(s.boxes.size(), 0u);
  EXPECT_LT(s.boxes.size(), 100u);
}

TEST(RasterFace, covers_with_every_cell_per_length) {
  const AxialSurface sphere(SurfaceType::kSphere, kRasterFrame, 1, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  for (const double ratio : {1.0, 2.0, 4.0, 8.0})
    expect_everywhere(sphere, sample(sphere, {}, {0.01, 1, radians(10), ratio}), kRasterLimits.alpha, 0.02);
}

/// Two rectangles that meet at x = 0.1, the second turned by `kink` about that side and moved along it by `jump`.
CompositeSurface kinked_composite(double kink, double jump) {
  constexpr double kSide = 0.1;
  const Vec3 along{std::cos(kink), 0, std::sin(kink)}, across{0, 1, 0};
  std::vector<std::unique_ptr<Surface>> members;
  members.push_back(std::make_unique<PlaneSurface>(kRasterFrame, -1, kSide, 0, 1));
  members.push_back(
      std::make_unique<PlaneSurface>(Frame{{kSide, jump, 0}, along, across, cross(along, across)}, 0, 1, 0, 1));
  Chart chart;
  chart.uv = {{-1, 0}, {kSide, 0}, {kSide, 1}, {-1, 1}, {1 + kSide, 0}, {1 + kSide, 1}};
  for (const Vec2 p : chart.uv)
    chart.x.push_back(Vec3{std::min(p.x, kSide), p.y, 0} + std::max(p.x - kSide, 0.0) * along);
  chart.normal.assign(chart.x.size(), Vec3{0, 0, 1});
  chart.corners = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  CompositeSupport support;
  for (std::size_t t = 0; t < chart.corners.size(); ++t) {
    std::array<Vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = chart.uv[static_cast<std::size_t>(chart.corners[t][k])] - Vec2{t < 2 ? 0 : kSide, 0};
    support.member.push_back(t < 2 ? 0 : 1);
    support.corner_uv.push_back(uv);
    support.pole.push_back(kNone);
  }
  return CompositeSurface(std::move(chart), std::move(support), std::move(members), {-1, 1 + kSide, 0, 1});
}

/// A wavy spline, cut at u = 0.37 as the two members of a composite, or not. The second member is turned: its (u,v) is
/// that of another spline, with v the other way round.
struct CutSpline {
  static constexpr double kCut = 0.37;

  static std::unique_ptr<BsplineSurface> spline(double u_min, double u_max, bool is_turned) {
    constexpr int kPoles = 10;
    std::vector<double> knots{0, 0, 0};
    for (int i = 0; i <= kPoles - 3; ++i) knots.push_back(i / (kPoles - 3.0));
    knots.insert(knots.end(), {1, 1, 1});
    std::vector<Pole> poles;
    for (int i = 0; i < kPoles; ++i)
      for (const double v : {is_turned ? 2.0 : 0.0, is_turned ? 0.0 : 2.0})
        poles.push_back({{3.0 * i / (kPoles - 1), v, 0.2 * std::sin(1.7 * i + v), 1}});
    return std::make_unique<BsplineSurface>(KnotSpans(3, knots, 0), KnotSpans(1, {0, 0, 1, 1}, 0), poles, 2, false,
                                            Box2{{u_min, 0}, {u_max, 1}});
  }

  static CompositeSurface composite() {
    std::vector<std::unique_ptr<Surface>> members;
    members.push_back(spline(0, kCut, false));
    members.push_back(spline(kCut, 1, true));
    Chart chart;
    chart.uv = {{0, 0}, {kCut, 0}, {kCut, 1}, {0, 1}, {1, 0}, {1, 1}};
    for (const Vec2 p : chart.uv) chart.x.push_back(spline(0, 1, false)->point(p));
    chart.normal.assign(chart.x.size(), Vec3{0, 0, 1});
    chart.corners = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
    CompositeSupport support{{0, 0, 1, 1}, {}, std::vector<std::int32_t>(4, kNone)};
    for (std::size_t t = 0; t < chart.corners.size(); ++t) {
      std::array<Vec2, 3> uv;
      for (std::size_t k = 0; k < 3; ++k) {
        uv[k] = chart.uv[static_cast<std::size_t>(chart.corners[t][k])];
        if (t >= 2) uv[k].y = 1 - uv[k].y;
      }
      support.corner_uv.push_back(uv);
    }
    return CompositeSurface(std::move(chart), std::move(support), std::move(members), {0, 1, 0, 1});
  }
};

TEST(RasterFace, asks_for_the_same_lengths_where_a_cut_makes_two_members_of_a_spline) {
  const auto whole = CutSpline::spline(0, 1, false);
  const SamplingLimits limits{0.001, 1, radians(2), 2};
  const Sampling one = sample(*whole, {}, limits), two = sample(CutSpline::composite(), {}, limits);
  EXPECT_NEAR(one.report.area, two.report.area, 0.01 * one.report.area);
  int n = 0, n_other = 0;  // others are near the cut
  for_grid(*whole, 60, [&](Vec2 uv) {
    const double length = one.length_at(whole->point(uv));
    ++n;
    n_other += std::abs(two.length_at(whole->point(uv)) / length - 1) > 1e-6;
  });
  EXPECT_LT(n_other, n / 10);
}

TEST(RasterFace, has_outward_normals_on_members_that_are_turned) {
  const Sampling s = sample(CutSpline::composite());
  for (const RasterBox& box : s.boxes) EXPECT_GT(Vec3(box.normal).z, 0) << box.center.x;
}

TEST(RasterFace, a_kink_between_members_of_a_composite_is_no_curvature) {
  SamplingLimits limits = kRasterLimits;
  limits.alpha = radians(2);
  const Sampling flat = sample(kinked_composite(0, 0), {}, limits),
                 kinked = sample(kinked_composite(radians(2.5), 0), {}, limits);
  EXPECT_FLOAT_EQ(static_cast<float>(kinked.smallest()), static_cast<float>(limits.max_length));
  EXPECT_EQ(kinked.boxes.size(), flat.boxes.size());
}

TEST(RasterFace, places_that_jump_between_members_of_a_composite_are_not_split_without_end) {
  SamplingLimits limits = kRasterLimits;
  limits.min_length = limits.max_length = 0.05;
  limits.max_samples = 1 << 16;
  const Sampling flat = sample(kinked_composite(0, 0), {}, limits),
                 jumping = sample(kinked_composite(0, 0.2), {}, limits);
  EXPECT_LE(jumping.boxes.size(), flat.boxes.size() + flat.boxes.size() / 10);
}

/// Beside facets the nearest place jumps from one to the other, on a slanting line that splits never leave.
TEST(RasterFace, places_that_jump_between_facets_are_not_split_without_end) {
  Chart chart;
  chart.uv = {{0, 0}, {1, 0}, {0, 1}, {4, 4}, {3, 4}, {4, 3}};
  for (const Vec2 p : chart.uv) chart.x.push_back({p.x, p.y, 0});
  chart.normal.assign(chart.x.size(), {0, 0, 1});
  chart.corners = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_LT(sample(ChartSurface(std::move(chart))).report.n_evaluations, 10'000'000);
}

TEST(RasterFace, tells_meanwhile_what_area_is_sampled) {
  const AxialSurface sphere(SurfaceType::kSphere, kRasterFrame, 1, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  std::vector<RasterBox> boxes;
  std::vector<double> news;
  raster_face(sphere, LoopPolygons(), {0.01, 0.01, radians(10), 2}, 0, boxes, nullptr, nullptr,
              [&](double area) { news.push_back(area); });
  ASSERT_EQ(news.size(), boxes.size() / 1000);
  ASSERT_GT(news.size(), 20u);
  double sum = 0;
  for (const double area : news) sum += area;
  EXPECT_NEAR(sum, 4 * kPi, 0.05 * 4 * kPi);
}

}  // namespace
}  // namespace st
