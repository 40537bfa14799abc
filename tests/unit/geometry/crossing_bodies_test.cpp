// Parts that cross are named at import.
#include <gtest/gtest.h>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <gp_Ax1.hxx>
#include <gp_Trsf.hxx>

#include "geometry/brep/compound.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;

TEST(CrossingBodies, are_found_once_for_each_pair_at_a_place_of_both) {
  const auto found = findings_of(import_broken("crossing_boxes"), "parts cross: ");
  ASSERT_EQ(found.size(), 1u);
  for (const double x : {found[0].xyz.x, found[0].xyz.y, found[0].xyz.z}) {
    EXPECT_GE(x, 5 - 1e-6);
    EXPECT_LE(x, 10 + 1e-6);
  }
  EXPECT_EQ(findings_of(import_broken("wing_in_body"), "parts cross: ").size(), 3u);
}

TEST(CrossingBodies, are_not_those_that_touch_or_are_apart) {
  for (const char* shape : {"touching_boxes", "offset_boxes", "pin_in_plate", "boxes_along_edge", "box_twice",
                            "box_in_box", "stacked_boxes", "nested_shells"})
    EXPECT_TRUE(findings_of(import_broken(shape), "parts cross").empty()) << shape;
}

/// A cube of splines about (x, 0, 0), turned about its diagonal.
TopoDS_Shape spline_cube(double x, double edge, double angle) {
  const gp_Pnt corner(x - 0.5 * edge, -0.5 * edge, -0.5 * edge);
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(x, 0, 0), gp_Dir(1, 1, 1)), angle);
  return BRepBuilderAPI_Transform(
             BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeBox(corner, edge, edge, edge).Shape()).Shape(), turn, true)
      .Shape();
}

/// Two that lie inside each other take all comparisons that two bodies may have; those behind them get theirs.
TEST(CrossingBodies, are_all_found_however_long_two_that_do_not_cross_take) {
  const TemporaryDirectory dir;
  const TopoDS_Shape all =
      occt::compound_of({spline_cube(0, 40, 0.5), spline_cube(0, 20, 0.2), spline_cube(0, 10, 0.9),
                         spline_cube(100, 10, 0.3), spline_cube(104, 10, 0.7), spline_cube(108, 10, 0.1)});
  BRepTools::Write(all, (dir / "model.brep").c_str());
  EXPECT_EQ(findings_of(import_model(dir / "model.brep", {}), "parts cross: ").size(), 3u);
}

TEST(CrossingBodies, are_none_once_united) {
  ImportOptions options;
  options.unite = true;
  EXPECT_TRUE(findings_of(import_broken("wing_in_body", options), "parts cross").empty());
}

}  // namespace
}  // namespace st
