#include "stages/report_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/base64.h"
#include "base/log.h"
#include "base/progress.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"
#include "judge/surface_deviation.h"
#include "stages/check_stage.h"
#include "stages/inspect_stage.h"
#include "stages/merge_stage.h"
#include "stages/mesh_export.h"
#include "stages/report_cad.h"
#include "stages/report_faces.h"
#include "stages/report_origin.h"
#include "stages/report_page.h"
#include "stages/report_sizes.h"
#include "stages/stored_model.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostCells = 100000;  // of a slice: 2 MB of the page

/// The files of one run, by kind; empty: not given.
struct RunFiles {
  std::string mesh, patches, geometry, sizing, raster;
  bool is_merged_here = false;  ///< the mesh is a temporary file, of the patches
};

/// Throws Error(kUsage) for two artifacts of one kind, and without anything to look at.
RunFiles sort_files(const ReportStageOptions& o) {
  RunFiles files;
  const auto take = [](std::string& place, const std::string& path, const char* kind) {
    if (!place.empty())
      throw Error(ExitCode::kUsage, fmt::format("{} and {}: both are a {}; give one of each kind", place, path, kind));
    place = path;
  };
  for (const std::string& path : o.artifacts) {
    const std::string kind = read_header(path).schema;
    if (kind == "mesh") take(files.mesh, path, "mesh");
    if (kind == "patches") take(files.patches, path, "patches artifact");
    if (kind == "geometry") take(files.geometry, path, "geometry");
    if (kind == "sizing") take(files.sizing, path, "sizing");
    if (kind == "raster") take(files.raster, path, "raster");
  }
  if (!o.geometry.empty()) take(files.geometry, o.geometry, "geometry");
  if (!o.sizing.empty()) take(files.sizing, o.sizing, "sizing");
  if (files.mesh.empty() && files.patches.empty() && files.geometry.empty())
    throw Error(ExitCode::kUsage,
                "none of these artifacts can be looked at; give mesh.hdf, patches.hdf of a run that failed, or "
                "geometry.hdf before meshing");
  if (files.raster.empty() && !files.sizing.empty()) files.raster = raster_beside(files.sizing);
  return files;
}

Verdict check(const RunFiles& files) {
  if (files.mesh.empty()) return {};
  CheckStageOptions options;
  options.mesh = files.mesh;
  options.geometry = files.geometry;
  options.sizing = files.sizing;
  Verdict verdict;
  verdict.passes = run_check(options, &verdict.json).code == ExitCode::kOk;
  return verdict;
}

/// The mesh before a remeshing, checked against what of the run belongs to it; "null" without one.
std::string check_before(const std::string& before, const RunFiles& files) {
  if (before.empty()) return "null";
  const ArtifactHeader mesh = read_header(before);
  if (mesh.schema != "mesh")
    throw Error(ExitCode::kUsage, fmt::format("--before {}: is a {} artifact; give a mesh", before, mesh.schema));
  RunFiles own;
  own.mesh = before;
  if (!files.geometry.empty() && read_header(files.geometry).content_hash == mesh.geometry_hash) {
    own.geometry = files.geometry;
    own.sizing = files.sizing;
  }
  return check(own).json;
}

/// Quality, length over requested length; after st-remesh 1 where a triangle is new; with the geometry, distance from
/// the CAD. [n_triangles] each
std::vector<TriangleValues> values_to_show(const Model* model, const MeshArtifact& mesh) {
  std::vector<TriangleValues> values = measured_values(mesh.mesh);
  if (!mesh.mesh.triangle_previous.empty()) {
    TriangleValues is_new{"is_new", {}};
    for (const TriangleId t : mesh.mesh.triangle_previous) is_new.of_triangle.push_back(t == kNone ? 1.0F : 0.0F);
    values.push_back(is_new);
  }
  if (model) values.push_back({"deviation", triangle_deviations(*model, mesh.mesh)});
  return values;
}

/// The box of nothing is the origin.
Box3 box_of(std::span<const Vec3> points) {
  Box3 box;
  for (const Vec3& p : points) box.add(p);
  if (points.empty()) box.add(Vec3{});
  return box;
}

