#include "stages/fitting_files.h"

#include <optional>
#include <utility>

#include "io/foreign/triangulation_reader.h"
#include "io/hdf5/artifact.h"

namespace st {

void require_fitting(const std::vector<GivenFile>& files) {
  std::optional<std::pair<std::string, ArtifactHeader>> first;
  for (const GivenFile& file : files) {
    if (file.path.empty() || is_foreign_mesh(file.path)) continue;
    ArtifactHeader header = read_header(file.path);
    if (header.schema != file.schema) continue;
    if (first)
      require_same_geometry(first->first, first->second, file.path, header);
    else
      first.emplace(file.path, std::move(header));
  }
}

}  // namespace st
