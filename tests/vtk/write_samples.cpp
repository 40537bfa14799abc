// write_samples DIR: the sample mesh as an artifact and in every export format.
#include <cstdio>
#include <exception>
#include <string>

#include "io/export/export.h"
#include "unit/io/sample_artifacts.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string directory = std::string(argv[1]) + "/";
  try {
    const st::MeshArtifact mesh = st::sample_mesh();
    st::write_mesh(directory + "mesh.hdf", mesh);
    for (const char* name : {"mesh.vtu", "mesh.stl", "mesh.obj", "mesh.ply", "mesh.ascii.stl"})
      st::export_mesh(directory + name, mesh.mesh);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
