// Faces that are there twice.
#include <gtest/gtest.h>
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Iterator.hxx>
#include <gp_Trsf.hxx>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/bare_models.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;

TEST(DuplicateFaces, removes_a_face_that_is_there_twice) {
  const ImportResult r = import_broken("doubled_face");
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 0);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
  const auto found = findings_of(r, "duplicated face");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_repair);
  EXPECT_EQ(found[0].entity, "face 7 of the file");
}

TEST(DuplicateFaces, removes_sheets_that_lie_on_a_solid) {
  const ImportResult r = import_broken("sheet_on_solid");
  EXPECT_EQ(findings_of(r, "duplicated face").size(), 2u);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
}

TEST(DuplicateFaces, removes_a_solid_that_is_there_twice) {
  const ImportResult r = import_broken("box_twice");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_NEAR(r.volume, 1000, 1e-6);
  const auto found = findings_of(r, "solid that is there twice, removed");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].entity, "solid 2 of the file");
  EXPECT_TRUE(found[0].is_repair);
}

TEST(DuplicateFaces, keeps_faces_of_solids_that_touch) {
  const ImportResult r = import_broken("touching_boxes");
  EXPECT_EQ(r.tables.n_faces(), 12);
  EXPECT_EQ(r.n_repairs(), 0);
}

TEST(DuplicateFaces, are_not_faces_of_solids_that_touch_whatever_else_is_in_the_file) {
  const ImportResult r = import_broken("touching_boxes_and_sheet");
  EXPECT_EQ(r.tables.n_faces(), 13);
  EXPECT_TRUE(findings_of(r, "duplicated face").empty());
}

TEST(DuplicateFaces, are_not_faces_of_one_plane_side_by_side) {
  for (const char* shape : {"two_boxes", "stepped_box", "baffled_box", "t_junction", "loose_box"})
    EXPECT_TRUE(findings_of(test::import_shape(shape), "duplicated face").empty()) << shape;
}

/// Boxes on each other with a wall of their own each, between the same edges, but for `n_own` of the upper's.
std::vector<TopoDS_Shape> boxes_with_common_edges(int n_own) {
  BRepAlgoAPI_BuilderAlgo builder;
  TopTools_ListOfShape boxes;
  boxes.Append(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 5)).Shape());
  boxes.Append(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 5), gp_Pnt(10, 10, 9)).Shape());
  builder.SetArguments(boxes);
  builder.Build();
  TopTools_IndexedMapOfShape solids, lower;
  TopExp::MapShapes(builder.Shape(), TopAbs_SOLID, solids);
  TopExp::MapShapes(solids(1), TopAbs_FACE, lower);
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  for (TopExp_Explorer f(solids(2), TopAbs_FACE); f.More(); f.Next()) {
    if (!lower.Contains(f.Current())) continue;
    const TopoDS_Shape face = f.Current().Oriented(TopAbs_FORWARD);
    TopoDS_Shape copy = face.EmptyCopied();
    BRep_Builder make;
    for (TopoDS_Iterator wire(face); wire.More(); wire.Next()) make.Add(copy, wire.Value());
    reshape->Replace(face, copy);
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More() && n_own-- > 0; e.Next()) {
      const TopoDS_Shape edge = e.Current().Oriented(TopAbs_FORWARD);
      TopoDS_Shape own = edge.EmptyCopied();
      for (TopoDS_Iterator vertex(edge); vertex.More(); vertex.Next()) make.Add(own, vertex.Value());
      reshape->Replace(edge, own);
    }
  }
  return {solids(1), reshape->Apply(solids(2))};
}

TEST(DuplicateFaces, between_the_same_edges_are_one_wall_of_both_solids) {
  const ImportResult r = test::import_faces(boxes_with_common_edges(0));
  EXPECT_EQ(r.tables.n_faces(), 11);
  EXPECT_EQ(r.tables.n_solids, 2);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 4);
  EXPECT_NEAR(r.volume, 900, 1e-6);
  EXPECT_EQ(findings_of(r, "duplicated face").size(), 1u);
  EXPECT_TRUE(findings_of(r, "bodies touch").empty());
}

TEST(DuplicateFaces, between_some_common_edges_are_one_wall_of_both_solids) {
  const ImportResult r = test::import_faces(boxes_with_common_edges(2));
  EXPECT_EQ(r.tables.n_faces(), 11);
  EXPECT_EQ(r.tables.n_edges(), 20);
  EXPECT_EQ(r.tables.n_solids, 2);
  EXPECT_NEAR(r.volume, 900, 1e-6);
  EXPECT_EQ(findings_of(r, "bodies that touch joined").size(), 1u);
}

TEST(DuplicateFaces, of_one_shell_between_the_same_edges_go) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 5).Shape();
  TopoDS_Shape shell = TopExp_Explorer(box, TopAbs_SHELL).Current();
  const TopoDS_Shape face = TopExp_Explorer(shell, TopAbs_FACE).Current(), forward = face.Oriented(TopAbs_FORWARD);
  TopoDS_Shape twin = forward.EmptyCopied(), solid = box.EmptyCopied();
  BRep_Builder make;
  for (TopoDS_Iterator wire(forward); wire.More(); wire.Next()) make.Add(twin, wire.Value());
  shell.Free(true);
  make.Add(shell, twin.Oriented(face.Orientation()));
  make.Add(solid, shell);
  const ImportResult r = test::import_faces({solid});
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.volume, 500, 1e-6);
  EXPECT_EQ(findings_of(r, "duplicated face").size(), 1u);
}

TEST(DuplicateFaces, of_instances_of_one_solid_at_different_places_stay) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 5).Shape();
  gp_Trsf up;
  up.SetTranslation(gp_Vec(0, 0, 5));
  const ImportResult r = test::import_faces({box, box.Moved(up)});
  EXPECT_EQ(r.tables.n_faces(), 12);
  EXPECT_EQ(r.n_repairs(), 0);
  EXPECT_EQ(findings_of(r, "bodies touch").size(), 1u);
}

}  // namespace
}  // namespace st
