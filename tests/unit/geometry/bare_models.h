// Bare surfaces for the tests of the import: planes and splines that share no edges.
#pragma once

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Face.hxx>
#include <string>
#include <vector>

#include "geometry/brep/compound.h"
#include "geometry/import/import.h"
#include "unit/io/temporary_directory.h"

namespace st::test {

using Points = std::vector<gp_Pnt>;

/// Linear both ways through rows of points, with a knot at each row and column.
inline TopoDS_Face spline_face(const std::vector<Points>& rows) {
  const auto knots = [](int n) {
    TColStd_Array1OfReal t(1, n);
    for (int i = 1; i <= n; ++i) t(i) = i;
    return t;
  };
  const auto multiplicities = [](int n) {
    TColStd_Array1OfInteger m(1, n);
    for (int i = 1; i <= n; ++i) m(i) = i == 1 || i == n ? 2 : 1;
    return m;
  };
  const int n_u = static_cast<int>(rows.size()), n_v = static_cast<int>(rows[0].size());
  TColgp_Array2OfPnt poles(1, n_u, 1, n_v);
  for (int i = 1; i <= n_u; ++i)
    for (int j = 1; j <= n_v; ++j) poles(i, j) = rows[i - 1][j - 1];
  const Handle(Geom_BSplineSurface) spline =
      new Geom_BSplineSurface(poles, knots(n_u), knots(n_v), multiplicities(n_u), multiplicities(n_v), 1, 1);
  return BRepBuilderAPI_MakeFace(spline, Precision::Confusion()).Face();
}

inline TopoDS_Face polygon(const Points& points) {
  BRepBuilderAPI_MakePolygon wire;
  for (const gp_Pnt& p : points) wire.Add(p);
  wire.Close();
  return BRepBuilderAPI_MakeFace(wire.Wire()).Face();
}

/// The faces of a box, each for itself.
inline std::vector<TopoDS_Shape> loose_box(gp_Pnt low, gp_Pnt high) {
  std::vector<TopoDS_Shape> faces;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(low, high).Shape();
  for (TopExp_Explorer f(box, TopAbs_FACE); f.More(); f.Next())
    faces.push_back(BRepBuilderAPI_Copy(f.Current()).Shape());
  return faces;
}

inline ImportResult import_faces(const std::vector<TopoDS_Shape>& faces, const ImportOptions& options = {}) {
  const TemporaryDirectory dir;
  const std::string path = dir / "model.brep";
  BRepTools::Write(occt::compound_of(faces), path.c_str());
  return import_model(path, options);
}

}  // namespace st::test
