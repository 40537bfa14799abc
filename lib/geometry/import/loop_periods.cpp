#include "geometry/import/loop_periods.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Face.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/boxes.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/surface_closing.h"
#include "geometry/shape/loop_polygons.h"

namespace st::occt {
namespace {

constexpr int kSides = 24;         // of each edge: enough to tell inside from outside
constexpr int kManySides = 2048;   // likewise near a bent edge, before a hole is left out
constexpr double kBeyond = 0.01;   // of the surface's range: beyond it by less is rounding
constexpr double kWinding = 0.5;   // of a period: a loop that ends further from its start goes around
constexpr double kMaxPeriods = 8;  // to look for a hole

/// A wire in (u,v), as the face has it.
struct Loop {
  TopoDS_Wire wire;
  std::vector<LoopSide> sides;
  Box2 box;
  Vec2 winding;     ///< from its start to its end: 0 when it is closed
  double area = 0;  ///< signed
};

void add_edge(Loop& loop, const TopoDS_Edge& edge, const TopoDS_Face& face, int n_sides) {
  double t0, t1;
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (pcurve.IsNull()) return;
  const bool is_reversed = edge.Orientation() == TopAbs_REVERSED;
  Vec2 last;
  for (int k = 0; k <= n_sides; ++k) {
    const double s = static_cast<double>(is_reversed ? n_sides - k : k) / n_sides;
    const gp_Pnt2d p = pcurve->Value(t0 + (t1 - t0) * s);
    const Vec2 uv{p.X(), p.Y()};
    loop.box.add(uv);
    if (k > 0) {
      loop.sides.push_back({last, uv});
      loop.winding = loop.winding + (uv - last);
    }
    last = uv;
  }
}

std::vector<Loop> loops_of(const TopoDS_Face& face, int n_sides = kSides) {
  std::vector<Loop> loops;
  for (TopoDS_Iterator w(face); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) continue;
    Loop loop;
    loop.wire = TopoDS::Wire(w.Value());
    for (TopExp_Explorer e(loop.wire, TopAbs_EDGE); e.More(); e.Next())
      if (!is_constraint(e.Current())) add_edge(loop, TopoDS::Edge(e.Current()), face, n_sides);
    if (loop.sides.empty()) continue;
    const Vec2 origin = loop.sides[0].a;  // areas of loops far from (0, 0) are exact enough, too
    for (const LoopSide& s : loop.sides) loop.area += 0.5 * cross(s.a - origin, s.b - origin);
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Corners of the loop that are inside the polygons once it is moved.
std::ptrdiff_t count_inside(const Loop& loop, Vec2 shift, const LoopPolygons& polygons) {
  return std::count_if(loop.sides.begin(), loop.sides.end(),
                       [&](const LoopSide& s) { return polygons.contains(s.a + shift); });
}

/// Whether most of the loop is.
bool is_inside(const Loop& loop, Vec2 shift, const LoopPolygons& polygons) {
  return 2 * count_inside(loop, shift, polygons) > static_cast<std::ptrdiff_t>(loop.sides.size());
}

/// What loops that are no holes enclose.
LoopPolygons outside_of(const std::vector<Loop>& loops) {
  std::vector<LoopSide> sides;
  for (const Loop& loop : loops)
    if (loop.area > 0) sides.insert(sides.end(), loop.sides.begin(), loop.sides.end());
  return LoopPolygons(std::move(sides));
}

/// Whether no point of a hole is inside the face, however bent its edges are.
bool is_stray(const TopoDS_Face& face, const TopoDS_Wire& hole) {
  const std::vector<Loop> loops = loops_of(face, kManySides);
  const LoopPolygons polygons = outside_of(loops);
  return std::all_of(loops.begin(), loops.end(), [&](const Loop& loop) {
    return !loop.wire.IsSame(hole) || (loop.area < 0 && count_inside(loop, {0, 0}, polygons) == 0);
  });
}

/// Numbers of periods that bring [lo, hi] onto [to_lo, to_hi], at least in part.
std::pair<int, int> periods_onto(double lo, double hi, double to_lo, double to_hi, double period) {
  if (period == 0) return {0, 0};
  const double least = std::ceil((to_lo - hi) / period), most = std::floor((to_hi - lo) / period);
  if (!(std::abs(least) < 1e9 && std::abs(most) < 1e9)) return {0, 0};
  const double end = std::min(most, least + kMaxPeriods);
  return {static_cast<int>(least), static_cast<int>(end)};
}

/// The shift that brings a hole inside the outer loops; nullopt: none does.
std::optional<Vec2> shift_into(const Loop& hole, const Loop& outer, const LoopPolygons& polygons,
                               const SurfaceClosing& c) {
  const auto [i0, i1] = periods_onto(hole.box.lo.x, hole.box.hi.x, outer.box.lo.x, outer.box.hi.x, c.period.x);
  const auto [j0, j1] = periods_onto(hole.box.lo.y, hole.box.hi.y, outer.box.lo.y, outer.box.hi.y, c.period.y);
  for (int i = i0; i <= i1; ++i)
    for (int j = j0; j <= j1; ++j)
      if (const Vec2 shift{i * c.period.x, j * c.period.y}; is_inside(hole, shift, polygons)) return shift;
  return std::nullopt;
}

/// Both curves of a seam, or the one of another edge.
void move_edge(const TopoDS_Edge& shape, const TopoDS_Face& face, const gp_Vec2d& shift) {
  const TopoDS_Edge edge = TopoDS::Edge(shape.Oriented(TopAbs_FORWARD));
  double t0, t1;
  const auto moved = [&](const TopoDS_Shape& side) -> Handle(Geom2d_Curve) {
    const Handle(Geom2d_Curve) old = BRep_Tool::CurveOnSurface(TopoDS::Edge(side), face, t0, t1);
    return old.IsNull() ? old : Handle(Geom2d_Curve)::DownCast(old->Translated(shift));
  };
  const Handle(Geom2d_Curve) pcurve = moved(edge);
  if (pcurve.IsNull()) return;
  BRep_Builder builder;
  if (BRep_Tool::IsClosed(edge, face))
    builder.UpdateEdge(edge, pcurve, moved(edge.Reversed()), face, BRep_Tool::Tolerance(edge));
  else
    builder.UpdateEdge(edge, pcurve, face, BRep_Tool::Tolerance(edge));
  builder.Range(edge, face, t0, t1);
}

void move_loop(Loop& loop, const TopoDS_Face& face, Vec2 shift) {
  TopTools_MapOfShape seen;
  for (TopExp_Explorer e(loop.wire, TopAbs_EDGE); e.More(); e.Next())
    if (seen.Add(e.Current())) move_edge(TopoDS::Edge(e.Current()), face, {shift.x, shift.y});
  for (LoopSide& s : loop.sides) s = {s.a + shift, s.b + shift};
  loop.box = {loop.box.lo + shift, loop.box.hi + shift};
}

/// "1 period in u, -2 in v".
std::string words(Vec2 shift, Vec2 period) {
  const auto count = [](double by, double of) { return of == 0 ? 0 : std::lround(by / of); };
  const auto n_u = count(shift.x, period.x), n_v = count(shift.y, period.y);
  std::string text;
  if (n_u != 0) text = std::to_string(n_u) + " in u";
  if (n_v != 0) text += (text.empty() ? "" : ", ") + std::to_string(n_v) + " in v";
  return text;
}

/// A face and what it takes to name it.
struct NamedFace {
  TopoDS_Face face;  ///< forward
  int number = 0;    ///< from 1
};

/// A loop that is left out of its face, or runs around it the wrong way.
struct WrongLoop {
  NamedFace of;
  TopoDS_Wire wire;
  bool is_stray = false;
};

void say(FindingKind kind, const NamedFace& f, const TopoDS_Shape& place, const std::string& detail,
         std::vector<ImportFinding>& findings) {
  const Box3 box = rough_box(place);
  findings.push_back({kind, "face " + std::to_string(f.number), box.center(), box.diagonal(),
                      kind != FindingKind::kStrayHole, detail});
}

/// Brings all loops between the bounds of a surface that has no points beyond them.
void move_face(const NamedFace& f, std::vector<Loop>& loops, const Loop& outer, const SurfaceClosing& c,
               std::vector<ImportFinding>& findings) {
  const auto shift_of = [](double lo, double hi, double from, double to, double period) {
    return period == 0 ? 0.0 : -period * std::floor((0.5 * (lo + hi) - from) / (to - from));
  };
  const Vec2 shift{c.is_u_periodic ? 0 : shift_of(outer.box.lo.x, outer.box.hi.x, c.lo.x, c.hi.x, c.period.x),
                   c.is_v_periodic ? 0 : shift_of(outer.box.lo.y, outer.box.hi.y, c.lo.y, c.hi.y, c.period.y)};
  if (shift.x == 0 && shift.y == 0) return;
  say(FindingKind::kMovedLoop, f, outer.wire, words(shift, c.period), findings);
  for (Loop& loop : loops) move_loop(loop, f.face, shift);
}

/// Holes that are outside in every period are added to `wrong`.
void move_holes(const NamedFace& f, std::vector<Loop>& loops, std::size_t outer, const SurfaceClosing& c,
                std::vector<WrongLoop>& wrong, std::vector<ImportFinding>& findings) {
  const LoopPolygons polygons = outside_of(loops);
  for (Loop& loop : loops) {
    if (loop.area >= 0 || is_inside(loop, {0, 0}, polygons)) continue;
    const std::optional<Vec2> shift = shift_into(loop, loops[outer], polygons, c);
    if (!shift) {
      if (is_stray(f.face, loop.wire)) wrong.push_back({f, loop.wire, true});
      continue;
    }
    say(FindingKind::kMovedLoop, f, loop.wire, words(*shift, c.period), findings);
    move_loop(loop, f.face, *shift);
  }
}

/// Where all of several loops run the same way, those that are holes or no holes against it are turned, as
/// make_domain() reads them.
void turn_loops(const NamedFace& f, std::vector<Loop>& loops, std::vector<WrongLoop>& wrong) {
  const auto n_positive = std::count_if(loops.begin(), loops.end(), [](const Loop& l) { return l.area > 0; });
  if (loops.size() < 2 || (n_positive != 0 && n_positive != static_cast<std::ptrdiff_t>(loops.size()))) return;
  std::vector<char> is_turned(loops.size(), 0);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    std::vector<LoopSide> others;
    for (std::size_t k = 0; k < loops.size(); ++k)
      if (k != i) others.insert(others.end(), loops[k].sides.begin(), loops[k].sides.end());
    is_turned[i] = is_inside(loops[i], {0, 0}, LoopPolygons(std::move(others))) == (loops[i].area > 0);
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (!is_turned[i]) continue;
    wrong.push_back({f, loops[i].wire});
    loops[i].area = -loops[i].area;  // its sides may stay: inside is where an odd number of them is passed
  }
}

bool has_holes(const TopoDS_Face& face) {
  int n_loops = 0;
  for (TopoDS_Iterator w(face); w.More(); w.Next()) n_loops += w.Value().ShapeType() == TopAbs_WIRE;
  return n_loops > 1;
}

/// One point of each edge beyond the bounds of a surface that has none there, or several loops.
bool is_to_be_looked_at(const TopoDS_Face& face, const Handle(Geom_Surface) & surface) {
  if (has_holes(face)) return true;
  if (surface_type(surface) == SurfaceType::kPlane) return false;
  double u0, u1, v0, v1;
  surface->Bounds(u0, u1, v0, v1);
  const double room_u = surface->IsUPeriodic() ? 1e300 : kBeyond * (u1 - u0);
  const double room_v = surface->IsVPeriodic() ? 1e300 : kBeyond * (v1 - v0);
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double t0, t1;
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, t0, t1);
    if (pcurve.IsNull()) continue;
    const gp_Pnt2d p = pcurve->Value(0.5 * (t0 + t1));
    if (p.X() < u0 - room_u || p.X() > u1 + room_u || p.Y() < v0 - room_v || p.Y() > v1 + room_v) return true;
  }
  return false;
}

