#include "stages/export_stage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "base/length.h"
#include "base/log.h"
#include "base/progress.h"
#include "geometry/flite/flite_writer.h"
#include "io/export/cell_view.h"
#include "io/export/export.h"
#include "io/export/octree_export.h"
#include "io/file/json_text.h"
#include "io/file/output_files.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/failure_artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "judge/surface_deviation.h"
#include "mesh/edge_segments.h"
#include "meshing/associate/curved_sides.h"
#include "stages/cad_view.h"
#include "stages/mesh_export.h"
#include "stages/report_stage.h"
#include "stages/stored_model.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

/// `outputs`: at least one.
StageSummary export_summary(const std::string& artifact, const std::vector<std::string>& outputs, const Timer& timer) {
  StageSummary summary;
  summary.line = fmt::format("{}: {} exported, {:.2f} s{}", fmt::join(outputs, ", "), artifact, timer.seconds(),
                             gmsh_hint(outputs));
  Json json{{"tool", "st-export"}, {"artifact", artifact}, {"output", outputs[0]}};
  if (outputs.size() > 1) json["outputs"] = outputs;
  json["seconds"] = timer.seconds();
  summary.json = json_text(json);
  return summary;
}

/// Formats that show values of triangles.
bool shows_values(const std::string& path) { return path.ends_with(".vtu") || path.ends_with(".vtm"); }

/// What of the options says how a mesh is written. Throws Error(kUsage) where they contradict each other.
ExportOptions mesh_options(const ExportStageOptions& o) {
  const auto require = [&](bool is_right, const std::string& what) {
    if (!is_right) throw Error(ExitCode::kUsage, what);
  };
  require(!o.ascii || !o.binary, "--ascii and --binary exclude each other; give one of them");
  require(!o.quadratic || !o.geometry.empty(), "--quadratic puts nodes on the CAD; give --geometry geometry.hdf");
  require(o.quadratic || o.parametric || shows_values(o.output) || o.geometry.empty(),
          "--geometry is for --quadratic, --parametric, .vtu and .vtm; leave it out");
  require(!o.quadratic || !(o.split_groups || o.output.ends_with(".vtm")),
          "--quadratic needs all groups in one file; leave out --split-groups, or give -o mesh.vtu");
  o.kFeatureAngle.require(o.feature_angle_deg);
  ExportOptions options;
  options.format = o.format;
  options.encoding = o.ascii ? Encoding::kText : o.binary ? Encoding::kBinary : Encoding::kOfFormat;
  options.has_quads = o.quads;
  options.has_mid_nodes = o.quadratic;
  options.has_parameters = o.parametric;
  options.feature_angle_deg = o.feature_angle_deg;
  return options;
}

/// What a mesh has beside itself.
struct Additions {
  MidNodes mid_nodes;
  std::vector<TriangleValues> values;
  std::vector<NodeValues> node_values;  ///< that st-remesh carried
};

/// Coordinates and sizes in the unit that is wanted; parameters stay those of the CAD. Returns the unit.
std::string change_unit(const ExportStageOptions& o, MeshArtifact& artifact, Additions& added) {
  if (o.unit.empty()) return artifact.header.unit;
  const std::optional<double> wanted = unit_in_metres(o.unit);
  if (!wanted) throw Error(ExitCode::kUsage, "--unit: '" + o.unit + "' is no unit of length; use m, mm, cm, in or ft");
  if (!artifact.header.unit_in_m)
    throw Error(ExitCode::kUsage, o.artifact +
                                      ": the model has no unit, so --unit has nothing to start from; give "
                                      "st-import --unit");
  const double factor = *artifact.header.unit_in_m / *wanted;
  for (Vec3& x : artifact.mesh.node_xyz) x = factor * x;
  for (Vec3& x : added.mid_nodes.xyz) x = factor * x;
  for (TriangleValues& v : added.values)
    if (v.name == "deviation")
      for (float& value : v.of_triangle) value *= static_cast<float>(factor);
  for (double& size : artifact.mesh.node_size) size *= factor;
  for (FacePair& pair : artifact.mesh.merged.pairs) pair.motion.translation = factor * pair.motion.translation;
  return o.unit;
}

/// Of faces that are several of the CAD: the number of the one at the middle of each triangle.
std::vector<float> cad_face_numbers(const Model& model, const SurfaceMesh& mesh) {
  std::vector<float> numbers;
  for (std::size_t first = 0; first < mesh.triangle_face.size();) {
    const FaceId face = mesh.triangle_face[first];
    std::vector<Vec2> middles;
    for (; first < mesh.triangle_face.size() && mesh.triangle_face[first] == face; ++first) {
      const Vec2* uv = &mesh.corner_uv[3 * first];
      middles.push_back((1.0 / 3) * (uv[0] + uv[1] + uv[2]));
    }
    for (const FaceId f : model.cad_faces(face, middles)) numbers.push_back(static_cast<float>(f + 1));
  }
  return numbers;
}

