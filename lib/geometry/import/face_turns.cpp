#include "geometry/import/face_turns.h"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Poly_Triangulation.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/brep/face_integral.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/uv_box.h"

namespace st::occt {
namespace {

constexpr double kMoreThanOnce = 1.01;  // periods
constexpr double kAngle = 0.1;          // between facets, radians
constexpr double kDeflection = 1e-3;    // of facets, of the face's diagonal
constexpr double kFilled = 0.02;        // of the area: what facets may lack

bool has_turns(const TopoDS_Face& face) {
  const GeomAdaptor_Surface surface(BRep_Tool::Surface(face));
  if (!surface.IsUPeriodic() && !surface.IsVPeriodic()) return false;
  const Vec2 extent = uv_box(face).size();
  return (surface.IsUPeriodic() && extent.x > kMoreThanOnce * surface.UPeriod()) ||
         (surface.IsVPeriodic() && extent.y > kMoreThanOnce * surface.VPeriod());
}

/// Part of a triangle where `height`, linear in it, is above 0.
double share_above(std::array<double, 3> height) {
  int n = 0;
  for (const double h : height) n += h > 0;
  if (n == 0 || n == 3) return n == 3 ? 1 : 0;
  const auto alone = [&](double h) { return (h > 0) == (n == 1); };
  const int k = alone(height[0]) ? 0 : alone(height[1]) ? 1 : 2;
  const double h = height[k];
  const double tip = h / (h - height[(k + 1) % 3]) * h / (h - height[(k + 2) % 3]);
  return n == 1 ? tip : 1 - tip;
}

std::optional<double> area_beyond(const TopoDS_Face& face, Vec3 normal, double offset) {
  const TopoDS_Face copy = TopoDS::Face(BRepBuilderAPI_Copy(face).Shape());
  const BRepMesh_IncrementalMesh mesher(copy, kDeflection * rough_box(face).diagonal(), false, kAngle);
  TopLoc_Location place;
  const Handle(Poly_Triangulation) facets = BRep_Tool::Triangulation(copy, place);
  if (facets.IsNull()) return std::nullopt;
  double all = 0, beyond = 0;
  for (int t = 1; t <= facets->NbTriangles(); ++t) {
    std::array<Vec3, 3> x;
    std::array<double, 3> height;
    for (int k = 0; k < 3; ++k) {
      const gp_Pnt p = facets->Node(facets->Triangle(t).Value(k + 1)).Transformed(place.Transformation());
      x[k] = {p.X(), p.Y(), p.Z()};
      height[k] = dot(normal, x[k]) - offset;
    }
    const double area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
    all += area;
    beyond += area * share_above(height);
  }
  const double exact = area_of_faces(face);
  if (!(std::abs(all - exact) <= kFilled * exact)) return std::nullopt;
  return beyond / all * exact;
}

}  // namespace

std::vector<TurnedFace> turned_faces_beyond(const TopTools_IndexedMapOfShape& faces, Vec3 normal, double offset) {
  std::vector<TurnedFace> found;
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f));
    if (!has_turns(face)) continue;
    if (const std::optional<double> area = area_beyond(face, normal, offset)) found.push_back({f, *area});
  }
  return found;
}

}  // namespace st::occt
