#include "stages/mesh_export.h"

#include <fmt/format.h>

#include "base/log.h"
#include "io/export/export.h"
#include "io/hdf5/artifact.h"

namespace st {

void export_and_warn(const std::string& path, const SurfaceMesh& mesh, const QuadPairs& elements) {
  const std::size_t n_lost = export_mesh(path, mesh, elements);
  if (n_lost > 0)
    log_warning(
        fmt::format("{}: this format has no groups of edges or vertices, so {} are not exported; .msh, .vtu, .obj and "
                    ".ply have them",
                    path, n_lost));
}

}  // namespace st
