#include "geometry/import/loop_joins.h"

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/vec.h"
#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

constexpr double kMeets = 1e-3;  // of a period

/// An edge as its loop runs, with its ends in (u,v).
struct Piece {
  TopoDS_Edge edge;
  Vec2 start, end;
  Vec2 shift;  ///< whole periods, from the first piece on
};

Vec2 period_of(const TopoDS_Face& face) {
  const GeomAdaptor_Surface surface(BRep_Tool::Surface(face));
  return {surface.IsUPeriodic() ? surface.UPeriod() : 0.0, surface.IsVPeriodic() ? surface.VPeriod() : 0.0};
}

/// The edges from head to tail; empty where they are no ring, one has no trimming curve or one is a seam.
std::vector<Piece> pieces_of(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  std::vector<Piece> pieces;
  std::size_t n_edges = 0;
  for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next()) n_edges += !is_constraint(e.Current());
  for (BRepTools_WireExplorer walk(wire); walk.More(); walk.Next()) {
    const TopoDS_Edge& edge = walk.Current();
    if (is_constraint(edge)) continue;
    double t0, t1;
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    if (pcurve.IsNull() || BRep_Tool::IsClosed(edge, face)) return {};
    const gp_Pnt2d first = pcurve->Value(t0), last = pcurve->Value(t1);
    Piece piece{edge, {first.X(), first.Y()}, {last.X(), last.Y()}, {0, 0}};
    if (edge.Orientation() == TopAbs_REVERSED) std::swap(piece.start, piece.end);
    pieces.push_back(piece);
  }
  return pieces.size() == n_edges ? pieces : std::vector<Piece>();
}

double whole_periods(double length, double period) { return period > 0 ? period * std::round(length / period) : 0.0; }

bool meets(Vec2 gap, Vec2 period) {
  const auto is_small = [](double x, double of) { return of == 0 || std::abs(x) < kMeets * of; };
  return is_small(gap.x, period.x) && is_small(gap.y, period.y);
}

/// Finds the shifts, those of the fewest edges. False where no edge needs one, or the loop is not closed with them.
bool find_shifts(std::vector<Piece>& pieces, Vec2 period) {
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const Vec2 gap = pieces[k - 1].end + pieces[k - 1].shift - pieces[k].start;
    pieces[k].shift = {whole_periods(gap.x, period.x), whole_periods(gap.y, period.y)};
    if (!meets(gap - pieces[k].shift, period)) return false;
  }
  if (!meets(pieces.back().end + pieces.back().shift - pieces.front().start, period)) return false;
  const auto n_with = [&](Vec2 shift) {
    return std::count_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return meets(p.shift - shift, period); });
  };
  const Vec2 most = std::max_element(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
                      return n_with(a.shift) < n_with(b.shift);
                    })->shift;
  for (Piece& p : pieces) p.shift = p.shift - most;
  return n_with({0, 0}) < static_cast<std::ptrdiff_t>(pieces.size());
}

void move(const Piece& piece, const TopoDS_Face& face) {
  const TopoDS_Edge edge = TopoDS::Edge(piece.edge.Oriented(TopAbs_FORWARD));
  double t0, t1;
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  const gp_Vec2d shift(piece.shift.x, piece.shift.y);
  const BRep_Builder builder;
  builder.UpdateEdge(edge, Handle(Geom2d_Curve)::DownCast(pcurve->Translated(shift)), face, BRep_Tool::Tolerance(edge));
  builder.Range(edge, face, t0, t1);
}

/// Returns the number of edges moved.
int join(const TopoDS_Wire& wire, const TopoDS_Face& face, Vec2 period) {
  std::vector<Piece> pieces = pieces_of(wire, face);
  if (pieces.size() < 2 || !find_shifts(pieces, period)) return 0;
  int n = 0;
  for (const Piece& piece : pieces) {
    if (meets(piece.shift, period)) continue;
    move(piece, face);
    ++n;
  }
  return n;
}

}  // namespace

void join_loops(ImportedShape& model, std::vector<ImportFinding>& findings) {
  TopTools_MapOfShape seen;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    const TopoDS_Face face = TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD));
    const Vec2 period = period_of(face);
    if ((period.x == 0 && period.y == 0) || !seen.Add(face.Located({}))) continue;
    int n = 0;
    for (TopoDS_Iterator w(face); w.More(); w.Next())
      if (w.Value().ShapeType() == TopAbs_WIRE) n += join(TopoDS::Wire(w.Value()), face, period);
    if (n == 0) continue;
    const Box3 box = rough_box(face);
    findings.push_back({FindingKind::kMovedLoop, "face " + std::to_string(i), box.center(), box.diagonal(), true,
                        "whole periods: " + std::to_string(n) + (n > 1 ? " edges" : " edge")});
  }
}

}  // namespace st::occt
