#include "geometry/import/solid_contacts.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
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

TEST(SolidContacts, are_none_across_a_slot_in_a_spline_though_both_sides_have_its_surface) {
  const auto spline_box = [](gp_Pnt at, double dx, double dy, double dz) {
    return BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeBox(at, dx, dy, dz).Shape(), true).Shape();
  };
  const TopoDS_Shape frame =
      BRepAlgoAPI_Cut(spline_box(gp_Pnt(0, 0, 0), 4, 4, 1), BRepPrimAPI_MakeBox(gp_Pnt(1, 1, -1), 2, 2, 3).Shape())
          .Shape();
  const auto groups_with = [&](const TopoDS_Shape& other) {
    occt::ImportedShape model = imported(occt::compound_of(std::vector<TopoDS_Shape>{frame, other}));
    return occt::find_touching_solids(model, occt::make_tables(model, "test").tables).groups;
  };
  EXPECT_TRUE(groups_with(spline_box(gp_Pnt(1.1, 1.1, 0), 1.8, 1.8, 1)).empty()) << "a flap";
  EXPECT_EQ(groups_with(spline_box(gp_Pnt(0.5, 0.2, 1), 0.4, 0.4, 1)).size(), 1u) << "a block on it";
  EXPECT_EQ(groups_with(spline_box(gp_Pnt(-1, 3, 1), 3, 2, 1)).size(), 1u) << "a block across its rim";
}

}  // namespace
}  // namespace st
