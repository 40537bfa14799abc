// Loose faces, three and more of which meet at an edge.
#include "geometry/import/rooms.h"

#include <gtest/gtest.h>

#include "unit/geometry/bare_models.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_faces;
using test::loose_box;
using test::polygon;

/// Rooms of 10 in a row, each wall once.
std::vector<TopoDS_Shape> row_of(int n) {
  std::vector<TopoDS_Shape> faces;
  for (int k = 0; k < n; ++k)
    for (const TopoDS_Shape& face : loose_box(gp_Pnt(10 * k, 0, 0), gp_Pnt(10 * k + 10, 10, 10))) faces.push_back(face);
  return faces;  // walls between rooms are there twice, as the file's duplicates
}

TEST(Rooms, in_a_row_have_common_walls) {
  for (const int n : {2, 3, 4}) {
    const ImportResult r = import_faces(row_of(n));
    EXPECT_TRUE(r.is_closed) << n;
    EXPECT_EQ(r.tables.n_faces(), 5 * n + 1) << n;
    EXPECT_EQ(r.tables.n_solids, n);
    EXPECT_EQ(r.edge_uses.n_nonmanifold, 4 * (n - 1)) << n;
    EXPECT_NEAR(r.volume, 1000 * n, 1e-6) << n;
    EXPECT_EQ(findings_of(r, "wall between two rooms").size(), n - 1u);
    EXPECT_EQ(findings_of(r, "sewn where three faces or more meet").size(), 1u);
  }
}

TEST(Rooms, keep_sheets_that_stand_in_them) {
  std::vector<TopoDS_Shape> faces = loose_box(gp_Pnt(0, 0, 0), gp_Pnt(20, 10, 10));
  faces.push_back(polygon({gp_Pnt(0, 0, 0), gp_Pnt(20, 0, 0), gp_Pnt(15, 5, 5), gp_Pnt(5, 5, 5)}));
  const ImportResult r = import_faces(faces);
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 1);
  EXPECT_EQ(r.edge_uses.n_free, 3);
  const auto found = findings_of(r, "sheet");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].entity, "face 7");
  EXPECT_FALSE(found[0].is_repair);
}

TEST(Rooms, are_divided_by_a_sheet_whose_ends_have_no_edge_to_lie_on) {
  std::vector<TopoDS_Shape> faces = loose_box(gp_Pnt(0, 0, 0), gp_Pnt(20, 10, 10));
  faces.push_back(polygon({gp_Pnt(0, 0, 0), gp_Pnt(20, 0, 0), gp_Pnt(20, 10, 10), gp_Pnt(0, 10, 10)}));
  const ImportResult r = import_faces(faces);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 4) << "the sheet's ends divide the sides of the box";
  EXPECT_EQ(r.tables.n_solids, 2);
}

TEST(Rooms, are_none_where_three_sheets_meet) {
  std::vector<TopoDS_Shape> faces;
  for (const auto& [y, z] : {std::pair{5, 0}, {-5, 0}, {0, 5}})
    faces.push_back(polygon({gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(10, y, z), gp_Pnt(0, y, z)}));
  const ImportResult r = import_faces(faces);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 1);
  EXPECT_EQ(r.edge_uses.n_free, 9);
  EXPECT_EQ(r.tables.n_faces(), 3);
}

TEST(Rooms, are_none_where_four_sheets_meet_at_one_edge) {
  std::vector<TopoDS_Shape> faces;
  for (const auto& [y, z] : {std::pair{5, 0}, {-5, 0}, {0, 5}, {0, -5}})
    faces.push_back(polygon({gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(10, y, z), gp_Pnt(0, y, z)}));
  const ImportResult r = import_faces(faces);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 1);
  EXPECT_EQ(r.edge_uses.n_free, 12);
  EXPECT_EQ(r.tables.n_edges(), 13);
  EXPECT_EQ(r.tables.n_faces(), 4);
}

}  // namespace
}  // namespace st
