#include "broken/kinked_shapes.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

namespace st::test {
namespace {

/// Straight sides through the points, as a spline of this degree with knots of full multiplicity.
Handle(Geom_BSplineCurve) outline(const std::vector<gp_Pnt>& points, int degree, bool is_periodic = false) {
  const int n_sides = static_cast<int>(points.size()) - 1;
  TColgp_Array1OfPnt poles(1, n_sides * degree + (is_periodic ? 0 : 1));
  TColStd_Array1OfReal knots(1, n_sides + 1);
  TColStd_Array1OfInteger multiplicities(1, n_sides + 1);
  for (int k = 0; k < poles.Length(); ++k) {
    const gp_Pnt a = points[k / degree], b = points[std::min(k / degree + 1, n_sides)];
    poles(k + 1) = gp_Pnt(a.XYZ() + (b.XYZ() - a.XYZ()) * (static_cast<double>(k % degree) / degree));
  }
  for (int k = 0; k <= n_sides; ++k) {
    knots(k + 1) = k;
    multiplicities(k + 1) = !is_periodic && (k == 0 || k == n_sides) ? degree + 1 : degree;
  }
  return new Geom_BSplineCurve(poles, knots, multiplicities, degree, is_periodic);
}

/// The prism of height 2 over what the points bound, the last side a line of its own.
TopoDS_Shape prism(const std::vector<gp_Pnt>& points, int degree) {
  BRepBuilderAPI_MakeEdge sides(outline(points, degree));
  BRepBuilderAPI_MakeWire wire(sides.Edge(), BRepBuilderAPI_MakeEdge(sides.Vertex2(), sides.Vertex1()).Edge());
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, 2)).Shape();
}

/// The rectangle alone: its outline's kinks are in a plane.
TopoDS_Shape plate() {
  BRepBuilderAPI_MakeEdge sides(outline({gp_Pnt(0, 0, 0), gp_Pnt(4, 0, 0), gp_Pnt(4, 3, 0), gp_Pnt(0, 3, 0)}, 3));
  BRepBuilderAPI_MakeWire wire(sides.Edge(), BRepBuilderAPI_MakeEdge(sides.Vertex2(), sides.Vertex1()).Edge());
  return BRepBuilderAPI_MakeFace(wire.Wire()).Face();
}

TopoDS_Shape rectangle(int degree) {
  return prism({gp_Pnt(0, 0, 0), gp_Pnt(4, 0, 0), gp_Pnt(4, 3, 0), gp_Pnt(0, 3, 0)}, degree);
}

TopoDS_Shape two_instances() {
  const TopoDS_Shape shape = rectangle(1);
  gp_Trsf turn, move;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 1, 0)), 0.7);
  move.SetTranslation(gp_Vec(20, 0, 0));
  TopoDS_Compound both;
  BRep_Builder().MakeCompound(both);
  BRep_Builder().Add(both, shape);
  BRep_Builder().Add(both, shape.Moved(TopLoc_Location(move * turn)));
  return both;
}

TopoDS_Shape tube() {
  const auto curve = outline(
      {gp_Pnt(0, -2, 0), gp_Pnt(2, -2, 0), gp_Pnt(2, 2, 0), gp_Pnt(-2, 2, 0), gp_Pnt(-2, -2, 0), gp_Pnt(0, -2, 0)}, 1,
      true);
  const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve).Edge()).Wire();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire).Face(), gp_Vec(0, 0, 2)).Shape();
}

TopoDS_Shape turned() {
  BRepBuilderAPI_MakeEdge side(outline({gp_Pnt(1, 0, 0), gp_Pnt(3, 0, 2), gp_Pnt(1, 0, 4)}, 1));
  BRepBuilderAPI_MakeWire wire(side.Edge(), BRepBuilderAPI_MakeEdge(gp_Pnt(1, 0, 4), gp_Pnt(0, 0, 4)).Edge(),
                               BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 4), gp_Pnt(0, 0, 0)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Edge());
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OZ()).Shape();
}

