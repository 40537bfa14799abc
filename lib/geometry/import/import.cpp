// import_model(), step by step.
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/length.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/required_unit.h"
#include "base/text.h"
#include "base/threads.h"
#include "geometry/brep/kept_surfaces.h"
#include "geometry/brep/scaled_shape.h"
#include "geometry/import/air_roles.h"
#include "geometry/import/body_relations.h"
#include "geometry/import/cad_reader.h"
#include "geometry/import/crossing_faces.h"
#include "geometry/import/duplicate_faces.h"
#include "geometry/import/embedded_edges.h"
#include "geometry/import/empty_faces.h"
#include "geometry/import/face_orientation.h"
#include "geometry/import/folded_slivers.h"
#include "geometry/import/half_model.h"
#include "geometry/import/import.h"
#include "geometry/import/kept_areas.h"
#include "geometry/import/kinked_faces.h"
#include "geometry/import/left_out_faces.h"
#include "geometry/import/loop_joins.h"
#include "geometry/import/loop_periods.h"
#include "geometry/import/loop_repair.h"
#include "geometry/import/mirror_image.h"
#include "geometry/import/model_unit.h"
#include "geometry/import/openings.h"
#include "geometry/import/pcurve_repair.h"
#include "geometry/import/plane_cut.h"
#include "geometry/import/shape_repair.h"
#include "geometry/import/shell_repair.h"
#include "geometry/import/short_ends.h"
#include "geometry/import/sound_geometry.h"
#include "geometry/import/space_curves.h"
#include "geometry/import/split_vertices.h"
#include "geometry/import/taken_roles.h"
#include "geometry/import/topology_report.h"
#include "geometry/import/touching_loops.h"
#include "geometry/import/wrong_sides.h"
#include "geometry/model/group_selection.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model.h"
#include "geometry/model/model_impl.h"
#include "geometry/model/model_tables.h"

