#include "stages/report_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "base/base64.h"
#include "base/log.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"
#include "judge/surface_deviation.h"
#include "stages/check_stage.h"
#include "stages/inspect_stage.h"
#include "stages/mesh_export.h"
#include "stages/report_page.h"
#include "stages/stored_model.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

/// What st-check reports, and its verdict.
struct Verdict {
  std::string json;
  bool passes;
};

Verdict check(const ReportStageOptions& o) {
  const TemporaryFile file(o.output + ".check");
  CheckStageOptions options;
  options.mesh = o.mesh;
  options.geometry = o.geometry;
  options.sizing = o.sizing;
  options.reports = {file.name()};
  const bool passes = run_check(options).code == ExitCode::kOk;
  return {read_text_file(file.name()), passes};
}

/// Quality, length over requested length; after st-remesh 1 where a triangle is new; with the geometry, distance from
/// the CAD. [n_triangles] each
std::vector<TriangleValues> values_to_show(const ReportStageOptions& o, const MeshArtifact& mesh) {
  std::vector<TriangleValues> values = measured_values(mesh.mesh);
  if (!mesh.mesh.triangle_previous.empty()) {
    TriangleValues is_new{"is_new", {}};
    for (const TriangleId t : mesh.mesh.triangle_previous) is_new.of_triangle.push_back(t == kNone ? 1.0F : 0.0F);
    values.push_back(is_new);
  }
  if (!o.geometry.empty()) {
    GeometryArtifact geometry = read_geometry(o.geometry);
    values.push_back({"deviation", triangle_deviations(stored_model(geometry, o.geometry), mesh.mesh)});
  }
  return values;
}

/// Triangles by group, in their order within each.
std::vector<TriangleId> by_group(const SurfaceMesh& mesh) {
  std::vector<TriangleId> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](TriangleId t) { return mesh.triangle_group[t]; });
  return order;
}

struct Box {
  Vec3 low, high;
  Vec3 middle() const { return 0.5 * (low + high); }
};

Box box_of(const SurfaceMesh& mesh) {
  if (mesh.node_xyz.empty()) return {};
  Box box{mesh.node_xyz[0], mesh.node_xyz[0]};
  for (const Vec3& p : mesh.node_xyz) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

std::string role_of(const FaceLabels& labels, std::size_t group) {
  return labels.group_role.empty() ? role_of_name(labels.group_name[group]) : labels.group_role[group];
}

/// What the page has to know of the arrays: groups with their triangles, names of the values, middle and size.
Json describe(const MeshArtifact& artifact, const Box& box, std::span<const TriangleValues> values) {
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
  const Vec3 middle = box.middle();
  return {{"groups", groups},
          {"values", names},
          {"centre", {middle.x, middle.y, middle.z}},
          {"diagonal", distance(box.low, box.high)},
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

std::string encoded_nodes(const SurfaceMesh& mesh, Vec3 middle) {
  std::vector<float> xyz;
  xyz.reserve(3 * mesh.node_xyz.size());
  for (const Vec3& node : mesh.node_xyz) {
    const Vec3 p = node - middle;
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

}  // namespace

StageSummary run_report(const ReportStageOptions& o) {
  const Timer timer;
  require_writable(o.output);
  const Verdict verdict = check(o);
  const MeshArtifact artifact = read_mesh(o.mesh);
  const std::vector<TriangleValues> values = values_to_show(o, artifact);
  const std::vector<TriangleId> order = by_group(artifact.mesh);
  const Box box = box_of(artifact.mesh);
  const std::vector<std::pair<std::string, std::string>> places = {
      {"META", script_text(json_text(describe(artifact, box, values)))},
      {"CHECK", script_text(verdict.json)},
      {"INFO", script_text(run_info(o.mesh).json)},
      {"NODES", encoded_nodes(artifact.mesh, box.middle())},
      {"CORNERS", encoded_corners(artifact.mesh, order)},
      {"VALUES", encoded_values(values, order)}};
  const std::string page = fill(report_page(), places);
  write_text_file(o.output, page);
  const Json summary = {{"tool", "st-report"},      {"mesh", o.mesh},       {"output", o.output},
                        {"passes", verdict.passes}, {"bytes", page.size()}, {"seconds", timer.seconds()}};
  return {fmt::format("{}: {} {}, {:.1f} MB, {:.1f} s", o.output, o.mesh, verdict.passes ? "passes" : "does not pass",
                      1e-6 * static_cast<double>(page.size()), timer.seconds()),
          json_text(summary)};
}

}  // namespace st
