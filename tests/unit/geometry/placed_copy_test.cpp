// A copy of a shape without locations.
#include "geometry/import/placed_copy.h"

#include <gtest/gtest.h>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"

namespace st {
namespace {

int count_placed(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return map.Extent();
}

TEST(PlacedCopy, has_parts_of_its_own_at_each_place) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(50, 0, 0));
  const TopoDS_Shape rod = BRepPrimAPI_MakeCylinder(5, 20).Shape();
  const TopoDS_Shape both = occt::compound_of(std::vector<TopoDS_Shape>{rod, rod.Moved(TopLoc_Location(move))});
  occt::PlacedCopy copy;
  const TopoDS_Shape copied = copy.of(both);
  for (const TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_FACE, TopAbs_EDGE, TopAbs_VERTEX})
    EXPECT_EQ(count_placed(copied, kind), count_placed(both, kind));
  for (TopExp_Explorer f(copied, TopAbs_FACE); f.More(); f.Next()) EXPECT_TRUE(f.Current().Location().IsIdentity());
  EXPECT_TRUE(BRepCheck_Analyzer(copied).IsValid());
  EXPECT_EQ(occt::count_free_edges(copied), 0);
  EXPECT_NEAR(occt::rough_box(copied).hi.x, 55, 1e-3);
}

}  // namespace
}  // namespace st