namespace st {
namespace {

using occt::CadFile;
using occt::ImportedShape;

/// Options that cannot be used without a unit are known before the work is done.
void require_units(const ImportOptions& options, const ModelUnit& unit) {
  require_unit(parse_length(options.small, "--small"), unit.in_m, "--small");
  if (!options.sew.empty()) require_unit(parse_length(options.sew, "--sew"), unit.in_m, "--sew");
  for (const GroupRule& rule : options.groups) require_unit(rule, unit.in_m);
}

/// Shape and findings from the unit they were read in to the model unit.
void scale_to_unit(ImportedShape& model, const ModelUnit& unit, std::vector<ImportFinding>& findings,
                   const std::string& path) {
  if (std::abs(unit.shape_units - 1.0) < 1e-12) return;
  const double factor = 1.0 / unit.shape_units;
  gp_Trsf scale;
  scale.SetScaleFactor(factor);
  BRepBuilderAPI_Transform transform = occt::scaled_shape(model.shape, scale);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(transform.Shape(), TopAbs_FACE, faces);
  if (faces.Extent() != model.faces.Extent())
    throw Error(ExitCode::kGeometry, path + ": the model cannot be scaled to its unit; give --unit mm");
  for (auto& [edge, name] : model.edge_names) edge = transform.ModifiedShape(edge);
  model.shape = transform.Shape();
  model.faces = faces;
  for (ImportFinding& f : findings) f.xyz = factor * f.xyz, f.size *= factor;
}

/// Tables of a model that has got new faces; these need no word on their trimming curves and shells.
void take_new_faces(ImportedShape& model, occt::ModelOfFile& tables, const std::string& path) {
  std::vector<ImportFinding> own;
  occt::join_loops(model, own);
  occt::repair_loops(model, own);
  occt::repair_pcurves(model, own);
  tables = occt::make_tables(model, path);
  if (occt::repair_shells(model, tables.measures, own)) tables = occt::make_tables(model, path);
}

/// The air that the file has gets its roles, or goes; then `asked` tells where the new one ends.
AirFaces settle_file_air(ImportedShape& model, occt::ModelOfFile& tables, occt::AskedAir& asked,
                         const std::string& path) {
  const occt::FileAir air = occt::find_file_air(model, tables.tables, asked, path);
  if (air.is_by_shape) tables = occt::make_tables(model, path);
  if (asked.replaces) {
    occt::remove_air(model, tables.tables, air.faces, asked, path);
    tables = occt::make_tables(model, path);
  }
  AirFaces counts = occt::counts_of(air);
  counts.is_replaced = asked.replaces;
  return counts;
}

/// Symmetry plane and far field that are asked for.
void make_air(ImportedShape& model, occt::ModelOfFile& tables, const occt::AskedAir& asked,
              std::vector<ImportFinding>& findings, const std::string& path) {
  if (!asked.plane && !asked.far) return;
  occt::make_flow_domain(model, tables.tables.box(), tables.tables.reference_diagonal(), asked.plane, asked.far,
                         findings, path);
  take_new_faces(model, tables, path);
}

/// One half becomes the image of the other, where that is asked for.
std::optional<occt::MirrorShapes> mirror_model(ImportedShape& model, occt::ModelOfFile& tables,
                                               const std::optional<occt::SymmetryPlane>& plane,
                                               std::vector<ImportFinding>& findings, const std::string& path) {
  if (!plane) return std::nullopt;
  const double diagonal = tables.tables.reference_diagonal();
  if (occt::cut_at_plane(model, *plane, diagonal, path) > 0) take_new_faces(model, tables, path);
  occt::MirrorShapes shapes = occt::mirror_half(model, *plane, diagonal, findings, path);
  tables = occt::make_tables(model, path);
  return shapes;
}

/// Numbers in a groups file are those before the far field goes: they would name others after it.
void refuse_numbers(const ImportOptions& options) {
  if (options.air.replace_farfield.empty()) return;
  for (const GroupRule& rule : options.groups)
    for (const std::vector<std::string>* items :
         {&rule.selection.faces, &rule.selection.edges, &rule.selection.vertices})
      if (std::any_of(items->begin(), items->end(), [](const std::string& item) { return as_range(item).has_value(); }))
        throw Error(ExitCode::kUsage, rule.where +
                                          ": selects by number, and --replace-farfield gives faces other numbers; "
                                          "select by name, part, layer or place, or name groups after the import");
}

/// Whether the faces of a rule are known before sewing only by numbers that a symmetry plane or a far field changes.
bool is_known_late(const GroupRule& rule, const ImportOptions& options) {
  if (!options.air.changes_numbers()) return false;
  return std::any_of(rule.selection.faces.begin(), rule.selection.faces.end(), [](const std::string& item) {
    return item.find_first_not_of("0123456789-") == std::string::npos;
  });
}

/// Rules of faces that can be told before sewing, none of which has to match yet.
std::vector<GroupRule> rules_before_sewing(const ImportOptions& options) {
  std::vector<GroupRule> rules;
  for (GroupRule rule : options.groups) {
    if (rule.of != EntityDim::kFace || is_known_late(rule, options)) continue;
    rule.is_optional = true;
    rules.push_back(std::move(rule));
  }
  return rules;
}

/// Tolerances of the faces' groups, unit of the shape; empty when no group has one, or nothing is to be sewn.
std::vector<double> group_tolerances(const ImportedShape& model, const ModelUnit& unit, const ImportOptions& options) {
  const auto has_tolerance = [](const GroupRule& rule) { return rule.tolerance.has_value(); };
  if (std::none_of(options.groups.begin(), options.groups.end(), has_tolerance)) return {};
  if (occt::count_free_edges(model.shape) == 0) return {};
  ModelTables t = occt::make_face_tables(model, 1.0 / unit.shape_units);
  t.unit_in_m = unit.in_m;
  apply_groups(rules_before_sewing(options), t);
  std::vector<double> tolerances = face_tolerances(t.labels);
  for (double& tolerance : tolerances) tolerance *= unit.shape_units;
  return tolerances;
}

void say_what_is_not_sewn(const ImportOptions& options, std::vector<ImportFinding>& findings) {
  for (const GroupRule& rule : options.groups)
    if (rule.tolerance && is_known_late(rule, options))
      findings.push_back({FindingKind::kUnusedTolerance, "group \"" + rule.name + "\"", {}, 0, false});
}

occt::SewingLimits sewing_limits(const CadFile& file, const ModelUnit& unit, const ImportedShape& model,
                                 const ImportOptions& options) {
  occt::SewingLimits limits{file.resolution_mm, std::nullopt, group_tolerances(model, unit, options)};
  const std::string& sew = options.sew;
  if (sew.empty()) return limits;
  const double diagonal = model.box().diagonal() / unit.shape_units;
  limits.largest = unit.shape_units * resolve_length(parse_length(sew, "--sew"), {diagonal, unit.in_m}, "--sew");
  return limits;
}

/// Sewing and voids may put the faces in another order: a group that names them by number must not end with others than
/// those that were sewn for it. With a flow domain such groups are not sewn.
void require_sewn_faces(const ImportedShape& model, const ModelTables& tables, const ImportOptions& options) {
  if (options.air.changes_numbers()) return;
  const std::vector<double> tolerances = face_tolerances(tables.labels);
  for (FaceId f = 0; f < tables.n_faces(); ++f)
    if (model.attributes[f].is_sewn_by_group && (tolerances.empty() || tolerances[f] == 0))
      throw Error(ExitCode::kUsage,
                  tables.face_label(f) +
                      " was sewn by the tolerance of a group that no longer contains it: repairs gave the faces new "
                      "numbers; for groups with a tolerance select by place, part, layer or name");
}

/// Once the small faces that lie on a neighbour are merged into it. Meanwhile the bytes of what is left are made.
std::vector<occt::FaceCrossing> find_faces_that_cross(ImportedShape& model, occt::ModelOfFile& tables,
                                                      ImportResult& result, const std::string& path) {
  constexpr int kMostPasses = 4;  // each merges one sliver into a face
  std::vector<occt::FaceCrossing> found;
  run_jobs({[&] { found = occt::find_crossing_faces(model, tables.tables); },
            [&] { result.brep = occt::brep_bytes(model.shape); }});
  for (int i = 0; i < kMostPasses && occt::merge_folded_slivers(model, tables.tables, found, result.findings); ++i) {
    tables = occt::make_tables(model, path);
    found = occt::find_crossing_faces(model, tables.tables);
    result.brep = occt::brep_bytes(model.shape);
  }
  return found;
}

void say_which_faces_cross(const std::vector<occt::FaceCrossing>& crossings, const ModelTables& t,
                           std::vector<ImportFinding>& findings) {
  for (const occt::FaceCrossing& c : crossings) {
    if (c.first == c.second)
      findings.push_back({c.is_pinch  ? FindingKind::kPinchedFace
                          : c.is_fold ? FindingKind::kFoldedFace
                                      : FindingKind::kSelfCrossingFace,
                          t.face_label(c.first), c.xyz, c.size, false});
    else
      findings.push_back({FindingKind::kCrossingFaces, t.face_label(c.first), c.xyz, c.size, false,
                          t.face_label(c.first) + " and " + t.face_label(c.second) +
                              (c.is_overlap ? ", which lie on each other" : "")});
  }
}

void close_openings(ImportedShape& model, occt::ModelOfFile& tables, const ImportOptions& options,
                    std::vector<ImportFinding>& findings, const std::string& path) {
  if (options.cap && occt::cap_openings(model, tables.tables.reference_diagonal(), findings))
    take_new_faces(model, tables, path);
}

/// Openings, bodies that overlap or touch, and the air around them.
AirFaces settle_bodies_and_air(ImportedShape& model, occt::ModelOfFile& tables, const ImportOptions& options,
                               std::vector<ImportFinding>& findings, const std::string& path, Progress& progress) {
  close_openings(model, tables, options, findings, path);
  occt::AskedAir air = occt::parse_air(options);
  const bool has_new_air = air.far.has_value();
  AirFaces faces;
  if (has_new_air) faces = settle_file_air(model, tables, air, path);  // its solids are no bodies to be united
  occt::relate_bodies(model, tables, options, has_new_air, findings, path, progress);
  progress.step("far field and symmetry", 0.7);
  if (!has_new_air) faces = settle_file_air(model, tables, air, path);
  make_air(model, tables, air, findings, path);
  return faces;
}

void repair_edges_and_loops(ImportedShape& model, std::vector<ImportFinding>& findings) {
  occt::open_slits(model, findings);
  occt::rebuild_space_curves(model, findings);
  occt::join_loops(model, findings);
  occt::rebuild_lost_loops(model, findings);
  occt::repair_loops(model, findings);
  occt::move_loops(model, findings);
  occt::repair_pcurves(model, findings);
  occt::join_touching_loops(model, findings);
  occt::divide_kinked_faces(model, findings);
}

/// Numbers in the file; the findings of divided faces get the numbers of what is left of their parts.
void name_parts(const ImportedShape& model, ImportResult& result) {
  std::vector<std::int32_t>& file_faces = result.file_faces;
  for (const occt::FaceAttributes& a : model.attributes) file_faces.push_back(a.file_face);
  for (ImportFinding& f : result.findings) {
    if (f.kind != FindingKind::kDividedSurface) continue;
    std::string ids;
    for (std::size_t k = 0; k < file_faces.size(); ++k)
      if (file_faces[k] != kNone && occt::file_label(file_faces[k]) == f.entity)
        ids += (ids.empty() ? ": " : ", ") + std::to_string(k + 1);
    f.detail += ids;
  }
}

void say_what_is_missing(const CadFile& file, std::vector<ImportFinding>& findings) {
  for (const std::string& name : file.missing_files)
    findings.push_back({FindingKind::kMissingFile, "", {}, 0, false, name});
  for (const std::string& item : file.unread) findings.push_back({FindingKind::kUnread, "", {}, 0, false, item});
}

ImportResult import_cad(const std::string& path, const ImportOptions& options) {
  refuse_numbers(options);
  const std::optional<occt::SymmetryPlane> mirror = occt::parse_air(options).mirror;  // checks all of them
  Progress progress("importing", 1);
  progress.step("reading", 0);
  CadFile file = occt::read_cad(path);
  const ModelUnit unit = choose_unit(file.unit_in_mm, options.unit);
  require_units(options, unit);
  ImportResult result;
  result.format = file.format;
  say_what_is_missing(file, result.findings);
  occt::mend_wrong_sides(file, result.findings);
  ImportedShape model = occt::collect_parts(file, path);
  occt::require_sound_geometry(model.shape, path);
  progress.step("looking for faces without area and duplicates", 0.4);
  occt::remove_empty_faces(model, result.findings, path);
  occt::remove_null_edges(model, result.findings);
  occt::split_vertices(model, result.findings);
  occt::make_space_curves(model, result.findings);
  occt::extend_short_ends(model, result.findings);
  occt::remove_duplicate_solids(model, result.findings);
  occt::share_common_faces(model, result.findings);
  occt::remove_duplicates(model, result.findings);
  say_what_is_not_sewn(options, result.findings);
  progress.step("sewing", 0.42);
  occt::sew_and_keep_areas(model, sewing_limits(file, unit, model, options), result.findings);
  occt::orient_faces(model, result.findings);
  progress.step("repairing edges and loops", 0.5);
  repair_edges_and_loops(model, result.findings);
  scale_to_unit(model, unit, result.findings, path);
  if (file.has_mixed_units) result.findings.push_back({FindingKind::kMixedUnits, "", {}, 0, false, unit.name});
  progress.step("topology and areas", 0.6);
  occt::ModelOfFile tables = occt::make_tables(model, path);
  if (occt::leave_out_faces(model, tables.tables, result.findings, path)) tables = occt::make_tables(model, path);
  if (occt::repair_crossing_loops(model, tables, result.findings)) tables = occt::make_tables(model, path);
  if (occt::repair_shells(model, tables.measures, result.findings)) tables = occt::make_tables(model, path);
  result.air = settle_bodies_and_air(model, tables, options, result.findings, path, progress);
  const auto mirrored = mirror_model(model, tables, mirror, result.findings, path);
  progress.step("faces that cross", 0.75);
  const auto crossings = find_faces_that_cross(model, tables, result, path);
  occt::require_sound_boxes(tables.tables.face_box, path);
  result.tables = std::move(tables.tables);
  result.tables.unit = unit.name;
  result.tables.unit_in_m = unit.in_m;
  result.has_assumed_unit = unit.in_m && !file.unit_in_mm;
  const FaceLabels labels_of_file = result.tables.labels;
  occt::report_groups(apply_groups(options.groups, result.tables, tables.measures.edge_box), result);
  say_taken_roles(options.groups, labels_of_file, result.tables);
  require_sewn_faces(model, result.tables, options);
  const double small = resolve_length(parse_length(options.small, "--small"),
                                      {result.tables.reference_diagonal(), unit.in_m}, "--small");
  progress.step("looking for defects", 0.8);
  occt::report_topology(model, tables.measures, small, result);
  say_which_faces_cross(crossings, result.tables, result.findings);
  if (options.check_only) occt::report_validity(model, result);
  if (options.require_closed) occt::require_closed(result, path);
  if (mirrored) result.mirror = mirrored->numbers_in(model.shape, path);
  name_parts(model, result);
  return result;
}

}  // namespace

ImportResult import_model(const std::string& path, const ImportOptions& options) {
  try {
    const occt::KeptSurfaces kept;
    return import_cad(path, options);
  } catch (const Standard_Failure& e) {
    throw Error(ExitCode::kGeometry,
                path + ": OpenCASCADE failed on this model (" +
                    (e.GetMessageString() && *e.GetMessageString() ? e.GetMessageString() : e.DynamicType()->Name()) +
                    "); repair it in the CAD system");
  }
}

}  // namespace st