bool goes_around(const Loop& loop, const SurfaceClosing& c) {
  return (c.period.x > 0 && std::abs(loop.winding.x) > kWinding * c.period.x) ||
         (c.period.y > 0 && std::abs(loop.winding.y) > kWinding * c.period.y);
}

void move_loops_of(const NamedFace& f, std::vector<WrongLoop>& wrong, std::vector<ImportFinding>& findings) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(f.face);
  if (!is_to_be_looked_at(f.face, surface)) return;
  const SurfaceClosing c = surface_type(surface) == SurfaceType::kPlane ? SurfaceClosing{} : surface_closing(f.face);
  const bool is_closed = c.period.x > 0 || c.period.y > 0;
  if (!is_closed && !has_holes(f.face)) return;
  std::vector<Loop> loops = loops_of(f.face);
  if (loops.empty()) return;
  if (!is_closed) turn_loops(f, loops, wrong);
  if (std::any_of(loops.begin(), loops.end(), [&](const Loop& loop) { return goes_around(loop, c); }))
    return;  // a band between loops that go around has no outer loop
  const auto outer = std::max_element(loops.begin(), loops.end(),
                                      [](const Loop& a, const Loop& b) { return std::abs(a.area) < std::abs(b.area); });
  if (outer->area <= 0) return;
  if (is_closed) move_face(f, loops, *outer, c, findings);
  if (loops.size() > 1) move_holes(f, loops, static_cast<std::size_t>(outer - loops.begin()), c, wrong, findings);
}

