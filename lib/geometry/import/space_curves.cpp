#include "geometry/import/space_curves.h"

#include <Adaptor3d_CurveOnSurface.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomLib.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Line.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <cmath>
#include <memory>
#include <string>

#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/uv_box.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr double kWild = 0.05;   // of the edge's extent between its curves: no matter of accuracy any more
constexpr double kAgree = 0.01;  // of that distance, between the trimming curves
constexpr double kFractions[] = {0.31, 0.69};
constexpr int kFewest = 17, kMost = 1025;  // points of a new curve

/// A face's own idea of where an edge is.
struct Track {
  TopoDS_Face face;  ///< forward
  Handle(Geom2d_Curve) pcurve;
  Handle(Geom_Surface) surface;
  double t0 = 0, t1 = 0;
  gp_Pnt at(double fraction) const {
    const gp_Pnt2d uv = pcurve->Value(t0 + (t1 - t0) * fraction);
    return surface->Value(uv.X(), uv.Y());
  }
};

Track track_of(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  Track track;
  track.face = face;
  track.surface = BRep_Tool::Surface(face);
  track.pcurve = BRep_Tool::CurveOnSurface(edge, face, track.t0, track.t1);
  return track;
}

/// Empty when one of them has none.
std::vector<Track> tracks_of(const TopoDS_Edge& edge, const TopTools_ListOfShape& faces) {
  std::vector<Track> tracks;
  for (const TopoDS_Shape& shape : faces) {
    const TopoDS_Face face = TopoDS::Face(shape.Oriented(TopAbs_FORWARD));
    const Track track = track_of(edge, face);
    if (track.pcurve.IsNull()) return {};
    tracks.push_back(track);
  }
  return tracks;
}

/// How far a track reaches from its start.
double extent_of(const Track& track) {
  double extent = 0;
  for (int k = 1; k < kFewest; ++k)
    extent = std::max(extent, track.at(0).Distance(track.at(static_cast<double>(k) / (kFewest - 1))));
  return extent;
}

double distance_at_equal_parameters(const Track& a, const Track& b) {
  double distance = 0;
  for (int k = 0; k < kFewest; ++k) {
    const double s = static_cast<double>(k) / (kFewest - 1);
    distance = std::max(distance, a.at(s).Distance(b.at(s)));
  }
  return distance;
}

/// Whether the tracks lie at one place, to within a share of a distance.
bool agree(const std::vector<Track>& tracks, double within) {
  for (const Track& track : tracks)
    if (distance_at_equal_parameters(track, tracks[0]) > within) return false;
  return true;
}

/// How far the space curve is off somewhere, where that is far, the faces agree everywhere, and it is off their
/// surfaces; 0 otherwise.
double local_distance_off(const Handle(Geom_Curve) & curve, double t0, double t1, const std::vector<Track>& tracks,
                          double harmless) {
  double largest = 0, at = 0;
  for (int k = 1; k < kFewest; ++k) {
    const double s = static_cast<double>(k) / kFewest, d = curve->Value(t0 + (t1 - t0) * s).Distance(tracks[0].at(s));
    if (d > largest) largest = d, at = s;
  }
  if (largest < kWild * extent_of(tracks[0]) || !agree(tracks, std::max(harmless, kAgree * largest))) return 0;
  const Vec3 p = vec(curve->Value(t0 + (t1 - t0) * at));
  return closest_point(*make_surface(tracks[0].surface, uv_box(tracks[0].face)), p).distance > 0.1 * largest ? largest
                                                                                                             : 0;
}

