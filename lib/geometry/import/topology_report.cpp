#include "geometry/import/topology_report.h"

#include <BRepCheck.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_ListIteratorOfListOfStatus.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <cctype>
#include <sstream>

#include "base/error.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/import.h"
#include "geometry/model/model_state.h"

namespace st::occt {
namespace {

Vec3 middle(const ModelTables& t, EdgeId e) {
  return 0.5 * (t.vertex_xyz[t.edge_vertices[2 * e]] + t.vertex_xyz[t.edge_vertices[2 * e + 1]]);
}

void report_edges(double small, ImportResult& result) {
  const ModelTables& t = result.tables;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e]) continue;
    const double tolerance = std::max({t.edge_tolerance[e], t.vertex_tolerance[t.edge_vertices[2 * e]],
                                       t.vertex_tolerance[t.edge_vertices[2 * e + 1]]});
    if (t.edge_length[e] < small)
      result.findings.push_back({FindingKind::kShortEdge, t.edge_label(e), middle(t, e), t.edge_length[e], false});
    if (t.edge_length[e] < tolerance)
      result.findings.push_back({FindingKind::kLooseEdgeTolerance, t.edge_label(e), middle(t, e), tolerance, false});
  }
}

/// Vertices whose edges end further apart than `small`: an edge is missing in the file, or the loops do not close.
void report_gaps(const ImportedShape& model, double small, ImportResult& result) {
  const ModelTables& t = result.tables;
  std::vector<double> gap(t.n_vertices(), 0);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(model.shape, TopAbs_EDGE, edges);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e]) continue;
    double t0, t1;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges(e + 1)), t0, t1);
    if (curve.IsNull()) continue;
    for (const auto& [end, at] : {std::pair{0, t0}, std::pair{1, t1}}) {
      const VertexId v = t.edge_vertices[2 * e + end];
      gap[v] = std::max(gap[v], distance(vec(curve->Value(at)), t.vertex_xyz[v]));
    }
  }
  for (VertexId v = 0; v < t.n_vertices(); ++v)
    if (gap[v] > small)
      result.findings.push_back(
          {FindingKind::kOpenVertex, "vertex " + std::to_string(v + 1), t.vertex_xyz[v], gap[v], false});
}

double edge_tolerance(const ModelTables& t, FaceId f) {
  double tolerance = t.face_tolerance[f];
  for (const EdgeId e : t.edges_of(f)) tolerance = std::max(tolerance, t.edge_tolerance[e]);
  return tolerance;
}

void report_faces(const FaceMeasures& measures, double small, ImportResult& result) {
  const ModelTables& t = result.tables;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const Vec3 at = t.face_box[f].center();
    const double tolerance = edge_tolerance(t, f);
    if (t.face_width[f] < small)
      result.findings.push_back({FindingKind::kSliverFace, t.face_label(f), at, t.face_width[f], false});
    if (t.face_width[f] < tolerance)
      result.findings.push_back({FindingKind::kLooseFaceTolerance, t.face_label(f), at, tolerance, false});
    if (const auto& c = measures.crossing[f])
      result.findings.push_back({FindingKind::kCrossingLoop, t.face_label(f), c->xyz, c->size, false});
  }
}

/// "BRepCheck_InvalidCurveOnSurface" -> "invalid curve on surface".
std::string words(BRepCheck_Status status) {
  std::ostringstream stream;
  BRepCheck::Print(status, stream);
  std::string name = stream.str(), text;
  if (const std::size_t prefix = name.find('_'); prefix != std::string::npos) name.erase(0, prefix + 1);
  for (const char c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) continue;
    if (std::isupper(static_cast<unsigned char>(c)) && !text.empty()) text += ' ';
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

std::string first_status(const BRepCheck_ListOfStatus& list) {
  for (BRepCheck_ListIteratorOfListOfStatus s(list); s.More(); s.Next())
    if (s.Value() != BRepCheck_NoError) return words(s.Value());
  return {};
}

/// Why the checker calls `shape` invalid: its own status, else that of the first wire or edge in it.
std::string cause(const BRepCheck_Analyzer& checker, const TopoDS_Shape& shape) {
  if (const auto& own = checker.Result(shape); !own.IsNull())
    if (std::string text = first_status(own->Status()); !text.empty()) return text;
  for (const auto kind : {TopAbs_FACE, TopAbs_WIRE, TopAbs_EDGE, TopAbs_VERTEX})
    for (TopExp_Explorer e(shape, kind); e.More(); e.Next()) {
      const auto& part = checker.Result(e.Current());
      if (part.IsNull()) continue;
      if (std::string text = first_status(part->Status()); !text.empty()) return text;
      for (part->InitContextIterator(); part->MoreShapeInContext(); part->NextShapeInContext())
        if (std::string text = first_status(part->StatusOnShape()); !text.empty()) return text;
    }
  return "cause unknown";
}

}  // namespace