/// Faces but `f` with an edge of the wire.
std::vector<int> faces_at(const ImportedShape& model, const TopoDS_Wire& wire, const NamedFace& f) {
  TopTools_MapOfShape edges;
  for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next()) edges.Add(e.Current());
  std::vector<int> faces;
  for (int i = 1; i <= model.faces.Extent(); ++i)
    for (TopExp_Explorer e(model.faces(i), TopAbs_EDGE); e.More(); e.Next()) {
      if (i == f.number || !edges.Contains(e.Current())) continue;
      faces.push_back(i);
      break;
    }
  return faces;
}

TopoDS_Shape repaired(const TopoDS_Face& face, const std::vector<WrongLoop>& wrong) {
  TopoDS_Shape result = face.EmptyCopied();
  for (TopoDS_Iterator w(face, false, false); w.More(); w.Next()) {
    const auto loop = std::find_if(wrong.begin(), wrong.end(),
                                   [&](const WrongLoop& other) { return other.wire.IsPartner(w.Value()); });
    if (loop == wrong.end())
      BRep_Builder().Add(result, w.Value());
    else if (!loop->is_stray)
      BRep_Builder().Add(result, w.Value().Reversed());
  }
  return result;
}

/// A face ends at its outer loop: what is beyond it bounds nothing. Other faces that end there stay open.
void say_stray(const WrongLoop& hole, const ImportedShape& model, std::vector<ImportFinding>& findings) {
  const std::vector<int> others = faces_at(model, hole.wire, hole.of);
  std::string names;
  for (const int i : others) names += (names.empty() ? "" : ", ") + ("face " + std::to_string(i));
  say(FindingKind::kStrayHole, hole.of, hole.wire, names.empty() ? "" : "; open there: " + names, findings);
  findings.back().is_repair = others.empty();
}

