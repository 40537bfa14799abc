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
#include <cmath>
#include <cstring>
#include <istream>
#include <span>
#include <sstream>
#include <streambuf>

#include "base/assert.h"
#include "base/error.h"
#include "base/memory.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/model/model_impl.h"
#include "geometry/shape/analytic.h"
#include "geometry/shape/chain_curve.h"
#include "geometry/shape/composite_surface.h"
#include "geometry/shape/polyline.h"

namespace st {
namespace {

/// Bytes in memory, read where they are.
class ByteStream : public std::streambuf {
 public:
  explicit ByteStream(std::span<const std::byte> bytes) {
    char* begin = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
    setg(begin, begin, begin + bytes.size());
  }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override {
    char* target = (way == std::ios_base::beg ? eback() : way == std::ios_base::cur ? gptr() : egptr()) + offset;
    if (target < eback() || target > egptr()) return pos_type(off_type(-1));
    setg(eback(), target, egptr());
    return target - eback();
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(position, std::ios_base::beg, mode);
  }
};

/// Null where there is none in the bytes.
TopoDS_Shape shape_of(const std::vector<std::byte>& brep) try {
  ByteStream buffer(brep);
  std::istream stream(&buffer);
  TopoDS_Shape shape;
  BinTools::Read(shape, stream);
  return shape;
} catch (const Standard_Failure& e) {
  throw Error(ExitCode::kInput, std::string("the B-Rep of the geometry artifact cannot be read (") +
                                    e.DynamicType()->Name() + "); run st-import again");
}

/// The plane of a flat chart with the chart's own (u,v), which are places in it: the one nearest to all nodes, along
/// their longest extent first. A single triangle of a fine chart would tilt it.
std::unique_ptr<Surface> plane_of(const Chart& chart, const double* bounds) {
  Vec3 middle{}, along{}, across{};
  Vec2 center{};
  const double share = 1 / static_cast<double>(chart.x.size());
  for (std::size_t n = 0; n < chart.x.size(); ++n) {
    middle += share * chart.x[n];
    center = center + share * chart.uv[n];
  }
  double uu = 0, uv = 0, vv = 0;
  for (const Vec2 p : chart.uv) {
    const Vec2 d = p - center;
    uu += d.x * d.x, uv += d.x * d.y, vv += d.y * d.y;
  }
  const double turn = 0.5 * std::atan2(2 * uv, uu - vv), cosine = std::cos(turn), sine = std::sin(turn);
  for (std::size_t n = 0; n < chart.x.size(); ++n) {
    const Vec2 d = chart.uv[n] - center;
    along += (cosine * d.x + sine * d.y) * (chart.x[n] - middle);
    across += (cosine * d.y - sine * d.x) * (chart.x[n] - middle);
  }
  along = normalized(along);
  across = normalized(across - dot(across, along) * along);
  const Vec3 u = cosine * along - sine * across, v = sine * along + cosine * across;
  return std::make_unique<PlaneSurface>(Frame{middle - center.x * u - center.y * v, u, v, cross(u, v)}, bounds[0],
                                        bounds[1], bounds[2], bounds[3]);
}

ChainParameters parameters_of(const ModelTables& cad, std::span<const EdgePiece> pieces) {
  std::vector<ChainParameters::Piece> parameters;
  for (const EdgePiece& p : pieces) {
    const double* range = &cad.edge_range[2 * static_cast<std::size_t>(p.edge)];
    parameters.push_back({range[p.is_reversed ? 1 : 0], range[p.is_reversed ? 0 : 1],
                          cad.edge_length[static_cast<std::size_t>(p.edge)]});
  }
  return ChainParameters(std::move(parameters));
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
  impl_->shape = shape_of(brep_);
  if (!impl_->shape.IsNull()) {
    TopExp::MapShapes(impl_->shape, TopAbs_FACE, impl_->faces);
    TopExp::MapShapes(impl_->shape, TopAbs_EDGE, impl_->edges);
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

Model::Model(ModelTables cad, std::vector<std::byte> brep, Composites composites) : impl_(std::make_unique<Impl>()) {
  if (const std::string what = composites.contradiction(cad); !what.empty())
    throw Error(ExitCode::kInput,
                "the " + what + " in the geometry artifact contradict its tables; run st-import again");
  impl_->composites = std::move(composites);
  impl_->joined = join_tables(cad, impl_->composites);
  tables_ = std::move(impl_->joined.tables);
  impl_->cad = std::make_unique<Model>(std::move(cad), std::move(brep));
}

Model::~Model() {
  if (impl_ && ends_with_memory()) keep_to_end(std::move(impl_));  // OpenCASCADE frees thousands of small objects
}
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

const Model& Model::cad() const { return impl_->cad ? *impl_->cad : *this; }

std::vector<FaceId> Model::cad_faces(FaceId face, std::span<const Vec2> uv) const {
  const std::int32_t i = impl_->cad ? impl_->joined.composite[face] : kNone;
  if (i == kNone) return std::vector<FaceId>(uv.size(), face);
  const ChartSurface chart(impl_->composites.chart(i));
  const std::span<const FaceId> of_triangle =
      std::span(impl_->composites.triangle_face)
          .subspan(static_cast<std::size_t>(impl_->composites.triangle_offsets[i]));
  std::vector<FaceId> faces;
  for (const Vec2 p : uv) faces.push_back(of_triangle[static_cast<std::size_t>(chart.locate(p).triangle)]);
  return faces;
}

std::unique_ptr<Curve> Model::Impl::chain(EdgeId edge) const {
  const std::span<const EdgePiece> pieces = joined.pieces_of(edge);
  if (pieces.size() == 1) return cad->curve(pieces[0].edge);
  std::vector<std::unique_ptr<Curve>> curves;
  for (const EdgePiece& p : pieces) curves.push_back(cad->curve(p.edge));
  return std::make_unique<ChainCurve>(parameters_of(cad->tables(), pieces), std::move(curves));
}

std::unique_ptr<Surface> Model::Impl::composite(std::int32_t i, SurfaceType type, const double* bounds) {
  if (type == SurfaceType::kPlane) return plane_of(composites.chart(i), bounds);
  const std::span<const FaceId> faces = composites.members(i);
  std::vector<std::unique_ptr<Surface>> members;
  for (const FaceId f : faces) members.push_back(cad->surface(f));
  return composite_charts.get(i, std::move(members), [&](std::vector<std::unique_ptr<Surface>> own) {
    CompositeSupport support;
    for (auto t = static_cast<std::size_t>(composites.triangle_offsets[i]);
         t < static_cast<std::size_t>(composites.triangle_offsets[i + 1]); ++t) {
      const auto at = std::ranges::lower_bound(faces, composites.triangle_face[t]) - faces.begin();
      support.member.push_back(static_cast<std::int32_t>(at));
      support.corner_uv.push_back(composites.triangle_uv[t]);
      support.pole.push_back(composites.triangle_pole[t]);
    }
    return std::make_unique<CompositeSurface>(composites.chart(i), std::move(support), std::move(own),
                                              std::array{bounds[0], bounds[1], bounds[2], bounds[3]});
  });
}

std::unique_ptr<Curve2d> Model::Impl::rim(std::int32_t i, CoedgeId coedge) const {
  const std::int32_t row = composites.rim(coedge);
  const auto first = static_cast<std::size_t>(composites.triangle_offsets[i]),
             first_node = static_cast<std::size_t>(composites.node_offsets[i]);
  std::vector<RimCurve2d::Segment> segments;
  FaceId face = kNone;
  for (std::int32_t k = composites.rim_offsets[row]; k + 1 < composites.rim_offsets[row + 1]; ++k) {
    const std::size_t t = first + static_cast<std::size_t>(composites.rim_triangle[k]);
    std::array<Vec2, 3> places;
    for (std::size_t c = 0; c < 3; ++c)
      places[c] = composites.node_uv[first_node + static_cast<std::size_t>(composites.triangle_nodes[t][c])];
    segments.push_back(
        {composites.rim_t[k], MemberMap(places, composites.triangle_uv[t], composites.triangle_pole[t])});
    face = composites.triangle_face[t];
  }
  return std::make_unique<RimCurve2d>(cad->pcurve(face, coedge), std::move(segments));
}

std::unique_ptr<Curve2d> Model::Impl::trimming(FaceId face, CoedgeId coedge, EdgeId edge) const {
  const std::int32_t i = joined.composite[face];
  std::vector<std::unique_ptr<Curve2d>> curves;
  for (const CoedgeId c : joined.pieces_of_coedge(coedge))
    curves.push_back(i == kNone ? cad->pcurve(face, c) : rim(i, c));
  if (curves.size() == 1) return std::move(curves[0]);
  return std::make_unique<ChainCurve2d>(parameters_of(cad->tables(), joined.pieces_of(edge)), std::move(curves));
}

std::unique_ptr<Curve> Model::curve(EdgeId edge) const {
  ST_ASSERT(edge >= 0 && edge < tables_.n_edges() && !tables_.edge_is_degenerate[edge]);
  return impl_->curves.get(edge, [&]() -> std::unique_ptr<Curve> {
    if (impl_->cad) return impl_->chain(edge);
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
  return impl_->surfaces.get(face, [&]() -> std::unique_ptr<Surface> {
    if (impl_->cad) {
      const std::int32_t composite = impl_->joined.composite[face];
      return composite == kNone ? impl_->cad->surface(face) : impl_->composite(composite, tables_.face_type[face], b);
    }
    if (!facets_.empty()) return surface_of(facets_, tables_, face);
    return occt::make_surface(BRep_Tool::Surface(TopoDS::Face(impl_->faces(face + 1))), {{b[0], b[2]}, {b[1], b[3]}});
  });
}

std::unique_ptr<Curve2d> Model::pcurve(FaceId face, CoedgeId coedge) const {
  ST_ASSERT(face >= 0 && face < tables_.n_faces() && coedge >= 0 && coedge < tables_.n_coedges());
  if (impl_->cad) return impl_->trimming(face, coedge, tables_.coedge_edge[coedge]);
  if (!facets_.empty()) {
    std::vector<Vec2> uv;
    for (std::int32_t i = facets_.coedge_node_offsets[coedge]; i < facets_.coedge_node_offsets[coedge + 1]; ++i)
      uv.push_back(facets_.node_uv[facets_.face_node_offsets[face] + facets_.coedge_nodes[i]]);
    return std::make_unique<PolylineCurve2d>(polyline_parameters(facets_.points(tables_.coedge_edge[coedge])),
                                             std::move(uv));
  }
  const auto find = [&]() -> Handle(Geom2d_Curve) {
    const TopoDS_Face f = TopoDS::Face(impl_->faces(face + 1).Oriented(TopAbs_FORWARD));
    const TopoDS_Shape e = impl_->edges(tables_.coedge_edge[coedge] + 1);
    const auto orientation = tables_.coedge_is_reversed[coedge] ? TopAbs_REVERSED : TopAbs_FORWARD;
    double t0, t1;
    return BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Oriented(orientation)), f, t0, t1);
  };
  const bool is_projected = tables_.face_type[face] == SurfaceType::kPlane;  // by OpenCASCADE, whenever it is asked
  const Handle(Geom2d_Curve) c = is_projected ? impl_->pcurves_on_planes.get(coedge, find) : find();
  if (c.IsNull())
    throw Error(ExitCode::kGeometry, tables_.edge_label(tables_.coedge_edge[coedge]) + " has no trimming curve on " +
                                         tables_.face_label(face) + "; repair the CAD model");
  const double* range = &tables_.edge_range[2 * static_cast<std::size_t>(tables_.coedge_edge[coedge])];
  return occt::make_curve2d(c, range[0], range[1]);
}

}  // namespace st
