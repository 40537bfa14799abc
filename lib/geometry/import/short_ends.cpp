#include "geometry/import/short_ends.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Plane.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Pln.hxx>
#include <optional>
#include <string>
#include <vector>

#include "geometry/brep/shape_queries.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr double kNear = 0.1;     // of the gap: what is left of it on the curve and on all faces
constexpr double kLongest = 0.5;  // of the edge: gap

using Range = std::array<double, 2>;  // parameters

/// Where the curve comes to the vertex beyond its end; nothing where it does not. `outward`: 1 or -1.
std::optional<double> parameter_at(const Handle(Geom_Curve) & curve, double end, double outward, const gp_Pnt& vertex,
                                   double gap) {
  constexpr int kSteps = 8;
  double t = end;
  for (int i = 0; i < kSteps; ++i) {
    gp_Pnt x;
    gp_Vec d;
    curve->D1(t, x, d);
    if (!(d.SquareMagnitude() > 0)) return std::nullopt;
    t += gp_Vec(x, vertex).Dot(d) / d.SquareMagnitude();
    if (!(t >= curve->FirstParameter() && t <= curve->LastParameter())) return std::nullopt;
  }
  if ((t - end) * outward <= 0 || curve->Value(t).Distance(vertex) > kNear * gap) return std::nullopt;
  return t;
}

/// A trimming curve of an edge.
struct Trimming {
  Handle(Geom2d_Curve) pcurve;
  Handle(Geom_Surface) surface;
  TopLoc_Location where;
};

bool covers(const Trimming& own, const Range& range) {
  return own.pcurve->FirstParameter() <= range[0] && own.pcurve->LastParameter() >= range[1];
}

/// Of the longer edge; nothing where one cannot go on. Curves in planes are made again.
std::optional<std::vector<Trimming>> trimmings_over(const TopoDS_Edge& edge, const Range& range) {
  std::vector<Trimming> all;
  for (int k = 1;; ++k) {
    Trimming own;
    double t0 = 0, t1 = 0;
    BRep_Tool::CurveOnSurface(edge, own.pcurve, own.surface, own.where, t0, t1, k);
    if (own.pcurve.IsNull()) return all;
    if (!covers(own, range)) {
      const Handle(Geom_Plane) plane = Handle(Geom_Plane)::DownCast(own.surface);
      if (plane.IsNull()) return std::nullopt;
      const Handle(Geom_Curve) curve = new Geom_TrimmedCurve(BRep_Tool::Curve(edge, t0, t1), range[0], range[1]);
      const auto in_plane = Handle(Geom_Curve)::DownCast(curve->Transformed(own.where.Transformation().Inverted()));
      own.pcurve = GeomAPI::To2d(in_plane, plane->Pln());
      if (own.pcurve.IsNull() || !covers(own, range)) return std::nullopt;
    }
    all.push_back(own);
  }
}

class EndExtender {
 public:
  EndExtender(const TopoDS_Shape& shape, std::vector<ImportFinding>& findings) : shape_(shape), findings_(findings) {
    TopExp::MapShapes(shape, TopAbs_EDGE, edges_);
  }

  void run() {
    for (int i = 1; i <= edges_.Extent(); ++i) {
      const TopoDS_Edge edge = TopoDS::Edge(edges_(i).Oriented(TopAbs_FORWARD));
      if (BRep_Tool::Degenerated(edge) || !BRep_Tool::SameRange(edge) || BRep_Tool::IsClosed(edge)) continue;
      try {
        for (const bool is_last : {false, true}) extend(edge, is_last, i);
      } catch (const Standard_Failure&) {  // stays as it is
      }
    }
  }

 private:
  bool is_harmless(double gap) {
    if (gap <= 10 * Precision::Confusion()) return true;
    if (!least_) least_ = 10 * kHarmless * rough_box(shape_).diagonal();
    return gap <= *least_;
  }

  void extend(const TopoDS_Edge& edge, bool is_last, int number) {
    Range range{};
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, range[0], range[1]);
    const TopoDS_Vertex vertex = is_last ? TopExp::LastVertex(edge) : TopExp::FirstVertex(edge);
    if (curve.IsNull() || vertex.IsNull()) return;
    const gp_Pnt goal = BRep_Tool::Pnt(vertex);
    double& end = range[is_last ? 1 : 0];
    const double gap = curve->Value(end).Distance(goal);
    if (is_harmless(gap) || gap > kLongest * curve->Value(range[0]).Distance(curve->Value(range[1]))) return;
    const std::optional<double> t = parameter_at(curve, end, is_last ? 1 : -1, goal, gap);
    if (!t) return;
    end = *t;
    const auto trimmings = trimmings_over(edge, range);
    if (!trimmings) return;
    for (const Trimming& own : *trimmings) {
      const gp_Pnt2d uv = own.pcurve->Value(end);
      if (own.surface->Value(uv.X(), uv.Y()).Transformed(own.where).Distance(goal) > kNear * gap) return;
    }
    BRep_Builder builder;
    for (const Trimming& own : *trimmings)
      builder.UpdateEdge(edge, own.pcurve, own.surface, own.where, BRep_Tool::Tolerance(edge));
    builder.Range(edge, range[0], range[1]);
    findings_.push_back({FindingKind::kOther, "edge " + std::to_string(number), vec(goal), gap, true,
                         "edge that stopped short of its vertex, extended to it"});
  }

  const TopoDS_Shape& shape_;
  std::vector<ImportFinding>& findings_;
  TopTools_IndexedMapOfShape edges_;
  std::optional<double> least_;  // gap, unit of the file; once needed
};

}  // namespace

void extend_short_ends(ImportedShape& model, std::vector<ImportFinding>& findings) {
  EndExtender(model.shape, findings).run();
}

}  // namespace st::occt
