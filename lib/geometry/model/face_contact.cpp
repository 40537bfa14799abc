// Model::contacts(): where two faces meet although they share nothing there.
#include <fmt/format.h>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Section.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <atomic>
#include <cmath>

#include "base/boxes.h"
#include "base/child_process.h"
#include "base/error.h"
#include "base/log.h"
#include "base/packer.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/model/model.h"
#include "geometry/model/model_impl.h"

namespace st {
namespace {

constexpr int kSamples = 33;
constexpr double kMostSeconds = 10;  // for two faces: damaged surfaces may take OpenCASCADE for ever, or crash it
constexpr int kMostGivenUp = 3;      // pairs of faces; then no more are tried
constexpr double kTangent = 0.9998;  // cosine of 1 degree: the faces touch, they do not cross

/// Edges and vertices as one shape to measure distances to; null when there is none.
TopoDS_Shape as_one(const std::vector<TopoDS_Shape>& shapes) {
  return shapes.empty() ? TopoDS_Shape() : occt::compound_of(shapes);
}

std::vector<TopoDS_Shape> subshapes(const TopoDS_Shape& face, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(face, type, map);
  std::vector<TopoDS_Shape> result;
  for (int i = 1; i <= map.Extent(); ++i)
    if (type != TopAbs_EDGE || !BRep_Tool::Degenerated(TopoDS::Edge(map(i)))) result.push_back(map(i));
  return result;
}

/// What both faces have: edges and vertices.
TopoDS_Shape shared_by(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  std::vector<TopoDS_Shape> shared;
  for (const TopAbs_ShapeEnum type : {TopAbs_EDGE, TopAbs_VERTEX})
    for (const TopoDS_Shape& s : subshapes(a, type))
      for (const TopoDS_Shape& t : subshapes(b, type))
        if (s.IsSame(t)) shared.push_back(s);
  return as_one(shared);
}

double distance_to(const TopoDS_Shape& shape, const gp_Pnt& p) {
  if (shape.IsNull()) return 1e300;
  const BRepExtrema_DistShapeShape d(BRepBuilderAPI_MakeVertex(p).Vertex(), shape);
  return d.IsDone() ? d.Value() : 1e300;
}

gp_Vec normal_at(const TopoDS_Face& face, const gp_Pnt& p) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  GeomAPI_ProjectPointOnSurf foot(p, surface);
  if (foot.NbPoints() == 0) return {};
  double u, v;
  foot.LowerDistanceParameters(u, v);
  GeomLProp_SLProps properties(surface, u, v, 1, 1e-12);
  return properties.IsNormalDefined() ? gp_Vec(properties.Normal()) : gp_Vec();
}

/// Both faces go on beyond the curve, and not the same way.
bool passes_through(const TopoDS_Face& a, const TopoDS_Face& b, const gp_Pnt& p, double tolerance) {
  for (const TopoDS_Face& face : {a, b})
    if (distance_to(as_one(subshapes(face, TopAbs_EDGE)), p) <= tolerance) return false;
  return std::abs(normal_at(a, p).Dot(normal_at(b, p))) < kTangent;
}

/// The pieces of a section curve that keep away from what the faces share, each up to the sample where it comes near.
void add_pieces(const TopoDS_Edge& edge, const TopoDS_Shape& shared, double tolerance, bool passes_through,
                std::vector<FaceContact>& result) {
  const BRepAdaptor_Curve curve(edge);
  const double t0 = curve.FirstParameter(), t1 = curve.LastParameter();
  std::vector<Vec3> points;
  std::vector<char> is_away;
  for (int k = 0; k < kSamples; ++k) {
    const gp_Pnt p = curve.Value(t0 + (t1 - t0) * k / (kSamples - 1));
    points.push_back(occt::vec(p));
    is_away.push_back(distance_to(shared, p) > tolerance);
  }
  for (int first = 0; first < kSamples; ++first) {
    if (!is_away[first]) continue;
    int last = first;
    while (last + 1 < kSamples && is_away[last + 1]) ++last;
    result.push_back(
        {{points.begin() + std::max(0, first - 1), points.begin() + std::min(kSamples, last + 2)}, passes_through});
    first = last;
  }
}

std::vector<FaceContact> find_contacts(const TopoDS_Face& a, const TopoDS_Face& b, double tolerance) {
  std::vector<FaceContact> result;
  try {
    BRepAlgoAPI_Section section(a, b, false);
    section.Approximation(false);
    section.Build();
    if (!section.IsDone()) return {};
    const TopoDS_Shape shared = shared_by(a, b);
    for (TopExp_Explorer e(section.Shape(), TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      const BRepAdaptor_Curve curve(edge);
      const gp_Pnt middle = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
      add_pieces(edge, shared, tolerance, passes_through(a, b, middle, tolerance), result);
    }
    for (TopExp_Explorer v(section.Shape(), TopAbs_VERTEX, TopAbs_EDGE); v.More(); v.Next())
      if (const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(v.Current())); distance_to(shared, p) > tolerance)
        result.push_back({{occt::vec(p)}, false});
  } catch (const Standard_Failure&) {
    return {};
  }
  return result;
}

/// Of the bytes that a child gives back.
std::vector<FaceContact> contacts_of(const std::string& text) {
  const Bytes bytes(reinterpret_cast<const Bytes::value_type*>(text.data()),
                    reinterpret_cast<const Bytes::value_type*>(text.data()) + text.size());
  std::vector<FaceContact> contacts;
  unpack(bytes, contacts);
  return contacts;
}

}  // namespace

std::vector<FaceContact> Model::contacts(FaceId first, FaceId second) const {
  if (impl_->cad) {
    std::vector<FaceContact> all;
    for (const FaceId a : impl_->cad_faces(first))
      for (const FaceId b : impl_->cad_faces(second)) {
        const ModelTables& cad = impl_->cad->tables();
        if (a == b || !meet(cad.face_box[a], cad.face_box[b])) continue;
        std::vector<FaceContact> found = impl_->cad->contacts(a, b);
        all.insert(all.end(), found.begin(), found.end());
      }
    return all;
  }
  static std::atomic<int> n_given_up = 0;
  if (n_given_up >= kMostGivenUp || !facets_.empty()) return {};
  const TopoDS_Face a = TopoDS::Face(impl_->faces(first + 1)), b = TopoDS::Face(impl_->faces(second + 1));
  const double tolerance =
      std::max({1e-6 * tables_.box().diagonal(), occt::max_edge_tolerance(a), occt::max_edge_tolerance(b)});
  const auto find = [&] {
    const Bytes bytes = packed(find_contacts(a, b, tolerance));
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  try {
    return contacts_of(run_in_child(find, {kMostSeconds, "", 2 * kMostSeconds}, "damaged surfaces"));
  } catch (const Error&) {
    ++n_given_up;
    log_warning(
        fmt::format("where {} and {} meet was not found, OpenCASCADE crashed or took more than {} s: what "
                    "crosses there counts as a fault",
                    tables_.face_label(first), tables_.face_label(second), kMostSeconds));
  }
  return {};
}

}  // namespace st
