#include "geometry/import/other_side.h"

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_Curve.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeFix_Edge.hxx>
#include <ShapeFix_Face.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax3.hxx>
#include <optional>
#include <vector>

#include "geometry/import/vertex_loops.h"

namespace st::occt {
namespace {

/// Whether the line of constant v is a point.
bool is_pole(const Handle(Geom_Surface) & surface, double u, double period, double v) {
  constexpr int kStations = 4;
  for (int k = 1; k < kStations; ++k)
    if (surface->Value(u, v).Distance(surface->Value(u + k * period / kStations, v)) > Precision::Confusion())
      return false;
  return true;
}

bool has_no_border(const Handle(Geom_Surface) & surface) {
  if (surface.IsNull() || !surface->IsUPeriodic()) return false;
  if (surface->IsVPeriodic()) return true;
  double u_min, u_max, v_min, v_max;
  surface->Bounds(u_min, u_max, v_min, v_max);
  if (Precision::IsInfinite(v_min) || Precision::IsInfinite(v_max)) return false;
  const auto is_end = [&](double v) { return is_pole(surface, u_min, surface->UPeriod(), v); };
  return is_end(v_min) && is_end(v_max);
}

int poles_on(const TopoDS_Wire& loop) {
  int n = 0;
  for (TopoDS_Iterator e(loop); e.More(); e.Next()) n += BRep_Tool::Degenerated(TopoDS::Edge(e.Value()));
  return n;
}

/// The one loop of a face without a seam. It meets no pole, or both: then it is a meridian there and another one back.
/// Of a ball it may meet one.
std::optional<TopoDS_Wire> plain_loop(const TopoDS_Face& face) {
  std::optional<TopoDS_Wire> loop;
  for (TopoDS_Iterator w(face); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE || loop) return std::nullopt;
    loop = TopoDS::Wire(w.Value());
  }
  if (!loop) return std::nullopt;
  for (TopExp_Explorer e(*loop, TopAbs_EDGE); e.More(); e.Next())
    if (BRep_Tool::IsClosed(TopoDS::Edge(e.Current()), face)) return std::nullopt;
  const int n = poles_on(*loop);
  const bool is_ball = BRep_Tool::Surface(face)->IsKind(STANDARD_TYPE(Geom_SphericalSurface));
  return n == 0 || n == 2 || (n == 1 && is_ball) ? loop : std::nullopt;
}

/// The rest around a loop that meets no pole; its seam is far from that.
TopoDS_Face around_hole(const TopoDS_Face& face, const TopoDS_Wire& loop) {
  TopoDS_Shape rest = face.EmptyCopied();
  BRep_Builder().Add(rest, loop.Reversed());
  ShapeFix_Face fix(TopoDS::Face(rest));
  if (fix.FixAddNaturalBound()) return fix.Face();
  return bound_around_holes(TopoDS::Face(rest)) ? TopoDS::Face(rest) : TopoDS_Face();
}

/// From the middle of a ball to the middle of a loop on it; nullopt where the loop goes around more than a cap.
std::optional<gp_Dir> middle_of(const TopoDS_Wire& loop, const gp_Pnt& middle) {
  constexpr int kStations = 8;
  constexpr double kWidest = 1.3;  // radians: the turned ball's poles and seam are beyond a right angle from the middle
  std::vector<gp_Dir> places;
  gp_XYZ sum(0, 0, 0);
  for (TopoDS_Iterator e(loop); e.More(); e.Next()) {
    double t0, t1;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(e.Value()), t0, t1);
    for (int k = 0; k < kStations && !curve.IsNull(); ++k)
      sum += places.emplace_back(gp_Vec(middle, curve->Value(t0 + (k + 0.5) * (t1 - t0) / kStations))).XYZ();
  }
  if (sum.Modulus() < Precision::Confusion()) return std::nullopt;
  const gp_Dir direction(sum);
  const bool is_cap = std::ranges::all_of(places, [&](const gp_Dir& d) { return d.Angle(direction) < kWidest; });
  return is_cap ? std::optional(direction) : std::nullopt;
}

/// The rest of a ball around a loop that meets a pole, as the same ball with poles and seam far from the loop.
TopoDS_Face around_hole_of_turned_ball(const TopoDS_Face& face, const TopoDS_Wire& loop) {
  const auto ball = Handle(Geom_SphericalSurface)::DownCast(BRep_Tool::Surface(face));
  if (ball.IsNull()) return {};
  const std::optional<gp_Dir> direction = middle_of(loop, ball->Location());
  if (!direction) return {};
  gp_Ax3 axes(ball->Location(), gp_Ax2(ball->Location(), *direction).XDirection(), direction->Reversed());
  if (!ball->Position().Direct()) axes.YReverse();
  TopoDS_Face rest;
  BRep_Builder builder;
  builder.MakeFace(rest, new Geom_SphericalSurface(axes, ball->Radius()), BRep_Tool::Tolerance(face));
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (TopoDS_Iterator e(loop); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Value());
    if (BRep_Tool::Degenerated(edge)) continue;
    if (!ShapeFix_Edge().FixAddPCurve(edge, rest, false)) return {};
    builder.Add(wire, edge);
  }
  wire.Closed(true);
  return around_hole(rest, wire);
}

