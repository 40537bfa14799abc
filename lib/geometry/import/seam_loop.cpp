#include "geometry/import/seam_loop.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace st::occt {
namespace {

constexpr double kClose = 1e-4;  // of a period: ends of edges that follow each other in a loop

/// An edge of a loop in (u,v), in the direction of the loop.
struct LoopEdge {
  TopoDS_Edge edge;
  Handle(Geom2d_Curve) curve;
  double t_min = 0, t_max = 0;
  bool is_seam = false;   ///< or a pole, or the way back of another edge a period away
  bool is_bound = false;  ///< along the bounds of a period
  gp_Vec2d shift = {};    ///< of its curve
  bool is_turned = false;

  gp_Pnt2d point(double share) const {
    const bool is_reversed = (edge.Orientation() == TopAbs_REVERSED) != is_turned;
    return curve->Value(t_min + (is_reversed ? 1 - share : share) * (t_max - t_min)).Translated(shift);
  }
};

/// The periods of a surface, with their seams at the bounds; a direction without has no bounds.
struct Periods {
  double u_min = 0, v_min = 0, u = 0, v = 0;

  explicit Periods(const Geom_Surface& surface) {
    double u_max, v_max;
    surface.Bounds(u_min, u_max, v_min, v_max);
    if (surface.IsUPeriodic()) u = surface.UPeriod();
    if (surface.IsVPeriodic()) v = surface.VPeriod();
  }
  bool is_inside(gp_Pnt2d p) const { return is_inside(p.X() - u_min, u) && is_inside(p.Y() - v_min, v); }
  /// By whole periods, the shift that brings a point inside.
  gp_Vec2d into(gp_Pnt2d p) const { return {-whole(p.X() - u_min, u), -whole(p.Y() - v_min, v)}; }
  /// The shift of what is along one bound to the other.
  gp_Vec2d across(gp_Pnt2d p) const { return {-other(p.X() - u_min, u), -other(p.Y() - v_min, v)}; }
  /// Whether a line between two points passes a third one, a period away.
  bool is_away(gp_Pnt2d p, gp_Pnt2d a, gp_Pnt2d b) const {
    for (const gp_Vec2d shift : {gp_Vec2d(u, 0), gp_Vec2d(-u, 0), gp_Vec2d(0, v), gp_Vec2d(0, -v)}) {
      const gp_Pnt2d moved = p.Translated(shift);
      if (shift.Magnitude() > 0 && moved.Distance(a) + moved.Distance(b) < a.Distance(b) + close()) return true;
    }
    return false;
  }
  double close() const { return kClose * std::max(u, v); }
  /// Whether a line between two points runs along the bounds: so do seams of files whose faces share no edges.
  bool is_along(gp_Pnt2d a, gp_Pnt2d middle, gp_Pnt2d b) const {
    return is_along(a.X() - u_min, middle.X() - u_min, b.X() - u_min, u) ||
           is_along(a.Y() - v_min, middle.Y() - v_min, b.Y() - v_min, v);
  }

