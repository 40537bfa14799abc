// Faces that end or lie on the inside of others.
#include "geometry/import/imprints.h"

#include <gtest/gtest.h>

#include "unit/geometry/bare_models.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_faces;
using test::loose_box;
using test::polygon;

TopoDS_Face sheet(double low, double high) {
  return polygon({gp_Pnt(5, 0, low), gp_Pnt(5, 10, low), gp_Pnt(5, 10, high), gp_Pnt(5, 0, high)});
}

TEST(Imprints, of_a_sheet_across_a_box_make_two_rooms) {
  std::vector<TopoDS_Shape> faces = loose_box(gp_Pnt(0, 0, 0), gp_Pnt(20, 10, 10));
  faces.push_back(sheet(0, 10));
  const ImportResult r = import_faces(faces);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_faces(), 11);
  EXPECT_EQ(r.tables.n_solids, 2);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 4);
  EXPECT_NEAR(r.volume, 2000, 1e-6);
  EXPECT_NEAR(r.area, 1100, 1e-6);
  EXPECT_FALSE(findings_of(r, "ends or lies on other faces, joined there").empty());
}

TEST(Imprints, of_a_sheet_that_ends_in_the_air_leave_it_a_sheet) {
  std::vector<TopoDS_Shape> faces = loose_box(gp_Pnt(0, 0, 0), gp_Pnt(20, 10, 10));
  faces.push_back(polygon({gp_Pnt(5, 2, 10), gp_Pnt(5, 8, 10), gp_Pnt(5, 8, 15), gp_Pnt(5, 2, 15)}));
  const ImportResult r = import_faces(faces);
  EXPECT_EQ(r.edge_uses.n_free, 3);
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_NEAR(r.area, 1000 + 30, 1e-6);
}

TEST(Imprints, are_none_where_a_sheet_pierces_a_box_or_stands_off_it) {
  for (const auto& [low, high] : {std::pair{-5.0, 5.0}, std::pair{10.1, 15.0}}) {
    std::vector<TopoDS_Shape> faces = loose_box(gp_Pnt(0, -5, 0), gp_Pnt(20, 15, 10));
    faces.push_back(sheet(low, high));
    const ImportResult r = import_faces(faces);
    EXPECT_EQ(r.tables.n_faces(), 7);
    EXPECT_TRUE(findings_of(r, "ends or lies on other faces").empty());
  }
}

TEST(Imprints, of_sheets_onto_a_sheet_divide_it) {
  const ImportResult r =
      import_faces({polygon({gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(10, 10, 0), gp_Pnt(0, 10, 0)}), sheet(0, 5)});
  EXPECT_EQ(r.tables.n_faces(), 3);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 1);
  EXPECT_NEAR(r.area, 150, 1e-9);
}

TEST(Imprints, of_bodies_of_loose_faces_that_touch_make_common_walls) {
  std::vector<TopoDS_Shape> faces;
  for (const auto& [low, high] : {std::pair{gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 5)},
                                  {gp_Pnt(0, 0, 5), gp_Pnt(10, 10, 9)},
                                  {gp_Pnt(10, 0, 0), gp_Pnt(15, 5, 5)}})
    for (const TopoDS_Shape& face : loose_box(low, high)) faces.push_back(face);
  const ImportResult r = import_faces(faces);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_solids, 3);
  EXPECT_NEAR(r.volume, 500 + 400 + 125, 1e-6);
  EXPECT_NEAR(r.area, 400 + 260 + 150 - 25, 1e-6) << "each common wall once";
  EXPECT_EQ(findings_of(r, "wall between two rooms").size(), 2u);
}

}  // namespace
}  // namespace st
