#include "io/export/displacement_export.h"

#include "io/export/export_formats.h"
#include "io/export/vtu_writer.h"

namespace st {
namespace {

void write_csv(Output& out, std::span<const Vec3> from, const SurfaceMesh& moved) {
  TextBuffer text(out);
  text << "node,x,y,z,dx,dy,dz\n";
  for (std::size_t n = 0; n < from.size(); ++n) {
    const Vec3 d = moved.node_xyz[n] - from[n];
    text << static_cast<std::int64_t>(n);
    for (const double value : {from[n].x, from[n].y, from[n].z, d.x, d.y, d.z}) text << "," << value;
    text << "\n";
  }
  text.flush();
}

void write_vtu(Output& out, std::span<const Vec3> from, const SurfaceMesh& moved) {
  constexpr std::uint8_t kTriangle = 5;
  std::vector<double> xyz, by;
  for (std::size_t n = 0; n < from.size(); ++n) {
    const Vec3 d = moved.node_xyz[n] - from[n];
    xyz.insert(xyz.end(), {from[n].x, from[n].y, from[n].z});
    by.insert(by.end(), {d.x, d.y, d.z});
  }
  std::vector<std::int32_t> nodes;
  std::vector<std::int64_t> offsets;
  for (const Triangle& t : moved.triangles) {
    nodes.insert(nodes.end(), t.n, t.n + 3);
    offsets.push_back(static_cast<std::int64_t>(nodes.size()));
  }
  begin_vtu(out);
  out.text("<Piece NumberOfPoints=\"" + std::to_string(from.size()) + "\" NumberOfCells=\"" +
           std::to_string(offsets.size()) + "\">\n<Points>\n");
  write_vtu_array(out, "Points", xyz, 3);
  out.text("</Points>\n<Cells>\n");
  write_vtu_array(out, "connectivity", nodes);
  write_vtu_array(out, "offsets", offsets);
  write_vtu_array(out, "types", std::vector<std::uint8_t>(offsets.size(), kTriangle));
  out.text("</Cells>\n<PointData>\n");
  write_vtu_array(out, "displacement", by, 3);
  out.text("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace

void require_displacement_format(const std::string& path) {
  if (!path.ends_with(".vtu") && !path.ends_with(".csv"))
    throw Error(ExitCode::kUsage, path + ": displacements are written as .vtu or .csv; give one of these suffixes");
}

void export_displacements(const std::string& path, std::span<const Vec3> from, const SurfaceMesh& moved) {
  require_displacement_format(path);
  Output out(path);
  path.ends_with(".csv") ? write_csv(out, from, moved) : write_vtu(out, from, moved);
  out.commit();
}

}  // namespace st
