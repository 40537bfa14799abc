#include "geometry/import/openings.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>

#include <algorithm>
#include <cmath>
#include <functional>

#include "geometry/brep/compound.h"
#include "geometry/import/plane_loops.h"

namespace st {
namespace {

using Faces = std::vector<TopoDS_Face>;

/// The faces of a solid that `stays` keeps, by the middle of their boxes.
Faces opened(const TopoDS_Shape& solid, const std::function<bool(Vec3)>& stays) {
  Faces faces;
  for (TopExp_Explorer f(solid, TopAbs_FACE); f.More(); f.Next())
    if (stays(occt::rough_box(f.Current()).center())) faces.push_back(TopoDS::Face(f.Current()));
  return faces;
}

struct Capped {
  occt::ImportedShape model;
  std::vector<ImportFinding> findings;
  bool has_caps = false;

  explicit Capped(const Faces& faces, double diagonal = 3) {
    model.shape = occt::compound_of(faces);
    TopExp::MapShapes(model.shape, TopAbs_FACE, model.faces);
    model.attributes.resize(model.faces.Extent());
    has_caps = occt::cap_openings(model, diagonal, findings);
  }
  std::vector<double> areas() const {
    std::vector<double> found;
    for (int i = 0; i < model.faces.Extent(); ++i)
      if (model.attributes[i].name == "cap_" + std::to_string(found.size() + 1))
        found.push_back(occt::area_of(model.faces(i + 1)));
    return found;
  }
  int n_free() const { return occt::count_free_edges(model.shape); }
};

const TopoDS_Shape& brick() {
  static const TopoDS_Shape shape = BRepPrimAPI_MakeBox(3, 2, 1).Shape();
  return shape;
}

TEST(Openings, in_one_plane_get_a_face_each_the_largest_first) {
  const Capped tube(opened(BRepPrimAPI_MakeCylinder(1, 5).Shape(), [](Vec3 x) { return x.z > 0.1 && x.z < 4.9; }));
  ASSERT_TRUE(tube.has_caps);
  ASSERT_EQ(tube.areas().size(), 2u);
  for (const double area : tube.areas()) EXPECT_NEAR(area, M_PI, 1e-6);
  EXPECT_EQ(tube.n_free(), 0);
  const Capped ends(opened(brick(), [](Vec3 x) { return x.z < 0.9 && x.x > 0.1; }));
  ASSERT_EQ(ends.areas().size(), 2u) << "top and one end have one rim, and meet in an edge";
  EXPECT_NEAR(ends.areas()[0], 6, 1e-9);
  EXPECT_NEAR(ends.areas()[1], 2, 1e-9);
  EXPECT_EQ(ends.n_free(), 0);
  EXPECT_EQ(std::ranges::count(ends.findings, FindingKind::kCapped, &ImportFinding::kind), 2);
}

TEST(Openings, in_three_planes_meet_in_a_point) {
  const Capped corner(opened(brick(), [](Vec3 x) { return x.z < 0.9 && x.x > 0.1 && x.y > 0.1; }));
  EXPECT_EQ(corner.areas(), (std::vector<double>{6, 3, 2}));
  EXPECT_EQ(corner.n_free(), 0);
}

TEST(Openings, within_each_other_bound_one_face) {
  Faces sides = opened(BRepPrimAPI_MakeCylinder(2, 5).Shape(), [](Vec3 x) { return x.z > 0.1 && x.z < 4.9; });
  for (const TopoDS_Face& f :
       opened(BRepPrimAPI_MakeCylinder(1, 5).Shape(), [](Vec3 x) { return x.z > 0.1 && x.z < 4.9; }))
    sides.push_back(TopoDS::Face(f.Reversed()));
  const Capped pipe(sides);
  ASSERT_EQ(pipe.areas().size(), 2u);
  for (const double area : pipe.areas()) EXPECT_NEAR(area, 3 * M_PI, 1e-6);
  EXPECT_EQ(pipe.n_free(), 0);
}

TEST(Openings, in_no_plane_are_named_and_left) {
  // A tube whose upper end another cylinder cuts across.
  const TopoDS_Shape across = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-5, 0, 5), gp_Dir(1, 0, 0)), 2, 10).Shape();
  const TopoDS_Shape cut = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(1, 5).Shape(), across).Shape();
  const Capped tube(opened(cut, [](Vec3 x) { return x.z > 0.1 && x.z < 3; }));
  EXPECT_EQ(tube.areas().size(), 1u);
  EXPECT_EQ(std::ranges::count(tube.findings, FindingKind::kOpeningLeft, &ImportFinding::kind), 1);
  EXPECT_GT(tube.n_free(), 0);
}

