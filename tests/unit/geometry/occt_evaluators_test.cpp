// Our evaluators against OpenCASCADE's, on every kind of surface and curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "geometry/model.h"
#include "support/shapes.h"

namespace st {
namespace {

constexpr double kPointError = 1e-12;  // of the model's diagonal
constexpr double kSlopeError = 1e-10;  // of the diagonal per parameter range, and of the derivative
constexpr double kBendError = 1e-8;    // likewise for second derivatives

/// The k-th of a sequence of numbers in [0,1] that fills it evenly.
double spread(int k, double step) { return std::fmod(0.5 + k * step, 1.0); }

/// Compares a model with OpenCASCADE at `n` places per face and edge, ends included.
void expect_as_occt(const ModelTables& t, const std::vector<std::byte>& brep, const std::string& what, int n) {
  const Model model(t, brep);
  const test::Oracle oracle(brep);
  const Box3 box = t.box();
  const double size = std::max({box.diagonal(), norm(box.lo), norm(box.hi)});
  double worst = 0, worst_slope = 0, worst_bend = 0;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const auto surface = model.surface(f);
    const double u0 = surface->u_min(), du = surface->u_max() - u0, v0 = surface->v_min(), dv = surface->v_max() - v0;
    for (int k = 0; k < n; ++k) {
      Vec2 uv{u0 + du * spread(k, 0.7548776662466927), v0 + dv * spread(k, 0.5698402909980532)};
      if (k < 4) uv = {u0 + du * (k & 1), v0 + dv * (k >> 1)};
      const SurfacePoint2 want = oracle.surface(f, uv), have = surface->evaluate2(uv);
      const SurfacePoint first = surface->evaluate(uv);
      worst = std::max({worst, distance(want.x, have.x), distance(want.x, first.x), distance(want.x, surface->point(uv))});
      const auto relative = [&](Vec3 a, Vec3 b, double range) { return distance(a, b) / (size / range + norm(a)); };
      worst_slope = std::max({worst_slope, relative(want.du, have.du, du), relative(want.dv, have.dv, dv), relative(want.du, first.du, du),
                              relative(want.dv, first.dv, dv)});
      worst_bend = std::max({worst_bend, relative(want.duu, have.duu, du * du), relative(want.duv, have.duv, du * dv),
                             relative(want.dvv, have.dvv, dv * dv)});
    }
  }
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e]) continue;
    const auto curve = model.curve(e);
    const double t0 = curve->t_min(), range = curve->t_max() - t0;
    for (int k = 0; k < n; ++k) {
      const double at = k < 2 ? t0 + range * k : t0 + range * spread(k, 0.6180339887498949);
      const CurvePoint want = oracle.curve(e, at), have = curve->evaluate(at);
      worst = std::max({worst, distance(want.x, have.x), distance(want.x, curve->point(at))});
      worst_slope = std::max(worst_slope, distance(want.d1, have.d1) / (size / range + norm(want.d1)));
      worst_bend = std::max(worst_bend, distance(want.d2, have.d2) / (size / (range * range) + norm(want.d2)));
    }
  }
  EXPECT_LE(worst, kPointError * size) << what;
  EXPECT_LE(worst_slope, kSlopeError) << what;
  EXPECT_LE(worst_bend, kBendError) << what;
}

class EvaluatorsOf : public testing::TestWithParam<std::string> {};

TEST_P(EvaluatorsOf, agree_with_opencascade) {
  const ImportResult r = test::import_shape(GetParam());
  expect_as_occt(r.tables, r.brep, GetParam(), 200);
}

TEST_P(EvaluatorsOf, do_not_depend_on_what_was_asked_before) {
  const Model model = test::make_model(GetParam());
  for (FaceId f = 0; f < model.tables().n_faces(); ++f) {
    const auto used = model.surface(f);
    const auto at = [&](int k) {
      return Vec2{used->u_min() + (used->u_max() - used->u_min()) * spread(k, 0.7548776662466927),
                  used->v_min() + (used->v_max() - used->v_min()) * spread(k, 0.5698402909980532)};
    };
    for (int k = 0; k < 30; ++k) {
      used->evaluate2(at(k + 7));
      const Vec3 again = used->evaluate(at(k)).x, fresh = model.surface(f)->evaluate(at(k)).x;
      EXPECT_TRUE(again == fresh) << "face " << f;
    }
  }
}

