// Triangles that a mesh lacks.
#include "meshing/hole/mesh_gaps.h"

#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

/// The box's mesh without some of its triangles.
SurfaceMesh without_triangles(SurfaceMesh m, TriangleId begin, TriangleId end) {
  m.triangles.erase(m.triangles.begin() + begin, m.triangles.begin() + end);
  m.triangle_face.erase(m.triangle_face.begin() + begin, m.triangle_face.begin() + end);
  m.triangle_group.erase(m.triangle_group.begin() + begin, m.triangle_group.begin() + end);
  m.corner_uv.erase(m.corner_uv.begin() + 3 * begin, m.corner_uv.begin() + 3 * end);
  return m;
}

TEST(MeshGaps, are_missing_triangles_in_a_face_and_missing_faces) {
  const BoxMesh box;
  const ModelTables& t = box.model.tables();
  const HoleMesh whole(box.mesh, t);
  EXPECT_TRUE(find_open_sides(whole).empty());
  const SurfaceMesh punched = without_triangles(box.mesh, whole.face_begin[2] + 5, whole.face_begin[2] + 6);
  EXPECT_EQ(find_open_sides(HoleMesh(punched, t)).size(), 3u);
  const SurfaceMesh open = without_triangles(box.mesh, whole.face_begin[1], whole.face_begin[2]);
  const HoleMesh holes(open, t);
  EXPECT_GT(find_open_sides(holes).size(), 3u);
  for (const OpenSide& s : find_open_sides(holes)) EXPECT_FALSE(holes.segments_between(s.low, s.high).empty());
}

TEST(MeshGaps, are_none_at_the_rims_of_an_open_model) {
  const ShapeMesh plate("plate_with_hole", 0.04);
  EXPECT_TRUE(find_open_sides(HoleMesh(plate.mesh, plate.model.tables())).empty());
  TriangleId inner = 0;  // off the rims
  while (std::any_of(plate.mesh.triangles[inner].n, plate.mesh.triangles[inner].n + 3,
                     [&](NodeId n) { return plate.mesh.node_entity_dim[n] < 2; }))
    ++inner;
  const SurfaceMesh punched = without_triangles(plate.mesh, inner, inner + 1);
  EXPECT_EQ(find_open_sides(HoleMesh(punched, plate.model.tables())).size(), 3u);
}

}  // namespace
}  // namespace st::test