/// How far the space curve is off at least, where it is off everywhere and the faces agree; else how far it is off
/// somewhere, see above; 0: it is where it should be.
double distance_off(const TopoDS_Edge& edge, const std::vector<Track>& tracks, double harmless) {
  double t0, t1;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  if (curve.IsNull()) return 0;
  double least = 1e300, most = 0;
  for (const double s : kFractions) {
    const gp_Pnt p = curve->Value(t0 + (t1 - t0) * s);
    for (const Track& track : tracks) {
      const double d = p.Distance(track.at(s));
      least = std::min(least, d);
      most = std::max(most, d);
    }
  }
  const double near = std::max(10 * harmless, 2 * BRep_Tool::Tolerance(edge));
  if (most <= near) return 0;
  const gp_Pnt a = tracks[0].at(0), b = tracks[0].at(0.5), c = tracks[0].at(1);
  bool is_off = least > near && least >= kWild * (a.Distance(b) + b.Distance(c));
  for (const double s : kFractions)
    for (const Track& track : tracks)
      is_off &= track.at(s).Distance(tracks[0].at(s)) <= std::max(harmless, kAgree * least);
  return is_off ? least : local_distance_off(curve, t0, t1, tracks, harmless);
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

/// Those that the edge has, both sides of a seam among them.
std::vector<Track> known_tracks(const TopoDS_Edge& edge, const TopTools_ListOfShape& faces) {
  std::vector<Track> tracks;
  TopTools_IndexedMapOfShape seen;
  for (const TopoDS_Shape& shape : faces) {
    const TopoDS_Face face = TopoDS::Face(shape.Oriented(TopAbs_FORWARD));
    if (seen.Contains(face)) continue;
    seen.Add(face);
    for (const auto side : {TopAbs_FORWARD, TopAbs_REVERSED}) {
      if (side == TopAbs_REVERSED && !BRep_Tool::IsClosed(edge, face)) continue;
      const Track track = track_of(TopoDS::Edge(edge.Oriented(side)), face);
      if (!track.pcurve.IsNull()) tracks.push_back(track);
    }
  }
  return tracks;
}

/// How far a track leaves the surfaces of the others, where these are trimmed.
double distance_to_others(const Track& track, const std::vector<Track>& tracks, double harmless) {
  double distance = 0;
  for (const Track& other : tracks) {
    if (other.face.IsSame(track.face) || distance_at_equal_parameters(track, other) <= harmless) continue;
    const std::unique_ptr<Surface> surface = make_surface(other.surface, uv_box(other.face));
    for (int k = 0; k < kFewest; ++k)
      distance =
          std::max(distance, closest_point(*surface, vec(track.at(static_cast<double>(k) / (kFewest - 1)))).distance);
  }
  return distance;
}

/// The track to make the edge of: one that ends at its vertices, and lies best on the other faces.
const Track& best_track(const TopoDS_Edge& edge, const std::vector<Track>& tracks, double harmless) {
  const Track* best = nullptr;
  double least = 0;
  for (const Track& track : tracks) {
    const double off = distance_to_others(track, tracks, harmless);
    const double score = ends_at_vertices(edge, track, 10 * harmless) ? off : 1e100 + off;
    if (best && score >= least) continue;
    best = &track;
    least = score;
  }
  return *best;
}

/// Exact on planes and along isolines, else approximated within `tolerance`; null when neither can be.
Handle(Geom_Curve) curve_of(const Track& track, double tolerance) {
  constexpr int kMaxDegree = 14, kMaxSegments = 64;  // BRepLib's degree, more of its segments
  const Handle(Geom2dAdaptor_Curve) pcurve = new Geom2dAdaptor_Curve(track.pcurve, track.t0, track.t1);
  const Handle(GeomAdaptor_Surface) surface = new GeomAdaptor_Surface(track.surface);
  Adaptor3d_CurveOnSurface on_surface(pcurve, surface);
  Handle(Geom_Curve) curve;
  double largest = 0, mean = 0;
  try {
    GeomLib::BuildCurve3d(tolerance, on_surface, track.t0, track.t1, curve, largest, mean, GeomAbs_C1, kMaxDegree,
                          kMaxSegments);
    if (!curve.IsNull() && gap_between(curve, {track}, track.t0, track.t1, 4 * kFewest) <= tolerance) return curve;
  } catch (const Standard_Failure&) {  // points do
  }
  for (int n = kFewest; n <= kMost; n = 4 * n - 3) {
    curve = curve_through(track, track.t0, track.t1, n);
    if (curve.IsNull() || gap_between(curve, {track}, track.t0, track.t1, 2 * n) <= tolerance) break;
  }
  return curve;
}

/// False when no curve can be made.
bool make_curve_of(const TopoDS_Edge& edge, const std::vector<Track>& tracks, double harmless) {
  const Track& track = best_track(edge, tracks, harmless);
  const Handle(Geom_Curve) curve = curve_of(track, harmless);
  if (curve.IsNull()) return false;
  BRep_Builder builder;
  builder.UpdateEdge(edge, curve, BRep_Tool::Tolerance(edge));
  builder.Range(edge, track.t0, track.t1, true);
  for (const Track& other : tracks) {
    if (other.t0 != track.t0 || other.t1 != track.t1) builder.SameRange(edge, false);
    if (distance_at_equal_parameters(track, other) > std::max(harmless, BRep_Tool::Tolerance(edge)))
      builder.SameParameter(edge, false);
  }
  if (!BRep_Tool::SameRange(edge)) builder.SameParameter(edge, false);
  return true;
}

/// Between planes an edge is straight, if it is between two vertices.
bool make_straight(const TopoDS_Edge& edge, const TopTools_ListOfShape& faces) {
  const TopoDS_Vertex first = TopExp::FirstVertex(edge), last = TopExp::LastVertex(edge);
  if (first.IsNull() || last.IsNull()) return false;
  const gp_Pnt a = BRep_Tool::Pnt(first), b = BRep_Tool::Pnt(last);
  bool is_between_planes = faces.Extent() > 1 && a.Distance(b) > Precision::Confusion();
  for (const TopoDS_Shape& face : faces)
    is_between_planes &= surface_type(BRep_Tool::Surface(TopoDS::Face(face))) == SurfaceType::kPlane;
  if (!is_between_planes) return false;
  const Handle(Geom_Curve) line = new Geom_Line(a, gp_Vec(a, b));
  BRep_Builder().UpdateEdge(edge, line, BRep_Tool::Tolerance(edge));
  BRep_Builder().Range(edge, 0, a.Distance(b));
  return true;
}

/// What was done to an edge without a space curve; empty: it is a pole, rightly. `is_made` is false when nothing helps.
std::string mend(const TopoDS_Edge& edge, const TopTools_ListOfShape& faces, double harmless, bool& is_made) {
  const std::vector<Track> tracks = known_tracks(edge, faces);
  double extent = 0;
  for (const Track& track : tracks) extent = std::max(extent, extent_of(track));
  const TopoDS_Vertex first = TopExp::FirstVertex(edge), last = TopExp::LastVertex(edge);
  const bool is_ring = first.IsNull() || first.IsSame(last);
  if (BRep_Tool::Degenerated(edge)) {
    if (is_ring || tracks.empty() || extent <= 10 * harmless || !ends_at_vertices(edge, tracks[0], 10 * harmless))
      return {};
    BRep_Builder().Degenerated(edge, false);
  } else if (is_ring && !tracks.empty() && extent <= std::max(harmless, BRep_Tool::Tolerance(edge))) {
    BRep_Builder().Degenerated(edge, true);
    return "one point of its face, marked as a pole";
  }
  if (!tracks.empty() && make_curve_of(edge, tracks, harmless)) return "made from its trimming curve";
  if (tracks.empty() && make_straight(edge, faces)) return "made straight between two planes";
  is_made = false;
  return "none can be made from its trimming curves";
}

}  // namespace

