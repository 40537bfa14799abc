// A model whose faces and edges end at a plane.
#include "geometry/import/plane_cut.h"

#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <TopExp.hxx>

#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"

namespace st {
namespace {

occt::ImportedShape model_of(const TopoDS_Shape& shape) {
  occt::ImportedShape model;
  model.shape = shape;
  TopExp::MapShapes(shape, TopAbs_FACE, model.faces);
  model.attributes.resize(model.faces.Extent());
  for (std::size_t f = 0; f < model.attributes.size(); ++f)
    model.attributes[f].file_face = static_cast<std::int32_t>(f);
  return model;
}

TEST(PlaneCut, divides_what_is_on_both_sides_and_nothing_else) {
  occt::ImportedShape model = model_of(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  EXPECT_EQ(occt::cut_at_plane(model, {1, 8, 0}, 37, "model"), 4);
  EXPECT_EQ(model.faces.Extent(), 10);
  EXPECT_EQ(occt::count_free_edges(model.shape), 0);
  const auto sides = occt::sides_of(model, {1, 8, 0}, 1e-6);
  EXPECT_EQ(std::count(sides.begin(), sides.end(), occt::PlaneSide::kAbove), 5);
  EXPECT_EQ(std::count(sides.begin(), sides.end(), occt::PlaneSide::kBelow), 5);
  EXPECT_EQ(occt::cut_at_plane(model, {1, 8, 0}, 37, "model"), 0);
}

TEST(PlaneCut, a_plane_along_faces_or_edges_divides_nothing) {
  occt::ImportedShape model = model_of(BRepPrimAPI_MakeBox(10, 20, 30).Shape());
  EXPECT_EQ(occt::cut_at_plane(model, {1, 20, 0}, 37, "model"), 0);
  const auto sides = occt::sides_of(model, {1, 20, 0}, 1e-6);
  EXPECT_EQ(std::count(sides.begin(), sides.end(), occt::PlaneSide::kIn), 1);
  EXPECT_EQ(model.faces.Extent(), 6);
}

TEST(PlaneCut, bodies_that_touch_stay_apart) {
  occt::ImportedShape model = model_of(occt::compound_of(std::vector<TopoDS_Shape>{
      BRepPrimAPI_MakeBox(10, 20, 30).Shape(), BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 30), 10, 20, 5).Shape()}));
  EXPECT_EQ(occt::cut_at_plane(model, {1, 8, 0}, 37, "model"), 8);
  EXPECT_EQ(model.faces.Extent(), 20);
  TopTools_IndexedMapOfShape edges;
  for (const int n : occt::edge_uses(model.shape, edges)) EXPECT_EQ(n, 2);
}

TEST(PlaneCut, parts_keep_what_the_face_had) {
  occt::ImportedShape model = model_of(BRepPrimAPI_MakeSphere(10).Shape());
  model.attributes[0].name = "ball";
  EXPECT_EQ(occt::cut_at_plane(model, {2, 0, 0}, 34, "model"), 1);
  ASSERT_EQ(model.faces.Extent(), 2);
  for (const occt::FaceAttributes& a : model.attributes) EXPECT_EQ(a.name, "ball");
}

}  // namespace
}  // namespace st
