#include "stages/report_origin.h"

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "io/hdf5/artifact.h"

namespace st {

std::string raster_beside(const std::string& sizing) {
  for (const InputRef& input : read_header(sizing).inputs) {
    if (input.role != "raster") continue;
    const std::string path = std::filesystem::path(sizing).replace_filename(input.name).string();
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none)) continue;
    const ArtifactHeader raster = read_header(path);
    if (raster.schema == "raster" && raster.content_hash == input.hash) return path;
  }
  return "";
}

nlohmann::ordered_json origins(std::span<const std::string> artifacts) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& path : artifacts) {
    if (path.empty()) continue;
    const ArtifactHeader header = read_header(path);
    nlohmann::ordered_json inputs = nlohmann::ordered_json::array();
    for (const InputRef& input : header.inputs)
      inputs.push_back({{"role", input.role}, {"name", input.name}, {"hash", input.hash}});
    nlohmann::ordered_json options = nlohmann::ordered_json::parse(header.options_json, nullptr, false);
    list.push_back({{"file", std::filesystem::path(path).filename().string()},
                    {"tool", header.tool},
                    {"version", header.tool_version},
                    {"hash", header.content_hash},
                    {"options", options.is_object() ? std::move(options) : nlohmann::ordered_json::object()},
                    {"inputs", std::move(inputs)}});
  }
  return list;
}

nlohmann::ordered_json stage_times(const std::string& folder) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  if (folder.empty()) return list;
  for (const char* stage : {"st-import", "st-raster", "st-prolong", "st-mesh", "st-remesh", "st-merge", "st-check"}) {
    std::ifstream file(std::filesystem::path(folder) / (std::string(stage) + ".seconds"));
    if (double seconds = 0; file >> seconds) list.push_back({stage, seconds});
  }
  if (list.empty())
    throw Error(ExitCode::kInput, folder + ": has no files such as st-mesh.seconds; give the folder OUT/log of make");
  return list;
}

}  // namespace st
