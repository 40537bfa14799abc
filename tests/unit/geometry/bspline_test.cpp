#include "geometry/shape/bspline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/threads.h"

namespace st {
namespace {

/// Sum over the acting functions of the basis' power coefficients, evaluated at s.
double basis_sum(const KnotSpans& k, int span, double s) {
  const int order = k.degree() + 1;
  double sum = 0;
  for (int j = 0; j < order; ++j) {
    double value = 0;
    for (int c = order - 1; c >= 0; --c) value = value * s + k.basis(span)[j * order + c];
    sum += value;
  }
  return sum;
}

std::vector<double> clamped_knots(int degree, std::vector<double> inner, double end) {
  std::vector<double> knots(degree + 1, 0.0);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), degree + 1, end);
  return knots;
}

TEST(KnotSpans, basis_functions_sum_to_one) {
  for (int degree : {1, 2, 3, 5, 9, 15, 25}) {
    const KnotSpans k(degree, clamped_knots(degree, {0.1, 0.5, 0.5, 2}, 3), 0);
    ASSERT_EQ(k.n_spans(), 4);
    for (int span = 0; span < k.n_spans(); ++span)
      for (double s : {-1.0, -0.3, 0.0, 0.8, 1.0})
        EXPECT_NEAR(basis_sum(k, span, s), 1, 1e-13 * std::pow(2.5, degree)) << degree;
  }
}

TEST(KnotSpans, finds_the_span_whatever_it_was_before) {
  const KnotSpans k(2, clamped_knots(2, {1, 1.5, 4}, 6), 0);
  const std::pair<double, int> expected[] = {{0, 0}, {0.99, 0}, {1, 1}, {1.5, 2}, {3.9, 2},
                                             {4, 3}, {6, 3},    {7, 3}, {-1, 0}};
  for (int before = 0; before < 4; ++before)
    for (const auto& [t, span] : expected) {
      int last = before;
      double s;
      EXPECT_EQ(k.locate(t, last, s), span) << t;
      EXPECT_EQ(last, span);
      if (t >= 0 && t <= 6) {
        EXPECT_LE(std::abs(s), 1);
      }
    }
}

TEST(KnotSpans, local_parameter_runs_from_minus_one_to_one) {
  const KnotSpans k(3, clamped_knots(3, {2}, 5), 0);
  int last = 0;
  double s;
  k.locate(2, last, s);
  EXPECT_DOUBLE_EQ(s, -1);
  k.locate(5, last, s);
  EXPECT_DOUBLE_EQ(s, 1);
  EXPECT_DOUBLE_EQ(k.rate(1), 2.0 / 3);
}

TEST(KnotSpans, wraps_by_the_period) {
  const KnotSpans k(2, clamped_knots(2, {1, 3}, 4), 4);
  int last = 0;
  double s, t;
  for (double x : {0.5, 2.0, 3.5})
    for (double turns : {-3.0, -1.0, 1.0, 2.0}) {
      const int span = k.locate(x, last, s);
      EXPECT_EQ(k.locate(x + 4 * turns, last, t), span);
      EXPECT_NEAR(s, t, 1e-14);
    }
}

TEST(KnotSpans, finds_spans_of_very_different_lengths) {
  const std::vector<double> inner{1e-9, 2e-9, 3e-9, 0.5, 0.5 + 1e-12, 0.7, 0.99999999};
  const KnotSpans k(3, clamped_knots(3, inner, 1), 0);
  const std::vector<double> knots = k.distinct_knots();
  ASSERT_EQ(knots.size(), inner.size() + 2);
  for (int i = 0; i < k.n_spans(); ++i)
    for (double share : {0.0, 0.5, 0.99}) {
      const double t = knots[i] + share * (knots[i + 1] - knots[i]);
      int last = (i + 3) % k.n_spans();
      double s;
      EXPECT_EQ(k.locate(t, last, s), i) << t;
    }
}

TEST(KnotSpans, lists_its_knots_along_the_period) {
  const KnotSpans once(2, clamped_knots(2, {1, 3, 3}, 4), 0), round(2, clamped_knots(2, {1, 3}, 4), 4);
  EXPECT_EQ(once.distinct_knots(), (std::vector<double>{0, 1, 3, 4}));
  EXPECT_EQ(once.knots_between(0, 4), (std::vector<double>{1, 3}));
  EXPECT_EQ(once.knots_between(1, 3.5), std::vector<double>{3});
  EXPECT_EQ(round.knots_between(-2, 5.5), (std::vector<double>{-1, 0, 1, 3, 4, 5}));
  EXPECT_EQ(round.knots_between(0, 4), (std::vector<double>{1, 3}));
}

