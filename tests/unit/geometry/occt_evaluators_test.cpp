// Our evaluators against OpenCASCADE's, on every kind of surface and curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>

#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "support/shapes.h"

namespace st {
namespace {

constexpr double kPointError = 1e-12;  // of the model's diagonal
constexpr double kSlopeError = 1e-10;  // of the diagonal per polynomial piece, and of the derivative
constexpr double kBendError = 1e-8;    // likewise for second derivatives

/// The k-th of a sequence of numbers in [0,1] that fills it evenly.
double spread(int k, double step) { return std::fmod(0.5 + k * step, 1.0); }

/// Length of the polynomial piece that holds `t`: derivatives are as exact as points are against it.
double piece_length(std::vector<double> knots, double lo, double hi, double t) {
  knots.insert(knots.begin(), lo);
  knots.push_back(hi);
  std::size_t k = 1;
  while (k + 1 < knots.size() && t > knots[k]) ++k;
  double length = knots[k] - knots[k - 1];
  if (t == knots[k] && k + 1 < knots.size()) length = std::min(length, knots[k + 1] - knots[k]);
  return length;
}

/// How far our evaluators are from OpenCASCADE's, worst of all that was compared.
struct Difference {
  double point = 0;  // of the model's size
  double slope = 0, bend = 0;

  /// `n` places of a face; the first four are the corners of the bounds, one in eight lies outside by half a per cent
  /// of the outermost piece.
  void add_face(const Model& model, const test::Oracle& oracle, FaceId f, double size, int n) {
    const auto s = model.surface(f);
    const double u0 = s->u_min(), du = s->u_max() - u0, v0 = s->v_min(), dv = s->v_max() - v0;
    for (int k = 0; k < n; ++k) {
      Vec2 at{spread(k, 0.7548776662466927), spread(k, 0.5698402909980532)};
      if (k < 4) at = {double(k & 1), double(k >> 1)};
      Vec2 uv{u0 + du * at.x, v0 + dv * at.y};
      if (k % 16 == 7) uv.x = u0 - 0.005 * piece_length(s->u_knots(), u0, u0 + du, u0);
      if (k % 16 == 15) uv.y = v0 + dv + 0.005 * piece_length(s->v_knots(), v0, v0 + dv, v0 + dv);
      add_place(*s, oracle, f, uv, size);
    }
  }

  void add_place(const Surface& s, const test::Oracle& oracle, FaceId f, Vec2 uv, double size) {
    const double du = piece_length(s.u_knots(), s.u_min(), s.u_max(), uv.x),
                 dv = piece_length(s.v_knots(), s.v_min(), s.v_max(), uv.y);
    const SurfacePoint2 want = oracle.surface(f, uv), have = s.evaluate2(uv);
    const SurfacePoint first = s.evaluate(uv);
    point = std::max({point, distance(want.x, have.x) / size, distance(want.x, first.x) / size,
                      distance(want.x, s.point(uv)) / size});
    const auto is_near = [](double a, double b, double range) { return std::abs(a - b) <= 1e-12 * range; };
    const auto is_kink = [&](const std::vector<double>& breaks, double period, double lo, double hi, double t) {
      return (period > 0 && (is_near(t, lo, period) || is_near(t, hi, period))) ||
             std::any_of(breaks.begin(), breaks.end(), [&](double b) { return is_near(t, b, hi - lo); });
    };
    if (is_kink(s.u_breaks(), s.u_period(), s.u_min(), s.u_max(), uv.x)) return;  // either side is right
    if (is_kink(s.v_breaks(), s.v_period(), s.v_min(), s.v_max(), uv.y)) return;
    const auto relative = [&](Vec3 a, Vec3 b, double range) { return distance(a, b) / (size / range + norm(a)); };
    slope = std::max({slope, relative(want.du, have.du, du), relative(want.dv, have.dv, dv),
                      relative(want.du, first.du, du), relative(want.dv, first.dv, dv)});
    bend = std::max({bend, relative(want.duu, have.duu, du * du), relative(want.duv, have.duv, du * dv),
                     relative(want.dvv, have.dvv, dv * dv)});
  }

