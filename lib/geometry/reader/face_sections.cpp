// Where two faces meet although they share nothing there, by OpenCASCADE's section of both: a module.
#include "geometry/model/face_sections.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Section.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>

#include "geometry/brep/compound.h"
#include "geometry/brep/edge_tolerance.h"

namespace st {
namespace {

constexpr int kSamples = 33;
constexpr double kTangent = 0.9998;  // cosine of 1 degree: the faces touch, they do not cross

/// Edges and vertices as one shape to measure distances to; null when there is none.
TopoDS_Shape as_one(const std::vector<TopoDS_Shape>& shapes) {
  return shapes.empty() ? TopoDS_Shape() : occt::compound_of(shapes);
}

std::vector<TopoDS_Shape> subshapes(const TopoDS_Shape& face, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(face, type, map);
  std::vector<TopoDS_Shape> result;
  for (int i = 1; i <= map.Extent(); ++i)
    if (type != TopAbs_EDGE || !BRep_Tool::Degenerated(TopoDS::Edge(map(i)))) result.push_back(map(i));
  return result;
}

/// What both faces have: edges and vertices.
TopoDS_Shape shared_by(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  std::vector<TopoDS_Shape> shared;
  for (const TopAbs_ShapeEnum type : {TopAbs_EDGE, TopAbs_VERTEX})
    for (const TopoDS_Shape& s : subshapes(a, type))
      for (const TopoDS_Shape& t : subshapes(b, type))
        if (s.IsSame(t)) shared.push_back(s);
  return as_one(shared);
}

double distance_to(const TopoDS_Shape& shape, const gp_Pnt& p) {
  if (shape.IsNull()) return 1e300;
  const BRepExtrema_DistShapeShape d(BRepBuilderAPI_MakeVertex(p).Vertex(), shape);
  return d.IsDone() ? d.Value() : 1e300;
}

gp_Vec normal_at(const TopoDS_Face& face, const gp_Pnt& p) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  GeomAPI_ProjectPointOnSurf foot(p, surface);
  if (foot.NbPoints() == 0) return {};
  double u, v;
  foot.LowerDistanceParameters(u, v);
  GeomLProp_SLProps properties(surface, u, v, 1, 1e-12);
  return properties.IsNormalDefined() ? gp_Vec(properties.Normal()) : gp_Vec();
}

/// Both faces go on beyond the curve, and not the same way.
bool passes_through(const TopoDS_Face& a, const TopoDS_Face& b, const gp_Pnt& p, double tolerance) {
  for (const TopoDS_Face& face : {a, b})
    if (distance_to(as_one(subshapes(face, TopAbs_EDGE)), p) <= tolerance) return false;
  return std::abs(normal_at(a, p).Dot(normal_at(b, p))) < kTangent;
}

/// The pieces of a section curve that keep away from what the faces share, each up to the sample where it comes near.
void add_pieces(const TopoDS_Edge& edge, const TopoDS_Shape& shared, double tolerance, bool passes_through,
                std::vector<FaceContact>& result) {
  const BRepAdaptor_Curve curve(edge);
  const double t0 = curve.FirstParameter(), t1 = curve.LastParameter();
  std::vector<Vec3> points;
  std::vector<char> is_away;
  for (int k = 0; k < kSamples; ++k) {
    const gp_Pnt p = curve.Value(t0 + (t1 - t0) * k / (kSamples - 1));
    points.push_back(Vec3{p.X(), p.Y(), p.Z()});
    is_away.push_back(distance_to(shared, p) > tolerance);
  }
  for (int first = 0; first < kSamples; ++first) {
    if (!is_away[first]) continue;
    int last = first;
    while (last + 1 < kSamples && is_away[last + 1]) ++last;
    result.push_back(
        {{points.begin() + std::max(0, first - 1), points.begin() + std::min(kSamples, last + 2)}, passes_through});
    first = last;
  }
}

std::vector<FaceContact> find_contacts(const TopoDS_Face& a, const TopoDS_Face& b, double least) {
  const double tolerance = std::max({least, occt::max_edge_tolerance(a), occt::max_edge_tolerance(b)});
  std::vector<FaceContact> result;
  try {
    BRepAlgoAPI_Section section(a, b, false);
    section.Approximation(false);
    section.ComputePCurveOn1(true);
    section.ComputePCurveOn2(true);
    section.Build();
    if (!section.IsDone()) return {};
    const TopoDS_Shape shared = shared_by(a, b);
    for (TopExp_Explorer e(section.Shape(), TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      const BRepAdaptor_Curve curve(edge);
      const gp_Pnt middle = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
      add_pieces(edge, shared, tolerance, passes_through(a, b, middle, tolerance), result);
    }
    for (TopExp_Explorer v(section.Shape(), TopAbs_VERTEX, TopAbs_EDGE); v.More(); v.Next())
      if (const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(v.Current())); distance_to(shared, p) > tolerance)
        result.push_back({{Vec3{p.X(), p.Y(), p.Z()}}, false});
  } catch (const Standard_Failure&) {
    return {};
  }
  return result;
}

}  // namespace

extern "C" void st_find_face_sections(const TopoDS_Face& a, const TopoDS_Face& b, double tolerance,
                                      std::vector<FaceContact>& found) {
  const std::vector<FaceContact> own = find_contacts(a, b, tolerance);
  found.insert(found.end(), own.begin(), own.end());
}

}  // namespace st
