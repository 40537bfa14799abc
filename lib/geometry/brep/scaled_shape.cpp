#include "geometry/brep/scaled_shape.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <gp.hxx>
#include <gp_GTrsf2d.hxx>

#include "geometry/brep/faces_of.h"
#include "geometry/brep/pcurve_fit.h"

namespace st::occt {
namespace {

struct RangedCurve {
  Handle(Geom2d_Curve) curve;
  double t0 = 0, t1 = 0;

  double at(double share) const { return t0 + share * (t1 - t0); }
};

/// The one that is stored: planes compute one where there is none.
RangedCurve curve_of(const TopoDS_Shape& edge, const TopoDS_Face& face) {
  RangedCurve c;
  Standard_Boolean is_stored = false;
  c.curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge), face, c.t0, c.t1, &is_stored);
  return is_stored ? c : RangedCurve();
}

/// A trimming curve of the shape as it has to be.
class ScaledCurve {
 public:
  ScaledCurve(const RangedCurve& before, const gp_GTrsf2d& growth) : before_(before), growth_(growth) {}

  gp_XY point(double share) const {
    gp_XY uv = before_.curve->Value(before_.at(share)).XY();
    growth_.Transforms(uv);
    return uv;
  }

  /// Largest distance of a curve that OpenCASCADE made, over the extent of this one, between `n` shares.
  double distance_of(const RangedCurve& made, int n) const {
    double largest = 0, extent = 0;
    const gp_XY begin = point(0);
    for (int k = 1; k < 2 * n; k += 2) {
      const gp_XY uv = point(0.5 * k / n);
      largest = std::max(largest, (made.curve->Value(made.at(0.5 * k / n)).XY() - uv).Modulus());
      extent = std::max(extent, (uv - begin).Modulus());
    }
    return largest / std::max(extent, 1e-300);
  }

  /// Null where none is near enough.
  Handle(Geom2d_Curve) fitted(const RangedCurve& made) const {
    constexpr int kFirst = 64, kMost = 4096;
    for (int n = kFirst; n <= kMost; n *= 2) {
      UvPoints points;
      for (int k = 0; k <= n; ++k) {
        const double share = static_cast<double>(k) / n;
        const gp_XY uv = point(share);
        points[made.at(share)] = {uv.X(), uv.Y()};
      }
      const Handle(Geom2d_Curve) spline = spline_through(points, 0);
      if (spline.IsNull()) return {};
      if (distance_of(RangedCurve{spline, made.t0, made.t1}, n) < kNear) return spline;
    }
    return {};
  }

  static constexpr double kNear = 1e-9;  // of its extent: rounding of both, and of splines

 private:
  const RangedCurve& before_;
  const gp_GTrsf2d& growth_;
};

/// Makes the trimming curve of the moved edge again where its parameter is another one.
void keep_parameter(const TopoDS_Edge& edge, const TopoDS_Face& face, const TopoDS_Edge& moved,
                    const TopoDS_Face& moved_face, const gp_GTrsf2d& growth) {
  constexpr int kPlaces = 4;
  const RangedCurve before = curve_of(edge, face), after = curve_of(moved, moved_face);
  if (before.curve.IsNull() || after.curve.IsNull()) return;
  const ScaledCurve wanted(before, growth);
  if (wanted.distance_of(after, kPlaces) < ScaledCurve::kNear) return;
  const Handle(Geom2d_Curve) curve = wanted.fitted(after);
  if (curve.IsNull()) return;
  BRep_Builder builder;
  const double tolerance = BRep_Tool::Tolerance(moved);
  if (BRep_Tool::IsClosed(moved, moved_face)) {
    const bool is_first = moved.Orientation() != TopAbs_REVERSED;
    const Handle(Geom2d_Curve) other = curve_of(moved.Reversed(), moved_face).curve;
    builder.UpdateEdge(moved, is_first ? curve : other, is_first ? other : curve, moved_face, tolerance);
  } else {
    builder.UpdateEdge(moved, curve, moved_face, tolerance);
  }
  builder.Range(moved, moved_face, after.t0, after.t1);
}

}  // namespace

BRepBuilderAPI_Transform scaled_shape(const TopoDS_Shape& shape, const gp_Trsf& motion) {
  BRepBuilderAPI_Transform transform(shape, motion, true);
  if (std::abs(std::abs(motion.ScaleFactor()) - 1) < gp::Resolution()) return transform;
  for (const TopoDS_Face& face : faces_of(shape)) {
    const gp_GTrsf2d growth = BRep_Tool::Surface(face)->ParametricTransformation(motion);
    const TopoDS_Face moved_face = TopoDS::Face(transform.ModifiedShape(face).Oriented(TopAbs_FORWARD));
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Shape moved = transform.ModifiedShape(e.Current()).Oriented(e.Current().Orientation());
      keep_parameter(TopoDS::Edge(e.Current()), face, TopoDS::Edge(moved), moved_face, growth);
    }
  }
  return transform;
}

}  // namespace st::occt
