#include "io/hdf5/face_numbers.h"

namespace st {

std::vector<FaceNumbers> face_numbers(const SurfaceMesh& mesh) {
  const FaceLabels& labels = mesh.labels;
  std::vector<FaceNumbers> all;
  if (labels.part_path.size() > 1) all.push_back({"part", &labels.part_path, &labels.face_part});
  for (const GroupTable& table : labels.tables)
    if (!table.group_name.empty()) all.push_back({"group_" + table.name, &table.group_name, &table.face_group});
  return all;
}

std::vector<std::int32_t> triangle_numbers(const SurfaceMesh& mesh, const FaceNumbers& numbers) {
  std::vector<std::int32_t> of_triangle;
  of_triangle.reserve(mesh.triangle_face.size());
  for (const FaceId f : mesh.triangle_face)
    of_triangle.push_back(static_cast<std::size_t>(f) < numbers.of_face->size() ? (*numbers.of_face)[f] + 1 : 0);
  return of_triangle;
}

}  // namespace st
