#include "geometry/import/sound_geometry.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <limits>
#include <vector>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// A patch of 3 x 3 control points, whose middle one is lifted to `z`.
TopoDS_Shape patch(double z) {
  TColgp_Array2OfPnt poles(1, 3, 1, 3);
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 3; ++j) poles(i, j) = gp_Pnt(i, j, 0);
  Handle(Geom_BezierSurface) surface = new Geom_BezierSurface(poles);
  const TopoDS_Shape face(BRepBuilderAPI_MakeFace(surface, 1e-7).Face());
  surface->SetPole(2, 2, gp_Pnt(2, 2, z));
  return face;
}

TEST(SoundGeometry, takes_points_that_are_far_away_but_not_absurd) {
  EXPECT_NO_THROW(occt::require_sound_geometry(patch(1), "a.step"));
  EXPECT_NO_THROW(occt::require_sound_geometry(patch(5e5), "a.step"));
}

TEST(SoundGeometry, takes_a_cone_whose_rim_has_two_points_but_for_rounding) {
  BRep_Builder builder;
  TopoDS_Compound cone;
  builder.MakeCompound(cone);
  for (const gp_Pnt& p : {gp_Pnt(0, 0, 12), gp_Pnt(5, 0, 0), gp_Pnt(5, 6e-16, 0)})
    builder.Add(cone, BRepBuilderAPI_MakeVertex(p).Vertex());
  EXPECT_NO_THROW(occt::require_sound_geometry(cone, "a.igs"));
}

TEST(SoundGeometry, refuses_points_that_are_not_finite_or_absurdly_far) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_ERROR(occt::require_sound_geometry(patch(-kInfinity), "a.step"), kGeometry, "a.step: face 1 has a point");
  EXPECT_ERROR(occt::require_sound_geometry(patch(std::numeric_limits<double>::quiet_NaN()), "a.step"), kGeometry,
               "not finite");
  EXPECT_ERROR(occt::require_sound_geometry(patch(9.2e11), "a.step"), kGeometry, "times as far away");
  EXPECT_ERROR(occt::require_sound_geometry(patch(9.2e18), "a.step"), kGeometry, "a coordinate beyond 1e+12");
  gp_Trsf large;
  large.SetScale(gp_Pnt(), 1e307);
  EXPECT_ERROR(occt::require_sound_geometry(BRepBuilderAPI_Transform(patch(1), large, true).Shape(), "a.step"),
               kGeometry, "a coordinate beyond 1e+12");
}

TEST(SoundGeometry, refuses_nodes_of_facets_that_are_absurdly_far) {
  const std::vector<Vec3> usual{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {0, 0, 1e5}};
  EXPECT_NO_THROW(occt::require_sound_nodes(usual, "a.stl"));
  EXPECT_NO_THROW(occt::require_sound_nodes({}, "a.stl"));
  std::vector<Vec3> stray = usual;
  stray[2].y = 1e9;
  EXPECT_ERROR(occt::require_sound_nodes(stray, "a.stl"), kGeometry, "a.stl: node 3 has a point (0, 1e+09, 0)");
  stray[2].y = 1e30;
  EXPECT_ERROR(occt::require_sound_nodes(stray, "a.stl"), kGeometry, "a coordinate beyond 1e+12");
}

TEST(SoundGeometry, refuses_faces_that_reach_absurdly_far) {
  const Box3 usual{{0, 0, 0}, {1, 1, 1}}, huge{{-1e307, 0, 0}, {1, 1, 1}};
  EXPECT_NO_THROW(occt::require_sound_boxes(std::vector<Box3>{usual, usual}, "a.step"));
  EXPECT_ERROR(occt::require_sound_boxes(std::vector<Box3>{usual, huge}, "a.step"), kGeometry,
               "a.step: face 2 reaches to (-1e+307, 0, 0), beyond 1e+12");
}

}  // namespace
}  // namespace st
