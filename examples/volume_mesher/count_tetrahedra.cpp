// count_tetrahedra mesh.hdf sizing.hdf: what a volume mesher starts from. Reads the surface mesh with its groups and
// the sizes in space, and says how many tetrahedra of these sizes the closed surface would hold.
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"

namespace {

/// Of the tetrahedra between a point and the triangles: negative where normals point inward.
double volume_of(const st::SurfaceMesh& mesh) {
  double six = 0;
  for (const st::Triangle& t : mesh.triangles)
    six += dot(mesh.node_xyz[t.n[0]], cross(mesh.node_xyz[t.n[1]], mesh.node_xyz[t.n[2]]));
  return six / 6;
}

/// The integral of 1 over the volume of a regular tetrahedron of the size asked for, over the mesh's box; outside of
/// the surface, too: a volume mesher would ask for the size of each of its own points instead.
double tetrahedra_in_box(const st::SizeField& sizes, const st::Box3& box) {
  constexpr int kSamples = 64;  // along each axis
  const st::Vec3 step = (box.hi - box.lo) / kSamples;
  double count = 0;
  int hint = 0;  // the last leaf: the next point is near
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j)
      for (int k = 0; k < kSamples; ++k) {
        const st::Vec3 x = box.lo + st::Vec3{(i + 0.5) * step.x, (j + 0.5) * step.y, (k + 0.5) * step.z};
        const double length = sizes.size(x, hint);
        count += step.x * step.y * step.z / (length * length * length / (6 * std::sqrt(2.0)));
      }
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: count_tetrahedra mesh.hdf sizing.hdf\n");
    return 2;
  }
  try {
    const st::MeshArtifact artifact = st::read_mesh(argv[1]);
    st::ArtifactHeader header;
    const std::unique_ptr<st::SizeField> sizes = st::open_sizing(argv[2], &header);
    st::require_same_geometry(argv[1], artifact.header, argv[2], header);
    const st::SurfaceMesh& mesh = artifact.mesh;
    st::Box3 box;
    for (const st::Vec3& x : mesh.node_xyz) box.add(x);
    std::printf("%lld triangles, %lld nodes\n", static_cast<long long>(mesh.n_triangles()),
                static_cast<long long>(mesh.n_nodes()));
    for (const std::string& group : mesh.labels.group_name) std::printf("group %s\n", group.c_str());
    const st::Vec3 edges = box.hi - box.lo;
    const double volume = volume_of(mesh), of_box = edges.x * edges.y * edges.z;
    std::printf("volume %.6g\n", volume);
    std::printf("about %.0f tetrahedra\n", tetrahedra_in_box(*sizes, box) * std::abs(volume) / of_box);
  } catch (const st::Error& e) {
    std::fprintf(stderr, "count_tetrahedra: error: %s\n", e.what());
    return static_cast<int>(e.code());
  }
  return 0;
}
