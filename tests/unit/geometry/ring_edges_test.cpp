// Edges of IGES files that come back to where they begin.
#include "geometry/import/ring_edges.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/brep/faces_of.h"
#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/occt_shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// Ends of the curve of each edge as vertices of their own, `apart` from each other.
TopoDS_Shape with_open_rings(const TopoDS_Shape& shape, double apart) {
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next()) {
    TopoDS_Edge edge = TopoDS::Edge(e.Current().Oriented(TopAbs_FORWARD));
    const TopoDS_Vertex first = TopExp::FirstVertex(edge);
    if (!first.IsSame(TopExp::LastVertex(edge))) continue;
    TopoDS_Vertex last;
    BRep_Builder().MakeVertex(last, BRep_Tool::Pnt(first).Translated({0, 0, apart}), 1e-7);
    edge.Free(true);
    BRep_Builder().Remove(edge, first.Reversed());
    BRep_Builder().Add(edge, last.Reversed());
  }
  return shape;
}

TEST(RingEdges, get_one_vertex_where_both_ends_are_one_point) {
  const TopoDS_Shape disc = with_open_rings(test::occt_shape("disc"), 1e-5);
  EXPECT_EQ(occt::join_ring_ends(occt::faces_of(disc), 1e-6), 0) << "they are apart";
  EXPECT_EQ(occt::join_ring_ends(occt::faces_of(disc), 100.0), 0) << "it is no larger than that itself";
  EXPECT_EQ(occt::join_ring_ends(occt::faces_of(disc), 1e-4), 1);
  EXPECT_EQ(occt::join_ring_ends(occt::faces_of(disc), 1e-4), 0);
  const TopoDS_Edge edge = TopoDS::Edge(TopExp_Explorer(disc, TopAbs_EDGE).Current());
  EXPECT_TRUE(TopExp::FirstVertex(edge).IsSame(TopExp::LastVertex(edge)));
  EXPECT_GT(BRep_Tool::Tolerance(TopExp::FirstVertex(edge)), 1e-5);
  EXPECT_EQ(occt::join_ring_ends(occt::faces_of(test::occt_shape("box")), 1e-4), 0);
  const TopoDS_Shape bare = with_open_rings(test::occt_shape("disc"), 1e-5);
  const TopoDS_Edge without = TopoDS::Edge(TopExp_Explorer(bare, TopAbs_EDGE).Current());
  BRep_Builder().UpdateEdge(without, Handle(Geom_Curve)(), 1e-7);
  BRep_Builder().UpdateEdge(without, Handle(Geom2d_Curve)(), occt::faces_of(bare)[0], 1e-7);
  EXPECT_EQ(occt::join_ring_ends(occt::faces_of(bare), 1e-4), 0) << "an edge without curves";
}

/// A part of a ring, some 20 m wide.
TopoDS_Shape part_of_ring() {
  const std::vector<double> radii{1500, 2200, 1300, 2400, 1800, 2000};
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, static_cast<int>(radii.size()));
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(radii.size());
    points->SetValue(static_cast<int>(k) + 1, {8000 + radii[k] * std::cos(angle), 0, radii[k] * std::sin(angle)});
  }
  GeomAPI_Interpolate profile(points, true, 1e-7);
  profile.Perform();
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(profile.Curve());
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(edge), true);
  return BRepPrimAPI_MakeRevol(face, gp_Ax1(gp::Origin(), gp::DZ()), 2.96).Shape();
}

TEST(RingEdges, of_parts_of_rings_in_metres_are_passed_the_right_way) {
  const TemporaryDirectory dir;
  const TopoDS_Shape ring = part_of_ring();
  ASSERT_TRUE(BRepTools::Write(ring, (dir / "a.brep").c_str()));
  IGESControl_Controller::Init();
  IGESControl_Writer writer("M", 0);
  ASSERT_TRUE(writer.AddShape(ring) && writer.Write((dir / "a.igs").c_str()));
  const ImportResult sound = import_model(dir / "a.brep", {}), r = import_model(dir / "a.igs", {});
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, 1e-6 * sound.area, 1e-5 * r.area);
  EXPECT_NEAR(r.volume, 1e-9 * sound.volume, 1e-5 * r.volume);
}

}  // namespace
}  // namespace st
