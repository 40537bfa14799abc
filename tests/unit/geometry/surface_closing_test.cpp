#include "geometry/import/surface_closing.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <ShapeFix_ShapeTolerance.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <gp_Pln.hxx>

namespace st::occt {
namespace {

/// A tube of height 3 along v, whose ends in u are `gap` apart; its edges have this tolerance.
TopoDS_Face tube(double gap, double tolerance) {
  TColgp_Array2OfPnt poles(1, 5, 1, 2);
  const double x[] = {0, 4, 4, -4, 0}, y[] = {0, 0, 5, 5, gap};
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 2; ++k) poles(i + 1, k + 1) = gp_Pnt(x[i], y[i], 3 * k);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(new Geom_BezierSurface(poles), 1e-7).Face();
  ShapeFix_ShapeTolerance().SetTolerance(face, tolerance, TopAbs_EDGE);
  return face;
}

TEST(SurfaceClosing, has_the_period_of_a_periodic_surface) {
  const gp_Ax3 axes(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  const SurfaceClosing c =
      surface_closing(BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(axes, 2), 0, 1, 0, 1, 1e-7));
  EXPECT_NEAR(c.period.x, 2 * M_PI, 1e-12);
  EXPECT_TRUE(c.is_u_periodic);
  EXPECT_EQ(c.period.y, 0);
}

TEST(SurfaceClosing, of_ends_that_meet_within_the_tolerance_of_edges_is_the_whole_range) {
  const SurfaceClosing c = surface_closing(tube(1e-4, 1e-3));
  EXPECT_EQ(c.period.x, 1);
  EXPECT_FALSE(c.is_u_periodic);
  EXPECT_EQ(c.period.y, 0);
  EXPECT_EQ(surface_closing(tube(1e-2, 1e-3)).period.x, 0);
}

TEST(SurfaceClosing, is_not_believed_to_a_tolerance_as_large_as_the_surface) {
  EXPECT_EQ(surface_closing(tube(1e-4, 1)).period.x, 0);
}

TEST(SurfaceClosing, is_none_of_a_plane) {
  const SurfaceClosing c = surface_closing(BRepBuilderAPI_MakeFace(gp_Pln(), 0, 1, 0, 1));
  EXPECT_EQ(c.period.x, 0);
  EXPECT_EQ(c.period.y, 0);
}

}  // namespace
}  // namespace st::occt
