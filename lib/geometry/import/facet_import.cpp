#include "geometry/import/facet_import.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/equal_points.h"
#include "base/error.h"
#include "base/length.h"
#include "base/log.h"
#include "geometry/facet/facet_cuts.h"
#include "geometry/facet/facet_faces.h"
#include "geometry/facet/facet_model.h"
#include "geometry/facet/facet_repair.h"
#include "geometry/facet/facet_smoothing.h"
#include "geometry/import/facet_air.h"
#include "geometry/import/half_model.h"
#include "geometry/import/model_unit.h"
#include "geometry/import/sound_geometry.h"
#include "geometry/import/taken_roles.h"
#include "geometry/import/text_encoding.h"
#include "geometry/import/topology_report.h"
#include "geometry/model/group_selection.h"

namespace st {
namespace {

void require_known(const ImportOptions& o, const std::string& path) {
  const std::pair<const char*, bool> given[] = {{"--sew", !o.sew.empty()},
                                                {"--mirror", !o.air.mirror.empty()},
                                                {"--replace-farfield", !o.air.replace_farfield.empty()},
                                                {"--flow-domain", o.air.flow_domain != AirOptions().flow_domain},
                                                {"--join", o.join_touching},
                                                {"--unite", o.unite},
                                                {"--cap", o.cap}};
  for (const auto& [option, is_given] : given)
    if (is_given)
      throw Error(ExitCode::kUsage, fmt::format("{}: {} needs a CAD model, and this file has facets", path, option));
  if (o.unit.empty())
    throw Error(ExitCode::kUsage, path + ": facets have no unit; say with --unit in which one the file was written");
}

/// As of CAD: with a second far field the air would be there twice.
void require_no_air(const FacetInput& input, const std::string& path) {
  for (const std::string& name : input.part_name)
    if (role_of_name(name) == "farfield")
      throw Error(ExitCode::kUsage, fmt::format("{}: solid \"{}\" is a far field already; leave --farfield out, or "
                                                "the solid",
                                                path, name));
}

/// Formats of facets do not say which encoding names have.
void write_names_as_utf8(std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += name + "\n";
  const occt::TextEncoding encoding = occt::detect_encoding(all);
  for (std::string& name : names) name = occt::valid_utf8(occt::to_utf8(name, encoding));
}

/// Takes noise away where that is asked for; else says how much there is.
void mend_noise(FacetInput& input, const std::string& smooth, const ModelUnit& unit, const std::string& path) {
  if (smooth.empty()) {
    constexpr double kDeviations = 4;  // a node in 16,000 is further off
    if (const double noise = find_noise(input); noise > 0)
      log_warning(
          fmt::format("{}: the facets are rough, as those of a scan: nodes are off by {:.2g} {} from their "
                      "neighbours; triangles become small there, and --smooth {:.2g}{} takes it away",
                      path, noise, unit.name, kDeviations * noise, unit.name));
    return;
  }
  Box3 box;
  for (const Vec3 x : input.x) box.add(x);
  const double most = resolve_length(parse_length(smooth, "--smooth"), {box.diagonal(), unit.in_m}, "--smooth");
  const SmoothedFacets moved = smooth_facets(input, most);
  log_step(fmt::format("  nodes are moved by {:.2g} {} on average, by the {:.2g} of --smooth at {:.2g} % of them",
                       moved.mean, unit.name, most, 100 * moved.at_most));
}

std::vector<Box3> edge_boxes(const FacetShape& shape, const ModelTables& tables) {
  std::vector<Box3> boxes(static_cast<std::size_t>(tables.n_edges()));
  for (EdgeId e = 0; e < tables.n_edges(); ++e)
    for (const Vec3 x : shape.points(e)) boxes[e].add(x);
  return boxes;
}

void report(const ImportOptions& options, ImportResult& result) {
  const ModelTables& t = result.tables;
  occt::report_uses(result);
  const double small =
      resolve_length(parse_length(options.small, "--small"), {t.reference_diagonal(), t.unit_in_m}, "--small");
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (t.edge_length[e] < small)
      result.findings.push_back(
          {FindingKind::kShortEdge, t.edge_label(e), t.vertex_xyz[t.edge_vertices[2 * e]], t.edge_length[e], false});
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    result.area += t.face_area[f];
    if (t.face_width[f] < small)
      result.findings.push_back(
          {FindingKind::kSliverFace, t.face_label(f), t.face_box[f].center(), t.face_width[f], false});
  }
  if (result.is_closed) result.volume = t.volume.value_or(0);
}

}  // namespace

ImportResult import_facets(FacetInput& input, const ImportOptions& options, const std::string& path) {
  require_known(options, path);
  write_names_as_utf8(input.part_name);
  std::optional<occt::SymmetryPlane> plane;
  std::optional<occt::FarField> far;
  if (!options.air.symmetry.empty()) plane = occt::parse_symmetry(options.air.symmetry, "--symmetry");
  if (!options.air.farfield.empty()) far = occt::parse_farfield(options.air.farfield, "--farfield");
  if (far) require_no_air(input, path);
  const ModelUnit unit = choose_unit(std::nullopt, options.unit);
  ImportResult result;
  result.format = "facets";
  occt::require_sound_nodes(input.x, path);
  try {
    join_equal_points(input.x, input.corners);
    result.findings = repair_facets(input);
    mend_noise(input, options.smooth, unit, path);
    FacetMesh mesh = find_smooth_faces(input, radians(options.feature_deg));
    if (plane || far) make_flow_domain(mesh, input.part_name, plane, far, result.findings);
    cut_into_charts(mesh);
    FacetModel model = make_facet_model(mesh, input.part_name, radians(options.feature_deg));
    result.tables = std::move(model.tables);
    result.facets = std::move(model.shape);
  } catch (const Error& e) {
    throw Error(e.code(), path + ": " + e.what());
  }
  result.tables.unit = unit.name;
  result.tables.unit_in_m = unit.in_m;
  result.has_assumed_unit = true;
  const FaceLabels labels_of_file = result.tables.labels;
  occt::report_groups(apply_groups(options.groups, result.tables, edge_boxes(result.facets, result.tables)), result);
  say_taken_roles(options.groups, labels_of_file, result.tables);
  report(options, result);
  result.file_faces.assign(static_cast<std::size_t>(result.tables.n_faces()), kNone);
  if (options.require_closed) occt::require_closed(result, path);
  return result;
}

}  // namespace st
