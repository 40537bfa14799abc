// A shape that is read back equal need not be read.
#include "geometry/brep/read_back.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Plane.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <sstream>

namespace st::occt {
namespace {

/// One bilinear patch; the last weight counts where it is not 1.
TopoDS_Shape patch(double last_weight) {
  TColgp_Array2OfPnt poles(1, 2, 1, 2);
  TColStd_Array2OfReal weights(1, 2, 1, 2);
  weights.Init(1);
  for (int i = 1; i <= 2; ++i)
    for (int j = 1; j <= 2; ++j) poles(i, j) = gp_Pnt(i, j, 0.1 * i * j);
  weights(2, 2) = last_weight;
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = 0, knots(2) = 1;
  TColStd_Array1OfInteger twice(1, 2);
  twice.Init(2);
  const Handle(Geom_BSplineSurface) surface = new Geom_BSplineSurface(poles, weights, knots, knots, twice, twice, 1, 1);
  return BRepBuilderAPI_MakeFace(surface, 1e-7).Shape();
}

TopoDS_Shape on_plane(const gp_Dir& normal, const gp_Dir& along) {
  return BRepBuilderAPI_MakeFace(gp_Pln(gp_Ax3(gp_Pnt(1, 2, 3), normal, along))).Shape();
}

gp_Ax3 axes_of(const TopoDS_Shape& shape) {
  const TopExp_Explorer face(shape, TopAbs_FACE);
  return Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(TopoDS::Face(face.Current())))->Position();
}

TopoDS_Shape read_again(const TopoDS_Shape& shape) {
  std::stringstream bytes(std::ios::in | std::ios::out | std::ios::binary);
  BinTools::Write(shape, bytes);
  TopoDS_Shape again;
  BinTools::Read(again, bytes);
  return again;
}

TEST(ReadBack, splines_without_weights_are_equal_and_others_are_not_looked_at) {
  EXPECT_TRUE(is_read_back_equal(patch(1)));
  EXPECT_FALSE(is_read_back_equal(patch(2)));
  EXPECT_FALSE(is_read_back_equal(BRepPrimAPI_MakeSphere(1).Shape()));
  EXPECT_TRUE(is_read_back_equal(BRepPrimAPI_MakeBox(1, 1, 1).Shape()));
}

TEST(ReadBack, a_place_of_its_own_is_not_looked_at) {
  const TopoDS_Shape plain = on_plane({0, 0, 1}, {1, 0, 0});
  EXPECT_TRUE(is_read_back_equal(plain));
  gp_Trsf move;
  move.SetTranslation(gp_Vec(1, 0, 0));
  EXPECT_FALSE(is_read_back_equal(plain.Moved(move)));
}

/// Each answer against what reading does.
TEST(ReadBack, planes_are_equal_where_reading_keeps_all_digits_of_their_axes) {
  int n_equal = 0, n_other = 0;
  for (int i = 0; i < 200; ++i) {
    const TopoDS_Shape shape = on_plane({0.1 * i, 1, 0.37}, {1, 0.03 * i, -0.2});
    const gp_Ax3 a = axes_of(shape), b = axes_of(read_again(shape));
    const auto same = [](const gp_Dir& x, const gp_Dir& y) {
      return x.X() == y.X() && x.Y() == y.Y() && x.Z() == y.Z();
    };
    const bool is_same = same(a.Direction(), b.Direction()) && same(a.XDirection(), b.XDirection()) &&
                         same(a.YDirection(), b.YDirection());
    EXPECT_EQ(is_read_back_equal(shape), is_same) << i;
    ++(is_same ? n_equal : n_other);
  }
  EXPECT_GT(n_equal, 0);
  EXPECT_GT(n_other, 0);
}

}  // namespace
}  // namespace st::occt
