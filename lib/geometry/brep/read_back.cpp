#include "geometry/brep/read_back.h"

#include <BRep_CurveRepresentation.hxx>
#include <BRep_ListIteratorOfListOfCurveRepresentation.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

namespace st::occt {
namespace {

bool are_equal(const gp_Dir& a, const gp_Dir& b) { return a.X() == b.X() && a.Y() == b.Y() && a.Z() == b.Z(); }

/// As it is read: a unit vector once more.
gp_Dir read(const gp_Dir& d) { return {d.X(), d.Y(), d.Z()}; }

/// The second direction is made square to the first where they are read.
bool is_read_back_equal(const gp_Ax3& axes) {
  const gp_Dir normal = read(axes.Direction()), along = read(axes.XDirection()), across = read(axes.YDirection());
  gp_Ax3 again(axes.Location(), normal, along);
  if (along.DotCross(across, normal) < 0) again.YReverse();
  return are_equal(again.Direction(), axes.Direction()) && are_equal(again.XDirection(), axes.XDirection()) &&
         are_equal(again.YDirection(), axes.YDirection());
}

bool is_read_back_equal(const Handle(Geom_Surface) & surface) {
  if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface))
    return !spline->IsURational() && !spline->IsVRational() && !spline->IsUPeriodic() && !spline->IsVPeriodic();
  const auto plane = Handle(Geom_Plane)::DownCast(surface);
  return plane && is_read_back_equal(plane->Position());
}

bool is_read_back_equal(const Handle(Geom_Curve) & curve) {
  if (curve.IsNull()) return true;
  if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve)) return is_read_back_equal(trimmed->BasisCurve());
  if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve))
    return !spline->IsRational() && !spline->IsPeriodic();
  const auto line = Handle(Geom_Line)::DownCast(curve);
  return line && are_equal(line->Position().Direction(), read(line->Position().Direction()));
}

bool is_read_back_equal(const Handle(Geom2d_Curve) & curve) {
  if (const auto spline = Handle(Geom2d_BSplineCurve)::DownCast(curve))
    return !spline->IsRational() && !spline->IsPeriodic();
  const auto line = Handle(Geom2d_Line)::DownCast(curve);
  if (!line) return false;
  const gp_Dir2d direction = line->Direction(), again(direction.X(), direction.Y());
  return again.X() == direction.X() && again.Y() == direction.Y();
}

bool is_read_back_equal(const Handle(BRep_CurveRepresentation) & use) {
  if (!use->Location().IsIdentity()) return false;
  if (use->IsCurve3D()) return is_read_back_equal(use->Curve3D());
  if (use->IsRegularity()) return use->Location2().IsIdentity();
  if (!use->IsCurveOnSurface()) return false;
  return is_read_back_equal(use->Surface()) && is_read_back_equal(use->PCurve()) &&
         (!use->IsCurveOnClosedSurface() || is_read_back_equal(use->PCurve2()));
}

bool is_read_back_equal(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
  return location.IsIdentity() && is_read_back_equal(surface);
}

bool is_read_back_equal(const TopoDS_Edge& edge) {
  if (!edge.Location().IsIdentity()) return false;
  const auto shape = Handle(BRep_TEdge)::DownCast(edge.TShape());
  for (BRep_ListIteratorOfListOfCurveRepresentation use(shape->Curves()); use.More(); use.Next())
    if (!is_read_back_equal(use.Value())) return false;
  return true;
}

}  // namespace

bool is_read_back_equal(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces, edges;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i)
    if (!is_read_back_equal(TopoDS::Face(faces(i)))) return false;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i)
    if (!is_read_back_equal(TopoDS::Edge(edges(i)))) return false;
  return true;
}

}  // namespace st::occt
