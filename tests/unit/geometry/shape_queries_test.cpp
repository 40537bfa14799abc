#include "geometry/brep/shape_queries.h"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>

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

TEST(ShapeQueries, the_rough_box_holds_the_shape) {
  const Box3 box = rough_box(BRepPrimAPI_MakeBox(1, 2, 3).Shape());
  EXPECT_NEAR(norm(box.lo), 0, 1e-6);
  EXPECT_NEAR(norm(box.hi - Vec3{1, 2, 3}), 0, 1e-6);
  EXPECT_LE(box.lo.x, 0);
}

TEST(ShapeQueries, numbers_have_four_digits) { EXPECT_EQ(format_number(0.123456), "0.1235"); }

}  // namespace
}  // namespace st::occt