/// What the page has to know of the arrays: groups with their triangles, names of the values, middle and size.
Json describe(const MeshArtifact& artifact, const Box3& box, std::span<const TriangleValues> values) {
  const SurfaceMesh& mesh = artifact.mesh;
  std::vector<std::int64_t> counts(mesh.labels.group_name.size());
  for (const std::int32_t g : mesh.triangle_group) ++counts[g];
  Json groups = Json::array(), names = Json::array();
  std::int64_t first = 0;
  bool has_far_field = false;
  for (std::size_t g = 0; g < counts.size(); first += counts[g++]) {
    const std::string role = role_of(mesh.labels, g);
    has_far_field |= role == "farfield";
    groups.push_back({{"name", mesh.labels.group_name[g]}, {"role", role}, {"first", first}, {"count", counts[g]}});
  }
  for (const TriangleValues& v : values) names.push_back(v.name);
  const Vec3 middle = box.center();
  return {{"groups", groups},
          {"values", names},
          {"centre", {middle.x, middle.y, middle.z}},
          {"diagonal", box.diagonal()},
          {"outward", has_far_field ? -1 : 1},  // normals of a fluid domain point into the body
          {"unit", artifact.header.unit}};
}

/// JSON for a <script> element: no "<" may end it.
std::string script_text(const std::string& json) {
  std::string text;
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

template <class T>
std::string encoded(const std::vector<T>& array) {
  return base64(std::as_bytes(std::span(array)));
}

std::string encoded_points(std::span<const Vec3> points, Vec3 middle) {
  std::vector<float> xyz;
  xyz.reserve(3 * points.size());
  for (const Vec3& point : points) {
    const Vec3 p = point - middle;
    for (const double x : {p.x, p.y, p.z}) xyz.push_back(static_cast<float>(x));
  }
  return encoded(xyz);
}

std::string encoded_corners(const SurfaceMesh& mesh, std::span<const TriangleId> order) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * order.size());
  for (const TriangleId t : order)
    for (const NodeId n : mesh.triangles[t].n) corners.push_back(static_cast<std::uint32_t>(n));
  return encoded(corners);
}

std::string encoded_values(std::span<const TriangleValues> values, std::span<const TriangleId> order) {
  std::vector<float> all;
  all.reserve(values.size() * order.size());
  for (const TriangleValues& v : values)
    for (const TriangleId t : order) all.push_back(v.of_triangle[t]);
  return encoded(all);
}

/// The page with each place filled.
std::string fill(std::string_view page, std::span<const std::pair<std::string, std::string>> places) {
  std::string text;
  std::size_t at = 0;
  for (const auto& [name, content] : places) {
    const std::size_t next = page.find("@" + name + "@", at);
    text += page.substr(at, next - at);
    text += content;
    at = next + name.size() + 2;
  }
  return text += page.substr(at);
}

/// Findings of the import, repairs among them.
Json import_findings(std::span<const ImportFinding> findings) {
  Json list = Json::array();
  for (const ImportFinding& f : findings)
    list.push_back({{"words", f.what() + (f.entity.empty() ? "" : ", " + f.entity)},
                    {"xyz", {f.xyz.x, f.xyz.y, f.xyz.z}},
                    {"repair", f.is_repair}});
  return list;
}

/// What is known of the sizes, as parts of the page.
struct SizePart {
  Json meta = Json::object();
  SliceCells cells;
  std::vector<std::uint16_t> cause;  ///< by triangle, in their order on the page
};

SizePart sizes_to_show(const SizingArtifact& sizing, const SurfaceMesh& mesh, std::span<const TriangleId> order) {
  SizePart part;
  const TriangleCauses causes = triangle_causes(sizing, mesh);
  part.meta = {{"frame", slice_frame(sizing)}, {"causes", causes.list}};
  part.cells = slice_cells(sizing, kMostCells);
  for (const TriangleId t : order) part.cause.push_back(causes.index[t]);
  return part;
}

/// Before meshing: the plane alone, since facets are too coarse for causes.
SizePart sizes_before_meshing(const SizingArtifact& sizing) {
  SizePart part;
  part.meta = {{"frame", slice_frame(sizing)}, {"causes", Json::array()}};
  part.cells = slice_cells(sizing, kMostCells);
  return part;
}