TEST(KnotSpans, takes_a_parameter_that_misses_a_knot_by_rounding_for_the_knot) {
  const KnotSpans k(2, clamped_knots(2, {kPi, kPi}, 6), 0);
  int last = 0;
  double s;
  EXPECT_EQ(k.locate(std::nextafter(kPi, 0.0), last, s), 1);
  EXPECT_EQ(k.locate(kPi - 1e-13, last, s), 0);
  EXPECT_TRUE(k.knots_between(std::nextafter(kPi, 0.0), 6).empty());
  const KnotSpans round(2, clamped_knots(2, {2}, 4), 4);  // a seam at 0 that is missed by rounding is no turn
  EXPECT_EQ(round.locate(-1e-16, last, s), 0);
  EXPECT_EQ(round.locate(4 + 1e-15, last, s), 1);
  EXPECT_EQ(round.locate(-1e-9, last, s), 1);
}

TEST(KnotSpans, knows_its_kinks) {
  EXPECT_EQ(KnotSpans(3, clamped_knots(3, {1, 2, 2, 2, 3, 3}, 4), 0).c0_knots(), std::vector<double>{2});
  EXPECT_TRUE(KnotSpans(3, clamped_knots(3, {1, 2, 2}, 4), 0).c0_knots().empty());
  EXPECT_EQ(KnotSpans(1, clamped_knots(1, {1, 2}, 4), 0).c0_knots(), (std::vector<double>{1, 2}));
}

Pole pole(Vec3 x, double w = 1) { return {{w * x.x, w * x.y, w * x.z, w}}; }

TEST(BsplineCurve, of_equally_spaced_poles_is_a_line_of_constant_speed) {
  // Greville abscissae of the knots as x: the identity map, whatever the degree
  for (int degree : {1, 2, 3, 7}) {
    const std::vector<double> knots = clamped_knots(degree, {1, 1.5, 4}, 6);
    std::vector<Pole> poles;
    for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i) {
      double x = 0;
      for (int j = 1; j <= degree; ++j) x += knots[i + j] / degree;
      poles.push_back(pole({x, 2 * x, -x}));
    }
    const BsplineCurve c(KnotSpans(degree, knots, 0), poles, false, 0, 6);
    for (double t = 0; t <= 6; t += 0.37) {
      const CurvePoint p = c.evaluate(t);
      EXPECT_LE(distance(p.x, {t, 2 * t, -t}), 1e-13);
      EXPECT_LE(distance(p.d1, {1, 2, -1}), 1e-11);
      EXPECT_LE(norm(p.d2), 1e-9);
    }
  }
}

TEST(BsplineCurve, of_rational_quarter_is_a_circle) {
  const double w = std::sqrt(0.5);
  const BsplineCurve c(KnotSpans(2, clamped_knots(2, {}, 1), 0), {pole({5, 0, 0}), pole({5, 5, 0}, w), pole({0, 5, 0})},
                       true, 0, 1);
  for (double t = 0; t <= 1; t += 0.05) {
    const CurvePoint p = c.evaluate(t);
    EXPECT_NEAR(norm(p.x), 5, 1e-14);
    EXPECT_NEAR(dot(p.x, p.d1), 0, 1e-12);
    EXPECT_NEAR(norm2(p.d1) + dot(p.x, p.d2), 0, 1e-11);  // second derivative of |x|^2 = const
    EXPECT_TRUE(p.x == c.point(t));
  }
}

TEST(BsplineSurface, bilinear_patch_is_the_mean_of_its_corners) {
  const std::vector<double> knots = clamped_knots(1, {}, 1);
  const BsplineSurface s(KnotSpans(1, knots, 0), KnotSpans(1, knots, 0),
                         {pole({0, 0, 0}), pole({0, 1, 2}), pole({1, 0, 4}), pole({1, 1, 8})}, 2, false, {0, 1, 0, 1});
  const SurfacePoint2 p = s.evaluate2({0.5, 0.5});
  EXPECT_TRUE(p.x == (Vec3{0.5, 0.5, 3.5}));
  EXPECT_TRUE(p.du == (Vec3{1, 0, 5}));
  EXPECT_TRUE(p.dv == (Vec3{0, 1, 3}));
  EXPECT_TRUE(p.duv == (Vec3{0, 0, 2}));
  EXPECT_TRUE(s.point({0, 1}) == (Vec3{0, 1, 2}));  // v fastest
}

