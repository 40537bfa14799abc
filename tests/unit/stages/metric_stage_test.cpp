#include "stages/metric_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "base/error.h"
#include "io/foreign/size_mesh.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// The unit square in 2 n^2 triangles with `times` exp(-20 x) at its nodes: NAME.sol and NAME.mesh.
void write_layer(const std::string& stem, int n, double times = 1) {
  std::ofstream mesh(stem + ".mesh"), solution(stem + ".sol");
  mesh << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << (n + 1) * (n + 1) << "\n";
  solution << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" << (n + 1) * (n + 1) << "\n1 1\n";
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      mesh << static_cast<double>(i) / n << " " << static_cast<double>(j) / n << " 0 0\n";
      solution << times * std::exp(-20.0 * i / n) << "\n";
    }
  mesh << "Triangles\n" << 2 * n * n << "\n";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = 1 + i + (n + 1) * j, b = a + 1, c = a + n + 1, d = c + 1;
      mesh << a << " " << b << " " << d << " 0\n" << a << " " << d << " " << c << " 0\n";
    }
  mesh << "End\n";
  solution << "End\n";
}

TEST(MetricStage, writes_sizes_that_are_read_as_a_background) {
  const TemporaryDirectory dir;
  write_layer(dir / "flow", 40);
  MetricStageOptions o;
  o.fields = {dir / "flow.sol"};
  o.output = dir / "sizes.solb";
  o.nodes = 500;
  o.max_aspect = 10;
  EXPECT_EQ(run_metric(o).code, ExitCode::kOk);
  const BackgroundMesh sizes = read_size_mesh(o.output);
  ASSERT_EQ(sizes.node_xyz.size(), 41u * 41u);
  double complexity = 0;  // the integral of one over the lengths
  for (std::size_t n = 0; n < sizes.node_size.size(); ++n) {
    const LocalSize& s = sizes.node_size[n];
    const Vec3 x = sizes.node_xyz[n];
    const auto share = [](double at) { return at < 0.01 || at > 0.99 ? 0.5 : 1; };  // of a cell, on the rim
    complexity += share(x.x) * share(x.y) / (s.length * s.along) / (40.0 * 40.0);
    if (x.x > 0.1 && x.x < 0.3 && x.y > 0.2 && x.y < 0.8) {
      EXPECT_NEAR(s.along / s.length, 10, 0.1);
      EXPECT_NEAR(std::abs(s.direction.y), 1, 1e-3);
    }
  }
  EXPECT_NEAR(complexity * 2 / std::sqrt(3.0), 500, 50);
}

TEST(MetricStage, sizes_do_not_depend_on_the_unit_of_the_field) {
  const TemporaryDirectory dir;
  std::vector<std::vector<LocalSize>> sizes;
  for (const double times : {1.0, 1e-280, 1e280}) {
    write_layer(dir / "flow", 20, times);
    MetricStageOptions o;
    o.fields = {dir / "flow.sol"};
    o.output = dir / "sizes.solb";
    run_metric(o);
    sizes.push_back(read_size_mesh(o.output).node_size);
  }
  for (std::size_t n = 0; n < sizes[0].size(); ++n)
    for (const std::size_t k : {1, 2}) EXPECT_NEAR(sizes[k][n].length / sizes[0][n].length, 1, 1e-3);
}

TEST(MetricStage, refuses_what_asks_for_nothing) {
  MetricStageOptions o;
  o.fields = {"flow.sol"};
  o.output = "sizes.vtu";
  EXPECT_ERROR(run_metric(o), kUsage, "sizes are written as .solb");
  o.output = "sizes.solb";
  o.box = "1 2 3";
  EXPECT_ERROR(run_metric(o), kUsage, "takes two corners");
}

}  // namespace
}  // namespace st
