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
      if (joined.model.tables().face_type[f] != SurfaceType::kPlane) face = f;
    surface = joined.model.surface(face);
  }
  /// Places inside the chart.
  std::vector<Vec2> places() const {
    const Chart chart = joined.composites.chart(0);
    std::vector<Vec2> all;
    for (std::size_t t = 0; t < chart.corners.size(); t += 7)
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
    const FaceId f = skin.joined.model.cad_face(skin.face, uv);
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

TEST(CompositeSurface, has_the_curvature_of_the_cad_whatever_its_chart) {
  const Skin skin;
  const Model& cad = skin.joined.model.cad();
  for (const Vec2 uv : skin.places()) {
    const auto face = cad.surface(skin.joined.model.cad_face(skin.face, uv));
    const SurfacePoint2 p = skin.surface->evaluate2(uv);
    const double k = principal_curvature(face->evaluate2(closest_point(*face, p.x).uv)).k1;
    EXPECT_NEAR(std::abs(principal_curvature(p).k1), std::abs(k), 1e-5 * std::abs(k) + 1e-9);
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

TEST(CompositeSurface, copies_are_the_same) {
  const Skin skin;
  const auto copy = skin.surface->copy();
  ASSERT_TRUE(copy);
  for (const Vec2 uv : skin.places()) EXPECT_EQ(distance(copy->point(uv), skin.surface->point(uv)), 0);
  EXPECT_EQ(copy->u_max(), skin.surface->u_max());
}

TEST(AffineMap, takes_three_places_to_three) {
  const std::array<Vec2, 3> from{{{1, 2}, {4, 2.5}, {0, 7}}}, to{{{-1, 0}, {3, 3}, {2, -8}}};
  const AffineMap map(from, to);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(norm(map(from[k]) - to[k]), 1e-14);
  EXPECT_LE(norm(map((1 / 3.) * (from[0] + from[1] + from[2])) - (1 / 3.) * (to[0] + to[1] + to[2])), 1e-14);
}

}  // namespace
}  // namespace st
