#include "geometry/import/space_curves.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <cmath>

#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

constexpr double kHarmless = 1e-6;  // of the diagonal
constexpr double kWild = 0.05;      // of the edge's extent between its curves: no matter of accuracy any more
constexpr double kAgree = 0.01;     // of that distance, between the trimming curves
constexpr double kFractions[] = {0.31, 0.69};
constexpr int kFewest = 17, kMost = 1025;  // points of a new curve

/// A face's own idea of where an edge is.
struct Track {
  Handle(Geom2d_Curve) pcurve;
  Handle(Geom_Surface) surface;
  double t0 = 0, t1 = 0;
  gp_Pnt at(double fraction) const {
    const gp_Pnt2d uv = pcurve->Value(t0 + (t1 - t0) * fraction);
    return surface->Value(uv.X(), uv.Y());
  }
};

/// Empty when one of them has none.
std::vector<Track> tracks_of(const TopoDS_Edge& edge, const TopTools_ListOfShape& faces) {
  std::vector<Track> tracks;
  for (const TopoDS_Shape& shape : faces) {
    const TopoDS_Face face = TopoDS::Face(shape.Oriented(TopAbs_FORWARD));
    Track track;
    track.surface = BRep_Tool::Surface(face);
    track.pcurve = BRep_Tool::CurveOnSurface(edge, face, track.t0, track.t1);
    if (track.pcurve.IsNull()) return {};
    tracks.push_back(track);
  }
  return tracks;
}

/// How far the space curve is off at least, where it is off everywhere and the faces agree; 0 otherwise.
double distance_off(const TopoDS_Edge& edge, const std::vector<Track>& tracks, double harmless) {
  double t0, t1;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  if (curve.IsNull()) return 0;
  double least = 1e300;
  for (const double s : kFractions) {
    const gp_Pnt p = curve->Value(t0 + (t1 - t0) * s);
    for (const Track& track : tracks) least = std::min(least, p.Distance(track.at(s)));
    if (least <= std::max(10 * harmless, 2 * BRep_Tool::Tolerance(edge))) return 0;
  }
  const gp_Pnt a = tracks[0].at(0), b = tracks[0].at(0.5), c = tracks[0].at(1);
  if (least < kWild * (a.Distance(b) + b.Distance(c))) return 0;
  for (const double s : kFractions)
    for (const Track& track : tracks)
      if (track.at(s).Distance(tracks[0].at(s)) > std::max(harmless, kAgree * least)) return 0;
  return least;
}

Handle(Geom_BSplineCurve) curve_through(const Track& track, double t0, double t1, int n) {
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, n);
  const Handle(TColStd_HArray1OfReal) parameters = new TColStd_HArray1OfReal(1, n);
  for (int k = 0; k < n; ++k) {
    const double s = static_cast<double>(k) / (n - 1);
    points->SetValue(k + 1, track.at(s));
    parameters->SetValue(k + 1, t0 + (t1 - t0) * s);
  }
  GeomAPI_Interpolate interpolate(points, parameters, false, Precision::Confusion());
  interpolate.Perform();
  return interpolate.IsDone() ? interpolate.Curve() : Handle(Geom_BSplineCurve)();
}

double gap_between(const Handle(Geom_Curve) & curve, const std::vector<Track>& tracks, double t0, double t1, int n) {
  double gap = 0;
  for (int k = 0; k < n; ++k) {
    const double s = (k + 0.5) / n;
    const gp_Pnt p = curve->Value(t0 + (t1 - t0) * s);
    for (const Track& track : tracks) gap = std::max(gap, p.Distance(track.at(s)));
  }
  return gap;
}

bool ends_at_vertices(const TopoDS_Edge& edge, const Track& track, double tolerance) {
  const TopoDS_Vertex first = TopExp::FirstVertex(edge), last = TopExp::LastVertex(edge);
  return !first.IsNull() && !last.IsNull() &&
         BRep_Tool::Pnt(first).Distance(track.at(0)) <= std::max(tolerance, BRep_Tool::Tolerance(first)) &&
         BRep_Tool::Pnt(last).Distance(track.at(1)) <= std::max(tolerance, BRep_Tool::Tolerance(last));
}

/// False when no curve fits.
bool rebuild(const TopoDS_Edge& edge, const std::vector<Track>& tracks, double harmless) {
  double t0, t1;
  BRep_Tool::Range(edge, t0, t1);
  for (int n = kFewest; n <= kMost; n = 4 * n - 3) {
    const Handle(Geom_BSplineCurve) curve = curve_through(tracks[0], t0, t1, n);
    if (curve.IsNull()) return false;
    const double gap = gap_between(curve, tracks, t0, t1, 2 * n);
    if (gap > harmless && 4 * n - 3 <= kMost) continue;
    BRep_Builder().UpdateEdge(edge, curve, std::max(1.01 * gap, Precision::Confusion()));
    BRep_Builder().Range(edge, t0, t1);
    return true;
  }
  return false;
}

}  // namespace

void rebuild_space_curves(ImportedShape& model, std::vector<ImportFinding>& findings) {
  TopTools_IndexedDataMapOfShapeListOfShape edge_faces;
  TopExp::MapShapesAndAncestors(model.shape, TopAbs_EDGE, TopAbs_FACE, edge_faces);
  const double harmless = kHarmless * rough_box(model.shape).diagonal();
  for (int i = 1; i <= edge_faces.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edge_faces.FindKey(i).Oriented(TopAbs_FORWARD));
    if (BRep_Tool::Degenerated(edge) || edge_faces(i).Extent() < 2) continue;
    try {
      const std::vector<Track> tracks = tracks_of(edge, edge_faces(i));
      const double off = tracks.empty() ? 0 : distance_off(edge, tracks, harmless);
      if (off == 0 || !ends_at_vertices(edge, tracks[0], 10 * harmless)) continue;
      if (rebuild(edge, tracks, harmless))
        findings.push_back({FindingKind::kSpaceCurve, "edge " + std::to_string(i), vec(tracks[0].at(0.5)), off, true});
    } catch (const Standard_Failure&) {  // stays as it is
    }
  }
}

}  // namespace st::occt