/// Nodes on the sides where these are wanted, with parameters lines of all CAD edges, distances from the CAD where they
/// can be shown.
void use_geometry(const ExportStageOptions& o, const QuadPairs& elements, MeshArtifact& artifact, Additions& added) {
  GeometryArtifact geometry = read_geometry(o.geometry);
  require_same_geometry(o.artifact, artifact.header, o.geometry, geometry.header);
  part_as_meshed(artifact, geometry);
  const std::vector<NodeId> nodes_in_groups = artifact.mesh.segment_nodes;
  const std::vector<EdgeId> edges_in_groups = artifact.mesh.segment_edge;
  add_all_segments(artifact.mesh, geometry.tables.edge_vertices);
  const Model model = stored_model(geometry, o.geometry);
  if (shows_values(o.output)) added.values.push_back({"deviation", triangle_deviations(model, artifact.mesh)});
  if (shows_values(o.output) && &model.cad() != &model)
    added.values.push_back({"cad_face", cad_face_numbers(model, artifact.mesh)});
  if (o.quadratic) {
    std::int64_t n_straight = 0;
    added.mid_nodes = make_mid_nodes(artifact.mesh, elements, model, n_straight);
    if (n_straight > 0)
      log_warning(fmt::format("{}: {} of {} sides stay straight, where the CAD is too far from them", o.output,
                              n_straight, added.mid_nodes.size()));
  }
  if (!o.parametric) {
    artifact.mesh.segment_nodes = nodes_in_groups;
    artifact.mesh.segment_edge = edges_in_groups;
  }
}

void export_sol_artifact(const ExportStageOptions& o) {
  if (!o.unit.empty()) throw Error(ExitCode::kUsage, "--unit is not for .sol; export the mesh in the model unit, too");
  require_writable(o.output);
  const MeshArtifact artifact = read_mesh(o.artifact);
  ArtifactHeader sizing;
  const std::unique_ptr<SizeField> field = open_sizing(o.sizing, &sizing);
  if (sizing.geometry_hash != artifact.header.geometry_hash)
    throw Error(ExitCode::kMismatch, o.sizing + ": is of another geometry than " + o.artifact);
  export_sol(o.output, artifact.mesh, *field);
}

/// Throws Error(kUsage, kOutput) for a file that would be written besides the output and may not be.
void require_more_outputs(const ExportStageOptions& o, const SurfaceMesh& mesh, const ExportOptions& options) {
  const bool is_in_blocks = o.output.ends_with(".vtm");
  if (!is_in_blocks && !o.split_groups) return require_derived_outputs(files_beside(o.output, options));
  for (const GroupFile& file : group_files(is_in_blocks ? block_path(o.output) : o.output, mesh)) {
    require_derived_outputs({file.path});
    require_derived_outputs(files_beside(file.path, options));
  }
}

/// The files of the groups, with --split-groups; else none is named.
std::vector<std::string> export_mesh_artifact(const ExportStageOptions& o, ExportOptions options) {
  const bool is_sol = o.output.ends_with(".sol");
  if (is_sol != !o.sizing.empty())
    throw Error(ExitCode::kUsage, is_sol ? o.output + ": .sol holds the requested sizes; give --sizing sizing.hdf"
                                         : "--sizing is for .sol only; leave it out, or give -o mesh.sol");
  if (is_sol) {
    export_sol_artifact(o);
    return {};
  }
  const bool is_in_blocks = o.output.ends_with(".vtm");
  if (is_in_blocks) options.format = "vtu";
  require_export_format(o.output, options);
  require_writable(o.output);
  Progress progress("exporting", 1);
  progress.step("reading", 0);
  MeshArtifact artifact = read_mesh(o.artifact);
  require_more_outputs(o, artifact.mesh, options);
  progress.step("measuring", 0.2);
  const QuadPairs elements = o.quads ? pair_triangles(artifact.mesh) : all_triangles(artifact.mesh);
  Additions added;
  if (shows_values(o.output)) added.values = measured_values(artifact.mesh);
  added.node_values = read_stored_values(o.artifact);
  if (!o.geometry.empty()) use_geometry(o, elements, artifact, added);
  options.unit = change_unit(o, artifact, added);
  progress.step("writing", 0.5);
  std::vector<std::string> files;
  const ExportMesh mesh{artifact.mesh, elements, added.mid_nodes, added.values, added.node_values};
  if (is_in_blocks)
    export_blocks(o.output, mesh, options);
  else if (o.split_groups)
    for (const GroupFile& file : export_groups(o.output, mesh, options)) files.push_back(file.path);
  else
    export_and_warn(o.output, mesh, options);
  return files;
}

