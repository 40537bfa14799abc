#include "stages/group_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "base/length.h"
#include "geometry/model/groups.h"
#include "io/file/json_text.h"
#include "io/hdf5/artifact.h"
#include "stages/id_ranges.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

/// What the three artifacts have in common.
struct Identity {
  FaceLabels labels;
  std::vector<std::string> face_color = {}, face_layer = {}, face_surface = {};  ///< of a geometry alone: "#rrggbb" or
                                                                                 ///< empty, names
  std::vector<std::string> edge_name = {};                                       ///< likewise
  std::vector<double> face_area = {};                                            ///< likewise, model unit squared
  std::vector<Box3> face_box = {};                                               ///< likewise
  std::string unit = {};
};

std::vector<std::string> color_texts(const std::vector<std::int32_t>& colors) {
  std::vector<std::string> texts;
  for (const std::int32_t c : colors) texts.push_back(c < 0 ? "" : fmt::format("#{:06x}", c));
  return texts;
}

std::vector<std::string> surface_texts(const std::vector<SurfaceType>& types) {
  std::vector<std::string> texts;
  for (const SurfaceType type : types) texts.push_back(surface_type_names().at(static_cast<std::size_t>(type)));
  return texts;
}

Identity identity_of(const std::string& path) {
  const std::string schema = read_header(path).schema;
  if (schema == "geometry") {
    GeometryArtifact geometry = read_geometry(path);
    ModelTables t = std::move(geometry.composites.empty() ? geometry.tables : geometry.cad);  // as groups files count
    return {std::move(t.labels),    color_texts(t.face_color), std::move(t.face_layer), surface_texts(t.face_type),
            std::move(t.edge_name), std::move(t.face_area),    std::move(t.face_box),   std::move(t.unit)};
  }
  if (schema == "patches") return {read_patches(path).labels};
  if (schema != "mesh")
    throw Error(ExitCode::kInput,
                fmt::format("{}: is a {} artifact, which has no groups; give a geometry, patches or mesh artifact",
                            path, schema));
  MeshArtifact artifact = read_mesh(path);
  SurfaceMesh& m = artifact.mesh;
  m.labels.face_group.assign(m.labels.face_name.size(), kNone);
  for (const std::vector<FaceId>* faces : {&m.triangle_face, &artifact.triangle_cad_face})
    for (std::size_t t = 0; t < faces->size(); ++t) m.labels.face_group[(*faces)[t]] = m.triangle_group[t];
  return {std::move(m.labels)};
}

/// 1-based ids of the faces with this number.
std::vector<FaceId> faces_with(const std::vector<std::int32_t>& number_of_face, std::size_t number) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < number_of_face.size(); ++f)
    if (number_of_face[f] == static_cast<std::int32_t>(number)) faces.push_back(static_cast<FaceId>(f + 1));
  return faces;
}

/// Groups: GroupTable, or FaceLabels for the main ones.
template <class Groups>
Json groups_json(const Groups& of) {
  Json groups = Json::array();
  for (std::size_t g = 0; g < of.group_name.size(); ++g) {
    Json own = g < of.group_attributes.size() ? Json::parse(of.group_attributes[g], nullptr, false) : Json::object();
    groups.push_back({{"name", of.group_name[g]},
                      {"role", of.group_role[g]},
                      {"attributes", own},
                      {"faces", faces_with(of.face_group, g)}});
  }
  return groups;
}

/// Adds the groups of edges or vertices to their tables, which are made where they have no faces.
void add_entity_groups(const std::vector<EntityGroup>& groups, const char* kind, Json& tables) {
  for (const EntityGroup& g : groups) {
    const std::string name = g.table.empty() ? "main" : g.table;
    auto it = std::find_if(tables.begin(), tables.end(), [&](const Json& t) { return t["table"] == name; });
    if (it == tables.end()) {
      Json table = {{"table", name}, {"groups", Json::array()}};
      it = tables.insert(tables.end(), std::move(table));
    }
    std::vector<std::int32_t> ids = g.ids;
    for (std::int32_t& id : ids) ++id;
    (*it)["groups"].push_back(
        {{"name", g.name}, {"attributes", Json::parse(g.attributes, nullptr, false)}, {kind, ids}});
  }
}

