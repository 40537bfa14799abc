#include "geometry/brep/face_domain.h"

#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <cmath>

#include "geometry/brep/shape_queries.h"
#include "geometry/brep/uv_box.h"
#include "geometry/brep/wire_walk.h"
#include "geometry/shape/bspline.h"
#include "geometry/shape/loop_polygons.h"

namespace st::occt {
namespace {

constexpr int kSamples = 16;        // of a curved coedge, at least
constexpr int kSamplesPerSpan = 4;  // of a B-spline
constexpr int kMaxSamples = 256;

CoedgeUv make_coedge(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  CoedgeUv c;
  c.edge = edge;
  double t0 = 0, t1 = 0;
  c.curve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  const bool reversed = edge.Orientation() == TopAbs_REVERSED;
  c.t_start = reversed ? t1 : t0;
  c.t_end = reversed ? t0 : t1;
  if (c.curve.IsNull()) return c;
  const Geom2dAdaptor_Curve adaptor(c.curve, t0, t1);
  c.is_line = adaptor.GetType() == GeomAbs_Line;
  int n = c.is_line ? 1 : kSamples;
  if (adaptor.GetType() == GeomAbs_BSplineCurve)
    n = adaptor.Degree() == 1 ? std::max(n, 2 * adaptor.NbKnots())
                              : std::clamp(kSamplesPerSpan * adaptor.NbKnots(), n, kMaxSamples);
  for (int k = 0; k < n; ++k) {
    const gp_Pnt2d p = adaptor.Value(c.t_start + (c.t_end - c.t_start) * k / n);
    c.polygon.push_back({p.X(), p.Y()});
  }
  return c;
}

std::vector<double> inside(const TColStd_Array1OfReal& knots, double low, double high) {
  std::vector<double> result;
  for (const double t : knots)
    if (t > low && t < high) result.push_back(t);
  return result;
}

double polygon_area(const LoopUv& loop) {
  const std::vector<Vec2> p = loop.polygon();
  double area = 0;
  for (std::size_t k = 0; k < p.size(); ++k) area += 0.5 * cross(p[k] - p[0], p[(k + 1) % p.size()] - p[0]);
  return area;
}

void enlarge(Box3& box, Vec3 by) {
  if (box.is_empty()) return;
  box.lo = box.lo - by;
  box.hi = box.hi + by;
}

/// Adds to `sag` how far a parabola through three neighbours leaves their chords.
void add_sag(Vec3& sag, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 d = (a - 2.0 * b + c) / 8;
  sag = {std::max(sag.x, std::fabs(d.x)), std::max(sag.y, std::fabs(d.y)), std::max(sag.z, std::fabs(d.z))};
}

void add_sides(const LoopUv& loop, std::vector<LoopSide>& sides) {
  const std::vector<Vec2> p = loop.polygon();
  for (std::size_t k = 0; k < p.size(); ++k) sides.push_back({p[k], p[(k + 1) % p.size()]});
}

/// Where all of several loops run the same way, some must be wrong: holes, most of whose points are inside an odd
/// number of others, run clockwise.
void mark_turned(std::vector<LoopUv>& loops) {
  const auto n_positive = std::count_if(loops.begin(), loops.end(), [](const LoopUv& l) { return l.area > 0; });
  if (loops.size() < 2 || (n_positive != 0 && n_positive != static_cast<std::ptrdiff_t>(loops.size()))) return;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const std::vector<Vec2> points = loops[i].polygon();
    std::vector<LoopSide> others;
    for (std::size_t j = 0; j < loops.size(); ++j)
      if (j != i) add_sides(loops[j], others);
    const LoopPolygons polygons(std::move(others));
    const auto n_inside = std::count_if(points.begin(), points.end(), [&](Vec2 p) { return polygons.contains(p); });
    const bool is_hole = 2 * n_inside > static_cast<std::ptrdiff_t>(points.size());
    loops[i].is_turned = is_hole == (loops[i].area > 0);
  }
}

std::vector<LoopSide> sides_of(const FaceDomain& d) {
  std::vector<LoopSide> sides;
  for (const LoopUv& loop : d.loops) add_sides(loop, sides);
  return sides;
}

}  // namespace