/// Patches of which no mesh was made: what there is, as a mesh that is flagged incomplete.
void merge_what_there_is(const std::string& patches, const std::string& output) {
  MergeStageOptions options;
  options.patches = {patches};
  options.output = output;
  options.allow_incomplete = true;
  run_merge(options);
}

/// What a page is made of, as it was read.
struct Contents {
  MeshArtifact mesh;  ///< before meshing: the faces as facets
  std::optional<Model> model;
  std::vector<ImportFinding> findings;
  std::vector<FaceFailure> failures;
  std::optional<SizingArtifact> sizing;
  bool is_meshed = true, is_closed = false;  ///< closed: the CAD
  Json cad_numbers = Json::object();         ///< see cad_numbers()
};

/// Throws Error(kMismatch) for files of several models.
Contents read_contents(const RunFiles& files) {
  Contents c;
  std::optional<GeometryArtifact> geometry;
  if (!files.geometry.empty()) geometry = read_geometry(files.geometry);
  if (!files.sizing.empty()) c.sizing = read_sizing(files.sizing);
  c.is_meshed = !files.mesh.empty();
  if (c.is_meshed) c.mesh = read_mesh(files.mesh);
  if (geometry) {
    if (c.is_meshed) part_as_meshed(c.mesh, *geometry);
    c.findings = std::move(geometry->findings);
    c.is_closed = geometry->is_closed;
    c.cad_numbers = cad_numbers(*geometry);
    c.model = stored_model(*geometry, files.geometry);
  }
  if (!c.is_meshed) {
    c.mesh.mesh = facet_mesh(*c.model);
    c.mesh.header = geometry->header;
    if (c.sizing) require_same_geometry(files.geometry, geometry->header, files.sizing, c.sizing->header);
  }
  if (!files.patches.empty()) {
    PatchesArtifact patches = read_patches(files.patches);
    require_same_geometry(files.mesh, c.mesh.header, files.patches, patches.header);
    c.failures = std::move(patches.failures);
  }
  return c;
}

/// The CAD's edges, and which of them are drawn when: [[kind, group, number of lines], ...]. Each edge: [[number,
/// number of lines, length, name], ...].
struct LinePart {
  Json meta = Json::array(), edges = Json::array();
  std::vector<Vec3> ends;
};

LinePart lines_to_show(const Contents& c) {
  LinePart part;
  if (!c.model) return part;
  std::vector<FaceId> unmeshed;
  for (const FaceFailure& f : c.failures) unmeshed.push_back(f.face);
  CadLines lines = cad_lines(*c.model, unmeshed);
  for (const LineRun& run : lines.runs) part.meta.push_back({static_cast<int>(run.kind), run.group, run.n_lines});
  const ModelTables& t = c.model->tables();
  for (const EdgeLines& own : lines.edges)
    part.edges.push_back({own.edge + 1, own.n_lines, t.edge_length[own.edge], t.edge_name[own.edge]});
  part.ends = std::move(lines.ends);
  return part;
}

/// Before meshing: what the CAD is, for the page's first words.
Json cad_in_words(const Contents& c) {
  if (c.is_meshed) return nullptr;
  const ModelTables& t = c.model->tables();
  Json faces = Json::array();
  std::vector<int> of_group(t.labels.group_name.size(), 0);
  for (const std::int32_t g : t.labels.face_group) ++of_group[g];
  for (const int n : of_group) faces.push_back(n);
  return {{"faces", t.n_faces()}, {"edges", t.n_edges()}, {"closed", c.is_closed}, {"of_group", faces}};
}

/// Faces and parts under the pointer, and what the artifacts of the run say of themselves.
void describe_origin(const RunFiles& files, const Contents& c, std::span<const TriangleId> order, Json& meta) {
  meta["faces"] = faces_to_pick(c.mesh.mesh, order, c.model ? &c.model->tables() : nullptr);
  meta["parts"] = c.mesh.mesh.labels.part_path;
  meta["origins"] = origins(std::array{files.geometry, files.raster, files.sizing, files.patches,
                                       files.is_merged_here ? std::string() : files.mesh});
}