 private:
  static bool is_along(double a, double middle, double b, double period) {
    const double bound = period * std::round(middle / period);
    const auto is_on = [&](double x) { return std::abs(x - bound) < kClose * period; };
    return period > 0 && (bound == 0 || bound == period) && is_on(a) && is_on(middle) && is_on(b);
  }
  bool is_inside(double x, double period) const {
    return period == 0 || (x > -kClose * period && x < (1 + kClose) * period);
  }
  static double other(double x, double period) {
    return period == 0 || std::abs(x - period * std::round(x / period)) > kClose * period ? 0
           : x < 0.5 * period                                                             ? -period
                                                                                          : period;
  }
  static double whole(double x, double period) { return period == 0 ? 0 : period * std::floor(x / period); }
};

using Loop = std::vector<LoopEdge>;

std::optional<Loop> loop_of(const TopoDS_Wire& wire, const TopoDS_Face& face, const Periods& periods) {
  Loop loop;
  for (TopoDS_Iterator e(wire); e.More(); e.Next()) {
    LoopEdge& use = loop.emplace_back();
    use.edge = TopoDS::Edge(e.Value());
    use.curve = BRep_Tool::CurveOnSurface(use.edge, face, use.t_min, use.t_max);
    if (use.curve.IsNull()) return std::nullopt;
    use.is_seam = BRep_Tool::IsClosed(use.edge, face) || BRep_Tool::Degenerated(use.edge);
    use.is_bound = periods.is_along(use.point(0), use.point(0.5), use.point(1));
  }
  for (LoopEdge& use : loop)  // others along the bounds are sides of notches that end there
    use.is_seam =
        use.is_seam || (use.is_bound && std::ranges::any_of(loop, [&](const LoopEdge& back) {
                          return back.is_bound && periods.is_away(use.point(0.5), back.point(0), back.point(1));
                        }));
  return loop;
}

bool is_inside(const LoopEdge& e, const Periods& periods) {
  constexpr int kPlaces = 8;
  for (int k = 0; k <= kPlaces; ++k)
    if (!periods.is_inside(e.point(static_cast<double>(k) / kPlaces))) return false;
  return true;
}

bool is_closed(const Loop& loop, double tolerance) {
  return std::ranges::all_of(loop, [&](const LoopEdge& e) {
    return std::ranges::any_of(loop,
                               [&](const LoopEdge& next) { return e.point(1).Distance(next.point(0)) < tolerance; });
  });
}

/// Turns the chains between seams and puts them inside; whether the loop is sound then.
bool turn_chains(Loop& loop, const Periods& periods) {
  const auto seam = std::ranges::find_if(loop, &LoopEdge::is_seam);
  std::rotate(loop.begin(), seam, loop.end());
  for (std::size_t first = 0; first < loop.size();) {
    std::size_t end = first;
    gp_XY middle(0, 0);
    bool is_bound = true;
    for (; end < loop.size() && !loop[end].is_seam; ++end) {
      middle += loop[end].point(0.5).XY();
      is_bound = is_bound && loop[end].is_bound;
    }
    for (std::size_t i = first; i < end; ++i) {
      const gp_XY place = middle / static_cast<double>(end - first);
      loop[i].shift = is_bound ? periods.across(place) : periods.into(place);
      loop[i].is_turned = true;
      if (!is_inside(loop[i], periods)) return false;
    }
    first = std::max(end, first + 1);
  }
  return is_closed(loop, periods.close());
}

/// The edge as it is used in the loop, with its curve on the surface of `face`.
TopoDS_Edge put_on(const TopoDS_Face& face, const TopoDS_Face& old, const LoopEdge& use) {
  const TopoDS_Edge forward = TopoDS::Edge(use.edge.Oriented(TopAbs_FORWARD));
  const double tolerance = BRep_Tool::Tolerance(use.edge);
  double t_min, t_max;
  const auto curve = Handle(Geom2d_Curve)::DownCast(BRep_Tool::CurveOnSurface(forward, old, t_min, t_max)->Copy());
  curve->Translate(use.shift);
  if (BRep_Tool::IsClosed(use.edge, old)) {
    const TopoDS_Edge backward = TopoDS::Edge(use.edge.Oriented(TopAbs_REVERSED));
    const auto other = Handle(Geom2d_Curve)::DownCast(BRep_Tool::CurveOnSurface(backward, old, t_min, t_max)->Copy());
    BRep_Builder().UpdateEdge(forward, curve, other, face, tolerance);
  } else {
    BRep_Builder().UpdateEdge(forward, curve, face, tolerance);
  }
  BRep_Builder().Range(forward, face, t_min, t_max);
  return use.is_turned ? TopoDS::Edge(use.edge.Reversed()) : use.edge;
}

}  // namespace

TopoDS_Face with_chains_turned(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
  if (surface.IsNull() || !(surface->IsUPeriodic() || surface->IsVPeriodic())) return {};
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const Periods periods(*surface);
  std::vector<Loop> loops;
  bool is_any_turned = false;
  for (TopoDS_Iterator w(forward); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) return {};
    std::optional<Loop> loop = loop_of(TopoDS::Wire(w.Value()), forward, periods);
    if (!loop) return {};
    const bool has_seam = std::ranges::any_of(*loop, &LoopEdge::is_seam);
    const auto is_outside = [&](const LoopEdge& e) { return !is_inside(e, periods); };
    if (has_seam && std::ranges::any_of(*loop, is_outside)) {
      if (!turn_chains(*loop, periods)) return {};
      is_any_turned = true;
    }
    loops.push_back(std::move(*loop));
  }
  if (!is_any_turned) return {};
  TopoDS_Face turned;
  BRep_Builder builder;
  builder.MakeFace(turned, Handle(Geom_Surface)::DownCast(surface->Copy()), location, BRep_Tool::Tolerance(face));
  for (const Loop& loop : loops) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (const LoopEdge& use : loop) builder.Add(wire, put_on(turned, forward, use));
    wire.Closed(true);
    builder.Add(turned, wire);
  }
  return TopoDS::Face(turned.Oriented(TopAbs::Reverse(face.Orientation())));
}

}  // namespace st::occt
