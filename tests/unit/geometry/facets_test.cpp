// Coarse triangles of faces.
#include "geometry/model/facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "geometry/facet/facet_cuts.h"
#include "geometry/facet/facet_faces.h"
#include "geometry/facet/facet_model.h"
#include "support/backward_executor.h"
#include "support/shapes.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

TEST(Facets, of_neighbours_share_their_nodes) {
  const Model model = test::make_model("box");
  const std::vector<std::uint8_t> all(6, 1);
  const Facets facets = make_facets(model, all, {.deflection = 0.1});
  EXPECT_EQ(facets.triangle.size(), 12u);
  std::vector<std::int32_t> nodes;
  for (const auto& t : facets.triangle) nodes.insert(nodes.end(), t.begin(), t.end());
  std::sort(nodes.begin(), nodes.end());
  EXPECT_EQ(std::unique(nodes.begin(), nodes.end()) - nodes.begin(), 8);
}

TEST(Facets, of_many_faces_are_the_same_in_whatever_order_tasks_arrive) {
  constexpr int kCubes = 40;  // 240 faces
  const Model model = test::make_row_of_cubes(kCubes);
  std::vector<std::uint8_t> wanted(6 * kCubes, 1);
  wanted[7] = 0;
  const Facets facets = make_facets(model, wanted, {.deflection = 0.1});
  EXPECT_EQ(facets.triangle.size(), 12u * kCubes - 2);
  EXPECT_TRUE(std::is_sorted(facets.face.begin(), facets.face.end()));
  const test::BackwardExecutor backward;
  const Facets other = make_facets(model, wanted, {.deflection = 0.1}, backward);
  EXPECT_GT(backward.n_tasks, 1u);
  EXPECT_EQ(facets.face, other.face);
  EXPECT_EQ(facets.triangle, other.triangle);
  EXPECT_EQ(facets.xyz, other.xyz);
}

TEST(Facets, join_those_of_other_faces) {
  const Model model = test::make_model("box");
  Facets facets = make_facets(model, {0, 1, 0, 1, 0, 1}, {.deflection = 0.1});
  add_facets(model, {1, 0, 1, 0, 1, 0}, {.deflection = 0.1}, SerialExecutor(), facets);
  const Facets all = make_facets(model, std::vector<std::uint8_t>(6, 1), {.deflection = 0.1});
  EXPECT_EQ(facets.face, all.face);
  std::vector<std::int32_t> nodes;
  for (const auto& t : facets.triangle) nodes.insert(nodes.end(), t.begin(), t.end());
  std::sort(nodes.begin(), nodes.end());
  EXPECT_EQ(std::unique(nodes.begin(), nodes.end()) - nodes.begin(), 8);
}

/// Returns those that came one by one.
Facets expect_same_one_by_one(const Model& model) {
  const FaceId n_faces = model.tables().n_faces();
  const auto only = [&](FaceId f) {
    std::vector<std::uint8_t> wanted(static_cast<std::size_t>(n_faces), 0);
    wanted[static_cast<std::size_t>(f)] = 1;
    return wanted;
  };
  Facets steps, unjoined;
  for (FaceId k = 0; k < n_faces; ++k) {
    const FaceId f = (k * 31) % n_faces;  // here and there
    add_facets(model, only(f), {.deflection = 0.1}, SerialExecutor(), steps);
    append_facets(make_unjoined_facets(model, only(f), {.deflection = 0.1}, SerialExecutor()), unjoined);
  }
  Facets once;
  join_facets(model, std::move(unjoined), once);
  EXPECT_EQ(steps.face, once.face);
  EXPECT_EQ(steps.xyz, once.xyz);
  EXPECT_EQ(steps.triangle, once.triangle) << "nodes in one place are the first of them";
  return steps;
}

TEST(Facets, that_come_one_by_one_are_joined_as_if_they_came_at_once) {
  const Facets steps = expect_same_one_by_one(test::make_row_of_cubes(12));
  EXPECT_TRUE(std::ranges::is_sorted(steps.along_x, {}, [&](std::int32_t n) { return steps.xyz[n].x; }));
}

TEST(Facets, of_a_model_of_facets_that_come_one_by_one_are_joined_as_if_they_came_at_once) {
  FacetMesh mesh = find_smooth_faces(test::drum_facets(24, 3), radians(40));
  cut_into_charts(mesh);
  const FacetModel made = make_facet_model(mesh, {""}, radians(40));
  const Model model(made.tables, made.shape);
  expect_same_one_by_one(model);
  const Facets all = make_facets(model, std::vector<std::uint8_t>(made.tables.n_faces(), 1), {.deflection = 0.1});
  for (const auto& t : all.triangle)
    for (const std::int32_t n : t)
      EXPECT_EQ(std::ranges::find(all.xyz, all.xyz[n]) - all.xyz.begin(), n) << "the first node at its place";
}

}  // namespace
}  // namespace st
