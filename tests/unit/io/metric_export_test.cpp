#include "io/export/metric_export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "io/foreign/size_mesh.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

BackgroundMesh two_tets() {
  BackgroundMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  return mesh;
}

TEST(MetricExport, is_read_back_as_it_was_written) {
  const TemporaryDirectory dir;
  const Vec3 t = normalized(Vec3{1, 2, -3});
  // 0.5 along t, 0.1 across it
  std::array<double, 6> stretched{100 - 96 * t.x * t.x, 100 - 96 * t.y * t.y, 100 - 96 * t.z * t.z,
                                  -96 * t.x * t.y,      -96 * t.y * t.z,      -96 * t.x * t.z};
  BackgroundMesh surface = two_tets();
  surface.tets.clear();
  surface.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}};
  for (const BackgroundMesh& mesh : {two_tets(), surface})
    for (const char* name : {"m.sol", "m.solb"}) {
      export_metric(dir / name, mesh, std::vector<std::array<double, 6>>(5, stretched));
      const BackgroundMesh read = read_size_mesh(dir / name);
      EXPECT_EQ(read.tets, mesh.tets);
      EXPECT_EQ(read.triangles, mesh.triangles);
      EXPECT_EQ(read.node_xyz, mesh.node_xyz);
      for (const LocalSize& s : read.node_size) {
        EXPECT_NEAR(s.length, 0.1, 1e-12);
        EXPECT_NEAR(s.along, 0.5, 1e-12);
        EXPECT_NEAR(std::abs(dot(s.direction, t)), 1, 1e-12);
      }
    }
}

TEST(MetricExport, has_one_length_for_each_node_where_no_metric_has_a_direction) {
  const TemporaryDirectory dir;
  export_metric(dir / "m.solb", two_tets(), std::vector<std::array<double, 6>>(5, {16, 16, 16, 0, 0, 0}));
  const BackgroundMesh read = read_size_mesh(dir / "m.solb");
  for (const LocalSize& s : read.node_size) EXPECT_EQ(s.length, 0.25);
  EXPECT_LT(std::filesystem::file_size(dir / "m.solb"), 120u);
}

TEST(MetricExport, takes_names_of_solutions_alone) {
  EXPECT_EQ(metric_files("a/b.sol"), (std::array<std::string, 2>{"a/b.mesh", "a/b.sol"}));
  EXPECT_EQ(metric_files("b.solb"), (std::array<std::string, 2>{"b.meshb", "b.solb"}));
  EXPECT_ERROR(metric_files("b.vtu"), kUsage, "sizes are written as .solb");
}

}  // namespace
}  // namespace st