std::vector<Vec2> LoopUv::polygon() const {
  std::vector<Vec2> p;
  for (const CoedgeUv& c : coedges) p.insert(p.end(), c.polygon.begin(), c.polygon.end());
  return p;
}

FaceDomain make_domain(const TopoDS_Face& face) {
  FaceDomain d;
  d.bounds = uv_box(face);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  d.surface = make_surface(surface, d.bounds);
  d.u_knots = d.surface->u_breaks();
  d.v_knots = d.surface->v_breaks();
  if (const GeomAdaptor_Surface adaptor(surface); adaptor.GetType() == GeomAbs_BSplineSurface) {
    const Handle(Geom_BSplineSurface) spline = adaptor.BSpline();
    d.n_u = std::clamp(2 * spline->NbUKnots(), d.n_u, kMaxSamples);
    d.n_v = std::clamp(2 * spline->NbVKnots(), d.n_v, kMaxSamples);
    d.u_knots = inside(spline->UKnots(), d.bounds.lo.x, d.bounds.hi.x);
    d.v_knots = inside(spline->VKnots(), d.bounds.lo.y, d.bounds.hi.y);
  }
  for (TopoDS_Iterator w(face); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) continue;
    LoopUv loop;
    for (const TopoDS_Edge& edge : walk_wire(TopoDS::Wire(w.Value()), face, d.bounds))
      loop.coedges.push_back(make_coedge(edge, face));
    if (loop.coedges.empty()) continue;
    loop.area = polygon_area(loop);
    d.loops.push_back(std::move(loop));
  }
  std::stable_sort(d.loops.begin(), d.loops.end(), [](const LoopUv& a, const LoopUv& b) { return a.area > b.area; });
  if (d.surface->u_period() == 0 && d.surface->v_period() == 0) mark_turned(d.loops);
  return d;
}

Box3 sampled_box(const Curve& curve) {
  constexpr int kSteps = 32;
  std::vector<Vec3> x;
  for (int k = 0; k <= kSteps; ++k)
    x.push_back(curve.point(curve.t_min() + (curve.t_max() - curve.t_min()) * k / kSteps));
  Box3 box;
  Vec3 sag;
  for (int k = 0; k <= kSteps; ++k) {
    box.add(x[k]);
    if (k > 0 && k < kSteps) add_sag(sag, x[k - 1], x[k], x[k + 1]);
  }
  enlarge(box, sag);
  return box;
}

Box3 sampled_box(const FaceDomain& d) {
  Box3 box;
  const LoopPolygons loops(sides_of(d));
  if (d.surface->is_planar() || loops.sides().empty()) return box;
  const double du = (d.bounds.hi.x - d.bounds.lo.x) / d.n_u, dv = (d.bounds.hi.y - d.bounds.lo.y) / d.n_v;
  Vec3 sag;
  std::vector<Vec2> places;  // of the samples inside at one v, with their neighbours along u; then those at v - dv, v +
                             // dv
  std::vector<Vec3> points;
  for (int j = 1; j < d.n_v; ++j) {
    const double v = d.bounds.lo.y + j * dv;
    std::vector<double> u;
    for (int i = 1; i < d.n_u; ++i)
      if (const double at = d.bounds.lo.x + i * du; loops.contains({at, v})) u.push_back(at);
    places.clear();
    for (const double at : u) places.insert(places.end(), {{at - du, v}, {at, v}, {at + du, v}});
    for (const double beside : {v - dv, v + dv})
      for (const double at : u) places.push_back({at, beside});
    points.resize(places.size());
    point_batch(*d.surface, places, points);
    const Vec3 *before = points.data() + 3 * u.size(), *after = before + u.size();
    for (std::size_t k = 0; k < u.size(); ++k) {
      const Vec3* x = &points[3 * k + 1];
      box.add(*x);
      add_sag(sag, x[-1], *x, x[1]);
      add_sag(sag, before[k], *x, after[k]);
    }
  }
  enlarge(box, 2.0 * sag);  // along u and along v
  return box;
}

}  // namespace st::occt
