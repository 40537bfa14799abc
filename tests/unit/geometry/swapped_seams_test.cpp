// Seams whose two trimming curves have changed places.
#include "geometry/import/swapped_seams.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <gtest/gtest.h>

#include "geometry/brep/faces_of.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"
#include "unit/geometry/occt_shapes.h"

namespace st {
namespace {

struct Seam {
  TopoDS_Edge edge;
  TopoDS_Face face;

  Handle(Geom2d_Curve) curve(TopAbs_Orientation side) const {
    double t0, t1;
    return BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Oriented(side)), face, t0, t1);
  }
};

std::vector<Seam> seams_of(const TopoDS_Shape& shape) {
  std::vector<Seam> seams;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(face, TopAbs_EDGE, edges);
    for (int e = 1; e <= edges.Extent(); ++e)
      if (BRep_Tool::IsClosed(TopoDS::Edge(edges(e)), face)) seams.push_back({TopoDS::Edge(edges(e)), face});
  }
  return seams;
}

TEST(SwappedSeams, curves_that_changed_places_do_so_again) {
  const TopoDS_Shape shape = test::occt_shape("spindle_with_fin");
  const std::vector<Seam> seams = seams_of(shape);
  ASSERT_EQ(seams.size(), 2u);
  for (const Seam& seam : seams) {
    const Handle(Geom2d_Curve) there = seam.curve(TopAbs_FORWARD), back = seam.curve(TopAbs_REVERSED);
    const TopoDS_Edge forward = TopoDS::Edge(seam.edge.Oriented(TopAbs_FORWARD));
    BRep_Builder().UpdateEdge(forward, back, there, seam.face, 1e-7);
    EXPECT_EQ(seam.curve(TopAbs_FORWARD), back);
    EXPECT_EQ(occt::swap_seams(occt::faces_of(shape)), 1);
    EXPECT_EQ(seam.curve(TopAbs_FORWARD), there);
    EXPECT_EQ(seam.curve(TopAbs_REVERSED), back);
    EXPECT_EQ(occt::swap_seams(occt::faces_of(shape)), 0);
  }
}

TEST(SwappedSeams, others_stay) {
  for (const char* name : {"sphere", "torus", "cylinder", "cone", "drilled_cylinder", "ball_with_stem", "ball_with_bar",
                           "ball_with_socket", "spindle_with_fin", "periodic_tube", "closed_tube"})
    EXPECT_EQ(occt::swap_seams(occt::faces_of(test::occt_shape(name))), 0) << name;
}

class BodiesWithFins : public testing::TestWithParam<const char*> {};

TEST_P(BodiesWithFins, are_whole_in_step_files) {
  const TemporaryDirectory dir;
  test::expect_whole_in_step(GetParam(), dir);
}

INSTANTIATE_TEST_SUITE_P(, BodiesWithFins, testing::Values("spindle_with_fin", "lemon_with_fin"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace st
