// Loops along a seam that the reader of STEP turned.
#include "geometry/import/seam_loop.h"

#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XSAlgo.hxx>
#include <XSAlgo_AlgoContainer.hxx>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

/// Faces of a shape of a STEP file as OpenCASCADE reads them, whose chains had to be turned.
struct Turned {
  int n_faces = 0, n_turned = 0;
};
Turned turn_all(const std::string& shape) {
  const TemporaryDirectory dir;
  test::write_step(shape, dir / "a.step", "MM");
  STEPControl_Reader reader;
  const Handle(XSAlgo_AlgoContainer) mending = XSAlgo::AlgoContainer();  // of imports before
  XSAlgo::SetAlgoContainer(new XSAlgo_AlgoContainer);
  reader.ReadFile((dir / "a.step").c_str());
  reader.TransferRoots();
  XSAlgo::SetAlgoContainer(mending);
  Turned result;
  for (TopExp_Explorer f(reader.OneShape(), TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current()), turned = occt::with_chains_turned(face);
    ++result.n_faces;
    result.n_turned += !turned.IsNull();
    if (turned.IsNull()) continue;
    EXPECT_NE(turned.Orientation(), face.Orientation());
    EXPECT_TRUE(occt::with_chains_turned(turned).IsNull()) << "it is inside now";
  }
  return result;
}

TEST(SeamLoop, chains_outside_the_period_are_turned) {
  const Turned bar = turn_all("ball_with_bar");
  EXPECT_EQ(bar.n_turned, 1);
}

TEST(SeamLoop, others_stay) {
  for (const char* shape : {"sphere", "torus", "cylinder", "cone", "drilled_cylinder", "two_balls"}) {
    const Turned t = turn_all(shape);
    EXPECT_GT(t.n_faces, 0) << shape;
    EXPECT_EQ(t.n_turned, 0) << shape;
  }
}

TEST(SeamLoop, models_are_the_same_as_step_and_brep) {
  const TemporaryDirectory dir;
  test::expect_whole_in_step("ball_with_bar", dir);
}

TEST(SeamLoop, chains_in_iges_files_are_turned_where_no_edge_is_a_seam) {
  for (const char* shape : {"ring_with_ball", "ring_with_notch_at_seam"}) {
    const TemporaryDirectory dir;
    test::expect_whole_in_iges(shape, dir);
    const ImportResult r = import_model(dir / "a.igs", {});
    EXPECT_EQ(test::findings_of(r, "face on the wrong side of its loop").size(), 1u) << shape;
  }
}

}  // namespace
}  // namespace st
