// What lies on the inside of a face.
#pragma once

#include <BRepTopAdaptor_FClass2d.hxx>
#include <TopoDS_Face.hxx>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/brep/face_domain.h"
#include "geometry/shape/curve.h"
#include "geometry/shape/projection.h"

namespace st::occt {

/// Whether enough of the points are in the box for a FaceProbe to say more.
bool may_lie_on(const Box3& box, const std::vector<Vec3>& points, double tolerance);

/// A face that is asked for points on it, and for points of it.
class FaceProbe {
 public:
  /// `tolerance`: distance of points that are on the face, unit of the shape. Throws Standard_Failure for a face that
  /// cannot be measured.
  FaceProbe(const TopoDS_Face& face, double tolerance);

  /// The largest distance of the points that are on the face, inside its loops and away from its edges; nothing unless
  /// two are, one after the other: a curve that pierces it has one.
  std::optional<double> distance_of(const std::vector<Vec3>& points);

  /// Points inside the loops, of a grid, row by row.
  std::vector<Vec3> samples();

  /// Of a point from the face, its edges included; no closer than it is. Cost: where it is more,
  /// thousands of points of the surface once, and a search from some of them.
  double distance_to(Vec3 p);
  /// du x dv at the point of the surface that is next, normalised.
  Vec3 normal_at(Vec3 p);

 private:
  struct PlacedCurve {
    Box3 box;
    std::unique_ptr<Curve> curve;
  };
  std::optional<double> distance_inside(Vec3 p);
  std::vector<Vec2> nearest_places(Vec3 p);

  FaceDomain domain_;
  SurfaceGrid grid_;  ///< of its surface, made when first needed
  BRepTopAdaptor_FClass2d classifier_;
  double tolerance_;
  Box3 box_;
  std::vector<PlacedCurve> edges_;
  std::vector<std::pair<Vec2, Vec3>> places_;  ///< of a fine grid of the surface, made when first needed
};

}  // namespace st::occt
