#include "geometry/import/nested_solids.h"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp_Explorer.hxx>
#include <cmath>
#include <vector>

#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

TopoDS_Shape cube(double lo, double hi) { return BRepPrimAPI_MakeBox(gp_Pnt(lo, lo, lo), gp_Pnt(hi, hi, hi)).Shape(); }

TopoDS_Shape hollow_cube() { return BRepAlgoAPI_Cut(cube(0, 10), cube(2, 8)).Shape(); }

std::size_t count_nested(const std::vector<TopoDS_Shape>& shapes, Cavities cavities) {
  return nested_solids(compound_of(shapes), cavities).size();
}

TEST(NestedSolids, lie_inside_another_one) {
  const auto nested =
      nested_solids(compound_of(std::vector{cube(3, 4), cube(0, 10), cube(20, 21)}), Cavities::kOutside);
  ASSERT_EQ(nested.size(), 1u);
  EXPECT_NEAR(rough_box(nested[0].inner).diagonal(), std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(rough_box(nested[0].outer).diagonal(), std::sqrt(300.0), 1e-3);
}

TEST(NestedSolids, in_a_cavity_count_where_cavities_are_inside) {
  EXPECT_EQ(count_nested({hollow_cube(), cube(4, 5)}, Cavities::kOutside), 0u);
  EXPECT_EQ(count_nested({hollow_cube(), cube(4, 5)}, Cavities::kInside), 1u);
}

TEST(NestedSolids, are_none_of_two_at_one_place_or_that_stick_out) {
  EXPECT_EQ(count_nested({cube(0, 10), cube(0, 10)}, Cavities::kInside), 0u);
  EXPECT_EQ(count_nested({cube(0, 10), cube(9, 11)}, Cavities::kInside), 0u);
}

TEST(NestedSolids, are_those_that_are_asked_for) {
  const TopoDS_Shape two = compound_of(std::vector{cube(0, 10), cube(1, 2), cube(5, 6)});
  EXPECT_EQ(nested_solids(two, Cavities::kInside).size(), 2u);
  EXPECT_EQ(nested_solids(two, Cavities::kInside, [](const Box3& box) { return box.lo.x > 4; }).size(), 1u);
}

}  // namespace
}  // namespace st::occt
