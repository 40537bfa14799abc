#include "sizing/metric_in_space.h"

#include <gtest/gtest.h>

#include "sizing/space_metric.h"
#include "unit/sizing/background_meshes.h"
#include "unit/sizing/shock_metric.h"

namespace st::test {
namespace {

constexpr Vec3 kMiddle{0.4, 0.5, 0.6};

std::unique_ptr<SizeSource> cube_of_one_metric(const SymmetricTensor& metric) {
  BackgroundMesh mesh = cube_of_tets(2, [](Vec3) { return 1; });
  for (LocalSize& size : mesh.node_size) size = size_of_metric(metric);
  mesh.node_metric.assign(mesh.node_xyz.size(), metric);
  return make_background(std::move(mesh), 0.3);
}

TEST(MetricInSpace, has_both_long_lengths_of_a_shock) {
  const SymmetricTensor metric = metric_of_shock(normalized(Vec3{1, 2, 3}), 0.1, 0.4);
  const auto field = cube_of_one_metric(metric);
  int hint = 0;
  const SymmetricTensor told = metric_in_space(*field, kMiddle, hint);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(told[i], metric[i], 1e-9) << i;
}

TEST(MetricInSpace, has_three_lengths) {
  SymmetricTensor metric = metric_of_shock(normalized(Vec3{1, 2, 3}), 0.1, 0.4);
  const SymmetricTensor other = metric_of_shock(normalized(Vec3{3, 0, -1}), 0.2, 0.8);
  for (std::size_t i = 0; i < 6; ++i) metric[i] += other[i];
  const auto field = cube_of_one_metric(metric);
  int hint = 0;
  const SymmetricTensor told = metric_in_space(*field, kMiddle, hint);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(told[i], metric[i], 1e-9) << i;
}

/// Its planes ask for lengths that no metric has.
class Contradiction : public UniformField {
 public:
  Contradiction() : UniformField(1) {}
  LocalSize local_on(Vec3, Vec3 normal, int&) const override {
    const Vec3 a = normal.x > 0 ? Vec3{0, 1, 1} : normal.y > 0 ? Vec3{1, 0, 1} : Vec3{1, 1, 0};
    return {1, 100, normalized(a)};
  }
  bool has_metrics() const override { return true; }
};

TEST(MetricInSpace, is_that_of_the_lengths_where_planes_contradict_each_other) {
  int hint = 0;
  EXPECT_EQ(metric_in_space(Contradiction(), {}, hint), (SymmetricTensor{1, 1, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace st::test
