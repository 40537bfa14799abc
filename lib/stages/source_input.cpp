#include "stages/source_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "io/file/text_file.h"

namespace st {
namespace {

/// Reference to a file that is no artifact: name and hash of its bytes.
InputRef file_ref(const std::string& role, const std::string& path) {
  const std::string text = read_text_file(path);
  return {role, std::filesystem::path(path).filename().string(), hash_hex(text.data(), text.size())};
}

/// A named source takes the place of an earlier one of its name.
void merge(std::vector<SourceSpec>& all, const SourceFile& file, const std::string& path) {
  for (const std::string& name : file.deleted) {
    const auto is_it = [&](const SourceSpec& s) { return s.name == name; };
    if (std::none_of(all.begin(), all.end(), is_it))
      throw Error(ExitCode::kInput, fmt::format("{}: no source is named '{}'; nothing to delete", path, name));
    std::erase_if(all, is_it);
  }
  const std::size_t n_before = all.size();
  for (const SourceSpec& source : file.sources) {
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(n_before);
    const auto old = source.name.empty()
                         ? end
                         : std::find_if(all.begin(), end, [&](const SourceSpec& s) { return s.name == source.name; });
    if (old != end)
      *old = source;
    else
      all.push_back(source);
  }
}

void add_background(BackgroundMesh&& mesh, const Similarity& motion, bool is_stretched, SourceInput& input) {
  if (const std::int64_t n = is_stretched ? 0 : remove_stretch(mesh))
    log_warning(
        fmt::format("{} nodes of the background mesh are anisotropic, and their smallest spacing is used; give "
                    "st-raster --max-aspect to keep the others",
                    n));
  transform(motion, mesh);
  for (auto& tet : make_sources(mesh)) {
    input.sources.push_back({tet.get(), pack_cause(CauseKind::kOther, 0)});
    input.owned.push_back(std::move(tet));
  }
  input.n_tets += mesh.tets.size();
}

}  // namespace

SourceInput read_sources(const std::vector<std::string>& files, const std::string& background, const Similarity& motion,
                         double slope, const ModelScale& scale, bool is_stretched) {
  SourceInput input;
  std::vector<SourceSpec> specs;
  const auto take = [&](SourceFile&& file, const std::string& path, const std::string& role) {
    merge(specs, file, path);
    add_background(std::move(file.background), motion, is_stretched, input);
    input.files.push_back(file_ref(role, path));
  };
  if (!background.empty()) take(read_background_file(background), background, "background");
  for (const std::string& path : files) take(read_source_file(path, scale), path, "sources");
  for (SourceSpec& spec : specs) {
    transform(motion, spec);
    input.owned.push_back(make_source(spec, slope));
    input.sources.push_back(
        {input.owned.back().get(), pack_cause(CauseKind::kSource, static_cast<std::int32_t>(input.names.size()))});
    input.names.push_back(spec.name);
    input.max_aspect = std::max(input.max_aspect, spec.aspect);
  }
  return input;
}

}  // namespace st