void repair(const std::vector<WrongLoop>& wrong, ImportedShape& model, std::vector<ImportFinding>& findings) {
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  TopTools_MapOfShape seen;
  for (const WrongLoop& loop : wrong) {
    if (loop.is_stray)
      say_stray(loop, model, findings);
    else
      say(FindingKind::kTurnedLoop, loop.of, loop.wire, "", findings);
    if (seen.Add(loop.of.face)) reshape->Replace(loop.of.face, repaired(loop.of.face, wrong));
  }
  if (!wrong.empty())
    model.replace(reshape->Apply(model.shape), [&](const TopoDS_Shape& face) { return reshape->Apply(face); });
}

/// A band whose loops go around its surface, without the edge from one to the other.
bool lacks_seam(const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (surface_type(surface) == SurfaceType::kPlane || !is_to_be_looked_at(face, surface)) return false;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next())
    if (BRep_Tool::IsClosed(TopoDS::Edge(e.Current()), face) || BRep_Tool::Degenerated(TopoDS::Edge(e.Current())))
      return false;
  const SurfaceClosing c = surface_closing(face);
  const std::vector<Loop> loops = loops_of(face);
  return std::any_of(loops.begin(), loops.end(), [&](const Loop& loop) { return goes_around(loop, c); });
}

/// Bands get their seam, and the edges that it meets are divided; not where that would open edges.
void add_missing_seams(ImportedShape& model, std::vector<ImportFinding>& findings) {
  const Handle(ShapeBuild_ReShape) reshape = new ShapeBuild_ReShape;
  std::vector<ImportFinding> found;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    const TopoDS_Face face = TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD));
    if (!lacks_seam(face)) continue;
    const TopoDS_Shape now = reshape->Apply(face);
    if (now.IsNull() || now.ShapeType() != TopAbs_FACE) continue;
    ShapeFix_Face fix(TopoDS::Face(now));
    fix.SetContext(reshape);
    if (!fix.FixMissingSeam()) continue;
    say(FindingKind::kLostLoops, {face, i}, face, "", found);
  }
  if (found.empty()) return;
  const TopoDS_Shape repaired = reshape->Apply(model.shape);
  if (count_free_edges(repaired) > count_free_edges(model.shape)) return;
  model.replace(repaired, [&](const TopoDS_Shape& face) { return reshape->Apply(face); });
  findings.insert(findings.end(), found.begin(), found.end());
}

}  // namespace

void move_loops(ImportedShape& model, std::vector<ImportFinding>& findings) {
  add_missing_seams(model, findings);
  TopTools_MapOfShape seen;
  std::vector<WrongLoop> wrong;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    const TopoDS_Face face = TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD));
    if (seen.Add(face.Located({}))) move_loops_of({face, i}, wrong, findings);
  }
  repair(wrong, model, findings);
}

}  // namespace st::occt
