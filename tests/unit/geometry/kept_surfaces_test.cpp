// A surface that is kept answers as one that is converted anew, and no longer once it has changed.
#include "geometry/brep/kept_surfaces.h"

#include <gtest/gtest.h>

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <utility>

#include "geometry/brep/occt_evaluators.h"

namespace st::occt {
namespace {

/// Bicubic, of one span.
Handle(Geom_BSplineSurface) bent_patch() {
  TColgp_Array2OfPnt poles(1, 4, 1, 4);
  for (int i = 1; i <= 4; ++i)
    for (int j = 1; j <= 4; ++j) poles(i, j) = gp_Pnt(i, j, 0.3 * i * i - 0.1 * i * j);
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = 0, knots(2) = 1;
  TColStd_Array1OfInteger multiplicities(1, 2);
  multiplicities.Init(4);
  return new Geom_BSplineSurface(poles, knots, knots, multiplicities, multiplicities, 3, 3);
}

/// Of any two surfaces in their middle and at a corner.
void expect_same(const Surface& a, const Surface& b) {
  for (const Vec2 uv : {Vec2{0.4, 0.6}, Vec2{1, 0}}) {
    const SurfacePoint p = a.evaluate(uv), q = b.evaluate(uv);
    EXPECT_TRUE(p.x == q.x && p.du == q.du && p.dv == q.dv);
  }
}

TEST(KeptSurfaces, answer_as_a_surface_that_is_made_anew) {
  const Handle(Geom_BSplineSurface) original = bent_patch();
  const auto anew = make_surface(original);
  const KeptSurfaces kept;
  const auto first = make_surface(original), second = make_surface(original, {{0.25, 0}, {0.5, 1}});
  expect_same(*first, *anew);
  expect_same(*second, *anew);
  EXPECT_EQ(first->u_max(), 1);
  EXPECT_EQ(std::pair(second->u_min(), second->u_max()), std::pair(0.25, 0.5));
}

TEST(KeptSurfaces, forget_a_surface_that_has_changed) {
  const Handle(Geom_BSplineSurface) original = bent_patch();
  const KeptSurfaces kept;
  const Vec3 before = make_surface(original)->point({0.5, 0.5});
  original->SetPole(2, 2, gp_Pnt(2, 2, 9));
  const Vec3 after = make_surface(original)->point({0.5, 0.5});
  EXPECT_GT(after.z, before.z + 1);
  EXPECT_TRUE(after == make_surface(original)->point({0.5, 0.5}));
  original->InsertUKnot(0.3, 1, 0);
  EXPECT_NEAR(make_surface(original)->point({0.5, 0.5}).z, after.z, 1e-12);
  EXPECT_EQ(make_surface(original)->u_knots().size(), 1u);
}

TEST(KeptSurfaces, a_surface_outlives_what_kept_it) {
  const Handle(Geom_BSplineSurface) original = bent_patch();
  std::unique_ptr<Surface> surface;
  {
    const KeptSurfaces kept;
    surface = make_surface(original);
  }
  expect_same(*surface, *make_surface(original));
}

}  // namespace
}  // namespace st::occt
