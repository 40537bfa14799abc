#include "stages/inspect_stage.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/length.h"
#include "base/text.h"
#include "geometry/model/joined_tables.h"
#include "io/file/json_text.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/inspect.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

/// What there is how many of, by schema: name for people and programs, dataset whose rows are counted, rows that do not
/// count.
struct Count {
  const char* name;
  const char* dataset;
  std::int64_t surplus = 0;
};

const std::vector<Count>& counts_of(const std::string& schema) {
  static const std::map<std::string, std::vector<Count>> counts = {
      {"geometry",
       {{"faces", "/st/face/type"},
        {"edges", "/st/edge/length"},
        {"vertices", "/st/vertex/xyz"},
        {"loops", "/st/loop/coedge_offsets", 1},
        {"groups", "/st/group/name"},
        {"findings", "/st/finding/what"}}},
      {"raster", {{"cells", "/st/octree/leaf_key"}, {"faces", "/st/face/cell_offset", 1}}},
      {"sizing", {{"cells", "/st/octree/leaf_key"}, {"faces", "/st/face/weight"}}},
      {"patches",
       {{"triangles", "/st/triangle/nodes"},
        {"faces", "/st/face/group"},
        {"patches", "/st/patch/face"},
        {"failures", "/st/failure/face"},
        {"groups", "/st/group/name"}}},
      {"mesh",
       {{"triangles", "/VTKHDF/Types"},
        {"nodes", "/VTKHDF/Points"},
        {"faces", "/st/face/name"},
        {"groups", "/st/group/name"}}},
      {"failures", {{"failures", "/st/failure/face"}, {"cells", "/VTKHDF/Types"}}}};
  static const std::vector<Count> none;
  const auto it = counts.find(schema);
  return it == counts.end() ? none : it->second;
}

/// Attributes of our own groups, by their names without the group, header apart: resolved numbers, is_closed,
/// is_complete ...
std::vector<AttributeSummary> properties_of(const ArtifactDescription& artifact) {
  std::vector<AttributeSummary> properties;
  for (const AttributeSummary& a : artifact.attributes) {
    const std::string name = a.name.substr(a.name.find('@') + 1);
    const bool is_ours = a.name.rfind("/st", 0) == 0,
               is_header = name == "schema" || name == "schema_version" || name == "unit" || name == "unit_in_m";
    if (is_ours && !is_header) properties.push_back({name, a.value});
  }
  return properties;
}

/// is_* attributes are truths, whatever HDF5 stores them as.
Json to_json(const AttributeSummary& property) {
  return std::visit(
      [&](const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::int64_t>)
          if (property.name.rfind("is_", 0) == 0) return Json(value != 0);
        return Json(value);
      },
      property.value);
}

Json parse_or_text(const std::string& text) {
  Json parsed = Json::parse(text, nullptr, false);
  return parsed.is_discarded() ? Json(text) : parsed;
}

/// Where the faces of a geometry come from; empty where they have the numbers of a CAD file.
struct FaceOrigins {
  std::vector<std::int64_t> n_of_input;                 ///< [n_inputs]
  std::int64_t n_joined_faces = 0, n_joined_edges = 0;  ///< after joining; 0: none are joined
  std::vector<std::int32_t> file_face;  ///< [n_faces] of an imported geometry: number in the CAD file, kNone: none
};

FaceOrigins face_origins(const std::string& path, const ArtifactDescription& artifact) {
  FaceOrigins origins;
  if (artifact.header.schema != "geometry") return origins;
  if (artifact.rows("/st/composites/member") > 0) {
    const EntityCounts left = count_left(read_geometry(path).tables);
    origins.n_joined_faces = left.faces;
    origins.n_joined_edges = left.edges;
  }
  if (artifact.rows("/st/face/previous_id") == 0) return origins;
  const std::vector<InputRef>& inputs = artifact.header.inputs;
  origins.n_of_input.assign(inputs.size(), 0);
  const std::vector<std::int32_t> previous = read_geometry(path).previous_faces;
  for (std::size_t i = 0; i + 1 < previous.size(); i += 2) {
    if (previous[i] != kNone) ++origins.n_of_input[previous[i + 1]];
    if (inputs[0].role == "cad") origins.file_face.push_back(previous[i]);
  }
  return origins;
}

/// "face 3 of the file is 3, 4", a line for each face that is several.
std::vector<std::string> parts_of_faces(const std::vector<std::int32_t>& file_face) {
  constexpr std::size_t kMost = 8;
  std::map<std::int32_t, std::vector<std::size_t>> parts;
  for (std::size_t f = 0; f < file_face.size(); ++f)
    if (file_face[f] != kNone) parts[file_face[f]].push_back(f + 1);
  std::vector<std::string> lines;
  std::erase_if(parts, [](const auto& face) { return face.second.size() < 2; });
  for (const auto& [face, ids] : parts) {
    if (lines.size() == kMost) break;
    lines.push_back(fmt::format("face {} of the file is {}", face + 1, fmt::join(ids, ", ")));
  }
  if (parts.size() > kMost) lines.push_back(fmt::format("and {} faces more: see --json", parts.size() - kMost));
  return lines;
}

