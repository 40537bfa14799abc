// Faces that are a point or a line go before anything is sewn.
#include "geometry/import/empty_faces.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "unit/geometry/bare_models.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_faces;
using test::loose_box;
using test::spline_face;

const gp_Pnt kOrigin(0, 0, 0), kCorner(30, 20, 10);

TEST(EmptyFaces, that_are_points_do_not_stop_the_sewing) {
  std::vector<TopoDS_Shape> faces = loose_box(kOrigin, kCorner);
  for (int k = 0; k < 2; ++k) faces.insert(faces.begin() + 3, spline_face({{kCorner, kCorner}, {kCorner, kCorner}}));
  const ImportResult r = import_faces(faces);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_NEAR(r.volume, 6000, 1e-6);
  const auto found = findings_of(r, "face without area, left out");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].entity, "face 4 of the file");
  EXPECT_TRUE(found[0].is_repair);
  EXPECT_NEAR(distance(found[0].xyz, {30, 20, 10}), 0, 1e-9);
}

TEST(EmptyFaces, that_are_lines_leave_their_neighbours_joined) {
  std::vector<TopoDS_Shape> faces = loose_box(kOrigin, kCorner);
  const gp_Pnt a(0, 0, 0), b(30, 0, 0);
  faces.push_back(spline_face({{a, b}, {a, b}}));                                         // shrunk across
  faces.push_back(spline_face({{a, b}, {gp_Pnt(0, 1e-8, 0), gp_Pnt(30, -1e-8, 1e-8)}}));  // nearly
  const ImportResult r = import_faces(faces);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 0);
  EXPECT_EQ(findings_of(r, "face without area, left out").size(), 2u);
}

TEST(EmptyFaces, are_not_narrow_ones_and_not_closed_ones) {
  const double diagonal = 40;
  const auto width_of = [](double width) {
    return spline_face({{gp_Pnt(0, 0, 0), gp_Pnt(30, 0, 0)}, {gp_Pnt(0, width, 0), gp_Pnt(30, width, 0)}});
  };
  EXPECT_FALSE(occt::empty_box(width_of(1e-3), diagonal));
  EXPECT_TRUE(occt::empty_box(width_of(1e-6), diagonal));
  const gp_Pnt ring[] = {gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0), gp_Pnt(1, 1, 0), gp_Pnt(0, 1, 0), gp_Pnt(0, 0, 0)};
  test::Points low(std::begin(ring), std::end(ring)), high = low;
  for (gp_Pnt& p : high) p.SetZ(5);
  EXPECT_FALSE(occt::empty_box(spline_face({low, high}), diagonal)) << "its outline encloses nothing";
}

TEST(EmptyFaces, alone_are_no_model) {
  const gp_Pnt p(1, 2, 3);
  try {
    import_faces({spline_face({{p, p}, {p, p}}), spline_face({{p, p}, {p, p}})});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kGeometry);
    EXPECT_NE(std::string(e.what()).find("no face of the file has an area"), std::string::npos);
  }
}

}  // namespace
}  // namespace st
