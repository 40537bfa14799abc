#include "geometry/import/empty_faces.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "geometry/brep/face_domain.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/uv_box.h"

namespace st::occt {
namespace {

constexpr double kPoint = 1e-7;    // of the model's diagonal: the whole face, or edge
constexpr double kNoWidth = 1e-6;  // of the face's own diagonal: its mean width
constexpr double kNoLoop = 1e-9;   // of the larger range of (u,v), squared
constexpr int kMostCells = 64;     // along u and v

/// Corners of the cells of one line across the surface.
std::vector<Vec3> line_of(const FaceDomain& d, double v, int n_u) {
  std::vector<Vec3> line;
  for (int i = 0; i <= n_u; ++i)
    line.push_back(d.surface->point({d.bounds.lo.x + (d.bounds.hi.x - d.bounds.lo.x) * i / n_u, v}));
  return line;
}

/// Area of the surface within the bounds, by cells.
double sampled_area(const FaceDomain& d) {
  const int n_u = std::min(d.n_u, kMostCells), n_v = std::min(d.n_v, kMostCells);
  double area = 0;
  std::vector<Vec3> before = line_of(d, d.bounds.lo.y, n_u);
  for (int j = 1; j <= n_v; ++j) {
    const std::vector<Vec3> line = line_of(d, d.bounds.lo.y + (d.bounds.hi.y - d.bounds.lo.y) * j / n_v, n_u);
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      area += 0.5 * (norm(cross(line[i] - before[i], before[i + 1] - before[i])) +
                     norm(cross(line[i] - line[i + 1], before[i + 1] - line[i + 1])));
    before = line;
  }
  return area;
}

/// What the loops of a face say of it.
struct Outline {
  std::vector<Vec3> points;
  Box3 box;
  double length = 0;
  Vec3 vector_area;  ///< no surface with this outline has less
};

Outline outline_of(const FaceDomain& d) {
  Outline result;
  for (const LoopUv& loop : d.loops) {
    std::vector<Vec3> x;
    for (const Vec2 uv : loop.polygon()) x.push_back(d.surface->point(uv));
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Vec3 next = x[(k + 1) % x.size()];
      result.box.add(x[k]);
      result.length += distance(x[k], next);
      result.vector_area += 0.5 * cross(x[k] - x[0], next - x[0]);
    }
    result.points.insert(result.points.end(), x.begin(), x.end());
  }
  return result;
}

/// Whether the loops enclose nothing in (u,v): they may be wrong, and later be repaired.
bool encloses_nothing(const FaceDomain& d) {
  const double range = std::max(d.bounds.hi.x - d.bounds.lo.x, d.bounds.hi.y - d.bounds.lo.y);
  return d.loops.empty() || std::fabs(d.loops[0].area) <= kNoLoop * range * range;
}

/// Whether all points are within `width` of the line through the first and the one farthest from it.
bool is_straight(const std::vector<Vec3>& points, double width) {
  const Vec3 first = points.front();
  const Vec3 last = *std::max_element(points.begin(), points.end(),
                                      [&](Vec3 a, Vec3 b) { return distance(first, a) < distance(first, b); });
  return std::all_of(points.begin(), points.end(),
                     [&](Vec3 p) { return norm(cross(p - first, normalized(last - first))) <= width; });
}

/// Faces of solids and closed shells; two faces alone close without a room between them when they are lines.
TopTools_MapOfShape bounding_faces(const TopoDS_Shape& shape) {
  TopTools_MapOfShape faces;
  const auto add = [&](const TopoDS_Shape& body) {
    for (TopExp_Explorer f(body, TopAbs_FACE); f.More(); f.Next()) faces.Add(f.Current());
  };
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) add(solid.Current());
  for (TopExp_Explorer shell(shape, TopAbs_SHELL, TopAbs_SOLID); shell.More(); shell.Next())
    if (shell.Current().NbChildren() > 2 && count_free_edges(shell.Current()) == 0) add(shell.Current());
  return faces;
}

/// Whether the edge goes no further from its one vertex than that one's tolerance and `far`.
bool is_point(const TopoDS_Edge& edge, double far) {
  constexpr int kPlaces = 8;
  if (BRep_Tool::Degenerated(edge)) return false;
  TopoDS_Vertex first, last;
  TopExp::Vertices(edge, first, last);
  double t0, t1;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  if (first.IsNull() || !first.IsSame(last) || curve.IsNull()) return false;
  const double most = std::min(far, BRep_Tool::Tolerance(first));
  for (int k = 0; k <= kPlaces; ++k)
    if (curve->Value(t0 + k * (t1 - t0) / kPlaces).Distance(BRep_Tool::Pnt(first)) > most) return false;
  return true;
}

