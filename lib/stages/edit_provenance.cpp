#include "stages/edit_provenance.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/file/json_text.h"

namespace st {

std::string edit_options_json(const EditStageOptions& o) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : {std::pair("as", &o.as), std::pair("join", &o.join),
                                    std::pair("extract", &o.extract), std::pair("remove", &o.remove)})
    if (!value->empty()) json[name] = *value;
  if (!o.transforms.empty()) json["transform"] = o.transforms;
  if (!o.of.empty()) json["of"] = o.of;
  return json_text(json);
}

Similarity whole_motion(const std::string& path, const ArtifactHeader& moved, const std::string& geometry_hash) {
  const auto fail = [&](const std::string& what) {
    throw Error(
        ExitCode::kMismatch,
        fmt::format("{}: {}; give the geometry of the raster as st-edit --transform moved it as a whole", path, what));
  };
  if (moved.content_hash == geometry_hash) return {};
  if (moved.tool != "st-edit")
    fail(fmt::format("was made by {}, not moved by st-edit, and is not the geometry of the raster", moved.tool));
  if (moved.inputs.size() != 1) fail(fmt::format("was joined from {} geometries", moved.inputs.size()));
  if (moved.inputs[0].hash != geometry_hash)
    fail(fmt::format("was made from {}, which is not the geometry of the raster", moved.inputs[0].name));
  const nlohmann::json options = nlohmann::json::parse(moved.options_json, nullptr, false);
  if (!options.is_object()) fail("does not say how it was made");
  for (const char* partial : {"extract", "remove", "of"})
    if (options.contains(partial)) fail(fmt::format("was not moved as a whole (--{})", partial));
  Similarity motion;
  if (options.contains("transform"))
    for (const nlohmann::json& steps : options["transform"])
      motion = motion.then(parse_similarity(steps.is_string() ? steps.get<std::string>() : "?", path));
  return motion;
}

}  // namespace st
