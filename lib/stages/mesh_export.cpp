#include "stages/mesh_export.h"

#include <fmt/format.h>

#include "base/log.h"
#include "io/export/export.h"
#include "io/hdf5/artifact.h"

namespace st {

void export_and_warn(const std::string& path, const SurfaceMesh& mesh) {
  const std::size_t n_lost = export_mesh(path, mesh);
  if (n_lost > 0)
    log_warning(fmt::format(
        "{}: the format holds no groups of edges or vertices, {} are left out; .msh, .vtu, .obj and .ply hold them",
        path, n_lost));
}

}  // namespace st
