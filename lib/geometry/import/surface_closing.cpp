#include "geometry/import/surface_closing.h"

#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <algorithm>

#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

constexpr int kStations = 8;        // across a surface, at which its ends are compared
constexpr double kFarBelow = 0.01;  // of the surface's extent: a tolerance that says that ends meet

enum class Along { kU, kV };

/// Whether both ends of a bounded surface are one line within the tolerance of the face's edges, far below its size:
/// OpenCASCADE says so only of what is equal to 1e-7.
bool ends_meet(const Handle(Geom_Surface) & surface, const SurfaceClosing& c, Along along, double tolerance) {
  if (Precision::IsInfinite(c.lo.x) || Precision::IsInfinite(c.hi.x)) return false;
  if (Precision::IsInfinite(c.lo.y) || Precision::IsInfinite(c.hi.y)) return false;
  const auto point = [&](double s, double t) {  // s along, t across
    const Vec2 uv = along == Along::kU ? Vec2{s, t} : Vec2{t, s};
    return surface->Value(c.lo.x + uv.x * (c.hi.x - c.lo.x), c.lo.y + uv.y * (c.hi.y - c.lo.y));
  };
  double size = 0;
  for (int k = 0; k <= kStations; ++k) {
    const double t = static_cast<double>(k) / kStations;
    if (point(0, t).Distance(point(1, t)) > tolerance) return false;
    size = std::max(size, point(0, t).Distance(point(0.5, t)));
  }
  return tolerance < kFarBelow * size;
}

}  // namespace

SurfaceClosing surface_closing(const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  SurfaceClosing c;
  surface->Bounds(c.lo.x, c.hi.x, c.lo.y, c.hi.y);
  c.is_u_periodic = surface->IsUPeriodic();
  c.is_v_periodic = surface->IsVPeriodic();
  const double tolerance = std::max(Precision::Confusion(), max_edge_tolerance(face));
  const auto is_closed = [&](bool is_said, Along along) { return is_said || ends_meet(surface, c, along, tolerance); };
  c.period.x = c.is_u_periodic ? surface->UPeriod() : is_closed(surface->IsUClosed(), Along::kU) ? c.hi.x - c.lo.x : 0;
  c.period.y = c.is_v_periodic ? surface->VPeriod() : is_closed(surface->IsVClosed(), Along::kV) ? c.hi.y - c.lo.y : 0;
  return c;
}

}  // namespace st::occt
