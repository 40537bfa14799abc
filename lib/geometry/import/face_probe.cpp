#include "geometry/import/face_probe.h"

#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <limits>

#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr int kRows = 9;       // of the grid of points of a face
constexpr int kFineRows = 40;  // of the grid from which the closest point is sought again
constexpr int kStarts = 8;     // its nearest points
constexpr int kInARow = 2;     // points on the face
constexpr double kBeside = 3;  // tolerances from the face's edges: nearer, sewing joins them

TopoDS_Face forward(const TopoDS_Face& face) { return TopoDS::Face(face.Oriented(TopAbs_FORWARD)); }

bool holds(const Box3& box, Vec3 p, double tolerance) {
  for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
    if (p.*axis < box.lo.*axis - tolerance || p.*axis > box.hi.*axis + tolerance) return false;
  return true;
}

}  // namespace

bool may_lie_on(const Box3& box, const std::vector<Vec3>& points, double tolerance) {
  return std::count_if(points.begin(), points.end(), [&](Vec3 p) { return holds(box, p, tolerance); }) >= kInARow;
}

FaceProbe::FaceProbe(const TopoDS_Face& face, double tolerance)
    : domain_(make_domain(forward(face))),
      classifier_(forward(face), Precision::PConfusion()),
      tolerance_(tolerance),
      box_(rough_box(face)) {
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double t0, t1;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(e.Current()), t0, t1);
    if (!curve.IsNull()) edges_.push_back({rough_box(e.Current()), make_curve(curve, t0, t1)});
  }
}

std::optional<double> FaceProbe::distance_of(const std::vector<Vec3>& points) {
  int n_on = 0, longest = 0;
  double largest = 0;
  for (const Vec3 p : points) {
    const std::optional<double> distance = holds(box_, p, tolerance_) ? distance_inside(p) : std::nullopt;
    n_on = distance ? n_on + 1 : 0;
    longest = std::max(longest, n_on);
    largest = std::max(largest, distance.value_or(0));
  }
  return longest >= kInARow ? std::optional<double>(largest) : std::nullopt;
}

std::vector<Vec3> FaceProbe::samples() {
  const Box2& b = domain_.bounds;
  std::vector<Vec3> points;
  for (int i = 0; i < kRows; ++i)
    for (int k = 0; k < kRows; ++k) {
      const Vec2 uv = {b.lo.x + (b.hi.x - b.lo.x) * (i + 0.5) / kRows, b.lo.y + (b.hi.y - b.lo.y) * (k + 0.5) / kRows};
      if (classifier_.Perform(gp_Pnt2d(uv.x, uv.y)) == TopAbs_IN) points.push_back(domain_.surface->point(uv));
    }
  return points;
}

double FaceProbe::distance_to(Vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const SurfaceFoot& foot) {
    if (foot.distance < least && classifier_.Perform(gp_Pnt2d(foot.uv.x, foot.uv.y)) != TopAbs_OUT)
      least = foot.distance;
  };
  take(closest_point(*domain_.surface, p, grid_));
  if (least > tolerance_)
    for (const PlacedCurve& edge : edges_) least = std::min(least, closest_point(*edge.curve, p).distance);
  if (least > tolerance_)
    for (const Vec2 start : nearest_places(p)) take(descend_from(*domain_.surface, p, start));
  return least;
}

std::vector<Vec2> FaceProbe::nearest_places(Vec3 p) {
  if (places_.empty()) {
    const Box2& b = domain_.bounds;
    for (int i = 0; i <= kFineRows; ++i)
      for (int k = 0; k <= kFineRows; ++k) {
        const Vec2 uv = {b.lo.x + (b.hi.x - b.lo.x) * i / kFineRows, b.lo.y + (b.hi.y - b.lo.y) * k / kFineRows};
        places_.emplace_back(uv, domain_.surface->point(uv));
      }
  }
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < places_.size(); ++i) order.emplace_back(distance(places_[i].second, p), i);
  std::partial_sort(order.begin(), order.begin() + kStarts, order.end());
  std::vector<Vec2> nearest;
  for (int i = 0; i < kStarts; ++i) nearest.push_back(places_[order[i].second].first);
  return nearest;
}

Vec3 FaceProbe::normal_at(Vec3 p) {
  return surface_normal(*domain_.surface, closest_point(*domain_.surface, p, grid_).uv);
}

std::optional<double> FaceProbe::distance_inside(Vec3 p) {
  const SurfaceFoot foot = closest_point(*domain_.surface, p, grid_);
  if (foot.distance > tolerance_) return std::nullopt;
  if (classifier_.Perform(gp_Pnt2d(foot.uv.x, foot.uv.y)) != TopAbs_IN) return std::nullopt;
  const double beside = kBeside * tolerance_;
  for (const auto& [box, curve] : edges_)
    if (holds(box, p, beside) && closest_point(*curve, p).distance <= beside) return std::nullopt;
  return foot.distance;
}

}  // namespace st::occt