Json info_json(const std::string& path, const ArtifactDescription& artifact, const FaceOrigins& origins) {
  const ArtifactHeader& h = artifact.header;
  Json json = {{"tool", "st-info"},    {"artifact", path},
               {"schema", h.schema},   {"schema_version", h.schema_version},
               {"written_by", h.tool}, {"version", h.tool_version}};
  json["unit"] = h.unit.empty() ? Json(nullptr) : Json(h.unit);
  json["unit_in_m"] = h.unit_in_m ? Json(*h.unit_in_m) : Json(nullptr);
  json["counts"] = Json::object();
  for (const Count& c : counts_of(h.schema)) json["counts"][c.name] = artifact.rows(c.dataset) - c.surplus;
  if (origins.n_joined_faces > 0)
    json["joined"] = {{"faces", origins.n_joined_faces}, {"edges", origins.n_joined_edges}};
  json["properties"] = Json::object();
  for (const AttributeSummary& p : properties_of(artifact)) json["properties"][p.name] = to_json(p);
  json["inputs"] = Json::array();
  for (const InputRef& input : h.inputs)
    json["inputs"].push_back({{"role", input.role}, {"name", input.name}, {"hash", input.hash}});
  for (std::size_t i = 0; i < origins.n_of_input.size(); ++i) json["inputs"][i]["faces"] = origins.n_of_input[i];
  for (const std::int32_t face : origins.file_face)
    json["file_faces"].push_back(face == kNone ? Json(nullptr) : Json(face + 1));
  json["options"] = parse_or_text(h.options_json.empty() ? "{}" : h.options_json);
  json["geometry_hash"] = h.schema == "geometry" ? h.content_hash : h.geometry_hash;
  json["hash"] = h.content_hash;
  return json;
}

/// Lengths with their unit.
std::string property_text(const AttributeSummary& property, const std::string& unit) {
  const double* value = std::get_if<double>(&property.value);
  if (!value) return json_text(to_json(property));
  const bool is_length = property.name == "diagonal" || property.name.ends_with("_length");
  return fmt::format("{:.6g}{}", *value, is_length ? in_unit(unit) : "");
}

std::string info_lines(const std::string& path, const ArtifactDescription& artifact, const FaceOrigins& origins) {
  const ArtifactHeader& h = artifact.header;
  std::string text = fmt::format("{}: {} (schema version {}), written by {} {}\n", path, h.schema, h.schema_version,
                                 one_line(h.tool), one_line(h.tool_version));
  const auto row = [&](const std::string& name, const std::string& value) {
    text += fmt::format("  {:<16} {}\n", one_line(name), one_line(value));
  };
  for (const Count& c : counts_of(h.schema)) row(c.name, std::to_string(artifact.rows(c.dataset) - c.surplus));
  if (origins.n_joined_faces > 0)
    row("after joining", fmt::format("{} faces, {} edges", origins.n_joined_faces, origins.n_joined_edges));
  for (const AttributeSummary& p : properties_of(artifact)) row(p.name, property_text(p, one_line(h.unit)));
  row("unit", h.unit.empty() ? "none" : h.unit_in_m ? fmt::format("{} ({:g} m)", h.unit, *h.unit_in_m) : h.unit);
  for (std::size_t i = 0; i < h.inputs.size(); ++i)
    row("from " + h.inputs[i].role,
        fmt::format("{} {}{}", h.inputs[i].name, h.inputs[i].hash,
                    origins.n_of_input.empty() ? "" : fmt::format(" ({} faces)", origins.n_of_input[i])));
  for (const std::string& line : parts_of_faces(origins.file_face)) row("divided", line);
  if (!h.options_json.empty()) row("options", h.options_json);
  if (h.schema != "geometry") row("geometry", h.geometry_hash);
  row("hash", h.content_hash);
  text.pop_back();
  return text;
}

}  // namespace

StageSummary run_info(const std::string& artifact) {
  const ArtifactDescription description = describe_artifact(artifact);
  const FaceOrigins origins = face_origins(artifact, description);
  return {info_lines(artifact, description, origins), json_text(info_json(artifact, description, origins))};
}

StageSummary run_hash(const std::string& artifact) {
  const std::string hash = describe_artifact(artifact).header.content_hash;
  return {hash, json_text(Json{{"tool", "st-info"}, {"artifact", artifact}, {"hash", hash}})};
}

StageSummary run_diff(const DiffStageOptions& o) {
  const std::vector<std::string> differences = compare_artifacts(o.a, o.b, o.tolerance);
  StageSummary summary;
  summary.code = differences.empty() ? ExitCode::kOk : ExitCode::kIncomplete;
  summary.line = differences.empty() ? fmt::format("{} and {} are equal", o.a, o.b)
                                     : fmt::format("{} and {} differ in {} places", o.a, o.b, differences.size());
  if (differences.empty() && o.tolerance > 0) summary.line += fmt::format(" within {:g}", o.tolerance);
  for (const std::string& difference : differences) summary.line += "\n  " + difference;
  summary.json = json_text(Json{{"tool", "st-diff"},
                                {"a", o.a},
                                {"b", o.b},
                                {"tolerance", o.tolerance},
                                {"equal", differences.empty()},
                                {"differences", differences}});
  return summary;
}

}  // namespace st
