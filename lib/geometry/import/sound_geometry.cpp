#include "geometry/import/sound_geometry.h"

#include <fmt/format.h>

#include <BRep_Tool.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SweptSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/similarity.h"
#include "base/threads.h"

namespace st::occt {
namespace {

constexpr std::size_t kPointsPerPiece = 8'192;

struct ControlPoint {
  std::array<double, 3> xyz;
  const char* kind;  ///< "face", "edge", "vertex", "node"
  int number;        ///< from 1, in the shape
};

/// All points that the shape is made of, in its own frame.
class PointCollector {
 public:
  explicit PointCollector(const std::string& path) : path_(path) {}

  void add_shape(const TopoDS_Shape& shape) {
    TopTools_IndexedMapOfShape vertices, edges, faces;
    TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    begin("vertex");
    for (; number_ <= vertices.Extent(); ++number_) add(BRep_Tool::Pnt(TopoDS::Vertex(vertices(number_))), 1);
    begin("edge");
    for (; number_ <= edges.Extent(); ++number_) add_edge(TopoDS::Edge(edges(number_)));
    add_faces(faces);
  }

  void add_nodes(std::span<const Vec3> nodes) {
    points_.reserve(nodes.size());
    begin("node");
    for (const Vec3& x : nodes) {
      add(gp_Pnt(x.x, x.y, x.z), 1);
      ++number_;
    }
  }

  const std::vector<ControlPoint>& points() const { return points_; }

 private:
  void begin(const char* kind) {
    kind_ = kind;
    number_ = 1;
  }

  void add(const gp_Pnt& p, double weight) {
    if (!std::isfinite(p.X() + p.Y() + p.Z()) || !std::isfinite(weight))
      throw Error(ExitCode::kGeometry,
                  fmt::format("{}: {} {} has a point ({:.3g}, {:.3g}, {:.3g}) that is not finite; the file is damaged: "
                              "export it again from the CAD system",
                              path_, kind_, number_, p.X(), p.Y(), p.Z()));
    if (const double largest = std::max({std::abs(p.X()), std::abs(p.Y()), std::abs(p.Z())});
        largest > kLargestCoordinate)
      throw Error(
          ExitCode::kGeometry,
          fmt::format("{}: {} {} has a point ({:.3g}, {:.3g}, {:.3g}) with a coordinate beyond {:g}; the file is "
                      "damaged, or not in the unit it should be: export it again from the CAD system",
                      path_, kind_, number_, p.X(), p.Y(), p.Z(), kLargestCoordinate));
    points_.push_back({{p.X(), p.Y(), p.Z()}, kind_, number_});
  }

  /// The points of surfaces are most of all. An error is that of the first face that has one.
  void add_faces(const TopTools_IndexedMapOfShape& faces) {
    constexpr std::size_t kFacesPerPiece = 4;
    const auto n = static_cast<std::size_t>(faces.Extent());
    std::vector<PointCollector> pieces((n + kFacesPerPiece - 1) / kFacesPerPiece, PointCollector(path_));
    parallel_for(n, kFacesPerPiece, [&](std::size_t begin, std::size_t end) {
      PointCollector& own = pieces[begin / kFacesPerPiece];
      own.kind_ = "face";
      for (own.number_ = static_cast<int>(begin) + 1; own.number_ <= static_cast<int>(end); ++own.number_)
        own.add_face(TopoDS::Face(faces(own.number_)));
    });
    for (const PointCollector& own : pieces) points_.insert(points_.end(), own.points_.begin(), own.points_.end());
  }

  void add_edge(const TopoDS_Edge& edge) {
    TopLoc_Location where;
    double first = 0, last = 0;
    add_curve(BRep_Tool::Curve(edge, where, first, last), where.Transformation());
  }

  void add_face(const TopoDS_Face& face) {
    TopLoc_Location where;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, where);
    add_surface(surface, where.Transformation());
  }