  void add_edge(const Model& model, const test::Oracle& oracle, EdgeId e, double size, int n) {
    const auto curve = model.curve(e);
    const double t0 = curve->t_min(), range = curve->t_max() - t0;
    for (int k = 0; k < n; ++k) {
      const double at = k < 2 ? t0 + range * k : t0 + range * spread(k, 0.6180339887498949);
      const CurvePoint want = oracle.curve(e, at), have = curve->evaluate(at);
      point = std::max({point, distance(want.x, have.x) / size, distance(want.x, curve->point(at)) / size});
      if (k < 2 && curve->period() > 0) continue;  // at the seam either side is right
      const double piece = piece_length(curve->knots(), t0, t0 + range, at);
      slope = std::max(slope, distance(want.d1, have.d1) / (size / piece + norm(want.d1)));
      bend = std::max(bend, distance(want.d2, have.d2) / (size / (piece * piece) + norm(want.d2)));
    }
  }

  void expect_none(const std::string& what) const {
    EXPECT_LE(point, kPointError) << what;
    EXPECT_LE(slope, kSlopeError) << what;
    EXPECT_LE(bend, kBendError) << what;
  }
};

double size_of(const ModelTables& t) { return std::max({t.box().diagonal(), norm(t.box().lo), norm(t.box().hi)}); }

/// Compares a model with OpenCASCADE at `n` places per face and edge.
void expect_as_occt(const ModelTables& t, const std::vector<std::byte>& brep, const std::string& what, int n) {
  const Model model(t, brep);
  const test::Oracle oracle(brep);
  Difference difference;
  for (FaceId f = 0; f < t.n_faces(); ++f) difference.add_face(model, oracle, f, size_of(t), n);
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (!t.edge_is_degenerate[e]) difference.add_edge(model, oracle, e, size_of(t), n);
  difference.expect_none(what);
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
      const SurfacePoint l = s->evaluate({p.x - a, p.y}), r = s->evaluate({p.x + a, p.y}),
                         o = s->evaluate({p.x, p.y - b}), t = s->evaluate({p.x, p.y + b});
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

INSTANTIATE_TEST_SUITE_P(, EvaluatorsOf, testing::ValuesIn(shapes_with_faces()),
                         [](const auto& info) { return info.param; });

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

/// Faces that show every kind of surface: of each type some, spread over the model.
std::vector<FaceId> faces_of_every_type(const ModelTables& t, int n_each) {
  std::vector<FaceId> sample;
  for (int type = 0; type <= static_cast<int>(SurfaceType::kOther); ++type) {
    std::vector<FaceId> own;
    for (FaceId f = 0; f < t.n_faces(); ++f)
      if (static_cast<int>(t.face_type[f]) == type) own.push_back(f);
    const int n = static_cast<int>(own.size()), n_taken = std::min(n, n_each);
    for (int i = 0; i < n_taken; ++i) sample.push_back(own[static_cast<std::size_t>(i) * n / n_taken]);
  }
  return sample;
}

TEST(Evaluators, agree_with_opencascade_on_every_type_of_surface_of_real_files) {
  namespace fs = std::filesystem;
  const char* given = std::getenv("ST_CORPUS");
  const fs::path folder = given && *given ? fs::path(given) : fs::path(ST_SOURCE_DIR) / "../shared/corpus";
  if (!fs::is_directory(folder)) {
    std::cout
        << "SKIPPED: Evaluators.agree_with_opencascade_on_every_type_of_surface_of_real_files: corpus not found at "
        << folder << "; set ST_CORPUS" << std::endl;
    GTEST_SKIP() << "no corpus";
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string suffix = entry.path().extension().string();
    for (const char* known : {".brep", ".step", ".stp", ".igs", ".iges"})
      if (suffix == known) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 20u);
  std::set<SurfaceType> types;
  for (const fs::path& path : files) {
    const ImportResult r = import_model(path.string(), {});
    const Model model(r.tables, r.brep);
    const test::Oracle oracle(r.brep);
    const double size = size_of(r.tables);
    Difference difference;
    for (const FaceId f : faces_of_every_type(r.tables, 6)) {
      difference.add_face(model, oracle, f, size, 24);
      types.insert(r.tables.face_type[f]);
      const auto s = model.surface(f);
      const Vec2 middle{0.5 * (s->u_min() + s->u_max()), 0.5 * (s->v_min() + s->v_max())};
      for (const double turns : {-1.0, 1.0})
        difference.add_place(*s, oracle, f, {middle.x + turns * s->u_period(), middle.y + turns * s->v_period()}, size);
    }
    const EdgeId step = std::max(1, r.tables.n_edges() / 100);
    for (EdgeId e = 0; e < r.tables.n_edges(); e += step)
      if (!r.tables.edge_is_degenerate[e]) difference.add_edge(model, oracle, e, size, 12);
    difference.expect_none(path.filename().string());
  }
  EXPECT_GE(types.size(), 7u);
}

}  // namespace
}  // namespace st
