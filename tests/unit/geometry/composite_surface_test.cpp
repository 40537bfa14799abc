#include "geometry/shape/composite_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shape/projection.h"
#include "unit/geometry/joined_models.h"

namespace st {
namespace {

struct Skin {
  test::Joined joined{"wing_of_200"};
  FaceId face = kNone;
  std::unique_ptr<Surface> surface;

  Skin() {
    for (FaceId f = 0; f < joined.model.tables().n_faces(); ++f)
      if (joined.model.tables().face_type[f] != SurfaceType::kPlane && !joined.model.tables().loops(f).empty())
        face = f;
    surface = joined.model.surface(face);
  }
  /// Places inside the chart.
  std::vector<Vec2> places() const {
    const Chart chart = joined.composites.chart(0);
    std::vector<Vec2> all;
    for (std::size_t t = 0; t < chart.corners.size(); ++t)
      all.push_back(0.5 * chart.uv[chart.corners[t][0]] + 0.3 * chart.uv[chart.corners[t][1]] +
                    0.2 * chart.uv[chart.corners[t][2]]);
    return all;
  }
};

TEST(CompositeSurface, lies_on_the_faces_of_the_cad) {
  const Skin skin;
  const Model& cad = skin.joined.model.cad();
  ASSERT_GT(skin.places().size(), 100u);
  for (const Vec2 uv : skin.places()) {
    const FaceId f = skin.joined.model.cad_faces(skin.face, std::span(&uv, 1))[0];
    EXPECT_LE(closest_point(*cad.surface(f), skin.surface->point(uv)).distance, 1e-9);
  }
}

TEST(CompositeSurface, has_the_derivatives_of_its_places) {
  const Skin skin;
  constexpr double kStep = 1e-5;
  for (const Vec2 uv : skin.places()) {
    const SurfacePoint2 p = skin.surface->evaluate2(uv);
    const auto at = [&](double u, double v) { return skin.surface->point({uv.x + u * kStep, uv.y + v * kStep}); };
    EXPECT_LE(norm((at(1, 0) - at(-1, 0)) / (2 * kStep) - p.du), 1e-5);
    EXPECT_LE(norm((at(0, 1) - at(0, -1)) / (2 * kStep) - p.dv), 1e-5);
    EXPECT_LE(norm((at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / (kStep * kStep) - p.duu), 1e-3 * (1 + norm(p.duu)));
    EXPECT_LE(norm((at(0, 1) - 2 * at(0, 0) + at(0, -1)) / (kStep * kStep) - p.dvv), 1e-3 * (1 + norm(p.dvv)));
    const SurfacePoint q = skin.surface->evaluate(uv);
    EXPECT_EQ(norm(q.du - p.du) + norm(q.dv - p.dv) + distance(p.x, q.x), 0);
  }
}

TEST(CompositeSurface, is_smooth_around_a_pole) {
  const test::Joined melon("melon");
  ASSERT_EQ(melon.composites.size(), 1);
  const auto surface = melon.model.surface(melon.composites.members(0)[0]);
  const Chart chart = melon.composites.chart(0);
  int n = 0;
  for (std::size_t t = 0; t < chart.corners.size(); ++t) {
    if (melon.composites.triangle_pole[t] == kNone) continue;
    for (const double weight : {0.5, 0.99, 0.999999, 1.0}) {
      const auto pole = static_cast<std::size_t>(PoleCorner::of_code(melon.composites.triangle_pole[t]).corner);
      const Corners& c = chart.corners[t];
      const Vec2 uv = weight * chart.uv[c[pole]] +
                      (1 - weight) * (0.3 * chart.uv[c[(pole + 1) % 3]] + 0.7 * chart.uv[c[(pole + 2) % 3]]);
      const SurfacePoint2 p = surface->evaluate2(uv);
      EXPECT_NEAR(norm(p.x), 10, 1e-9);
      EXPECT_NEAR(std::abs(dot(normalized(cross(p.du, p.dv)), normalized(p.x))), 1, 1e-5);
      EXPECT_NEAR(std::abs(principal_curvature(p).k1), 0.1, 1e-4);
      ++n;
    }
  }
  EXPECT_GE(n, 6 * 4);
}

TEST(CompositeSurface, has_the_curvature_of_the_cad_whatever_its_chart) {
  const Skin skin;
  const Model& cad = skin.joined.model.cad();
  for (const Vec2 uv : skin.places()) {
    const auto face = cad.surface(skin.joined.model.cad_faces(skin.face, std::span(&uv, 1))[0]);
    const SurfacePoint2 p = skin.surface->evaluate2(uv);
    const double k = principal_curvature(face->evaluate2(closest_point(*face, p.x).uv)).k1;
    EXPECT_NEAR(std::abs(principal_curvature(p).k1), std::abs(k), 1e-5 * std::abs(k) + 1e-9);
  }
}

TEST(CompositeSurface, knows_what_it_has_of_each_member) {
  for (const char* shape : {"wing_of_200", "melon"}) {
    const test::Joined joined(shape);
    const Model& cad = joined.model.cad();
    const auto members = joined.composites.members(0);
    const auto made = joined.model.surface(members[0]);
    const auto& surface = dynamic_cast<const CompositeSurface&>(*made);
    ASSERT_EQ(surface.n_members(), static_cast<std::int32_t>(members.size()));
    const Chart chart = joined.composites.chart(0);
    for (std::int32_t i = 0; i < surface.n_members(); ++i) {
      const LoopPolygons rim(surface.rim_of_member(i));
      const FaceId own = members[static_cast<std::size_t>(i)];
      EXPECT_EQ(surface.is_member_turned(i), cad.tables().face_is_reversed[own] != 0);
      for (const Corners& c : chart.corners) {
        const auto at = surface.place(1 / 3.0 * (chart.uv[c[0]] + chart.uv[c[1]] + chart.uv[c[2]]));
        EXPECT_TRUE(at.member != i || rim.contains(at.uv)) << shape << " " << i;
      }
      double area = 0;  // of a grid's cells in the rim, in space
      const Surface& m = surface.member(i);
      constexpr int kCells = 100;
      const Vec2 cell{(m.u_max() - m.u_min()) / kCells, (m.v_max() - m.v_min()) / kCells};
      for (int k = 0; k < kCells * kCells; ++k) {
        const Vec2 uv{m.u_min() + (k % kCells + 0.5) * cell.x, m.v_min() + (k / kCells + 0.5) * cell.y};
        const SurfacePoint p = m.evaluate(uv);
        if (rim.contains(uv)) area += norm(cross(p.du, p.dv)) * cell.x * cell.y;
      }
      EXPECT_NEAR(area, cad.tables().face_area[own], 0.03 * cad.tables().face_area[own]) << shape << " " << i;
    }
  }
}

TEST(CompositeSurface, finds_the_feet_of_points_above_it) {
  const Skin skin;
  for (const Vec2 uv : skin.places()) {
    const SurfacePoint p = skin.surface->evaluate(uv);
    const Vec3 above = p.x + 1e-3 * normalized(cross(p.du, p.dv));
    const auto foot = project_near(*skin.surface, above, uv);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(distance(skin.surface->point(*foot), above), 1e-3, 1e-6);
    EXPECT_LE(distance(skin.surface->point(*foot), p.x), 1e-4);
  }
}

TEST(CompositeSurface, copies_are_the_same_and_go_on_beside_the_chart) {
  const std::vector<Vec3> x{{1, 2, 3}, {2, 2, 3}, {1, 3, 3}, {2, 3, 3}}, normal(4, Vec3{0, 0, 1});
  const std::vector<Vec2> own{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  std::vector<std::unique_ptr<Surface>> members;
  members.push_back(std::make_unique<ChartSurface>(Chart{x, normal, own, {{0, 1, 3}, {0, 3, 2}}}));
  const Chart chart{{x[0], x[1], x[2]}, {normal[0], normal[1], normal[2]}, {{0, 0}, {2, 0}, {0, 2}}, {{0, 1, 2}}};
  const CompositeSurface surface(chart, {{0}, {{own[0], own[1], own[2]}}, {kNone}}, std::move(members), {0, 2, 0, 2});
  const auto copy = surface.copy();
  ASSERT_TRUE(copy);
  for (const Vec2 uv : {Vec2{0.4, 0.4}, Vec2{1.2, 1}, Vec2{1.5, 1.5}}) {
    EXPECT_LE(distance(surface.point(uv), {1 + 0.5 * uv.x, 2 + 0.5 * uv.y, 3}), 1e-14);
    EXPECT_EQ(distance(copy->point(uv), surface.point(uv)), 0);
  }
  EXPECT_TRUE(surface.holds({0.4, 0.4}));
  EXPECT_FALSE(surface.holds({1.5, 1.5}));
  EXPECT_EQ(copy->u_max(), 2);
  std::vector<Vec3> lifted;
  for (const Vec3 p : x) lifted.push_back(p + Vec3{0, 0, 1});
  std::vector<std::unique_ptr<Surface>> others;
  others.push_back(std::make_unique<ChartSurface>(Chart{lifted, normal, own, {{0, 1, 3}, {0, 3, 2}}}));
  const auto above = surface.with_members(std::move(others));
  EXPECT_EQ(distance(above->point({0.4, 0.4}), surface.point({0.4, 0.4}) + Vec3{0, 0, 1}), 0);
  EXPECT_EQ(above->u_max(), 2);
}

/// x = (u, v, u v + u^2).
class Saddle final : public Surface {
 public:
  Vec3 point(Vec2 p) const override { return {p.x, p.y, p.x * p.y + p.x * p.x}; }
  SurfacePoint evaluate(Vec2 p) const override { return {point(p), {1, 0, p.y + 2 * p.x}, {0, 1, p.x}}; }
  SurfacePoint2 evaluate2(Vec2 p) const override {
    return {point(p), {1, 0, p.y + 2 * p.x}, {0, 1, p.x}, {0, 0, 2}, {0, 0, 1}, {}};
  }
};

TEST(CompositeSurface, mixes_second_derivatives_as_its_map_does) {
  const std::array<Vec2, 3> own{{{0, 0}, {1, 0.25}, {-0.5, 1}}};  // (u,v) -> (u - v / 2, u / 4 + v)
  const std::vector<Vec3> x(3), normal(3, Vec3{0, 0, 1});
  std::vector<std::unique_ptr<Surface>> members;
  members.push_back(std::make_unique<Saddle>());
  const CompositeSurface surface({x, normal, {{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}}, {{0}, {own}, {kNone}},
                                 std::move(members), {0, 1, 0, 1});
  const SurfacePoint2 p = surface.evaluate2(Vec2{0.3, 0.3});
  // z = (u - v / 2) (u / 4 + v) + (u - v / 2)^2
  EXPECT_NEAR(p.duu.z, 2.5, 1e-14);
  EXPECT_NEAR(p.duv.z, -0.125, 1e-14);
  EXPECT_NEAR(p.dvv.z, -0.5, 1e-14);
}

}  // namespace
}  // namespace st
