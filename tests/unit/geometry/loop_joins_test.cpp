// Loops whose edges lie in different periods.
#include "geometry/import/loop_joins.h"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include "geometry/brep/face_integral.h"

namespace st {
namespace {

constexpr double kRadius = 10, kHeight = 3, kStart = 5.5, kEnd = 7.5;  // across the seam of the cylinder

TopoDS_Face patch() {
  const Handle(Geom_CylindricalSurface) surface = new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), kRadius);
  return BRepBuilderAPI_MakeFace(surface, kStart, kEnd, 0, kHeight, 1e-7).Face();
}

/// Puts the edges at the start of the patch, or all of them, a turn back.
void turn_back(const TopoDS_Face& face, bool all) {
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    double t0, t1;
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    const bool is_at_start = pcurve->Value(t0).X() < kStart + 0.1 && pcurve->Value(t1).X() < kStart + 0.1;
    if (!all && !is_at_start) continue;
    const Handle(Geom2d_Curve) moved = Handle(Geom2d_Curve)::DownCast(pcurve->Translated(gp_Vec2d(-2 * M_PI, 0)));
    BRep_Builder().UpdateEdge(edge, moved, face, 1e-7);
  }
}

std::vector<ImportFinding> join(const TopoDS_Face& face) {
  occt::ImportedShape model;
  model.shape = face;
  TopExp::MapShapes(face, TopAbs_FACE, model.faces);
  model.attributes.resize(1);
  std::vector<ImportFinding> findings;
  occt::join_loops(model, findings);
  return findings;
}

TEST(LoopJoins, an_edge_in_another_turn_is_moved_to_its_neighbours) {
  const TopoDS_Face face = patch();
  const double area = kRadius * (kEnd - kStart) * kHeight;
  turn_back(face, false);
  EXPECT_GT(occt::area_of_faces(face), 2 * area);
  const std::vector<ImportFinding> findings = join(face);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].what(), "loop in another period of its surface, moved by whole periods: 1 edge");
  EXPECT_TRUE(findings[0].is_repair);
  EXPECT_NEAR(occt::area_of_faces(face), area, 1e-6 * area);
}

TEST(LoopJoins, loops_that_are_closed_stay_in_their_turn) {
  const TopoDS_Face face = patch();
  EXPECT_TRUE(join(face).empty());
  turn_back(face, true);
  EXPECT_TRUE(join(face).empty());
}

}  // namespace
}  // namespace st