/// An edge of a loop, in its direction.
struct Use {
  TopoDS_Edge edge;
  Handle(Geom2d_Curve) curve;
  double t0 = 0, t1 = 0;

  gp_Pnt2d begin() const { return curve->Value(edge.Orientation() == TopAbs_REVERSED ? t1 : t0); }
  gp_Pnt2d end() const { return curve->Value(edge.Orientation() == TopAbs_REVERSED ? t0 : t1); }
};
using Chain = std::vector<Use>;  // from one pole to the other

/// What is between the poles of a loop, in its order; empty where that is not one chain there and one back.
std::vector<Chain> chains_of(const TopoDS_Face& face, const TopoDS_Wire& loop) {
  std::vector<Use> uses;
  for (BRepTools_WireExplorer e(loop, face); e.More(); e.Next()) {
    Use& use = uses.emplace_back(Use{e.Current(), {}});
    use.curve = BRep_Tool::CurveOnSurface(use.edge, face, use.t0, use.t1);
    if (use.curve.IsNull()) return {};
  }
  const auto is_pole = [](const Use& use) { return BRep_Tool::Degenerated(use.edge); };
  std::rotate(uses.begin(), std::ranges::find_if(uses, is_pole), uses.end());
  std::vector<Chain> chains;
  for (const Use& use : uses) {
    if (is_pole(use)) chains.emplace_back();
    if (chains.empty()) return {};
    if (!is_pole(use)) chains.back().push_back(use);
  }
  return chains.size() == 2 && !chains[0].empty() && !chains[1].empty() ? chains : std::vector<Chain>();
}

/// Adds a pole to a loop, from one u to another.
void add_pole(TopoDS_Wire& wire, const TopoDS_Face& face, const TopoDS_Vertex& vertex, gp_Pnt2d from, gp_Pnt2d to) {
  BRep_Builder builder;
  TopoDS_Edge pole;
  builder.MakeEdge(pole);
  const Handle(Geom2d_Curve) line = new Geom2d_Line(from, gp_Dir2d(to.X() - from.X(), 0));
  builder.UpdateEdge(pole, line, face, BRep_Tool::Tolerance(vertex));
  builder.Range(pole, 0, std::abs(to.X() - from.X()));
  builder.Add(pole, vertex.Oriented(TopAbs_FORWARD));
  builder.Add(pole, vertex.Oriented(TopAbs_REVERSED));
  builder.Degenerated(pole, true);
  builder.Add(wire, pole);
}

/// The rest beside a loop of two chains between the poles: back along both, the left one a period further.
TopoDS_Face beside_chains(const TopoDS_Face& face, std::vector<Chain> chains) {
  TopLoc_Location location;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
  TopoDS_Face rest;
  BRep_Builder builder;
  builder.MakeFace(rest, Handle(Geom_Surface)::DownCast(surface->Copy()), location, BRep_Tool::Tolerance(face));
  const bool is_first_left = chains[0].front().begin().X() < chains[1].front().end().X();
  for (Use& use : chains[is_first_left ? 0 : 1])
    use.curve = Handle(Geom2d_Curve)::DownCast(use.curve->Translated(gp_Vec2d(surface->UPeriod(), 0)));
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (int c = 0; c < 2; ++c) {
    for (std::size_t i = chains[c].size(); i-- > 0;) {
      const Use& use = chains[c][i];
      builder.UpdateEdge(use.edge, use.curve, rest, BRep_Tool::Tolerance(use.edge));
      builder.Range(use.edge, rest, use.t0, use.t1);
      builder.Add(wire, use.edge.Reversed());
    }
    add_pole(wire, rest, TopExp::FirstVertex(chains[c].front().edge, true), chains[c].front().begin(),
             chains[1 - c].back().end());
  }
  wire.Closed(true);
  builder.Add(rest, wire);
  return rest;
}

}  // namespace

bool may_be_on_either_side(const TopoDS_Face& face) {
  return has_no_border(BRep_Tool::Surface(face)) && plain_loop(face);
}

TopoDS_Face other_side(const TopoDS_Face& face) {
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const std::optional<TopoDS_Wire> loop = plain_loop(forward);
  if (!loop) return {};
  TopoDS_Face rest;
  if (poles_on(*loop) == 0)
    rest = around_hole(forward, *loop);
  else if (poles_on(*loop) == 1)
    rest = around_hole_of_turned_ball(forward, *loop);
  else if (const std::vector<Chain> chains = chains_of(forward, *loop); !chains.empty())
    rest = beside_chains(forward, chains);
  return rest.IsNull() ? rest : TopoDS::Face(rest.Oriented(TopAbs::Reverse(face.Orientation())));
}

}  // namespace st::occt
