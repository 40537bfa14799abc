// The FLITE family's .fro: counts, nodes, triangles with the number of their CAD face.
#include <algorithm>

#include "io/export/export_formats.h"

namespace st {

void export_fro(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  TextBuffer text(out);
  const FaceId last = m.triangle_face.empty() ? -1 : *std::max_element(m.triangle_face.begin(), m.triangle_face.end());
  const std::int64_t n_faces = std::max<std::int64_t>(static_cast<std::int64_t>(m.labels.face_name.size()), last + 1);
  text << m.n_triangles() << " " << m.n_nodes() << " 1 0 0 " << n_faces << " 0 0\n";
  for (std::size_t i = 0; i < m.node_xyz.size(); ++i) {
    const Vec3& p = m.node_xyz[i];
    text << static_cast<std::int64_t>(i + 1) << " " << p.x << " " << p.y << " " << p.z << "\n";
  }
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    text << static_cast<std::int64_t>(i + 1);
    for (const NodeId n : m.triangles[i].n) text << " " << std::int64_t{n + 1};
    text << " " << std::int64_t{m.triangle_face[i] + 1} << "\n";
  }
  text.flush();
}

}  // namespace st