void report_groups(const std::vector<EmptyGroup>& groups, ImportResult& result) {
  for (const EmptyGroup& g : groups) {
    const char* member = g.of == EntityDim::kFace ? "a face" : g.of == EntityDim::kEdge ? "an edge" : "a vertex";
    result.findings.push_back({FindingKind::kEmptyGroup, "group \"" + g.name + "\"", {}, 0, false, member});
  }
}

void report_uses(ImportResult& result) {
  result.edge_uses = report_edge_uses(result.tables);
  const std::vector<ImportFinding>& found = result.edge_uses.findings;
  result.findings.insert(result.findings.end(), found.begin(), found.end());
  result.is_closed = is_closed(result.tables, result.edge_uses);
}

void require_closed(const ImportResult& result, const std::string& path) {
  if (!result.is_closed && result.edge_uses.n_free == 0 && result.edge_uses.n_contradictory > 0)
    throw Error(ExitCode::kGeometry, path +
                                         ": the model encloses no volume: its faces disagree which side is outside; "
                                         "repair it in the CAD system, or import without --require-closed");
  if (!result.is_closed)
    throw Error(ExitCode::kGeometry, path + ": the model is open: " + std::to_string(result.edge_uses.n_free) +
                                         " free edges; close it in the CAD system, or import without --require-closed");
}

void report_topology(const ImportedShape& model, const FaceMeasures& measures, double small, ImportResult& result) {
  report_uses(result);
  report_faces(measures, small, result);
  report_edges(small, result);
  report_gaps(model, small, result);
  for (double a : result.tables.face_area) result.area += a;
  if (!result.is_closed) return;
  std::vector<int> n_sides(result.tables.n_faces(), 0);
  for (TopExp_Explorer e(model.shape, TopAbs_FACE); e.More(); e.Next()) {
    const int f = model.faces.FindIndex(e.Current()) - 1;
    result.volume += (e.Current().Orientation() == TopAbs_REVERSED ? -1 : 1) * measures.cone_volume[f];
    ++n_sides[f];
  }
  const bool has_interfaces = std::any_of(n_sides.begin(), n_sides.end(), [](int n) { return n > 1; });  // a mesh has
                                                                                                         // them once
  if (!has_interfaces) result.tables.volume = result.volume;
}

void report_validity(const ImportedShape& model, ImportResult& result) {
  const ModelTables& t = result.tables;
  const BRepCheck_Analyzer checker(model.shape);
  if (checker.IsValid()) return;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (!checker.IsValid(model.faces(f + 1)))
      result.findings.push_back({FindingKind::kInvalidFace, t.face_label(f), t.face_box[f].center(),
                                 t.face_box[f].diagonal(), false, cause(checker, model.faces(f + 1))});
  for (const auto& [kind, name] : {std::pair{TopAbs_SHELL, "shell"}, std::pair{TopAbs_SOLID, "solid"}}) {
    TopTools_IndexedMapOfShape map;
    TopExp::MapShapes(model.shape, kind, map);
    for (int i = 1; i <= map.Extent(); ++i) {
      if (checker.IsValid(map(i))) continue;
      const Box3 box = rough_box(map(i));
      result.findings.push_back({kind == TopAbs_SHELL ? FindingKind::kInvalidShell : FindingKind::kInvalidSolid,
                                 std::string(name).append(" ").append(std::to_string(i)), box.center(), box.diagonal(),
                                 false, cause(checker, map(i))});
    }
  }
}

}  // namespace st::occt