/// z = slope (|x| + |y|) over the square of side 4; u is x, v is y.
Handle(Geom_BSplineSurface) ridge(double slope) {
  TColgp_Array2OfPnt poles(1, 3, 1, 3);
  TColStd_Array1OfReal knots(1, 3);
  TColStd_Array1OfInteger multiplicities(1, 3);
  for (int i = 0; i < 3; ++i) {
    knots(i + 1) = 2 * i - 2;
    multiplicities(i + 1) = i == 1 ? 1 : 2;
    for (int j = 0; j < 3; ++j)
      poles(i + 1, j + 1) = gp_Pnt(2 * i - 2, 2 * j - 2, slope * (std::abs(2 * i - 2) + std::abs(2 * j - 2)));
  }
  return new Geom_BSplineSurface(poles, knots, knots, multiplicities, multiplicities, 1, 1);
}

TopoDS_Shape whole(const Handle(Geom_Surface) & surface) { return BRepBuilderAPI_MakeFace(surface, 1e-7).Face(); }

TopoDS_Shape with_hole() {
  const Handle(Geom_BSplineSurface) surface = ridge(0.5);
  BRepBuilderAPI_MakeFace face(surface, 1e-7);
  const Handle(Geom2d_Circle) circle = new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0.1, 0.2), gp_Dir2d(1, 0)), 1);
  face.Add(TopoDS::Wire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle, surface).Edge()).Wire().Reversed()));
  const TopoDS_Face result = face.Face();
  BRepLib::BuildCurves3d(result);
  return result;
}

/// The part of the ridge inside the polygon in (u,v).
TopoDS_Shape part_of_ridge(const std::vector<gp_Pnt2d>& corners) {
  const Handle(Geom_BSplineSurface) surface = ridge(0.5);
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t k = 0; k < corners.size(); ++k)
    wire.Add(BRepBuilderAPI_MakeEdge(GCE2d_MakeSegment(corners[k], corners[(k + 1) % corners.size()]).Value(), surface)
                 .Edge());
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, wire.Wire()).Face();
  BRepLib::BuildCurves3d(face);
  return face;
}

using Makers = std::map<std::string, std::function<TopoDS_Shape()>>;

Makers makers() {
  const double rise = 4 * std::tan(15 * M_PI / 180);
  return {
      {"kink_prism", [] { return rectangle(1); }},
      {"kink_cubic", [] { return rectangle(3); }},
      {"kink_twice", two_instances},
      {"kink_tube", tube},
      {"kink_turned", turned},
      {"kink_ridge", [] { return whole(ridge(0.5)); }},
      {"kink_hole", with_hole},
      {"kink_trimmed", [] { return whole(new Geom_RectangularTrimmedSurface(ridge(0.5), -1.5, 2.0, -2.0, 1.0)); }},
      {"kink_notch",
       [] {
         return part_of_ridge({{-2, -2}, {2, -2}, {2, 2}, {0, 2}, {0, 0.5}, {-2, 0.5}});
       }},
      {"no_kink_flat",
       [rise] {
         return prism({gp_Pnt(0, 0, 0), gp_Pnt(4, 0, 0), gp_Pnt(8, rise, 0), gp_Pnt(12, 2.5 * rise, 0)}, 1);
       }},
      {"no_kink_plate", plate},
      {"no_kink_smooth", [] { return whole(ridge(0)); }},
      {"no_kink_side",
       [] {
         return part_of_ridge({{0.5, 0.5}, {2, 0.5}, {2, 2}, {0.5, 2}});
       }},
  };
}

}  // namespace

std::vector<std::string> kinked_shapes() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

void write_kinked(const std::string& name, const std::string& path) {
  const Makers all = makers();
  const auto maker = all.find(name);
  if (maker == all.end()) throw std::runtime_error("no kinked shape " + name);
  if (!BRepTools::Write(maker->second(), path.c_str())) throw std::runtime_error("cannot write " + path);
}

}  // namespace st::test
