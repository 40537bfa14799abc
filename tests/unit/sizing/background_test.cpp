#include "sizing/background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sizing/growth_limit.h"
#include "unit/sizing/background_meshes.h"
#include "unit/sizing/shock_metric.h"

namespace st {
namespace {

constexpr double kBackgroundSlope = 0.2, kSteep = 10;  // of which the latter limits nothing

BackgroundMesh one_tet(const std::array<double, 4>& lengths) {
  BackgroundMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const double h : lengths) mesh.node_size.push_back({h, h, {}});
  mesh.tets = {{0, 1, 2, 3}};
  return mesh;
}

using test::cube_of_tets;
using test::random_background_point;

double background_at(const SizeField& field, Vec3 x) { return field.size(x); }

TEST(BackgroundMesh, of_metrics_is_stretched_along_what_its_nodes_share) {
  BackgroundMesh mesh = one_tet({});
  const Vec3 t = normalized(Vec3{1, 2, 0});
  mesh.node_size = {{0.1, 0.8, t}, {0.1, 0.4, -t}, {0.2, 0.2, {}}, {0.1, 0.6, t}};
  const auto field = make_background(mesh, kSteep);
  int hint = 0;
  const LocalSize first = field->local({0, 0, 0}, hint), middle = field->local({0.25, 0.25, 0.25}, hint);
  EXPECT_NEAR(first.in(t), 0.8, 1e-9);
  EXPECT_NEAR(middle.in(t), (0.8 + 0.4 + 0.2 + 0.6) / 4, 1e-9);
  EXPECT_NEAR(middle.length, 0.125, 1e-12);
  EXPECT_NEAR(field->max_aspect(), 8, 1e-9);
}

TEST(BackgroundMesh, of_metrics_in_space_has_what_each_plane_cuts) {
  BackgroundMesh mesh = one_tet({});
  mesh.node_size.clear();
  for (int i = 0; i < 4; ++i) {
    mesh.node_metric.push_back(test::metric_of_shock({1, 0, 0}, 0.1 + 0.1 * i, 2));
    mesh.node_size.push_back(size_of_metric(mesh.node_metric.back()));
  }
  const auto field = make_background(mesh, kSteep);
  EXPECT_TRUE(field->has_metrics());
  int hint = 0;
  for (const Vec3 x : {Vec3{0, 0, 0}, Vec3{0.25, 0.25, 0.25}, Vec3{0.1, 0.2, 0.5}}) {
    const double across = field->size(x);
    EXPECT_NEAR(across, 0.1 + 0.1 * (x.x + 2 * x.y + 3 * x.z), 1e-12) << "linear";
    EXPECT_NEAR(field->local(x, hint).length, across, 1e-12);
    const LocalSize floor = field->local_on(x, {0, 0, 1}, hint), wall = field->local_on(x, {1, 0, 0}, hint);
    EXPECT_NEAR(floor.length, across, 1e-12);
    EXPECT_NEAR(std::abs(floor.direction.y), 1, 1e-9);
    EXPECT_GE(floor.along, 2 - 1e-9);
    EXPECT_NEAR(wall.length, floor.along, 1e-9) << "a plane that the shock lies on";
    EXPECT_NEAR(field->length_along(x, {0, 2, 2}, hint), wall.length, 1e-9);
  }
  // outside all lengths grow
  const LocalSize out = field->local_on({-0.01, 0, 0}, {0, 0, 1}, hint);
  EXPECT_NEAR(out.length, 0.2, 1e-9);
  EXPECT_NEAR(out.along, 2.1, 1e-9);
}

TEST(BackgroundMesh, keeps_metrics_when_another_mesh_without_them_is_appended) {
  BackgroundMesh with = one_tet({}), without = one_tet({0.3, 0.3, 0.3, 0.3});
  with.node_size.clear();
  for (int i = 0; i < 4; ++i) {
    with.node_metric.push_back(test::metric_of_shock({1, 0, 0}, 0.1, 2));
    with.node_size.push_back(size_of_metric(with.node_metric.back()));
  }
  for (const bool comes_first : {true, false}) {
    BackgroundMesh both = comes_first ? with : without;
    append(comes_first ? without : with, both);
    ASSERT_EQ(both.node_metric.size(), 8U);
    int hint = 0;  // both are at one place: their intersection
    const LocalSize size = make_background(both, kSteep)->local_on({0.2, 0.2, 0.2}, {0, 0, 1}, hint);
    EXPECT_NEAR(size.length, 0.1, 1e-9);
    EXPECT_NEAR(size.along, 0.3, 1e-9);
  }
  forget_plain_metrics(with);
  EXPECT_EQ(with.node_metric.size(), 4U);
  with.node_metric.assign(4, metric_of({0.1, 2, {0, 1, 0}}));
  forget_plain_metrics(with);
  EXPECT_TRUE(with.node_metric.empty());
}

TEST(BackgroundMesh, asks_for_no_less_around_a_place_than_its_bound_which_knows_how_flat_it_is) {
  const auto linear = [](Vec3 x) { return 0.1 + 0.011 * x.x - 0.003 * x.y + 0.013 * x.z; };
  const auto field = make_background(cube_of_tets(3, linear), kBackgroundSlope);
  std::mt19937 random(7);
  constexpr double kRadius = 0.15, kSteepest = 0.0174;
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = random_background_point(random, -0.3, 1.3);
    const double bound = field->least_within(x, kRadius, 1);
    for (int k = 0; k < 100; ++k) {
      const Vec3 step = random_background_point(random, -1, 1);
      if (norm(step) > 1) continue;
      ASSERT_GE(background_at(*field, x + kRadius * step), bound - 1e-12);
    }
    if (const Vec3 d = x - Vec3{0.5, 0.5, 0.5}; std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < 0.3) {
      ASSERT_GE(bound, linear(x) - kSteepest * kRadius - 1e-12);
    }
    EXPECT_LE(field->least_within(x, kRadius, 0.05), 0.05);
  }
}