/// Throws Error(kUsage) for an option that only meshes have.
void refuse_mesh_options(const ExportStageOptions& o, const std::string& schema) {
  const std::pair<bool, const char*> given[] = {{!o.format.empty(), "--format"},
                                                {o.ascii, "--ascii"},
                                                {o.binary, "--binary"},
                                                {!o.unit.empty(), "--unit"},
                                                {o.quads, "--quads"},
                                                {o.quadratic, "--quadratic"},
                                                {o.parametric, "--parametric"},
                                                {o.split_groups, "--split-groups"},
                                                {!o.geometry.empty(), "--geometry"},
                                                {!o.sizing.empty(), "--sizing"}};
  for (const auto& [is_given, flag] : given)
    if (is_given)
      throw Error(ExitCode::kUsage,
                  fmt::format("{}: {} is for meshes; this is a {} artifact", o.artifact, flag, schema));
}

/// The CAD alone, as st-report shows it.
void export_page(const std::string& geometry, const std::string& output) {
  ReportStageOptions options;
  options.artifacts = {geometry};
  options.output = output;
  run_report(options);
}

/// The files that it wrote.
std::vector<std::string> export_artifact(const ExportStageOptions& o) {
  const auto& [artifact, output] = std::tie(o.artifact, o.output);
  std::vector<std::string> files;
  const std::string schema = read_header(artifact).schema;
  if (schema != "mesh") refuse_mesh_options(o, schema);
  if (schema == "mesh") {
    files = export_mesh_artifact(o, mesh_options(o));
  } else if (schema == "raster" || schema == "sizing") {
    require_writable(output);
    export_octree(artifact, output);
  } else if (schema == "failures") {
    require_writable(output);
    export_failures(artifact, output);
  } else if (schema == "geometry") {
    if (output.ends_with(".html")) {
      export_page(artifact, output);
      return {output};
    }
    if (!output.ends_with(".vtu"))
      throw Error(
          ExitCode::kInput,
          artifact + ": is a geometry artifact, which is exported as .vtu, .html or FLITE .dat; give -o cad.vtu");
    require_writable(output);
    Progress progress("exporting", 1);
    progress.step("faces and edges", 0);
    GeometryArtifact geometry = read_geometry(artifact);
    write_cell_view(output, view_cad(stored_model(geometry, artifact).cad(), geometry.findings));
  } else {
    throw Error(
        ExitCode::kInput,
        fmt::format(
            "{}: is a {} artifact, which has no export; give a geometry, mesh, raster, sizing or failures artifact",
            artifact, schema));
  }
  return files.empty() ? std::vector{output} : files;
}

/// A geometry as FLITE surfaces; the summary says how close they are and what was divided.
StageSummary export_flite(const ExportStageOptions& o, const Timer& timer) {
  GeometryArtifact geometry = read_geometry(o.artifact);
  const double diagonal = geometry.tables.reference_diagonal();
  const double tolerance =
      resolve_length(parse_length(o.tolerance, "--tolerance"), {diagonal, geometry.tables.unit_in_m}, "--tolerance");
  require_writable(o.output);
  Progress progress("exporting", 1);
  progress.step("surfaces", 0);
  const FliteExport flite = make_flite(stored_cad(geometry, o.artifact), tolerance);
  write_text_file(o.output, flite_text(flite.file));
  StageSummary summary;
  const std::string where = flite.worst.empty() ? "" : fmt::format(" ({})", flite.worst);
  summary.line = fmt::format(
      "{}: {} exported: {} regions of {} faces ({} divided), {} segments, within {:.3g} of the model{}, {:.2f} s",
      o.output, o.artifact, flite.file.regions.size(), flite.n_faces, flite.n_divided, flite.file.segments.size(),
      flite.deviation, where, timer.seconds());
  if (flite.deviation > tolerance)
    log_warning(fmt::format("{}: the tolerance {:.3g} is not reached, the largest distance is {:.3g}{}", o.output,
                            tolerance, flite.deviation, where));
  summary.json = json_text(Json{{"tool", "st-export"},
                                {"artifact", o.artifact},
                                {"output", o.output},
                                {"faces", flite.n_faces},
                                {"regions", flite.file.regions.size()},
                                {"faces_divided", flite.n_divided},
                                {"segments", flite.file.segments.size()},
                                {"tolerance", tolerance},
                                {"deviation", flite.deviation},
                                {"worst", flite.worst},
                                {"seconds", timer.seconds()}});
  return summary;
}

}  // namespace

std::string gmsh_hint(const std::vector<std::string>& outputs) {
  for (const std::string& path : outputs) {
    const std::string script = path.ends_with(".msh") ? path.substr(0, path.size() - 4) + ".geo" : "";
    if (!script.empty() && std::find(outputs.begin(), outputs.end(), script) == outputs.end())
      return fmt::format("; gmsh -3 takes {}, which --export or st-export writes, not {} alone", script, path);
  }
  return "";
}

std::string mesh_suffixes() { return export_suffixes() + " .vtm .sol"; }

StageSummary run_export(const ExportStageOptions& o) {
  const Timer timer;
  parse_length(o.tolerance, "--tolerance");
  if (o.output.ends_with(".dat") && read_header(o.artifact).schema == "geometry") return export_flite(o, timer);
  return export_summary(o.artifact, export_artifact(o), timer);
}

}  // namespace st