  void add_curve(const Handle(Geom_Curve) & curve, const gp_Trsf& to_model) {
    if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve))
      return add_curve(trimmed->BasisCurve(), to_model);
    if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve))
      for (int i = 1; i <= spline->NbPoles(); ++i) add(spline->Pole(i).Transformed(to_model), spline->Weight(i));
    if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(curve))
      for (int i = 1; i <= bezier->NbPoles(); ++i) add(bezier->Pole(i).Transformed(to_model), bezier->Weight(i));
  }

  template <class Spline>
  void add_poles(const Spline& spline, const gp_Trsf& to_model) {
    for (int i = 1; i <= spline.NbUPoles(); ++i)
      for (int j = 1; j <= spline.NbVPoles(); ++j) add(spline.Pole(i, j).Transformed(to_model), spline.Weight(i, j));
  }

  void add_surface(const Handle(Geom_Surface) & surface, const gp_Trsf& to_model) {
    if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
      return add_surface(trimmed->BasisSurface(), to_model);
    if (const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface))
      return add_surface(offset->BasisSurface(), to_model);
    if (const auto swept = Handle(Geom_SweptSurface)::DownCast(surface)) add_curve(swept->BasisCurve(), to_model);
    if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface)) add_poles(*spline, to_model);
    if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface)) add_poles(*bezier, to_model);
  }

  const std::string& path_;
  const char* kind_ = "";
  int number_ = 1;
  std::vector<ControlPoint> points_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::array<double, 3> middle_of(const std::vector<ControlPoint>& points) {
  std::array<double, 3> middle{};
  parallel_for(3, 1, [&](std::size_t d, std::size_t) {
    std::vector<double> coordinate(points.size());
    std::transform(points.begin(), points.end(), coordinate.begin(), [d](const ControlPoint& p) { return p.xyz[d]; });
    middle[d] = median(std::move(coordinate));
  });
  return middle;
}

/// No point lies absurdly far from most others.
void require_close_points(const std::vector<ControlPoint>& points, const std::string& path) {
  if (points.empty()) return;
  const std::array<double, 3> middle = middle_of(points);
  std::vector<double> distance(points.size());
  parallel_for(points.size(), kPointsPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& x = points[i].xyz;
      distance[i] = std::hypot(x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]);
    }
  });
  const auto farthest = std::max_element(distance.begin(), distance.end());
  constexpr double kRounding = 1e-14;  // of the farthest: half of the points are at one place
  const double usual = median(distance);
  if (usual <= kRounding * *farthest || *farthest <= kFarthestPoint * usual) return;
  const ControlPoint& p = points[static_cast<std::size_t>(farthest - distance.begin())];
  throw Error(ExitCode::kGeometry,
              fmt::format("{}: {} {} has a point ({:.3g}, {:.3g}, {:.3g}), {:.1g} times as far away as half of the "
                          "model's points ({:.3g}); the file is damaged, or that part is to be left out",
                          path, p.kind, p.number, p.xyz[0], p.xyz[1], p.xyz[2], *farthest / usual, usual));
}

}  // namespace

void require_sound_geometry(const TopoDS_Shape& shape, const std::string& path) {
  PointCollector collector(path);
  collector.add_shape(shape);
  require_close_points(collector.points(), path);
}

void require_sound_nodes(std::span<const Vec3> nodes, const std::string& path) {
  PointCollector collector(path);
  collector.add_nodes(nodes);
  require_close_points(collector.points(), path);
}

void require_sound_boxes(std::span<const Box3> face_box, const std::string& path) {
  for (std::size_t f = 0; f < face_box.size(); ++f)
    for (const Vec3& x : {face_box[f].lo, face_box[f].hi})
      if (!(std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) <= kLargestCoordinate))
        throw Error(ExitCode::kGeometry, fmt::format("{}: face {} reaches to ({:.3g}, {:.3g}, {:.3g}), beyond {:g}; "
                                                     "the file is damaged: export it again from the CAD system",
                                                     path, f + 1, x.x, x.y, x.z, kLargestCoordinate));
}

}  // namespace st::occt
