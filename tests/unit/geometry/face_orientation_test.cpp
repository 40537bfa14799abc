#include "geometry/import/face_orientation.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/occt_shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// A shape with its faces anew in `whole`, an empty compound or shell, as `change(face, number)` makes them.
template <class Change>
void add_faces(const std::string& shape, const Change& change, TopoDS_Shape& whole) {
  BRep_Builder builder;
  int n = 0;
  for (TopExp_Explorer e(test::occt_shape(shape), TopAbs_FACE); e.More(); e.Next())
    builder.Add(whole, change(e.Current(), n++));
}

ImportResult import_brep(const TopoDS_Shape& shape) {
  const TemporaryDirectory dir;
  BRepTools::Write(shape, (dir / "b.brep").c_str());
  return import_model(dir / "b.brep", {});
}

/// The faces of a shape in no shell, each a copy of its own or not, turned over where `is_turned(number)`.
template <class IsTurned>
ImportResult import_loose(const std::string& shape, const IsTurned& is_turned, bool is_copied = true) {
  TopoDS_Compound loose;
  BRep_Builder().MakeCompound(loose);
  const auto change = [&](const TopoDS_Shape& original, int n) {
    const TopoDS_Shape face = is_copied ? BRepBuilderAPI_Copy(original).Shape() : original;
    return is_turned(n) ? face.Reversed() : face;
  };
  add_faces(shape, change, loose);
  return import_brep(loose);
}

std::ptrdiff_t n_turned(const ImportResult& r) {
  return std::ranges::count_if(r.findings,
                               [](const ImportFinding& f) { return f.what().starts_with("faces of open surfaces"); });
}

TEST(FaceOrientation, of_an_open_wing_does_not_depend_on_that_of_its_faces_in_the_file) {
  const ImportResult right = import_loose("wing_skin", [](int) { return true; });
  const ImportResult inside_out = import_loose("wing_skin", [](int) { return false; });
  const ImportResult mixed = import_loose("wing_skin", [](int i) { return i % 2 == 0; });
  EXPECT_EQ(inside_out.tables.face_is_reversed, right.tables.face_is_reversed);
  EXPECT_EQ(mixed.tables.face_is_reversed, right.tables.face_is_reversed);
  EXPECT_EQ(n_turned(inside_out), 1);
  EXPECT_EQ(n_turned(right), 0);
}

TEST(FaceOrientation, makes_a_solid_of_faces_that_share_their_edges_whichever_way_they_look) {
  for (const char* shape : {"box", "sharp_wing", "drilled_block"}) {
    const ImportResult solid = test::import_shape(shape);
    const ImportResult r = import_loose(
        shape, [](int i) { return i % 3 == 1; }, false);
    EXPECT_TRUE(r.is_closed) << shape;
    EXPECT_NEAR(r.volume, solid.volume, 1e-9 * solid.volume) << shape;
  }
}

TEST(FaceOrientation, of_a_sheet_stays_as_it_is) {
  for (const bool is_turned : {false, true}) {
    const ImportResult r = import_loose("plate_with_hole", [&](int) { return is_turned; });
    EXPECT_EQ(r.tables.face_is_reversed[0] != 0, is_turned);
    EXPECT_EQ(n_turned(r), 0);
  }
}

/// A solid of the shape's faces, some of them turned.
template <class IsTurned>
ImportResult import_solid(const std::string& shape, const IsTurned& is_turned) {
  TopoDS_Shell shell;
  BRep_Builder builder;
  builder.MakeShell(shell);
  add_faces(
      shape, [&](const TopoDS_Shape& face, int n) { return is_turned(n) ? face.Reversed() : face; }, shell);
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return import_brep(solid);
}

TEST(FaceOrientation, of_a_solid_is_that_of_most_of_its_faces) {
  for (const char* shape : {"box", "drilled_block"})
    for (const int turned : {0, 1, 3}) {
      const ImportResult right = test::import_shape(shape), r = import_solid(shape, [&](int i) { return i == turned; });
      EXPECT_TRUE(r.is_closed) << shape;
      EXPECT_NEAR(r.volume, right.volume, 1e-9 * right.volume) << shape << turned;
      EXPECT_EQ(std::ranges::count_if(
                    r.findings, [](const ImportFinding& f) { return f.what().starts_with("faces of solids turned"); }),
                1);
    }
}

TEST(FaceOrientation, of_solids_is_left_to_repair_shells) {
  const ImportResult r = test::import_shape("baffled_box");
  EXPECT_EQ(n_turned(r), 0);
}

}  // namespace
}  // namespace st
