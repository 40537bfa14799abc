#include "sizing/field_hessian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/threads.h"
#include "unit/sizing/background_meshes.h"

namespace st {
namespace {

/// The unit square in 2 n^2 triangles, bent to a roof at x = 1/2 by `rise`.
BackgroundMesh roof(int n, double rise) {
  BackgroundMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      mesh.node_xyz.push_back({x, y, rise * std::min(x, 1 - x)});
    }
  test::add_square_cells(n, 0, mesh);
  return mesh;
}

/// A cube of n^3 cubes of six tetrahedra whose nodes are moved a little at random.
BackgroundMesh shaken_cube(int n) {
  BackgroundMesh mesh;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.node_xyz.push_back(Vec3{i + shift(random), j + shift(random), k + shift(random)} / n);
  test::add_cube_cells(n, mesh);
  return mesh;
}

template <class Field>
std::vector<double> values_on(const BackgroundMesh& mesh, const Field& field) {
  std::vector<double> value;
  for (const Vec3 p : mesh.node_xyz) value.push_back(field(p));
  return value;
}

TEST(FieldHessian, of_a_quadratic_field_is_exact_in_a_volume) {
  const BackgroundMesh mesh = shaken_cube(5);
  const NodeHessians fit = fit_hessians(mesh, values_on(mesh, [](Vec3 p) {
                                          return 3 + p.x - 2 * p.z + p.x * p.x - 2 * p.y * p.y + 0.5 * p.z * p.z +
                                                 3 * p.x * p.y - p.y * p.z + 4 * p.x * p.z;
                                        }));
  EXPECT_EQ(fit.n_unknown, 0);
  const SymmetricTensor wanted{2, -4, 1, 3, -1, 4};
  for (const SymmetricTensor& h : fit.of_node)
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(h[k], wanted[k], 1e-9);
}

TEST(FieldHessian, on_a_surface_lies_in_it_and_has_its_largest_value_across) {
  const BackgroundMesh mesh = roof(12, 0);
  const NodeHessians fit = fit_hessians(mesh, values_on(mesh, [](Vec3 p) { return 3 * p.x * p.x - p.y * p.y; }));
  const SymmetricTensor wanted{6, -2, 6, 0, 0, 0};
  for (const SymmetricTensor& h : fit.of_node)
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(h[k], wanted[k], 1e-9);
}

TEST(FieldHessian, does_not_see_a_kink_of_the_field_at_a_sharp_edge) {
  const BackgroundMesh mesh = roof(12, 1);
  const NodeHessians fit = fit_hessians(mesh, values_on(mesh, [](Vec3 p) { return 5 * p.z + p.y; }));
  EXPECT_EQ(fit.n_unknown, 0);
  for (const SymmetricTensor& h : fit.of_node)
    for (const double component : h) EXPECT_NEAR(component, 0, 1e-9);
}

TEST(FieldHessian, of_a_linear_field_is_zero_and_no_rounding) {
  const auto linear = [](Vec3 p) { return 1e5 + 0.1 * p.x + 0.3 * p.y; };
  for (const BackgroundMesh& mesh : {roof(12, 0), shaken_cube(5)})
    for (const SymmetricTensor& h : fit_hessians(mesh, values_on(mesh, linear)).of_node)
      EXPECT_EQ(h, SymmetricTensor{});
}

TEST(FieldHessian, sees_a_weak_field_on_a_large_constant) {
  const BackgroundMesh mesh = roof(12, 0);
  const NodeHessians fit = fit_hessians(mesh, values_on(mesh, [](Vec3 p) { return 1e5 + 1e-3 * p.x * p.x; }));
  for (const SymmetricTensor& h : fit.of_node) EXPECT_NEAR(h[0], 2e-3, 1e-6);
}

TEST(FieldHessian, is_unknown_where_too_few_nodes_tell_it) {
  BackgroundMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  EXPECT_EQ(fit_hessians(mesh, std::vector<double>{1, 2, 3, 4}).n_unknown, 4);
}

TEST(FieldHessian, is_the_same_for_every_number_of_threads) {
  const BackgroundMesh mesh = shaken_cube(20);
  const std::vector<double> value = values_on(mesh, [](Vec3 p) { return std::sin(7 * p.x) * std::exp(p.y - p.z); });
  const int before = thread_count();
  set_thread_count(1);
  const NodeHessians one = fit_hessians(mesh, value);
  set_thread_count(3);
  const NodeHessians three = fit_hessians(mesh, value);
  set_thread_count(before);
  EXPECT_EQ(one.of_node, three.of_node);
}

}  // namespace
}  // namespace st
