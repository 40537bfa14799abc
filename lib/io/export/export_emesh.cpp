// OpenFOAM's .eMesh: the sharp, open and dividing sides of a mesh, for snappyHexMesh to keep.
#include "io/export/export_formats.h"
#include "mesh/feature_sides.h"

namespace st {

void export_emesh(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  const std::vector<std::array<NodeId, 2>> sides = feature_sides(m, task.options.feature_angle_deg);
  std::vector<std::int64_t> number(m.node_xyz.size(), kNone);
  for (const auto& side : sides)
    for (const NodeId n : side) number[n] = 0;
  std::int64_t n_points = 0;
  for (std::int64_t& n : number)
    if (n != kNone) n = n_points++;
  TextBuffer text(out);
  text << "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class featureEdgeMesh;\n    object features;\n}\n\n"
       << n_points << "\n(\n";
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] != kNone) text << "(" << m.node_xyz[i].x << " " << m.node_xyz[i].y << " " << m.node_xyz[i].z << ")\n";
  text << ")\n\n" << static_cast<std::int64_t>(sides.size()) << "\n(\n";
  for (const auto& [a, b] : sides) text << "(" << number[a] << " " << number[b] << ")\n";
  text << ")\n";
  text.flush();
}

}  // namespace st