Json report(const Identity& id) {
  Json json = {{"tables", Json::array()},     {"parts", Json::array()},   {"face_names", Json::object()},
               {"layers", Json::object()},    {"colors", Json::object()}, {"surfaces", Json::object()},
               {"edge_names", Json::object()}};
  const FaceLabels& labels = id.labels;
  json["tables"].push_back({{"table", "main"}, {"groups", groups_json(labels)}});
  for (const GroupTable& t : labels.tables) json["tables"].push_back({{"table", t.name}, {"groups", groups_json(t)}});
  add_entity_groups(labels.edge_groups, "edges", json["tables"]);
  add_entity_groups(labels.vertex_groups, "vertices", json["tables"]);
  for (std::size_t p = 0; p < labels.part_path.size(); ++p)
    json["parts"].push_back(
        {{"path", labels.part_path[p]}, {"name", labels.part_name[p]}, {"faces", faces_with(labels.face_part, p)}});
  const auto add = [&](const char* key, const std::vector<std::string>& texts) {
    for (std::size_t f = 0; f < texts.size(); ++f)
      if (!texts[f].empty()) json[key][texts[f]].push_back(f + 1);
  };
  add("face_names", labels.face_name);
  add("layers", id.face_layer);
  add("colors", id.face_color);
  add("surfaces", id.face_surface);
  add("edge_names", id.edge_name);
  return json;
}

/// "12 faces", "1 vertex".
std::string counted(std::size_t n, std::string kind) {
  if (n == 1) kind = kind == "vertices" ? "vertex" : kind.substr(0, kind.size() - 1);
  return fmt::format("{} {}", n, kind);
}

std::string row(const std::string& name, const Json& entities, const std::string& more, const char* kind = "faces",
                const std::string& what = "") {
  const std::vector<std::int32_t> ids = entities.get<std::vector<std::int32_t>>();
  return fmt::format("  \"{}\"{}: {}{}{}{}\n", name, more, counted(ids.size(), kind), what, ids.empty() ? "" : ": ",
                     id_ranges(ids));
}

/// "\"nut\", \"bolt\" and 3 more": of the texts that faces have, the group's own name left out.
std::string listed(const std::vector<std::string>& texts, const std::string& own) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> all;
  for (const std::string& text : texts)
    if (!text.empty() && text != own && std::ranges::find(all, text) == all.end()) all.push_back(text);
  std::string list;
  for (std::size_t k = 0; k < std::min(all.size(), kMost); ++k)
    list += fmt::format("{}\"{}\"", k > 0 ? ", " : "", all[k]);
  return all.size() > kMost ? fmt::format("{} and {} more", list, all.size() - kMost) : list;
}

/// What the faces of a group are: parts and names, and of a geometry area and place.
std::string in_words(const Json& group, const Identity& id) {
  std::vector<std::string> parts, names;
  double area = 0;
  Box3 box;
  const FaceLabels& l = id.labels;
  for (const std::size_t number : group["faces"].get<std::vector<std::size_t>>()) {
    const std::size_t f = number - 1;
    if (f < l.face_part.size() && l.face_part[f] != kNone)
      parts.push_back(l.part_name[static_cast<std::size_t>(l.face_part[f])]);
    names.push_back(l.face_name[f]);
    if (f >= id.face_area.size()) continue;
    area += id.face_area[f];
    box.add(id.face_box[f]);
  }
  const std::string own = group["name"], part = listed(parts, own), name = listed(names, own);
  std::string text = part.empty() ? "" : " of " + part;
  if (!name.empty()) text += " named " + name;
  if (box.is_empty()) return text;
  return text + fmt::format(", area {:.4g}{}, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}){}", area,
                            in_unit(id.unit, 2), box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z,
                            in_unit(id.unit));
}

/// Lists groups of faces, edges or vertices.
std::string group_row(const Json& g, const Identity& id) {
  const char* const kind = g.contains("edges") ? "edges" : g.contains("vertices") ? "vertices" : "faces";
  const std::string role = g.contains("role") ? ", " + g["role"].get<std::string>() : "",
                    attributes = g["attributes"].empty() ? "" : ", " + json_text(g["attributes"]);
  return row(g["name"], g[kind], role + attributes, kind, g.contains("faces") ? in_words(g, id) : "");
}

std::string lines(const Json& json, const Identity& id) {
  std::string text;
  for (const Json& table : json["tables"]) {
    text += fmt::format("groups, table {}: {}\n", table["table"].get<std::string>(), table["groups"].size());
    for (const Json& g : table["groups"]) text += group_row(g, id);
  }
  text += fmt::format("parts: {}\n", json["parts"].size());
  for (const Json& p : json["parts"]) text += row(p["path"], p["faces"], "");
  const char* const edge_names = "edge_names";
  for (const auto& [key, what] :
       {std::pair("face_names", "names of faces"), std::pair("layers", "layers"), std::pair("colors", "colors"),
        std::pair("surfaces", "surfaces"), std::pair(edge_names, "names of edges")}) {
    if (json[key].empty()) continue;
    text += fmt::format("{}: {}\n", what, json[key].size());
    for (const auto& [name, ids] : json[key].items()) text += row(name, ids, "", key == edge_names ? "edges" : "faces");
  }
  text.pop_back();
  return text;
}

}  // namespace

StageSummary run_groups(const std::string& artifact) {
  Json json = {{"tool", "st-info"}, {"artifact", artifact}};
  const Identity id = identity_of(artifact);
  json.update(report(id));
  return {lines(json, id), json_text(json)};
}

}  // namespace st
