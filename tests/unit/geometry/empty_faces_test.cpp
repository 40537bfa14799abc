// Faces that are a point or a line go before anything is sewn.
#include "geometry/import/empty_faces.h"

#include <gtest/gtest.h>

#include <BRepTools.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeCircle.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>

#include "base/error.h"
#include "unit/geometry/bare_models.h"
#include "unit/geometry/broken_import.h"
#include "unit/geometry/occt_shapes.h"

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

/// The face with an edge more in its loop where an edge ends at a vertex.
TopoDS_Shape with_edge_at(const TopoDS_Face& face, const TopoDS_Vertex& vertex, const TopoDS_Shape& edge) {
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  BRep_Builder builder;
  TopoDS_Shape result = forward.EmptyCopied();
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (BRepTools_WireExplorer e(BRepTools::OuterWire(forward), forward); e.More(); e.Next()) {
    builder.Add(wire, e.Current());
    if (TopExp::LastVertex(e.Current(), true).IsSame(vertex)) builder.Add(wire, edge);
  }
  wire.Closed(true);
  builder.Add(result, wire);
  return result;
}

/// A box with an edge of this length from a corner back to it, between two of its faces.
ImportResult import_box_with_ring_at_corner(double length) {
  const TopoDS_Shape box = test::occt_shape("box");
  const TopoDS_Edge between = TopoDS::Edge(TopExp_Explorer(box, TopAbs_EDGE).Current());
  const TopoDS_Vertex corner = TopExp::FirstVertex(between);
  const gp_Pnt p = BRep_Tool::Pnt(corner);
  BRep_Builder builder;
  TopoDS_Edge ring;
  builder.MakeEdge(ring, GC_MakeCircle(gp_Ax2(p, gp::DX()), length / (2 * M_PI)).Value(), 1e-7);
  builder.Range(ring, 0, 2 * M_PI);
  builder.Add(ring, corner.Oriented(TopAbs_FORWARD));
  builder.Add(ring, corner.Oriented(TopAbs_REVERSED));
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  TopAbs_Orientation orientation = TopAbs_FORWARD;
  for (TopExp_Explorer f(box, TopAbs_FACE); f.More(); f.Next()) {
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(f.Current(), TopAbs_EDGE, edges);
    if (!edges.Contains(between)) continue;
    const TopoDS_Shape changed = with_edge_at(TopoDS::Face(f.Current()), corner, ring.Oriented(orientation));
    reshape->Replace(f.Current().Oriented(TopAbs_FORWARD), changed);
    orientation = TopAbs_REVERSED;
  }
  const TemporaryDirectory dir;
  BRepTools::Write(reshape->Apply(box), (dir / "a.brep").c_str());
  return import_model(dir / "a.brep", {});
}

TEST(NullEdges, are_taken_out_of_their_loops) {
  const ImportResult box = import_box_with_ring_at_corner(4e-8);
  EXPECT_EQ(box.tables.n_edges(), 12);
  EXPECT_TRUE(box.is_closed);
  const auto found = test::findings_of(box, "edges without length, taken out of their loops: 1");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_repair);
}

TEST(NullEdges, are_no_edges_that_go_somewhere) {
  EXPECT_EQ(import_box_with_ring_at_corner(1e-4).tables.n_edges(), 13);
}

}  // namespace
}  // namespace st