TEST(BackgroundMesh, passes_over_flat_tetrahedra) {
  BackgroundMesh mesh = one_tet({0.1, 0.12, 0.13, 0.14});
  mesh.tets.push_back({0, 1, 2, 2});
  EXPECT_NEAR(background_at(*make_background(mesh, kBackgroundSlope), {0.2, 0.3, 0.1}), 0.1 + 0.004 + 0.009 + 0.004,
              1e-15);
}

TEST(BackgroundMesh, is_reproduced_to_rounding_where_it_is_flatter_than_the_slope) {
  const auto linear = [](Vec3 x) { return 0.1 + 0.11 * x.x - 0.03 * x.y + 0.13 * x.z; };
  BackgroundMesh mesh = cube_of_tets(5, linear);
  EXPECT_EQ(limit_growth(kBackgroundSlope, mesh), 0);
  const auto field = make_background(mesh, kBackgroundSlope);
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = random_background_point(random, 0, 1);
    ASSERT_NEAR(background_at(*field, x) / linear(x), 1, 1e-9);
  }
}

TEST(BackgroundMesh, grows_from_its_border_outside) {
  const auto field = make_background(cube_of_tets(3, [](Vec3) { return 0.1; }), kBackgroundSlope);
  EXPECT_NEAR(background_at(*field, {2, 0.5, 0.3}), 0.1 + kBackgroundSlope, 1e-12);
  EXPECT_NEAR(background_at(*field, {-3, -4, 0.3}), 0.1 + 5 * kBackgroundSlope, 1e-12);
}

