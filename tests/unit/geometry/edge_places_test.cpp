// Pieces of a model that have edges at one place.
#include "geometry/import/edge_places.h"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_Sewing.hxx>

#include <utility>

#include "unit/geometry/bare_models.h"

namespace st {
namespace {

using test::polygon;

TEST(EdgePlaces, are_those_of_free_edges_along_other_edges) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
  const TopoDS_Shape on_edge = polygon({gp_Pnt(0, 0, 0), gp_Pnt(5, 0, 0), gp_Pnt(5, -5, 0), gp_Pnt(0, -5, 0)}),
                     on_face = polygon({gp_Pnt(2, 2, 10), gp_Pnt(8, 2, 10), gp_Pnt(5, 2, 15)}),
                     far = polygon({gp_Pnt(50, 0, 0), gp_Pnt(60, 0, 0), gp_Pnt(60, 5, 0)});
  const std::vector<TopoDS_Shape> pieces = occt::pieces_of(occt::compound_of({box, on_edge, on_face, far}));
  ASSERT_EQ(pieces.size(), 4u);
  EXPECT_EQ(pieces[0].ShapeType(), TopAbs_SOLID);
  EXPECT_EQ(occt::have_edges_at_one_place(pieces, 1e-5), (std::vector<char>{1, 1, 0, 0}));
}

TEST(EdgePlaces, of_bodies_that_touch_are_none) {
  const std::vector<TopoDS_Shape> pieces = {BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(1, 1, 1)).Shape(),
                                            BRepPrimAPI_MakeBox(gp_Pnt(1, 0, 0), gp_Pnt(2, 1, 1)).Shape()};
  EXPECT_EQ(occt::have_edges_at_one_place(pieces, 1e-5), (std::vector<char>{0, 0}));
}

TEST(EdgePlaces, of_open_pieces_are_those_of_two_faces_too) {
  const auto wing = [](double x, double z) {
    return polygon({gp_Pnt(0, 0, 0), gp_Pnt(0, 10, 0), gp_Pnt(x, 10, z), gp_Pnt(x, 0, z)});
  };
  const auto pair = [&](double x, double z) {
    BRepBuilderAPI_Sewing sewing;
    sewing.Add(wing(x, z));
    sewing.Add(wing(-x, -z));
    sewing.Perform();
    return sewing.SewedShape();
  };
  const std::vector<TopoDS_Shape> cross = {pair(5, 0), pair(0, 5)};
  EXPECT_EQ(occt::have_edges_at_one_place(cross, 1e-5), (std::vector<char>{1, 1}));
  EXPECT_EQ(occt::have_edges_at_one_place({cross[0]}, 1e-5), (std::vector<char>{0}));
}

TEST(EdgePlaces, shells_of_faces_are_those_with_common_edges) {
  const TopoDS_Shape a = BRepPrimAPI_MakeBox(1, 1, 1).Shape(), b = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  std::vector<TopoDS_Shape> faces;
  for (const TopoDS_Shape& box : {a, b})
    for (TopExp_Explorer f(box, TopAbs_FACE); f.More(); f.Next()) faces.push_back(f.Current());
  std::swap(faces[2], faces[8]);
  const std::vector<TopoDS_Shape> shells = occt::shells_of(faces);
  ASSERT_EQ(shells.size(), 2u);
  EXPECT_EQ(shells[0].NbChildren(), 6);
  EXPECT_TRUE(TopExp_Explorer(shells[0], TopAbs_FACE).Current().IsSame(faces[0]));
}

}  // namespace
}  // namespace st
