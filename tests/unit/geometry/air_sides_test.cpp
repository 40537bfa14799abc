// Outer faces that were one before something cut them.
#include "geometry/import/air_sides.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Pln.hxx>

#include <numeric>

#include "geometry/model/model_tables.h"

namespace st::occt {
namespace {

std::vector<AirSide> all_sides(const TopoDS_Shape& s, std::int32_t& n_faces) {
  ImportedShape shape;
  shape.shape = s;
  TopExp::MapShapes(s, TopAbs_FACE, shape.faces);
  shape.attributes.resize(shape.faces.Extent());
  const ModelTables tables = make_tables(shape, "test").tables;
  n_faces = tables.n_faces();
  std::vector<FaceId> faces(static_cast<std::size_t>(n_faces));
  std::iota(faces.begin(), faces.end(), 0);
  return sides_of(AirPieces(shape, tables), faces);
}

TopoDS_Shape cut_twice(const TopoDS_Shape& solid) {
  TopTools_ListOfShape shells, planes;
  for (TopExp_Explorer e(solid, TopAbs_SHELL); e.More(); e.Next()) shells.Append(e.Current());
  for (const double x : {0.3, 0.34})  // a strip between them
    planes.Append(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(x, 0, 0), gp_Dir(1, 0.2, 0.3)), -9, 9, -9, 9).Face());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(shells);
  splitter.SetTools(planes);
  splitter.Build();
  return splitter.Shape();
}

TEST(AirSides, of_a_sphere_in_pieces_are_one_as_wide_as_before) {
  std::int32_t n_faces = 0;
  const std::vector<AirSide> sides = all_sides(cut_twice(BRepPrimAPI_MakeSphere(1).Shape()), n_faces);
  EXPECT_GE(n_faces, 3);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_NEAR(sides[0].area, 4 * 3.14159265, 1e-3);
  EXPECT_GT(sides[0].width, 1);
}

TEST(AirSides, of_a_box_in_pieces_are_six_and_fillets_stay_apart) {
  std::int32_t n_faces = 0;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  EXPECT_EQ(all_sides(cut_twice(box), n_faces).size(), 6u);
  BRepFilletAPI_MakeFillet rounding(box);
  rounding.Add(0.1, TopoDS::Edge(TopExp_Explorer(box, TopAbs_EDGE).Current()));
  const std::vector<AirSide> sides = all_sides(rounding.Shape(), n_faces);
  EXPECT_EQ(sides.size(), 7u);
  EXPECT_EQ(n_faces, 7);
}

}  // namespace
}  // namespace st::occt