TEST_P(EvaluatorsOf, derivatives_are_those_of_their_points) {
  const Model model = test::make_model(GetParam());
  for (FaceId f = 0; f < model.tables().n_faces(); ++f) {
    const auto s = model.surface(f);
    const double ru = s->u_max() - s->u_min(), rv = s->v_max() - s->v_min(), a = 1e-4 * ru, b = 1e-4 * rv;
    const double size = model.tables().box().diagonal();
    const auto near_break = [](const std::vector<double>& breaks, double x, double reach) {
      return std::any_of(breaks.begin(), breaks.end(), [&](double t) { return std::abs(t - x) <= reach; });
    };
    for (int k = 0; k < 40; ++k) {
      const Vec2 p{s->u_min() + ru * (0.01 + 0.98 * spread(k, 0.7548776662466927)),
                   s->v_min() + rv * (0.01 + 0.98 * spread(k, 0.5698402909980532))};
      if (near_break(s->u_breaks(), p.x, a) || near_break(s->v_breaks(), p.y, b)) continue;
      const SurfacePoint2 d = s->evaluate2(p);
      const SurfacePoint l = s->evaluate({p.x - a, p.y}), r = s->evaluate({p.x + a, p.y}), o = s->evaluate({p.x, p.y - b}),
                         t = s->evaluate({p.x, p.y + b});
      EXPECT_LE(distance(d.du, (r.x - l.x) / (2 * a)) * ru, 1e-4 * (size + norm(d.du) * ru));
      EXPECT_LE(distance(d.dv, (t.x - o.x) / (2 * b)) * rv, 1e-4 * (size + norm(d.dv) * rv));
      // third derivatives may jump at a knot: a difference across it is first order
      EXPECT_LE(distance(d.duu, (r.du - l.du) / (2 * a)) * ru * ru, 0.02 * (size + norm(d.duu) * ru * ru));
      EXPECT_LE(distance(d.duv, (r.dv - l.dv) / (2 * a)) * ru * rv, 0.02 * (size + norm(d.duv) * ru * rv));
      EXPECT_LE(distance(d.dvv, (t.dv - o.dv) / (2 * b)) * rv * rv, 0.02 * (size + norm(d.dvv) * rv * rv));
    }
  }
}

std::vector<std::string> shapes_with_faces() {
  std::vector<std::string> names = test::all_shapes();
  std::erase(names, "wire");
  return names;
}

INSTANTIATE_TEST_SUITE_P(, EvaluatorsOf, testing::ValuesIn(shapes_with_faces()), [](const auto& info) { return info.param; });

TEST(Evaluators, wrap_around_the_period) {
  const ImportResult r = test::import_shape("periodic_tube");
  const Model model(r.tables, r.brep);
  const auto s = model.surface(0);
  const double period = 9;
  for (int k = 0; k < 50; ++k) {
    const Vec2 uv{s->u_min() + period * spread(k, 0.618), s->v_min() + (s->v_max() - s->v_min()) * spread(k, 0.57)};
    for (double turns : {-2.0, -1.0, 1.0, 3.0}) {
      const SurfacePoint a = s->evaluate(uv), b = s->evaluate({uv.x + turns * period, uv.y});
      EXPECT_LE(distance(a.x, b.x), 1e-11);
      EXPECT_LE(distance(a.du, b.du), 1e-10);
    }
  }
}

TEST(Evaluators, name_the_parameters_where_the_surface_has_kinks) {
  const Model model = test::make_model("kinked");
  const auto kinked = model.surface(0);
  ASSERT_FALSE(kinked->u_breaks().empty());
  for (double u : kinked->u_breaks()) {
    const double e = 1e-9 * (kinked->u_max() - kinked->u_min()), v = 0.37 * kinked->v_max();
    EXPECT_GT(angle_between(kinked->evaluate({u - e, v}).du, kinked->evaluate({u + e, v}).du), 1e-3);
  }
  EXPECT_TRUE(test::make_model("wave").surface(0)->u_breaks().empty());
}

TEST(Evaluators, agree_with_opencascade_on_real_files) {
  namespace fs = std::filesystem;
  const char* given = std::getenv("ST_CORPUS");
  const fs::path folder = given && *given ? fs::path(given) : fs::path(__FILE__).parent_path() / "../../../../shared/corpus";
  if (!fs::is_directory(folder)) {
    std::cout << "SKIPPED: Evaluators.agree_with_opencascade_on_real_files: corpus not found at " << folder << "; set ST_CORPUS"
              << std::endl;
    GTEST_SKIP() << "no corpus";
  }
  for (const char* name : {"aero_onera_m6_sharpte.brep", "aero_evtol_bet.brep", "mech_occt_linkrods.step", "mech_netgen_screw.step",
                           "basic_refine_sphere_cube.brep", "aero_d150_wing.igs"}) {
    const fs::path path = folder / name;
    ASSERT_TRUE(fs::exists(path)) << path;
    const ImportResult r = import_model(path.string(), {});
    expect_as_occt(r.tables, r.brep, name, 12);
  }
}

}  // namespace
}  // namespace st
