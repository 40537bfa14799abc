#include "geometry/import/swapped_seams.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <optional>
#include <utility>
#include <vector>

namespace st::occt {
namespace {

constexpr double kClose = 1e-3;  // of the way from one curve of a seam to the other: ends that follow each other

/// First and last point of an edge in (u,v), in its own direction.
using Ends = std::pair<gp_Pnt2d, gp_Pnt2d>;

std::optional<Ends> ends_of(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  double t0, t1;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (curve.IsNull()) return std::nullopt;
  if (edge.Orientation() == TopAbs_REVERSED) std::swap(t0, t1);
  return Ends{curve->Value(t0), curve->Value(t1)};
}

/// Where an edge passes a seam, by its curve for that direction, and by that for the other one.
struct Passes {
  Ends now, swapped;
  double tolerance = 0;
};

std::optional<Passes> passes_of(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  const std::optional<Ends> now = ends_of(edge, face), back = ends_of(TopoDS::Edge(edge.Reversed()), face);
  if (!now || !back) return std::nullopt;
  return Passes{*now, {back->second, back->first}, kClose * now->first.Distance(back->second)};
}

/// Ends of a seam that lie where another edge of the loop ends or begins, by the curves as they are and swapped.
struct Joined {
  int now = 0, swapped = 0;

  void count(const Passes& passes, const Ends& other) {
    const auto n_close = [&](const Ends& ends) {
      return (other.second.Distance(ends.first) < passes.tolerance) +
             (other.first.Distance(ends.second) < passes.tolerance);
    };
    now += n_close(passes.now);
    swapped += n_close(passes.swapped);
  }
};

void swap_curves(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  const TopoDS_Edge forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
  double t0, t1;
  const Handle(Geom2d_Curve) there = BRep_Tool::CurveOnSurface(forward, face, t0, t1);
  const Handle(Geom2d_Curve) back = BRep_Tool::CurveOnSurface(TopoDS::Edge(forward.Reversed()), face, t0, t1);
  BRep_Builder().UpdateEdge(forward, back, there, face, BRep_Tool::Tolerance(forward));
  BRep_Builder().Range(forward, face, t0, t1);
}

int swap_seams_of(const TopoDS_Face& face, const TopoDS_Wire& wire) {
  std::vector<TopoDS_Edge> seams;  // one by one as the loop passes them
  std::vector<Ends> others;
  for (TopoDS_Iterator e(wire); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Value());
    if (BRep_Tool::Degenerated(edge)) continue;
    if (BRep_Tool::IsClosed(edge, face))
      seams.push_back(edge);
    else if (const std::optional<Ends> ends = ends_of(edge, face))
      others.push_back(*ends);
  }
  TopTools_IndexedMapOfShape edges;
  std::vector<Joined> joined;  // per edge
  for (const TopoDS_Edge& seam : seams) {
    const int k = edges.Add(seam);
    if (static_cast<std::size_t>(k) > joined.size()) joined.emplace_back();
    const std::optional<Passes> passes = passes_of(seam, face);
    for (const Ends& other : others)
      if (passes) joined[k - 1].count(*passes, other);
  }
  int n_swapped = 0;
  for (int k = 1; k <= edges.Extent() && edges.Extent() > 1; ++k) {
    if (joined[k - 1].now > 0 || joined[k - 1].swapped == 0) continue;
    swap_curves(TopoDS::Edge(edges(k)), face);
    ++n_swapped;
  }
  return n_swapped;
}

}  // namespace

int swap_seams(std::span<const TopoDS_Face> faces) {
  int n_swapped = 0;
  for (const TopoDS_Face& face : faces)
    for (TopoDS_Iterator w(face); w.More(); w.Next())
      if (w.Value().ShapeType() == TopAbs_WIRE) n_swapped += swap_seams_of(face, TopoDS::Wire(w.Value()));
  return n_swapped;
}

}  // namespace st::occt
