#include "geometry/import/placed_copy.h"

#include <BRep_Builder.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>

namespace st::occt {
namespace {

/// The trimming curve that is stored: planes compute one where there is none.
Handle(Geom2d_Curve) stored_curve(const TopoDS_Shape& edge, const TopoDS_Face& face, double& t0, double& t1) {
  Standard_Boolean is_stored = false;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge), face, t0, t1, &is_stored);
  return is_stored ? curve : Handle(Geom2d_Curve)();
}

void copy_trimming_curve(const TopoDS_Edge& from, const TopoDS_Face& from_face, const TopoDS_Edge& to,
                         const TopoDS_Face& to_face) {
  double t0, t1;
  const Handle(Geom2d_Curve) curve = stored_curve(from, from_face, t0, t1);
  if (curve.IsNull()) return;
  BRep_Builder builder;
  const double tolerance = BRep_Tool::Tolerance(from);
  if (BRep_Tool::IsClosed(from, from_face)) {
    double other_t0, other_t1;
    builder.UpdateEdge(to, curve, stored_curve(from.Reversed(), from_face, other_t0, other_t1), to_face, tolerance);
  } else {
    builder.UpdateEdge(to, curve, to_face, tolerance);
  }
  builder.Range(to, to_face, t0, t1);
}

}  // namespace

void PlacedCopy::keep(const TopoDS_Shape& shape) {
  const TopoDS_Shape forward = shape.Oriented(TopAbs_FORWARD);
  copies_.Bind(forward, forward);
}

TopoDS_Shape PlacedCopy::of(const TopoDS_Shape& shape) {
  const TopoDS_Shape forward = shape.Oriented(TopAbs_FORWARD);
  if (!copies_.IsBound(forward)) copies_.Bind(forward, make(forward));
  const TopoDS_Shape copy = copies_.Find(forward).Oriented(shape.Orientation());
  return motion_.IsNegative() && shape.ShapeType() == TopAbs_FACE ? copy.Reversed() : copy;
}

TopoDS_Shape PlacedCopy::make(const TopoDS_Shape& shape) {
  if (shape.ShapeType() == TopAbs_EDGE) return make_edge(TopoDS::Edge(shape));
  if (shape.ShapeType() == TopAbs_FACE) return make_face(TopoDS::Face(shape));
  if (shape.ShapeType() == TopAbs_VERTEX) {
    TopoDS_Vertex copy;
    const TopoDS_Vertex vertex = TopoDS::Vertex(shape);
    BRep_Builder().MakeVertex(copy, BRep_Tool::Pnt(vertex).Transformed(motion_), BRep_Tool::Tolerance(vertex));
    return copy;
  }
  TopoDS_Shape copy = shape.EmptyCopied();
  copy.Location({});
  add_children(shape, copy);
  copy.Closed(shape.Closed());
  return copy;
}

void PlacedCopy::add_children(const TopoDS_Shape& from, TopoDS_Shape& to) {
  BRep_Builder builder;
  for (TopoDS_Iterator child(from, false, true); child.More(); child.Next()) builder.Add(to, of(child.Value()));
}

TopoDS_Shape PlacedCopy::make_edge(const TopoDS_Edge& edge) {
  BRep_Builder builder;
  TopoDS_Edge copy;
  builder.MakeEdge(copy);
  double t0, t1;
  Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  if (is_moved() && !curve.IsNull()) curve = Handle(Geom_Curve)::DownCast(curve->Transformed(motion_));
  if (curve.IsNull())
    BRep_Tool::Range(edge, t0, t1), builder.UpdateEdge(copy, BRep_Tool::Tolerance(edge));
  else
    builder.UpdateEdge(copy, curve, BRep_Tool::Tolerance(edge));
  builder.Range(copy, t0, t1);
  builder.Degenerated(copy, BRep_Tool::Degenerated(edge));
  add_children(edge, copy);
  copy.Closed(edge.Closed());
  builder.SameParameter(copy, BRep_Tool::SameParameter(edge));
  builder.SameRange(copy, BRep_Tool::SameRange(edge));
  return copy;
}

TopoDS_Shape PlacedCopy::make_face(const TopoDS_Face& face) {
  BRep_Builder builder;
  TopoDS_Face copy;
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (is_moved()) surface = Handle(Geom_Surface)::DownCast(surface->Transformed(motion_));
  builder.MakeFace(copy, surface, BRep_Tool::Tolerance(face));
  builder.NaturalRestriction(copy, BRep_Tool::NaturalRestriction(face));
  add_children(face, copy);
  TopTools_MapOfShape seen;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    if (!seen.Add(e.Current())) continue;
    const TopoDS_Edge edge = TopoDS::Edge(e.Current().Oriented(TopAbs_FORWARD));
    copy_trimming_curve(edge, face, TopoDS::Edge(of(edge)), copy);
  }
  copy.Closed(face.Closed());
  return copy;
}

}  // namespace st::occt
