// Edges that stop short of their vertex.
#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

constexpr double kShort = 0.05;

/// A box of 10 of which one edge begins `gap` after its vertex, and its vertex lies `aside` off its line.
TopoDS_Shape box_with_gap(double gap, double aside) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
  const TopoDS_Edge edge = TopoDS::Edge(TopExp_Explorer(box, TopAbs_EDGE).Current().Oriented(TopAbs_FORWARD));
  double t0 = 0, t1 = 0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  gp_Pnt x;
  gp_Vec along;
  curve->D1(t0, x, along);
  BRep_Builder builder;
  builder.Range(edge, t0 + gap, t1);
  const gp_Vec side(along.Y(), along.Z(), along.X());
  builder.UpdateVertex(TopExp::FirstVertex(edge), x.Translated(aside * side), 2 * (gap + aside) + 1e-7);
  return box;
}

ImportResult import_box(double gap, double aside) {
  const TemporaryDirectory dir;
  BRepTools::Write(box_with_gap(gap, aside), (dir / "model.brep").c_str());
  return import_model(dir / "model.brep", {});
}

constexpr const char *kExtended = "edge that stopped short", *kAway = "edges end away";

TEST(ShortEnds, are_extended_to_their_vertices) {
  const ImportResult whole = import_box(0, 0), r = import_box(kShort, 0);
  EXPECT_TRUE(test::findings_of(whole, kExtended).empty());
  ASSERT_EQ(test::findings_of(r, kExtended).size(), 1u);
  EXPECT_NEAR(test::findings_of(r, kExtended)[0].size, kShort, 1e-9);
  EXPECT_TRUE(test::findings_of(r, kAway).empty());
  for (EdgeId e = 0; e < r.tables.n_edges(); ++e) EXPECT_NEAR(r.tables.edge_length[e], 10, 1e-9);
  EXPECT_NEAR(r.area, whole.area, 1e-9 * whole.area);
}

TEST(ShortEnds, stay_where_the_vertex_lies_beside_them) {
  const ImportResult r = import_box(kShort, kShort);
  EXPECT_TRUE(test::findings_of(r, kExtended).empty());
  EXPECT_NEAR(*std::ranges::min_element(r.tables.edge_length), 10 - kShort, 1e-9);
}

}  // namespace
}  // namespace st