TEST(BsplineCurve, copies_are_the_same_curve) {
  const std::vector<Pole> poles{{{0, 0, 0, 1}}, {{1, 0, 0, 1}}, {{1, 1, 0, 1}}, {{0, 1, 2, 1}}};
  const BsplineCurve curve(KnotSpans(2, clamped_knots(2, {1}, 2), 0), poles, false, 0.25, 1.75);
  const std::unique_ptr<Curve> copy = curve.copy();
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->t_min(), 0.25);
  EXPECT_EQ(copy->t_max(), 1.75);
  EXPECT_EQ(copy->knots(), curve.knots());
  for (const double t : {0.3, 1.0, 1.6}) EXPECT_EQ(copy->evaluate(t).d1, curve.evaluate(t).d1);
}

TEST(BsplineSurface, is_part_of_a_whole_one) {
  const std::vector<double> knots{0, 0, 2, 2};
  const std::vector<Pole> poles{{{0, 0, 0, 1}}, {{0, 1, 0, 1}}, {{1, 0, 0, 1}}, {{1, 1, 0, 1}}};
  const auto part = [&](double u_min, double u_max) {
    return BsplineSurface(KnotSpans(1, knots, 0), KnotSpans(1, knots, 0), poles, 2, false, {u_min, u_max, 0.5, 1});
  };
  const auto whole = part(0.25, 2).whole();
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->u_min() + whole->v_min(), 0);
  EXPECT_EQ(whole->u_max() + whole->v_max(), 4);
  EXPECT_EQ(whole->point({0.5, 1}), part(0.25, 2).point({0.5, 1}));
  EXPECT_FALSE(part(-0.25, 2).whole()) << "beyond a period a spline has no whole";
}

TEST(BsplineSurface, copies_live_on_their_own) {
  auto surface = std::make_unique<BsplineSurface>(
      KnotSpans(1, {0, 0, 1, 1}, 0), KnotSpans(1, {0, 0, 1, 1}, 0),
      std::vector<Pole>{{{0, 0, 0, 1}}, {{0, 1, 2, 1}}, {{1, 0, 3, 1}}, {{1, 1, 0, 1}}}, 2, false,
      Box2{{0.1, 0.2}, {0.9, 0.8}});
  const std::unique_ptr<Surface> copy = surface->copy();
  const SurfacePoint2 at = surface->evaluate2({0.3, 0.7});
  surface.reset();
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->evaluate2({0.3, 0.7}).x, at.x);
  EXPECT_EQ(copy->evaluate2({0.3, 0.7}).duv, at.duv);
  EXPECT_EQ(copy->u_min(), 0.1);
  EXPECT_EQ(copy->v_max(), 0.8);
  EXPECT_EQ(copy->type(), SurfaceType::kBspline);
}

TEST(BsplineSurface, copies_meet_the_same_spans_on_threads) {
  constexpr int kSpans = 200;
  std::vector<double> along;
  std::vector<Pole> poles;
  for (int i = 1; i < kSpans; ++i) along.push_back(i);
  for (int i = 0; i < kSpans + 2; ++i)
    for (int j = 0; j < 2; ++j) poles.push_back({{1.0 * i, 1.0 * j, std::sin(0.3 * i + j), 1}});
  const auto make = [&] {
    return BsplineSurface(KnotSpans(2, clamped_knots(2, along, kSpans), 0), KnotSpans(1, {0, 0, 1, 1}, 0), poles, 2,
                          false, {0, 1.0 * kSpans, 0, 1});
  };
  const BsplineSurface shared = make();
  std::vector<Vec3> expected;  // of a surface that has met no other span
  for (int i = 0; i < kSpans; ++i) expected.push_back(make().point({i + 0.4, 0.3}));
  constexpr std::size_t kCopies = 8;
  std::vector<int> n_other(kCopies);
  set_thread_count(4);
  parallel_for(kCopies, 1, [&](std::size_t k, std::size_t) {
    const std::unique_ptr<Surface> copy = shared.copy();
    for (int i = 0; i < kSpans; ++i) n_other[k] += !(copy->point({i + 0.4, 0.3}) == expected[i]);
  });
  set_thread_count(1);
  EXPECT_EQ(n_other, std::vector<int>(kCopies, 0));
}

}  // namespace
}  // namespace st