TEST(Openings, beside_walls_that_lean_outward_are_closed_like_others) {
  const auto is_wall = [](Vec3 x) { return x.z > 0.1 && x.z < 4.9; };
  const Capped bucket(opened(BRepPrimAPI_MakeCone(1, 3, 5).Shape(), is_wall));
  ASSERT_EQ(bucket.areas().size(), 2u);
  EXPECT_NEAR(bucket.areas()[0], 9 * M_PI, 1e-6);
  EXPECT_EQ(bucket.n_free(), 0);
}

TEST(Openings, of_a_rim_of_very_many_edges_are_found_in_two_planes) {
  BRepBuilderAPI_Sewing sewing;
  constexpr int kColumns = 400;  // of a gutter, open above and at one side
  const auto at = [](double i, double y, double z) { return gp_Pnt(i / kColumns * 40, y, z); };
  const auto add = [&](const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& c, const gp_Pnt& d) {
    sewing.Add(BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakePolygon(a, b, c, d, true).Wire(), true).Face());
  };
  for (int i = 0; i < kColumns; ++i) {
    add(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 2, 0), at(i, 2, 0));
    add(at(i, 2, 0), at(i + 1, 2, 0), at(i + 1, 2, 1), at(i, 2, 1));
  }
  add(at(0, 0, 0), at(0, 2, 0), at(0, 2, 1), at(0, 0, 1));
  add(at(kColumns, 0, 0), at(kColumns, 2, 0), at(kColumns, 2, 1), at(kColumns, 0, 1));
  sewing.Perform();
  const Capped gutter(opened(sewing.SewedShape(), [](Vec3) { return true; }), 40);
  ASSERT_EQ(gutter.areas().size(), 2u);
  EXPECT_NEAR(gutter.areas()[0], 80, 1e-6);
  EXPECT_NEAR(gutter.areas()[1], 40, 1e-6);
  EXPECT_EQ(gutter.n_free(), 0);
}

TEST(Openings, of_a_flat_sheet_are_its_holes_not_its_outline) {
  const Capped sheet(opened(brick(), [](Vec3 x) { return x.z > 0.9; }));
  EXPECT_FALSE(sheet.has_caps);
  ASSERT_EQ(sheet.findings.size(), 1u);
  EXPECT_EQ(sheet.findings[0].detail, "4 edges is the outline of a flat face");
  const TopoDS_Shape drilled =
      BRepAlgoAPI_Cut(brick(), BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(1, 1, 0), gp_Dir(0, 0, 1)), 0.5, 1).Shape())
          .Shape();
  const Capped plate(opened(drilled, [](Vec3 x) { return x.z > 0.9; }));
  ASSERT_EQ(plate.areas().size(), 1u);
  EXPECT_NEAR(plate.areas()[0], M_PI / 4, 1e-6);
  EXPECT_EQ(plate.n_free(), 4);
}

TEST(Openings, leave_closed_solids_as_they_are) {
  const Capped box(opened(brick(), [](Vec3) { return true; }));
  EXPECT_FALSE(box.has_caps);
  EXPECT_TRUE(box.findings.empty());
}

}  // namespace
}  // namespace st
