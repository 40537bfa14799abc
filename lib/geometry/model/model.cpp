#include "geometry/model/model.h"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cstring>
#include <istream>
#include <sstream>
#include <streambuf>

#include "base/assert.h"
#include "base/error.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/model/model_impl.h"
#include "geometry/shape/analytic.h"
#include "geometry/shape/polyline.h"

namespace st {
namespace {

/// Reads a byte array as a stream without copying it.
class ByteStream : public std::streambuf {
 public:
  explicit ByteStream(const std::vector<std::byte>& bytes) {
    char* begin = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
    setg(begin, begin, begin + bytes.size());
  }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override {
    char* target = way == std::ios_base::beg   ? eback() + offset
                   : way == std::ios_base::cur ? gptr() + offset
                                               : egptr() + offset;
    if (target < eback() || target > egptr()) return pos_type(off_type(-1));
    setg(eback(), target, egptr());
    return target - eback();
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(position, std::ios_base::beg, mode);
  }
};

/// The plane of a flat chart with the chart's own (u,v): the map of its largest triangle.
std::unique_ptr<Surface> plane_of(const Chart& chart, const double* bounds) {
  const auto area = [&](const Corners& c) {
    return cross(chart.uv[c[1]] - chart.uv[c[0]], chart.uv[c[2]] - chart.uv[c[0]]);
  };
  const Corners& c = *std::max_element(chart.corners.begin(), chart.corners.end(),
                                       [&](const Corners& a, const Corners& b) { return area(a) < area(b); });
  const Vec3 a = chart.x[c[1]] - chart.x[c[0]], b = chart.x[c[2]] - chart.x[c[0]];
  const Vec2 pa = chart.uv[c[1]] - chart.uv[c[0]], pb = chart.uv[c[2]] - chart.uv[c[0]];
  const Vec3 normal = normalized(cross(a, b)), u = normalized((pb.y * a - pa.y * b) / area(c)), v = cross(normal, u);
  const Vec2 p = chart.uv[c[0]];
  return std::make_unique<PlaneSurface>(Frame{chart.x[c[0]] - p.x * u - p.y * v, u, v, normal}, bounds[0], bounds[1],
                                        bounds[2], bounds[3]);
}

std::unique_ptr<Surface> surface_of(const FacetShape& facets, const ModelTables& t, FaceId face) {
  if (t.face_type[face] != SurfaceType::kPlane) return std::make_unique<ChartSurface>(facets.chart(face));
  return plane_of(facets.chart(face), &t.face_uv_bounds[4 * static_cast<std::size_t>(face)]);
}

}  // namespace

std::vector<std::byte> occt::brep_bytes(const TopoDS_Shape& shape) {
  std::ostringstream stream(std::ios::binary);
  BinTools::Write(shape, stream);
  const std::string bytes = stream.str();
  std::vector<std::byte> result(bytes.size());
  std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

Model::Model(ModelTables tables, std::vector<std::byte> brep)
    : tables_(std::move(tables)), brep_(std::move(brep)), impl_(std::make_unique<Impl>()) {
  try {
    ByteStream buffer(brep_);
    std::istream stream(&buffer);
    BinTools::Read(impl_->shape, stream);
    if (!impl_->shape.IsNull()) {
      TopExp::MapShapes(impl_->shape, TopAbs_FACE, impl_->faces);
      TopExp::MapShapes(impl_->shape, TopAbs_EDGE, impl_->edges);
    }
  } catch (const Standard_Failure& e) {
    throw Error(ExitCode::kInput, std::string("the B-Rep of the geometry artifact cannot be read (") +
                                      e.DynamicType()->Name() + "); run st-import again");
  }
  if (impl_->faces.Extent() != tables_.n_faces() || impl_->edges.Extent() != tables_.n_edges())
    throw Error(ExitCode::kInput, "the B-Rep of the geometry artifact contradicts its tables; run st-import again");
}

Model::Model(ModelTables tables, FacetShape facets)
    : tables_(std::move(tables)), facets_(std::move(facets)), impl_(std::make_unique<Impl>()) {
  if (const std::string what = facets_.contradiction(tables_); !what.empty())
    throw Error(ExitCode::kInput,
                "the " + what + " in the geometry artifact contradict its tables; run st-import again");
}

Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

std::unique_ptr<Curve> Model::curve(EdgeId edge) const {
  ST_ASSERT(edge >= 0 && edge < tables_.n_edges() && !tables_.edge_is_degenerate[edge]);
  return impl_->curves.get(edge, [&]() -> std::unique_ptr<Curve> {
    if (!facets_.empty()) {
      const std::span<const Vec3> points = facets_.points(edge);
      return std::make_unique<PolylineCurve>(std::vector<Vec3>(points.begin(), points.end()));
    }
    double t0, t1;
    const TopoDS_Edge e = TopoDS::Edge(impl_->edges(edge + 1));
    const Handle(Geom_Curve) c = BRep_Tool::Curve(e, t0, t1);
    if (c.IsNull())
      throw Error(ExitCode::kGeometry, tables_.edge_label(edge) + " has no space curve; repair the CAD model");
    return occt::make_curve(c, t0, t1);
  });
}

std::unique_ptr<Surface> Model::surface(FaceId face) const {
  ST_ASSERT(face >= 0 && face < tables_.n_faces());
  const double* b = &tables_.face_uv_bounds[4 * static_cast<std::size_t>(face)];
  return impl_->surfaces.get(face, [&] {
    if (!facets_.empty()) return surface_of(facets_, tables_, face);
    return occt::make_surface(BRep_Tool::Surface(TopoDS::Face(impl_->faces(face + 1))), {b[0], b[1], b[2], b[3]});
  });
}

std::unique_ptr<Curve2d> Model::pcurve(FaceId face, CoedgeId coedge) const {
  ST_ASSERT(face >= 0 && face < tables_.n_faces() && coedge >= 0 && coedge < tables_.n_coedges());
  if (!facets_.empty()) {
    std::vector<Vec2> uv;
    for (std::int32_t i = facets_.coedge_node_offsets[coedge]; i < facets_.coedge_node_offsets[coedge + 1]; ++i)
      uv.push_back(facets_.node_uv[facets_.face_node_offsets[face] + facets_.coedge_nodes[i]]);
    return std::make_unique<PolylineCurve2d>(polyline_parameters(facets_.points(tables_.coedge_edge[coedge])),
                                             std::move(uv));
  }
  const TopoDS_Face f = TopoDS::Face(impl_->faces(face + 1).Oriented(TopAbs_FORWARD));
  const TopoDS_Shape e = impl_->edges(tables_.coedge_edge[coedge] + 1);
  const auto orientation = tables_.coedge_is_reversed[coedge] ? TopAbs_REVERSED : TopAbs_FORWARD;
  double t0, t1;
  const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Oriented(orientation)), f, t0, t1);
  if (c.IsNull())
    throw Error(ExitCode::kGeometry, tables_.edge_label(tables_.coedge_edge[coedge]) + " has no trimming curve on " +
                                         tables_.face_label(face) + "; repair the CAD model");
  return occt::make_curve2d(c, t0, t1);
}

}  // namespace st
