// Seams that come out of the reader of STEP without trimming curves.
#include "geometry/import/seam_curves.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "geometry/brep/faces_of.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"
#include "unit/geometry/occt_shapes.h"

namespace st {
namespace {

TEST(SeamCurves, a_seam_gets_them_as_the_loop_passes_it) {
  const TopoDS_Shape shape = test::occt_shape("ball_with_notch");
  int n_seams = 0;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current().Oriented(TopAbs_FORWARD));
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (edge.Orientation() == TopAbs_REVERSED || !BRep_Tool::IsClosed(edge, face)) continue;
      ++n_seams;
      double t0, t1;
      const Handle(Geom2d_Curve) there = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
      const Handle(Geom2d_Curve) back = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), face, t0, t1);
      BRep_Builder().UpdateEdge(edge, Handle(Geom2d_Curve)(), Handle(Geom2d_Curve)(), face, 1e-7);
      EXPECT_EQ(occt::give_seams_curves(occt::faces_of(shape)), 1);
      const Handle(Geom2d_Curve) given = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
      const Handle(Geom2d_Curve) other = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), face, t0, t1);
      for (const double t : {t0, 0.3 * t0 + 0.7 * t1, t1}) {
        EXPECT_LT(given->Value(t).Distance(there->Value(t)), 1e-6);
        EXPECT_LT(other->Value(t).Distance(back->Value(t)), 1e-6);
      }
    }
  }
  EXPECT_EQ(n_seams, 1);
  EXPECT_EQ(occt::give_seams_curves(occt::faces_of(shape)), 0);
}

TEST(SeamCurves, those_beyond_a_pole_are_moved_back) {
  const TopoDS_Shape shape = test::occt_shape("ball_with_two_holes");
  ASSERT_EQ(occt::move_curves_between_poles(occt::faces_of(shape)), 0);
  int n_moved = 0;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current().Oriented(TopAbs_FORWARD));
    if (!BRep_Tool::Surface(face)->IsKind(STANDARD_TYPE(Geom_SphericalSurface))) continue;
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (BRep_Tool::IsClosed(edge, face) || BRep_Tool::Degenerated(edge)) continue;
      double t0, t1;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
      const gp_Pnt2d place = curve->Value(t0);
      curve->Translate(gp_Vec2d(0, n_moved % 2 ? 2 * M_PI : -4 * M_PI));
      EXPECT_EQ(occt::move_curves_between_poles(occt::faces_of(shape)), 1);
      EXPECT_LT(BRep_Tool::CurveOnSurface(edge, face, t0, t1)->Value(t0).Distance(place), 1e-9);
      ++n_moved;
    }
  }
  EXPECT_EQ(n_moved, 4);
}

class BallsWithSeams : public testing::TestWithParam<const char*> {};

TEST_P(BallsWithSeams, are_whole_in_step_files) {
  const TemporaryDirectory dir;
  test::expect_whole_in_step(GetParam(), dir);
}

INSTANTIATE_TEST_SUITE_P(, BallsWithSeams, testing::Values("ball_with_notch", "ball_with_two_holes"),
                         [](const auto& info) { return std::string(info.param); });

class BodiesWithoutTrimmingCurves : public testing::TestWithParam<const char*> {};

TEST_P(BodiesWithoutTrimmingCurves, are_whole_in_step_files) {
  STEPControl_Controller::Init();
  Interface_Static::SetIVal("write.surfacecurve.mode", 0);
  const TemporaryDirectory dir;
  test::expect_whole_in_step(GetParam(), dir);
  Interface_Static::SetIVal("write.surfacecurve.mode", 1);
  std::ostringstream text;
  text << std::ifstream(dir / "a.step").rdbuf();
  EXPECT_EQ(text.str().find("PCURVE"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, BodiesWithoutTrimmingCurves,
                         testing::Values("ball_with_notch", "ball_with_two_holes", "spindle_with_fin", "lemon_with_fin",
                                         "spindle_with_fin_beside", "lemon_with_fin_beside"),
                         [](const auto& info) { return std::string(info.param); });

/// Takes the (u,v) curves out of the trimming curves (entity 142) of an IGES file.
void keep_curves_in_space(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  const std::regex curve("(\n142,[0-9]+,[0-9]+,)([0-9]+)(,[0-9]+,)[0-9](;)");
  std::string kept, rest = text.str();
  for (std::smatch m; std::regex_search(rest, m, curve); rest = m.suffix())
    kept += m.prefix().str() + m[1].str() + std::string(m[2].length(), '0') + m[3].str() + "2" + m[4].str();
  std::ofstream(path) << kept << rest;
}

TEST(SeamCurves, of_one_piece_of_two_are_given_beside_a_cavity) {
  const TemporaryDirectory dir;
  test::expect_whole_in_step("ball_with_stem_and_cavity", dir);
}

TEST(SeamCurves, make_rings_with_a_notch_whole_in_iges_files) {
  for (const char* shape : {"torus", "ring_with_notch", "ring_with_notch_at_seam"}) {
    const TemporaryDirectory dir;
    test::expect_whole_in_iges(shape, dir);
  }
}

class BodiesWithPoles : public testing::TestWithParam<const char*> {};

TEST_P(BodiesWithPoles, are_whole_in_iges_files_with_curves_in_space_alone) {
  const TemporaryDirectory dir;
  test::write_brep(GetParam(), dir / "a.brep");
  test::write_iges(GetParam(), dir / "a.igs");
  keep_curves_in_space(dir / "a.igs");
  const ImportResult sound = import_model(dir / "a.brep", {}), r = import_model(dir / "a.igs", {});
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, sound.area, 1e-4 * sound.area);
  EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume);
}

INSTANTIATE_TEST_SUITE_P(, BodiesWithPoles,
                         testing::Values("sphere", "ball_with_two_holes", "ball_with_notch", "ball_with_bore",
                                         "spindle_with_fin", "lemon_with_fin"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace st
