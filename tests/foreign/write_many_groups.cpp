// write_many_groups FILE: a mesh artifact of 500 groups of two triangles each: a square sheet of 1000 triangles. Names
// are long, have blanks, quotes, umlauts and other scripts, and some are equal in their first 32 bytes.
#include <cstdio>
#include <exception>
#include <string>

#include "unit/io/sample_artifacts.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  constexpr int kColumns = 25, kRows = 20;
  st::MeshArtifact artifact;
  artifact.header = st::sample_header();
  st::SurfaceMesh& m = artifact.mesh;
  const char* kinds[] = {"Flügel unten ", "wing root, \"left\" ", "翼 ", "a/b ",
                         "a very long name of a group that differs late "};
  for (int row = 0; row <= kRows; ++row)
    for (int column = 0; column <= kColumns; ++column) {
      m.node_xyz.push_back({0.5 * column, 0.25 * row, 0});
      m.node_entity_dim.push_back(2);
      m.node_entity.push_back(0);
      m.node_t.push_back(0);
      m.node_size.push_back(0.5);
    }
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const int group = row * kColumns + column;
      const st::NodeId a = row * (kColumns + 1) + column, b = a + 1, c = b + kColumns + 1, d = c - 1;
      for (const st::Triangle& t : {st::Triangle{{a, b, c}}, st::Triangle{{a, c, d}}}) {
        m.triangles.push_back(t);
        m.triangle_face.push_back(group);
        m.triangle_group.push_back(group);
        for (const st::NodeId n : t.n) m.corner_uv.push_back({m.node_xyz[n].x, m.node_xyz[n].y});
      }
      m.labels.face_name.push_back("");
      m.labels.group_name.push_back(kinds[group % 5] + std::to_string(group));
      m.labels.group_role.push_back("wall");
    }
  try {
    st::write_mesh(argv[1], artifact);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
