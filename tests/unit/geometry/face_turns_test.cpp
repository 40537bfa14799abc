// Faces with turns, and the cut of a coil.
#include "geometry/import/face_turns.h"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepFill.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "geometry/import/import.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

constexpr double kInner = 10, kOuter = 11, kPitch = 3;

/// A strip of height 1 that winds on the cylinder of `radius` around z, from angle u0 to u1.
TopoDS_Face strip(double radius, double u0, double u1, std::array<TopoDS_Edge, 4>& edges) {
  const Handle(Geom_CylindricalSurface) surface = new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), radius);
  const auto rise = [](double u) { return kPitch * u / (2 * M_PI); };
  const std::array<gp_Pnt2d, 4> corner = {gp_Pnt2d{u0, rise(u0)}, gp_Pnt2d{u1, rise(u1)}, gp_Pnt2d{u1, rise(u1) + 1},
                                          gp_Pnt2d{u0, rise(u0) + 1}};
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t k = 0; k < 4; ++k) {
    edges[k] = BRepBuilderAPI_MakeEdge(GCE2d_MakeSegment(corner[k], corner[(k + 1) % 4]).Value(), surface).Edge();
    BRepLib::BuildCurve3d(edges[k], 1e-6, GeomAbs_C1, 14, 2000);
    wire.Add(edges[k]);
  }
  return BRepBuilderAPI_MakeFace(surface, wire.Wire(), true).Face();
}

/// Solid between the strips on both cylinders.
TopoDS_Solid coil(double u0, double u1) {
  std::array<TopoDS_Edge, 4> inner, outer;
  BRepBuilderAPI_Sewing sewing(1e-4);
  sewing.Add(strip(kInner, u0, u1, inner));
  sewing.Add(strip(kOuter, u0, u1, outer));
  for (std::size_t k = 0; k < 4; ++k) sewing.Add(BRepFill::Face(inner[k], outer[k]));
  sewing.Perform();
  TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL);
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shell.Current())).Solid();
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

double volume_of(double u0, double u1) { return 0.5 * (kOuter * kOuter - kInner * kInner) * (u1 - u0); }

ImportResult half_of_coil(double u0, double u1, const std::string& symmetry) {
  const TemporaryDirectory dir;
  BRepTools::Write(coil(u0, u1), (dir / "coil.brep").c_str());
  ImportOptions options;
  options.air.symmetry = symmetry;
  return import_model(dir / "coil.brep", options);
}

TEST(FaceTurns, are_found_with_their_area_beyond_a_plane) {
  std::array<TopoDS_Edge, 4> edges;
  TopTools_IndexedMapOfShape faces;
  faces.Add(strip(kInner, 0, 6.2, edges));              // less than once
  faces.Add(strip(kInner, M_PI / 2, 5 * M_PI, edges));  // two turns and a quarter, of which 1 and a quarter x < 0
  const std::vector<occt::TurnedFace> found = occt::turned_faces_beyond(faces, {-1, 0, 0}, 0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].face, 2);
  EXPECT_NEAR(found[0].area, kInner * 2.5 * M_PI, 1e-3 * kInner * M_PI);
}

TEST(FaceTurns, lost_at_the_symmetry_plane_are_an_error) {
  const double both = half_of_coil(0.3, 13, "x=0").volume + half_of_coil(0.3, 13, "x=0-").volume;
  EXPECT_NEAR(both, volume_of(0.3, 13), 1e-4 * both);
  try {
    const double volume = half_of_coil(0.3, 13, "y=0").volume;
    EXPECT_NEAR(volume, volume_of(0.3, M_PI) + volume_of(2 * M_PI, 3 * M_PI) + volume_of(4 * M_PI, 13), 0.1);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kGeometry);
    EXPECT_NE(std::string(e.what()).find("loses turns"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace st
