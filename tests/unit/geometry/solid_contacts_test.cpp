#include "geometry/import/solid_contacts.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp.hxx>

#include "geometry/brep/compound.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

occt::ImportedShape imported(const TopoDS_Shape& shape) {
  occt::ImportedShape model;
  model.shape = shape;
  TopExp::MapShapes(model.shape, TopAbs_FACE, model.faces);
  model.attributes.resize(model.faces.Extent());
  return model;
}

TEST(SolidContacts, join_solids_with_a_part_of_a_face_in_common_but_not_those_apart) {
  const auto box = [](double x, double size) { return BRepPrimAPI_MakeBox(gp_Pnt(x, 0, 0), size, size, size).Shape(); };
  occt::ImportedShape model = imported(occt::compound_of(std::vector<TopoDS_Shape>{box(0, 2), box(2, 1), box(5, 1)}));
  const ModelTables tables = occt::make_tables(model, "test").tables;
  const occt::TouchingGroups touching = occt::find_touching_solids(model, tables);
  EXPECT_EQ(touching.groups, (std::vector<std::vector<int>>{{0, 1}}));
  EXPECT_TRUE(touching.self_touching.empty());
  EXPECT_TRUE(occt::find_self_touching(model, tables).empty());
  EXPECT_TRUE(occt::edge_sharers(model.shape).empty());
}

TEST(SolidContacts, are_none_between_the_sides_of_a_thin_plate_in_a_large_domain) {
  occt::ImportedShape model =
      imported(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(-2500, -2500, -2500), 5000, 5000, 5000).Shape(),
                               BRepPrimAPI_MakeBox(1, 1, 0.004).Shape())
                   .Shape());
  const ModelTables tables = occt::make_tables(model, "test").tables;
  ASSERT_EQ(tables.n_faces(), 12);
  EXPECT_LT(0.004, 1e-6 * tables.box().diagonal()) << "one place by the domain";
  EXPECT_TRUE(occt::find_touching_solids(model, tables).self_touching.empty());
}

}  // namespace
}  // namespace st
