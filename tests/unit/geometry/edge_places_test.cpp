// Pieces of a model that have edges at one place.
#include "geometry/import/edge_places.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace st
