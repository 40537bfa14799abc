#include "geometry/import/meridians.h"

#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/brep/replace_children.h"

namespace st::occt {
namespace {

constexpr int kPieces = 64;  // of a meridian, at most one crossing of the axis each
using Range = std::pair<double, double>;

/// Distance of a meridian from the axis, negative beyond it.
class Distance {
 public:
  explicit Distance(const Geom_SurfaceOfRevolution& surface) : curve_(surface.BasisCurve()), axis_(surface.Axis()) {
    double furthest = 0;
    for (int k = 0; k <= kPieces; ++k) {
      const gp_Vec off = off_axis(at(k));
      if (off.Magnitude() <= furthest) continue;
      furthest = off.Magnitude();
      side_ = off.Normalized();
    }
  }
  double at(int piece) const {
    const double t0 = curve_->FirstParameter(), t1 = curve_->LastParameter();
    return piece == kPieces ? t1 : t0 + piece * (t1 - t0) / kPieces;
  }
  double operator()(double t) const { return off_axis(t).Dot(side_); }
  /// Whether the curve lies in a plane with the axis.
  bool is_flat() const {
    for (int k = 0; k <= kPieces; ++k)
      if (off_axis(at(k)).Crossed(side_).Magnitude() > Precision::Confusion()) return false;
    return true;
  }
  /// Where the meridian is nearest to a point that is turned into its plane, on either side of the axis.
  std::optional<double> parameter_of(const gp_Pnt& p) const {
    const gp_Vec to(axis_.Location(), p), along = to.Dot(axis_.Direction()) * gp_Vec(axis_.Direction());
    std::optional<double> nearest;
    double least = 1e300;
    for (const double side : {1.0, -1.0}) {
      const gp_Vec off = side * (to - along).Magnitude() * side_;
      const GeomAPI_ProjectPointOnCurve foot(axis_.Location().Translated(along + off), curve_);
      if (foot.NbPoints() == 0 || foot.LowerDistance() >= least) continue;
      least = foot.LowerDistance();
      nearest = foot.LowerDistanceParameter();
    }
    return nearest;
  }

 private:
  gp_Vec off_axis(double t) const {
    const gp_Vec to(axis_.Location(), curve_->Value(t));
    return to - to.Dot(axis_.Direction()) * gp_Vec(axis_.Direction());
  }

