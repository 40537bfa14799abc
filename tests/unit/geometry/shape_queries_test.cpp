#include "geometry/brep/shape_queries.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <gp_Pln.hxx>

namespace st::occt {
namespace {

TEST(ShapeQueries, every_edge_of_a_box_is_used_twice_and_of_its_face_once) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(box, edges);
  EXPECT_EQ(uses, std::vector<int>(12, 2));
  EXPECT_EQ(count_free_edges(box), 0);
  EXPECT_EQ(count_free_edges(TopExp_Explorer(box, TopAbs_FACE).Current()), 4);
}

TEST(ShapeQueries, poles_are_no_free_edges_and_a_seam_counts_twice) {
  const TopoDS_Shape sphere = BRepPrimAPI_MakeSphere(1).Shape();
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(sphere, edges);
  EXPECT_EQ(*std::max_element(uses.begin(), uses.end()), 2);
  EXPECT_EQ(count_free_edges(sphere), 0);
}

TEST(ShapeQueries, an_edge_inside_a_face_has_it_on_both_sides) {
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(gp_Pnt(1, 1, 0), gp_Pnt(2, 2, 0)).Edge();
  TopoDS_Shape face = BRepBuilderAPI_MakeFace(gp_Pln(), 0, 5, 0, 5).Shape();
  TopoDS_Shape wire = BRepBuilderAPI_MakeWire(edge).Wire();
  BRep_Builder().Add(face, wire.Oriented(TopAbs_INTERNAL));
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(face, edges), sides = edge_sides(face, edges);
  EXPECT_EQ(uses[edges.FindIndex(edge) - 1], 0);
  EXPECT_EQ(sides[edges.FindIndex(edge) - 1], 2);
}

TEST(ShapeQueries, the_rough_box_holds_the_shape) {
  const Box3 box = rough_box(BRepPrimAPI_MakeBox(1, 2, 3).Shape());
  EXPECT_NEAR(norm(box.lo), 0, 1e-6);
  EXPECT_NEAR(norm(box.hi - Vec3{1, 2, 3}), 0, 1e-6);
  EXPECT_LE(box.lo.x, 0);
}

TEST(ShapeQueries, numbers_have_four_digits) { EXPECT_EQ(format_number(0.123456), "0.1235"); }

}  // namespace
}  // namespace st::occt
