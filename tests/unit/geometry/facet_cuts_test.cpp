#include "geometry/facet/facet_cuts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/threads.h"
#include "geometry/facet/facet_faces.h"
#include "geometry/facet/knife_sides.h"
#include "geometry/shape/flatten.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

FacetMesh charts_of(const FacetInput& input) {
  FacetMesh mesh = find_smooth_faces(input, radians(40));
  cut_into_charts(mesh);
  return mesh;
}

std::int32_t n_charts(const FacetMesh& mesh) { return 1 + *std::max_element(mesh.face.begin(), mesh.face.end()); }

/// Every face is one disc whose parameters have no flips and stretch less than kMostStretch.
void expect_charts(const FacetMesh& mesh) {
  for (std::int32_t f = 0; f < n_charts(mesh); ++f) {
    std::vector<std::int32_t> own;
    for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
      if (mesh.face[t] == f) own.push_back(t);
    const std::vector<FacetPatch> patches = PatchFinder(mesh).find(own);
    ASSERT_EQ(patches.size(), 1u);
    const FacetPatch& p = patches.front();
    std::vector<Vec2> uv(p.x.size());
    for (std::size_t i = 0; i < p.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) uv[p.corners[i][k]] = mesh.uv[p.triangles[i]][k];
    EXPECT_LE(largest_stretch(p.x, p.corners, uv), kMostStretch);
    const PatchTopology t = find_topology(p.x, p.corners);
    EXPECT_TRUE(t.is_manifold && t.genus == 0 && !t.loops.empty());
  }
}

TEST(FacetCuts, leave_alone_what_is_flat) {
  const FacetMesh mesh = charts_of(test::cube_facets());
  EXPECT_EQ(n_charts(mesh), 6);
  EXPECT_EQ(mesh.n_triangles(), 12);
  expect_charts(mesh);
}

TEST(FacetCuts, open_a_sphere_a_torus_and_a_tube) {
  for (const auto& [input, most] : {std::pair(test::sphere_facets(20), 4), std::pair(test::torus_facets(48, 24), 8),
                                    std::pair(test::drum_facets(48, 6), 6)}) {
    const FacetMesh mesh = charts_of(input);
    EXPECT_LE(n_charts(mesh), most);
    expect_charts(mesh);
    for (const Corners& c : find_neighbours(mesh.corners)) EXPECT_EQ(std::count(c.begin(), c.end(), kNone), 0);
  }
}

TEST(FacetCuts, leave_no_face_on_both_sides_of_a_trailing_edge) {
  for (const int n_along : {1, 6, 40}) {
    const FacetMesh mesh = charts_of(test::skin_facets(120, n_along));
    EXPECT_LE(n_charts(mesh), 3);
    expect_charts(mesh);
    for (std::int32_t f = 0; f < n_charts(mesh); ++f) {
      std::vector<std::int32_t> own;
      for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
        if (mesh.face[t] == f) own.push_back(t);
      EXPECT_FALSE(KnifeSides(PatchFinder(mesh).find(own).front()).any());
    }
  }
}

TEST(FacetCuts, of_many_facets_are_those_of_few) {
  const FacetMesh few = charts_of(test::torus_facets(48, 24)), many = charts_of(test::torus_facets(320, 160));
  EXPECT_LE(n_charts(many), n_charts(few));
  expect_charts(many);
}

TEST(FacetCuts, are_the_same_at_any_number_of_threads) {
  const FacetInput torus = test::torus_facets(320, 160);
  const FacetMesh one = charts_of(torus);
  set_thread_count(3);
  const FacetMesh three = charts_of(torus);
  set_thread_count(1);
  EXPECT_TRUE(one.face == three.face && one.corners == three.corners && one.uv == three.uv && one.x == three.x);
}

TEST(FacetCuts, keep_the_surface) {
  const FacetInput torus = test::torus_facets(48, 24);
  EXPECT_NEAR(test::area_of(charts_of(torus)), test::area_of(find_smooth_faces(torus, radians(40))), 1e-11);
}

TEST(FacetCuts, of_a_tube_run_along_it) {
  const FacetInput tube = test::grid_facets(48, 40, [](int i, int j) {
    const double a = kPi * (i % 48) / 24;
    return Vec3{std::cos(a), std::sin(a), 0.2 * j};
  });
  EXPECT_EQ(n_charts(charts_of(tube)), 2);
}

/// A plate of 40 x 40 squares, bent to an arc that rises by `rise`, with a hole that opens along its middle and is 1
/// degree wide at its end, as behind the root of a sharp wing.
FacetInput plate_with_narrow_hole(double rise) {
  FacetInput plate = test::grid_facets(40, 40, [=](int i, int j) {
    return Vec3{0.1 * i, 0.1 * j, rise * std::sin(kPi * i / 40)};
  });
  std::vector<std::int32_t> above(plate.x.size(), kNone);
  for (std::int32_t n = 0; n < 41 * 41; ++n) {
    const Vec3 x = plate.x[n];
    if (std::abs(x.y - 2) > 0.01 || x.x < 1.05 || x.x > 2.95) continue;
    above[n] = static_cast<std::int32_t>(plate.x.size());
    plate.x.push_back(x + Vec3{0, std::tan(radians(1)) * (3 - x.x), 0});
  }
  for (Corners& c : plate.corners)
    if (std::any_of(c.begin(), c.end(), [&](std::int32_t n) { return plate.x[n].y > 2.05; }))
      for (std::int32_t& n : c)
        if (above[n] != kNone) n = above[n];
  return plate;
}

TEST(FacetCuts, begin_at_the_end_of_a_narrow_hole) {
  const FacetMesh bent = charts_of(plate_with_narrow_hole(0.2));
  EXPECT_EQ(n_charts(bent), 2);
  expect_charts(bent);
  EXPECT_EQ(n_charts(charts_of(plate_with_narrow_hole(0))), 1) << "a plane needs no cut";
}

}  // namespace
}  // namespace st
