#include "stages/fitting_files.h"

#include <gtest/gtest.h>

#include "io/hdf5/artifact.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// A geometry of this shape, and a mesh that goes back to it.
void write_both(const std::string& shape, const TemporaryDirectory& dir) {
  ImportResult r = test::import_shape(shape);
  GeometryArtifact g;
  g.tables = std::move(r.tables);
  g.brep = std::move(r.brep);
  MeshArtifact mesh;
  mesh.header.geometry_hash = write_geometry(dir / (shape + ".hdf"), g);
  write_mesh(dir / (shape + "_mesh.hdf"), mesh);
}

TEST(FittingFiles, go_back_to_one_geometry) {
  const TemporaryDirectory dir;
  write_both("box", dir);
  write_both("sphere", dir);
  const std::string box = dir / "box.hdf", of_box = dir / "box_mesh.hdf", of_sphere = dir / "sphere_mesh.hdf";
  EXPECT_NO_THROW(require_fitting({{box, "geometry"}, {"", "sizing"}, {of_box, "mesh"}}));
  EXPECT_ERROR(require_fitting({{box, "geometry"}, {of_sphere, "mesh"}}), kMismatch, "sphere_mesh.hdf");
  EXPECT_NO_THROW(require_fitting({{box, "geometry"}, {of_sphere, "sizing"}})) << "who reads it says that it is none";
  EXPECT_ERROR(require_fitting({{dir / "none.hdf", "geometry"}}), kInput, "none.hdf");
}

}  // namespace
}  // namespace st
