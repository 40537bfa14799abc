#include "io/export/cell_view.h"

#include "io/export/vtu_writer.h"

namespace st {

void write_cell_view(const std::string& path, const CellView& view) {
  std::vector<double> xyz;
  for (const Vec3& p : view.points) xyz.insert(xyz.end(), {p.x, p.y, p.z});
  Output out(path);
  begin_vtu(out);
  out.text("<FieldData>\n");
  for (const auto& [what, names] : view.names) write_vtu_names(out, what, names);
  out.text("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(view.points.size()) + "\" NumberOfCells=\"" +
           std::to_string(view.types.size()) + "\">\n<Points>\n");
  write_vtu_array(out, "Points", xyz, 3);
  out.text("</Points>\n<Cells>\n");
  write_vtu_array(out, "connectivity", view.nodes);
  write_vtu_array(out, "offsets", view.offsets);
  write_vtu_array(out, "types", view.types);
  out.text("</Cells>\n<CellData>\n");
  for (const auto& [name, values] : view.values) write_vtu_array(out, name, values);
  out.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  out.commit();
}

}  // namespace st