TEST(BackgroundMesh, of_a_surface_grows_to_all_sides_however_steep_it_is) {
  BackgroundMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.node_size = {{0.1, 0.1, {}}, {0.1, 0.1, {}}, {0.1, 0.1, {}}, {5, 5, {}}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_FALSE(mesh.is_empty());
  EXPECT_EQ(limit_growth(kBackgroundSlope, mesh), 0);
  const auto field = make_background(mesh, kBackgroundSlope);
  EXPECT_NEAR(background_at(*field, {0.3, 0.3, 0}), 0.1, 1e-12);
  EXPECT_NEAR(background_at(*field, {0.3, 0.3, 0.5}), 0.1 + 0.5 * kBackgroundSlope, 1e-12);
  EXPECT_NEAR(background_at(*field, {0.3, 0.3, -2}), 0.1 + 2 * kBackgroundSlope, 1e-12);
  EXPECT_NEAR(background_at(*field, {1, 1, 0}), 0.1 + std::sqrt(0.5) * kBackgroundSlope, 1e-12);
  BackgroundMesh both = cube_of_tets(2, [](Vec3) { return 1.0; });
  append(mesh, both);
  EXPECT_EQ(both.triangles[1], (std::array<std::int32_t, 3>{28, 30, 29}));
  EXPECT_NEAR(background_at(*make_background(both, kBackgroundSlope), {0.3, 0.3, 0.4}), 0.1 + 0.4 * kBackgroundSlope,
              1e-12);
}

TEST(BackgroundMesh, of_metrics_that_contradict_each_other_is_stretched_nowhere_between) {
  BackgroundMesh mesh = one_tet({});
  mesh.node_size = {{0.1, 0.5, {1, 0, 0}}, {0.1, 0.5, {0, 1, 0}}, {0.1, 0.5, {1, 0, 0}}, {0.1, 0.5, {0, 1, 0}}};
  const auto field = make_background(mesh, kSteep);
  int hint = 0;
  EXPECT_NEAR(field->local({0.25, 0.25, 0.25}, hint).along, 0.1, 1e-6);
  EXPECT_NEAR(field->local({0, 0, 0}, hint).along, 0.5, 1e-9);
}

TEST(BackgroundMesh, of_metrics_grows_from_its_border_along_their_direction) {
  BackgroundMesh mesh = cube_of_tets(2, [](Vec3) { return 0.1; });
  for (LocalSize& s : mesh.node_size) s = {0.1, 0.4, {0, 0, 1}};
  const auto field = make_background(mesh, kBackgroundSlope);
  int hint = 0;
  const LocalSize out = field->local({1.5, 0.5, 0.3}, hint);
  EXPECT_NEAR(out.in({0, 0, 1}), 0.4 + 0.5 * kBackgroundSlope, 1e-9);
  EXPECT_NEAR(out.in({1, 0, 0}), 0.1 + 0.5 * kBackgroundSlope, 1e-9);
}

TEST(BackgroundMesh, says_below_a_bound_what_it_says_without) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.1, 0.12);
  const auto field = make_background(cube_of_tets(4, [&](Vec3) { return uniform(random); }), kBackgroundSlope);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 x = random_background_point(random, -1, 2);
    const double h = background_at(*field, x);
    ASSERT_EQ(field->size_below(x, 0.15), std::min(h, 0.15));
  }
}

TEST(BackgroundMesh, of_a_surface_asks_for_the_least_over_all_its_triangles) {
  constexpr int kSide = 20;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.02, 0.06), stretch(1, 4);
  BackgroundMesh mesh;
  for (int j = 0; j <= kSide; ++j)
    for (int i = 0; i <= kSide; ++i) {
      mesh.node_xyz.push_back(Vec3{static_cast<double>(i), static_cast<double>(j), 0} / kSide);
      const double h = uniform(random);
      mesh.node_size.push_back({h, stretch(random) * h, normalized(Vec3{1, 2, 0})});
    }
  test::add_square_cells(kSide, 0, mesh);
  const auto field = make_background(mesh, kBackgroundSlope);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = random_background_point(random, -0.5, 1.5);
    double least = HUGE_VAL, least_along = HUGE_VAL;
    int hint = 0;
    const LocalSize got = field->local(x, hint);
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto over = [&](const auto& length) {
        return least_over_triangle(x, {mesh.node_xyz[a], mesh.node_xyz[b], mesh.node_xyz[c]},
                                   {length(mesh.node_size[a]), length(mesh.node_size[b]), length(mesh.node_size[c])},
                                   kBackgroundSlope);
      };
      least = std::min(least, over([](const LocalSize& s) { return s.length; }));
      least_along = std::min(least_along, over([](const LocalSize& s) { return s.along; }));
    }
    ASSERT_NEAR(got.length, least, 1e-12);
    ASSERT_NEAR(got.along, std::max(least, least_along), 1e-9);
  }
}

}  // namespace
}  // namespace st
