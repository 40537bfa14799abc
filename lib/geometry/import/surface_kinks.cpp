#include "geometry/import/surface_kinks.h"

#include <BRep_Tool.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_OffsetCurve.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SweptSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <algorithm>
#include <cmath>

#include "geometry/brep/face_domain.h"
#include "geometry/shape/loop_polygons.h"

namespace st::occt {
namespace {

constexpr double kBeside = 1e-6;  // of the way to the next knot: normals there are those at the knot
constexpr double kAround = 1e-3;  // of that way: on both sides of the knot must be the face
constexpr int kStations = 8;      // along each part of the line that is inside the face

bool has_sharp_knot(const Handle(Geom_Curve) & curve) {
  if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve)) return has_sharp_knot(trimmed->BasisCurve());
  if (const auto offset = Handle(Geom_OffsetCurve)::DownCast(curve)) return has_sharp_knot(offset->BasisCurve());
  const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve);
  if (spline.IsNull()) return false;
  for (int k = spline->IsPeriodic() ? 1 : 2; k < spline->NbKnots(); ++k)
    if (spline->Multiplicity(k) >= spline->Degree()) return true;
  return false;
}

/// Whether there is a knot at which the surface need not be smooth: most have none, and cost no more than this.
bool has_sharp_knot(const Handle(Geom_Surface) & surface) {
  if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
    return has_sharp_knot(trimmed->BasisSurface());
  if (const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface)) return has_sharp_knot(offset->BasisSurface());
  if (const auto swept = Handle(Geom_SweptSurface)::DownCast(surface)) return has_sharp_knot(swept->BasisCurve());
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (spline.IsNull()) return false;
  for (int k = spline->IsUPeriodic() ? 1 : 2; k < spline->NbUKnots(); ++k)
    if (spline->UMultiplicity(k) >= spline->UDegree()) return true;
  for (int k = spline->IsVPeriodic() ? 1 : 2; k < spline->NbVKnots(); ++k)
    if (spline->VMultiplicity(k) >= spline->VDegree()) return true;
  return false;
}

enum class Along { kU, kV };

/// The lines of constant u, or of constant v, of a face.
class Lines {
 public:
  Lines(const FaceDomain& domain, const LoopPolygons& loops, Along along)
      : domain_(domain), loops_(loops), is_u_(along == Along::kU) {}

  std::vector<double> kinks() {
    const std::vector<double> knots = inner_knots();
    const double lo = is_u_ ? domain_.bounds.lo.x : domain_.bounds.lo.y;
    const double hi = is_u_ ? domain_.bounds.hi.x : domain_.bounds.hi.y;
    std::vector<double> result;
    for (std::size_t k = 0; k < knots.size(); ++k) {
      const double before = k > 0 ? knots[k - 1] : lo, after = k + 1 < knots.size() ? knots[k + 1] : hi;
      if (is_kink(knots[k], std::min(knots[k] - before, after - knots[k]))) result.push_back(knots[k]);
    }
    return result;
  }

  Vec3 first_place() const { return first_place_; }

 private:
  /// Breaks inside the bounds, in each period.
  std::vector<double> inner_knots() const {
    const Surface& s = *domain_.surface;
    const Box2& b = domain_.bounds;
    const double lo = is_u_ ? b.lo.x : b.lo.y, hi = is_u_ ? b.hi.x : b.hi.y;
    const double period = is_u_ ? s.u_period() : s.v_period(), room = 1e-9 * (hi - lo);
    std::vector<double> knots;
    for (const double t : is_u_ ? s.u_breaks() : s.v_breaks()) {
      if (period == 0) knots.push_back(t);
      for (double k = std::ceil((lo - t) / period); period > 0 && t + k * period < hi; ++k)
        knots.push_back(t + k * period);
    }
    std::erase_if(knots, [&](double t) { return !(t > lo + room && t < hi - room); });
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end(), [&](double a, double c) { return c - a < room; }), knots.end());
    return knots;
  }

  Vec2 place(double t, double s) const { return is_u_ ? Vec2{t, s} : Vec2{s, t}; }

  /// Where the line t meets the loops, ascending.
  std::vector<double> crossings(double t) const {
    std::vector<double> result;
    for (const LoopSide& side : loops_.sides()) {
      const double a = is_u_ ? side.a.x : side.a.y, b = is_u_ ? side.b.x : side.b.y;
      const double at_a = is_u_ ? side.a.y : side.a.x, at_b = is_u_ ? side.b.y : side.b.x;
      if ((a > t) != (b > t)) result.push_back(at_a + (at_b - at_a) * (t - a) / (b - a));
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  double turning(double t, double s, double beside) const {
    const SurfacePoint a = domain_.surface->evaluate(place(t - beside, s));
    const SurfacePoint b = domain_.surface->evaluate(place(t + beside, s));
    const Vec3 before = cross(a.du, a.dv), after = cross(b.du, b.dv);
    return norm(before) > 0 && norm(after) > 0 ? angle_between(before, after) : 0;
  }

  bool is_kink(double t, double room) {
    const double around = kAround * room;
    const std::vector<double> s = crossings(t + around);
    for (std::size_t k = 0; k + 1 < s.size(); k += 2)
      for (int i = 0; i < kStations; ++i) {
        const double at = s[k] + (s[k + 1] - s[k]) * (i + 0.5) / kStations;
        if (turning(t, at, kBeside * room) <= kLeastKink || !loops_.contains(place(t - around, at))) continue;
        if (!has_place_) first_place_ = domain_.surface->point(place(t, at)), has_place_ = true;
        return true;
      }
    return false;
  }

  const FaceDomain& domain_;
  const LoopPolygons& loops_;
  bool is_u_;
  bool has_place_ = false;
  Vec3 first_place_;
};

LoopPolygons polygons_of(const FaceDomain& domain) {
  std::vector<LoopSide> sides;
  for (const LoopUv& loop : domain.loops) {
    const std::vector<Vec2> p = loop.polygon();
    for (std::size_t k = 0; k < p.size(); ++k) sides.push_back({p[k], p[(k + 1) % p.size()]});
  }
  return LoopPolygons(std::move(sides));
}

}  // namespace

std::optional<SurfaceKinks> find_kinks(const TopoDS_Face& face) {
  TopLoc_Location where;
  if (!has_sharp_knot(BRep_Tool::Surface(face, where))) return std::nullopt;
  const FaceDomain domain = make_domain(face);
  const LoopPolygons loops = polygons_of(domain);
  Lines along_u(domain, loops, Along::kU), along_v(domain, loops, Along::kV);
  SurfaceKinks kinks{along_u.kinks(), along_v.kinks(), {}};
  if (kinks.u.empty() && kinks.v.empty()) return std::nullopt;
  kinks.xyz = kinks.u.empty() ? along_v.first_place() : along_u.first_place();
  return kinks;
}

}  // namespace st::occt