  Handle(Geom_Curve) curve_;
  gp_Ax1 axis_;
  gp_Vec side_{1, 0, 0};
};

double root(const Distance& distance, double a, double b) {
  const bool is_beyond = distance(a) < 0;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (a + b);
    ((distance(middle) < 0) == is_beyond ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// Where the meridian meets the axis, ascending.
std::vector<double> tips_of(const Distance& distance) {
  constexpr double kOnAxis = 1e-9;  // model unit: rounding
  std::vector<double> tips;
  for (int k = 0; k <= kPieces; ++k) {
    const double t = distance.at(k), d = distance(t);
    if (std::abs(d) < kOnAxis)
      tips.push_back(t);
    else if (k > 0 && std::abs(distance(distance.at(k - 1))) >= kOnAxis &&
             (distance(distance.at(k - 1)) < 0) != (d < 0))
      tips.push_back(root(distance, distance.at(k - 1), t));
  }
  return tips;
}

/// The tips between which a range lies, if the meridian goes on beyond one of them.
std::optional<Range> tips_around(const Geom_SurfaceOfRevolution& surface, Range range) {
  const Handle(Geom_Curve) curve = surface.BasisCurve();
  const double t0 = curve->FirstParameter(), t1 = curve->LastParameter(), margin = 1e-6 * (t1 - t0);
  if (Precision::IsInfinite(t0) || Precision::IsInfinite(t1)) return std::nullopt;
  const Distance distance(surface);
  if (!distance.is_flat()) return std::nullopt;
  const std::vector<double> tips = tips_of(distance);
  for (std::size_t k = 0; k + 1 < tips.size(); ++k)
    if (tips[k] < range.first + margin && range.second < tips[k + 1] + margin)
      return tips[k] > t0 + margin || tips[k + 1] < t1 - margin ? std::optional(Range{tips[k], tips[k + 1]})
                                                                : std::nullopt;
  return std::nullopt;
}

/// Between tips that follow each other, around the whole meridian if it is closed.
std::vector<Range> parts_of(const Geom_Curve& curve, const Distance& distance) {
  std::vector<double> tips = tips_of(distance);
  if (curve.IsPeriodic() && !tips.empty()) {
    if (tips.back() - tips.front() > curve.Period() - 1e-9) tips.pop_back();
    tips.push_back(tips.front() + curve.Period());
  }
  std::vector<Range> parts;
  for (std::size_t k = 0; k + 1 < tips.size(); ++k) parts.emplace_back(tips[k], tips[k + 1]);
  return parts;
}

/// Volume around which a forward face on a part of the meridian looks outward, as far as its sign: from r and z.
double volume_within(const Geom_SurfaceOfRevolution& surface, const Distance& distance, Range part) {
  double sum = 0;
  const auto along = [&](double t) {
    return gp_Vec(surface.Axis().Location(), surface.BasisCurve()->Value(t)).Dot(surface.Axis().Direction());
  };
  for (int k = 0; k < kPieces; ++k) {
    const double t = part.first + k * (part.second - part.first) / kPieces,
                 next = part.first + (k + 1) * (part.second - part.first) / kPieces, r = distance(0.5 * (t + next));
    sum += r * r * (along(next) - along(t));
  }
  return sum;
}

/// Whether all edges of a face are seams or points.
bool has_no_border(const TopoDS_Face& face) {
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next())
    if (const TopoDS_Edge edge = TopoDS::Edge(e.Current());
        !BRep_Tool::Degenerated(edge) && !BRep_Tool::IsClosed(edge, face))
      return false;
  return true;
}

/// Leaves it to the healing to bound a face by its surface.
void remove_loops(const TopoDS_Face& face) {
  std::vector<TopoDS_Shape> loops;
  for (TopoDS_Iterator w(face, false); w.More(); w.Next()) loops.push_back(w.Value());
  replace_children(face, loops, {});
}

/// The part of its meridian around which a face without a border looks outward; nullopt where that is not one part of
/// several.
std::optional<Range> outward_part(const TopoDS_Face& face, const Geom_SurfaceOfRevolution& surface) {
  const Distance distance(surface);
  if (!distance.is_flat()) return std::nullopt;
  std::optional<Range> outward;
  const std::vector<Range> parts = parts_of(*surface.BasisCurve(), distance);
  for (const Range& part : parts) {
    if ((volume_within(surface, distance, part) > 0) == (face.Orientation() == TopAbs_REVERSED)) continue;
    if (outward) return std::nullopt;
    outward = part;
  }
  return parts.size() > 1 ? outward : std::nullopt;
}

/// Adds where an edge of a face is on the meridian; false where that is not known.
bool extend(Range& range, const TopoDS_Edge& edge, const TopoDS_Face& face, const Distance& distance) {
  constexpr int kPlaces = 8;
  double t0, t1;
  const Handle(Geom2d_Curve) flat = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  Handle(Geom_Curve) curve;
  if (flat.IsNull()) curve = BRep_Tool::Curve(edge, t0, t1);
  if (flat.IsNull() && curve.IsNull()) return false;
  for (int k = 0; k <= kPlaces; ++k) {
    const double t = t0 + k * (t1 - t0) / kPlaces;
    const std::optional<double> v = flat.IsNull() ? distance.parameter_of(curve->Value(t)) : flat->Value(t).Y();
    if (!v) return false;
    range = {std::min(range.first, *v), std::max(range.second, *v)};
  }
  return true;
}

/// Adds where the edges of a face are on its surface; false where that is not known.
bool extend(Range& range, const TopoDS_Face& face, const Geom_SurfaceOfRevolution& surface) {
  const Distance distance(surface);
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next())
    if (const TopoDS_Edge edge = TopoDS::Edge(e.Current()); !BRep_Tool::Degenerated(edge))
      if (!extend(range, edge, face, distance)) return false;
  return true;
}

}  // namespace

int trim_meridians(std::span<const TopoDS_Face> faces) {
  std::map<Geom_SurfaceOfRevolution*, std::optional<Range>> ranges;  // of the faces on each; nullopt: unknown
  for (const TopoDS_Face& face : faces) {
    TopLoc_Location location;
    const auto surface = Handle(Geom_SurfaceOfRevolution)::DownCast(BRep_Tool::Surface(face, location));
    if (surface.IsNull()) continue;
    std::optional<Range>& range = ranges.emplace(surface.get(), Range{1e300, -1e300}).first->second;
    if (range && !extend(*range, face, *surface)) range.reset();
  }
  int n = 0;
  for (const auto& [surface, range] : ranges) {
    if (!range || range->first > range->second) continue;
    const std::optional<Range> tips = tips_around(*surface, *range);
    if (!tips) continue;
    surface->SetBasisCurve(new Geom_TrimmedCurve(surface->BasisCurve(), tips->first, tips->second));
    ++n;
  }
  return n;
}

int trim_bare_meridians(const TopoDS_Shape& shape) {
  int n = 0;
  for (TopExp_Explorer s(shape, TopAbs_SHELL); s.More(); s.Next()) {
    const TopoDS_Shape shell = s.Current().Oriented(TopAbs_FORWARD);  // a cavity's faces look out of the cavity in it
    if (shell.NbChildren() != 1) continue;
    const TopoDS_Face face = TopoDS::Face(TopoDS_Iterator(shell).Value());
    TopLoc_Location location;
    const auto surface = Handle(Geom_SurfaceOfRevolution)::DownCast(BRep_Tool::Surface(face, location));
    if (surface.IsNull() || !has_no_border(face)) continue;
    const std::optional<Range> part = outward_part(face, *surface);
    if (!part) continue;
    surface->SetBasisCurve(new Geom_TrimmedCurve(surface->BasisCurve(), part->first, part->second));
    remove_loops(face);
    ++n;
  }
  return n;
}

}  // namespace st::occt
