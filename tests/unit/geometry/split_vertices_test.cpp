// Vertices in the middle of short edges.
#include <gtest/gtest.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

/// A box of 10 with a fillet of 0.1 at one edge.
TopoDS_Shape rounded_box() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  fillet.Add(0.1, TopoDS::Edge(TopExp_Explorer(box, TopAbs_EDGE).Current()));
  return fillet.Shape();
}

/// The ends of each arc become one vertex between them, and the arc is marked as a pole.
TopoDS_Shape with_merged_arcs(const TopoDS_Shape& shape) {
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    if (BRepAdaptor_Curve(edge).GetType() != GeomAbs_Circle) continue;
    const TopoDS_Vertex a = TopExp::FirstVertex(edge), b = TopExp::LastVertex(edge);
    const gp_Pnt middle(0.5 * (BRep_Tool::Pnt(a).XYZ() + BRep_Tool::Pnt(b).XYZ()));
    TopoDS_Vertex both;
    BRep_Builder().MakeVertex(both, middle, 0.2);
    reshape->Replace(a.Oriented(TopAbs_FORWARD), both);
    reshape->Replace(b.Oriented(TopAbs_FORWARD), both);
    BRep_Builder().UpdateEdge(edge, Handle(Geom_Curve)(), 1e-6);
    BRep_Builder().Degenerated(edge, true);
  }
  return reshape->Apply(shape);
}

ImportResult import_shape(const TopoDS_Shape& shape) {
  const TemporaryDirectory dir;
  BRepTools::Write(shape, (dir / "model.brep").c_str());
  return import_model(dir / "model.brep", {});
}

constexpr const char* kSplit = "vertex that stood for both ends";

TEST(SplitVertices, are_at_the_ends_of_arcs) {
  const ImportResult whole = import_shape(rounded_box()), r = import_shape(with_merged_arcs(rounded_box()));
  ASSERT_EQ(whole.tables.n_vertices(), 10);
  ASSERT_TRUE(test::findings_of(whole, kSplit).empty());
  EXPECT_EQ(test::findings_of(r, kSplit).size(), 2u);
  EXPECT_TRUE(test::findings_of(r, "edges end away").empty());
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_vertices(), 10);
  EXPECT_EQ(r.tables.n_faces(), 7);
  EXPECT_NEAR(r.area, whole.area, 1e-9 * whole.area);
  for (VertexId v = 0; v < r.tables.n_vertices(); ++v) {
    double least = 1;
    for (const Vec3 x : whole.tables.vertex_xyz) least = std::min(least, norm(x - r.tables.vertex_xyz[v]));
    EXPECT_LT(least, 1e-9);
    EXPECT_LT(r.tables.vertex_tolerance[v], 1e-5);
  }
}

TEST(SplitVertices, leave_poles_alone) {
  const ImportResult r = import_shape(BRepPrimAPI_MakeSphere(1).Shape());
  EXPECT_TRUE(test::findings_of(r, kSplit).empty());
}

}  // namespace
}  // namespace st
