#include "geometry/import/wild_tolerances.h"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <cmath>

#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

/// A box with an edge of this tolerance, and so its first vertex.
struct WildBox {
  explicit WildBox(double tolerance) : shape(BRepPrimAPI_MakeBox(10, 10, 10).Shape()) {
    edge = TopoDS::Edge(TopExp_Explorer(shape, TopAbs_EDGE).Current());
    vertex = TopExp::FirstVertex(edge);
    BRep_Builder().UpdateEdge(edge, tolerance);
    BRep_Builder().UpdateVertex(vertex, tolerance);
  }

  TopoDS_Shape shape;
  TopoDS_Edge edge;
  TopoDS_Vertex vertex;
};

TEST(WildTolerances, become_those_of_the_sewing) {
  const WildBox box(3);
  tighten_tolerances(box.shape, 1e-3, 1e-2);
  EXPECT_DOUBLE_EQ(BRep_Tool::Tolerance(box.edge), 1e-3);
  EXPECT_DOUBLE_EQ(BRep_Tool::Tolerance(box.vertex), 1e-3);
  EXPECT_DOUBLE_EQ(max_edge_tolerance(box.shape), 1e-3);
}

TEST(WildTolerances, of_a_vertex_stay_as_large_as_its_curves_need) {
  const WildBox box(3);
  const gp_Pnt place = BRep_Tool::Pnt(box.vertex);
  BRep_Builder().UpdateVertex(box.vertex, place.Translated(gp_Vec(0.1, 0.1, 0.1)), 3);
  tighten_tolerances(box.shape, 1e-3, 1e-2);
  EXPECT_NEAR(BRep_Tool::Tolerance(box.vertex), 1.01 * 0.1 * std::sqrt(3.0), 1e-9);
}

TEST(WildTolerances, are_those_above_the_limit) {
  const WildBox box(5e-3);
  tighten_tolerances(box.shape, 1e-3, 1e-2);
  EXPECT_DOUBLE_EQ(BRep_Tool::Tolerance(box.edge), 5e-3);
}

}  // namespace
}  // namespace st::occt