std::string make_page(const ReportStageOptions& o, const RunFiles& files, const std::string& shown_as,
                      const Verdict& verdict) {
  Progress progress("writing the report", 1);
  progress.step("reading", 0);
  const Contents c = read_contents(files);
  const SurfaceMesh& mesh = c.mesh.mesh;
  progress.step("values of triangles", 0.2);
  std::vector<TriangleValues> values;
  if (c.is_meshed) values = values_to_show(c.model ? &*c.model : nullptr, c.mesh);
  const std::vector<TriangleId> order = by_group_and_face(mesh);
  progress.step("causes of sizes", 0.5);
  SizePart sizes;
  sizes.meta = nullptr;  // none are given
  if (c.sizing) sizes = c.is_meshed ? sizes_to_show(*c.sizing, mesh, order) : sizes_before_meshing(*c.sizing);
  progress.step("edges of the CAD", 0.7);
  const LinePart lines = lines_to_show(c);
  progress.step("page", 0.8);
  const Box3 box = box_of(mesh.node_xyz.empty() ? lines.ends : mesh.node_xyz);
  Json meta = describe(c.mesh, box, values);
  meta["title"] = shown_as;
  meta["cad"] = cad_in_words(c);
  meta["import"] = import_findings(c.findings);
  meta["unmeshed"] = unmeshed_faces(c.failures, mesh.labels);
  meta["lines"] = lines.meta;
  meta["edges"] = lines.edges;
  meta.update(c.cad_numbers);
  meta["times"] = stage_times(o.times);
  describe_origin(files, c, order, meta);
  meta["sizes"] = sizes.meta;
  const std::vector<std::pair<std::string, std::string>> places = {
      {"META", script_text(json_text(meta))},
      {"CHECK", script_text(verdict.json)},
      {"BEFORE", script_text(check_before(o.before, files))},
      {"INFO", script_text(run_info(c.is_meshed ? files.mesh : files.geometry).json)},
      {"NODES", encoded_points(mesh.node_xyz, box.center())},
      {"CORNERS", encoded_corners(mesh, order)},
      {"VALUES", encoded_values(values, order)},
      {"CAUSES", encoded(sizes.cause)},
      {"CELLS", encoded(sizes.cells.corner)},
      {"LEVELS", encoded(sizes.cells.level)},
      {"LENGTHS", encoded(sizes.cells.length)},
      {"LINES", encoded_points(lines.ends, box.center())}};
  return fill(report_page(), places);
}

}  // namespace

void require_page(const std::string& path) {
  if (!path.ends_with(".html") && !path.ends_with(".htm"))
    throw Error(ExitCode::kUsage, path + ": the page is HTML; name it .html" +
                                      (path.ends_with(".pdf") ? ", and print it to a PDF from a browser" : ""));
  require_writable(path);
}

StageSummary run_report(const ReportStageOptions& o) {
  const Timer timer;
  require_writable(o.output);
  RunFiles files = sort_files(o);
  const std::string shown_as = !files.mesh.empty()      ? files.mesh
                               : !files.patches.empty() ? files.patches
                                                        : files.geometry;
  std::optional<TemporaryFile> merged;
  if (files.mesh.empty() && !files.patches.empty()) {
    files.mesh = merged.emplace(o.output + ".mesh").name();
    files.is_merged_here = true;
    merge_what_there_is(files.patches, files.mesh);
  }
  const Verdict verdict = o.checked ? *o.checked : check(files);
  const std::string page = make_page(o, files, shown_as, verdict);
  write_text_file(o.output, page);
  Json summary = {{"tool", "st-report"}, {"mesh", shown_as}, {"output", o.output}};
  if (verdict.passes) summary["passes"] = *verdict.passes;
  summary["bytes"] = page.size();
  summary["seconds"] = timer.seconds();
  const std::string said = !verdict.passes ? "not meshed yet" : *verdict.passes ? "passes" : "does not pass";
  return {fmt::format("{}: {} {}, {:.1f} MB, {:.1f} s", o.output, shown_as, said,
                      1e-6 * static_cast<double>(page.size()), timer.seconds()),
          json_text(summary)};
}

}  // namespace st