bool is_point_in_uv(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  constexpr double kNear = 1e-4;  // of the face's range: no part of a pole
  double t0, t1;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (curve.IsNull()) return false;
  const Vec2 size = uv_box(face).size();
  const gp_Pnt2d a = curve->Value(t0), middle = curve->Value(0.5 * (t0 + t1)), b = curve->Value(t1);
  const auto is_near = [&](const gp_Pnt2d& p) {
    return std::abs(p.X() - a.X()) <= kNear * size.x && std::abs(p.Y() - a.Y()) <= kNear * size.y;
  };
  return is_near(middle) && is_near(b);
}

}  // namespace

std::optional<Box3> empty_box(const TopoDS_Face& face, double diagonal) {
  try {
    const FaceDomain d = make_domain(face);
    const Outline outline = outline_of(d);
    if (outline.box.is_empty()) return std::nullopt;
    const double width = kNoWidth * outline.box.diagonal(), least = 0.5 * outline.length * width;
    if (norm(outline.vector_area) > least && outline.box.diagonal() > kPoint * diagonal) return std::nullopt;
    if (rough_box(face).diagonal() <= kPoint * diagonal) return outline.box;
    const bool is_line =
        d.surface->is_planar() ? is_straight(outline.points, width) : !encloses_nothing(d) && sampled_area(d) <= least;
    return is_line ? std::optional(outline.box) : std::nullopt;
  } catch (const Standard_Failure&) {
    return std::nullopt;
  }
}

void remove_empty_faces(ImportedShape& model, std::vector<ImportFinding>& findings, const std::string& path) {
  if (model.faces.Extent() == 1 &&
      surface_type(BRep_Tool::Surface(TopoDS::Face(model.faces(1)))) == SurfaceType::kPlane)
    return;  // nothing to be sewn to
  const TopTools_MapOfShape bounding = bounding_faces(model.shape);
  std::optional<double> diagonal;  // once needed
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  int n_removed = 0;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    if (bounding.Contains(model.faces(i))) continue;
    if (!diagonal) diagonal = model.box().diagonal();
    const std::optional<Box3> box = empty_box(TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD)), *diagonal);
    if (!box) continue;
    ++n_removed;
    reshape->Remove(model.faces(i));
    const FaceAttributes& a = model.attributes[i - 1];
    const std::string& name = a.name.empty() ? a.part : a.name;
    const std::string number = model.file_label(i);
    findings.push_back({FindingKind::kEmptyFace, name.empty() ? number : number + " \"" + name + "\"", box->center(),
                        box->diagonal(), true});
  }
  if (n_removed == 0) return;
  if (!model.replace(reshape->Apply(model.shape), [&](const TopoDS_Shape& face) { return reshape->Apply(face); }))
    throw Error(ExitCode::kGeometry, path + ": no face of the file has an area; export the surfaces again");
}

void remove_null_edges(ImportedShape& model, std::vector<ImportFinding>& findings) {
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(model.shape, TopAbs_EDGE, edges);
  std::optional<double> far;  // most models have no edge that needs it
  TopTools_MapOfShape points;
  for (int e = 1; e <= edges.Extent(); ++e) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(e));
    if (!is_point(edge, std::numeric_limits<double>::max())) continue;
    if (!far) far = kPoint * model.box().diagonal();
    if (is_point(edge, *far)) points.Add(edge);
  }
  if (points.IsEmpty()) return;
  for (TopExp_Explorer f(model.shape, TopAbs_FACE); f.More(); f.Next())
    for (TopExp_Explorer w(f.Current(), TopAbs_WIRE); w.More(); w.Next()) {
      bool is_any_long = false;
      for (TopoDS_Iterator e(w.Current()); e.More(); e.Next()) is_any_long |= !points.Contains(e.Value());
      for (TopoDS_Iterator e(w.Current()); e.More(); e.Next())
        if (points.Contains(e.Value()) &&
            !(is_any_long && is_point_in_uv(TopoDS::Edge(e.Value()), TopoDS::Face(f.Current()))))
          points.Remove(e.Value());
    }
  if (points.IsEmpty()) return;
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  Box3 box;
  for (TopTools_MapOfShape::Iterator e(points); e.More(); e.Next()) {
    reshape->Remove(e.Value());
    const Box3 own = rough_box(e.Value());
    box.add(own.lo);
    box.add(own.hi);
  }
  if (model.replace(reshape->Apply(model.shape), [&](const TopoDS_Shape& face) { return reshape->Apply(face); }))
    findings.push_back(
        {FindingKind::kNullEdge, "", box.center(), box.diagonal(), true, std::to_string(points.Extent())});
}

}  // namespace st::occt