void make_space_curves(ImportedShape& model, std::vector<ImportFinding>& findings) {
  TopTools_IndexedDataMapOfShapeListOfShape edge_faces;
  TopExp::MapShapesAndAncestors(model.shape, TopAbs_EDGE, TopAbs_FACE, edge_faces);
  double harmless = 0;
  for (int i = 1; i <= edge_faces.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edge_faces.FindKey(i).Oriented(TopAbs_FORWARD));
    TopLoc_Location where;
    double t0, t1;
    if (edge_faces(i).IsEmpty() || !BRep_Tool::Curve(edge, where, t0, t1).IsNull()) continue;
    if (harmless == 0) harmless = std::max(kHarmless * model.box().diagonal(), Precision::Confusion());
    bool is_made = true;
    const std::string what = mend(edge, edge_faces(i), harmless, is_made);
    const TopoDS_Vertex vertex = TopExp::FirstVertex(edge);
    if (!what.empty())
      findings.push_back({FindingKind::kNoSpaceCurve, "edge " + std::to_string(i),
                          vertex.IsNull() ? Vec3{} : vec(BRep_Tool::Pnt(vertex)), 0, is_made, what});
  }
}

void rebuild_space_curves(ImportedShape& model, std::vector<ImportFinding>& findings) {
  TopTools_IndexedDataMapOfShapeListOfShape edge_faces;
  TopExp::MapShapesAndAncestors(model.shape, TopAbs_EDGE, TopAbs_FACE, edge_faces);
  const double harmless = kHarmless * model.box().diagonal();
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
