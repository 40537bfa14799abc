#include "stages/cad_view.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "features/base_strips.h"
#include "features/certain_wing_edges.h"
#include "features/face_roles.h"
#include "features/strip.h"
#include "features/wing_edges.h"
#include "geometry/model/facets.h"

namespace st {
namespace {

// Of the diagonal: what an eye sees of the whole model.
constexpr double kDeflection = 2e-4;
constexpr double kFacetTurn = radians(8);  // of the normal along a facet: flat shading shows more
constexpr double kTurn = radians(5);       // between two segments of an edge
constexpr int kMaxSegments = 256;
constexpr std::uint8_t kPoint = 1, kLine = 3, kTriangle = 5;  // VTK's cell types

/// Adds cells and the values that all of them have.
class CellAdder {
 public:
  struct Values {
    std::int32_t dim = 0, id = 0, group = 0, part = 0, wing_edge = 0, finding = 0;
  };
  void add(std::uint8_t type, std::span<const std::int32_t> nodes, const Values& v) {
    view.nodes.insert(view.nodes.end(), nodes.begin(), nodes.end());
    view.offsets.push_back(static_cast<std::int64_t>(view.nodes.size()));
    view.types.push_back(type);
    const std::int32_t all[] = {v.dim, v.id, v.group, v.part, v.wing_edge, v.finding};
    for (std::size_t k = 0; k < std::size(all); ++k) view.values[k].second.push_back(all[k]);
  }
  std::int32_t add_point(Vec3 x) {
    view.points.push_back(x);
    return static_cast<std::int32_t>(view.points.size()) - 1;
  }
  CellView view{
      {}, {}, {}, {}, {{"dim", {}}, {"id", {}}, {"group", {}}, {"part", {}}, {"wing_edge", {}}, {"finding", {}}}, {}};
};

/// Kinds of findings as numbers from 1, and which faces and edges have which; where several, the first.
struct FindingNumbers {
  std::vector<std::string> kinds;
  std::vector<std::int32_t> of_finding;
  std::map<std::string, std::int32_t> of_entity;  ///< "face 17"

  explicit FindingNumbers(std::span<const ImportFinding> findings) {
    for (const ImportFinding& f : findings) {
      const std::string kind = name_of(f.kind);
      auto at = std::find(kinds.begin(), kinds.end(), kind);
      if (at == kinds.end()) at = kinds.insert(kinds.end(), kind);
      of_finding.push_back(static_cast<std::int32_t>(at - kinds.begin()) + 1);
      const std::size_t name = f.entity.find(' ', f.entity.find(' ') + 1);  // "edge 12 "TE"", "face 3 (17 of the CAD)"
      of_entity.emplace(f.entity.substr(0, name), of_finding.back());
    }
  }
  std::int32_t of(const char* what, std::int32_t id) const {
    const auto at = of_entity.find(std::string(what).append(" ").append(std::to_string(id + 1)));
    return at == of_entity.end() ? 0 : at->second;
  }
};

void add_faces(const Model& model, const FindingNumbers& findings, CellAdder& cells) {
  const ModelTables& t = model.tables();
  const Facets facets = facets_to_see(model);
  const auto first = static_cast<std::int32_t>(cells.view.points.size());
  cells.view.points.insert(cells.view.points.end(), facets.xyz.begin(), facets.xyz.end());
  for (std::size_t i = 0; i < facets.triangle.size(); ++i) {
    const FaceId f = facets.face[i];
    std::array<std::int32_t, 3> nodes = facets.triangle[i];
    for (std::int32_t& n : nodes) n += first;
    const std::int32_t part = t.labels.face_part.empty() ? kNone : t.labels.face_part[f];
    cells.add(kTriangle, nodes, {2, f + 1, t.labels.face_group[f] + 1, part + 1, 0, findings.of("face", f)});
  }
}

void add_edges(const Model& model, const FindingNumbers& findings, CellAdder& cells) {
  const ModelTables& t = model.tables();
  std::vector<std::int32_t> wing_edge(t.n_edges(), 0);
  for (const WingEdge& w : wing_edges_to_see(model)) wing_edge[w.edge] = w.kind == WingEdgeKind::kLeading ? 2 : 1;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e]) continue;
    std::int32_t last = kNone;
    for (const Vec3& x : line_to_see(*model.curve(e))) {
      const std::array<std::int32_t, 2> nodes = {last, cells.add_point(x)};
      if (last != kNone) cells.add(kLine, nodes, {1, e + 1, 0, 0, wing_edge[e], findings.of("edge", e)});
      last = nodes[1];
    }
  }
}

}  // namespace

Facets facets_to_see(const Model& model) {
  const ModelTables& t = model.tables();
  std::vector<std::uint8_t> is_near, is_far;
  for (const FaceRole role : face_roles(t).role) {
    is_far.push_back(role == FaceRole::kFarfield);
    is_near.push_back(!is_far.back());
  }
  const auto within = [](double diagonal) {
    return FacetLimits{.deflection = kDeflection * diagonal, .angle = kFacetTurn, .is_exact = true};
  };
  Facets facets = make_facets(model, is_near, within(t.reference_diagonal()));
  add_facets(model, is_far, within(t.box().diagonal()), SerialExecutor(), facets);
  return facets;
}

std::vector<Vec3> line_to_see(const Curve& curve) {
  const auto place = [&](int i, int n) { return curve.t_min() + i * (curve.t_max() - curve.t_min()) / n; };
  int n = 4;
  for (; n < kMaxSegments; n *= 2) {
    double worst = 0;
    Vec3 last = curve.evaluate(curve.t_min()).d1;
    for (int i = 1; i <= n; ++i) {
      const Vec3 d = curve.evaluate(place(i, n)).d1;
      worst = std::max(worst, angle_between(last, d));
      last = d;
    }
    if (worst <= kTurn) break;
  }
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i) points.push_back(curve.point(place(i, n)));
  return points;
}

std::vector<WingEdge> wing_edges_to_see(const Model& model) {
  const FaceRoles in_space = face_roles(model.tables());
  const std::vector<Strip> strips = find_base_strips(model, find_strips(model));
  std::optional<std::vector<WingEdge>> found =
      find_certain_wing_edges(model, in_space, strips, bound_reference_diagonal(model, in_space));
  return found ? *std::move(found) : find_wing_edges(model, face_roles(model), strips);  // by facets of all faces
}

CellView view_cad(const Model& model, std::span<const ImportFinding> findings) {
  const ModelTables& t = model.tables();
  const FindingNumbers numbers(findings);
  CellAdder cells;
  add_faces(model, numbers, cells);
  add_edges(model, numbers, cells);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const std::int32_t node = cells.add_point(findings[i].xyz);
    cells.add(kPoint, std::span(&node, 1), {0, static_cast<std::int32_t>(i) + 1, 0, 0, 0, numbers.of_finding[i]});
  }
  cells.view.names = {{"face", t.labels.face_name},
                      {"edge", t.edge_name},
                      {"group", t.labels.group_name},
                      {"part", t.labels.part_path},
                      {"finding", numbers.kinds}};
  return std::move(cells.view);
}

}  // namespace st
