// What a mesh has at noses and trailing edges.
#include "stages/wing_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/wing_table.h"
#include "unit/stages/plank.h"

namespace st {
namespace {

using test::kChordwise;
using test::kSpanwise;
using test::plank;
using test::record;

TEST(WingMeasure, knows_lengths_across_and_along_the_span) {
  const WingRecord wing = record(0.05);
  const std::vector<WingMeasure> all = measure_wings(plank(), {&wing, 1});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].n_triangles, 2 * 2 * kChordwise * kSpanwise);
  EXPECT_EQ(all[0].first_edge, 4);
  ASSERT_EQ(all[0].stations.size(), 5u);
  double share = 0.1;
  for (const WingStationMeasure& s : all[0].stations) {
    EXPECT_NEAR(s.share, share, 0.02);
    share += 0.2;
    for (const LengthsAt& at : {s.nose, s.trailing}) {
      EXPECT_NEAR(at.normal, 0.05, 1e-9);
      EXPECT_NEAR(at.along, 0.5 * (0.1 + std::hypot(0.05, 0.1)), 0.003) << "sides along the span and diagonals";
    }
    EXPECT_NEAR(s.chord_cells, kChordwise, 1e-6);
    EXPECT_EQ(s.turning, 0);
    EXPECT_EQ(s.base_cells, 0);
  }
  EXPECT_TRUE(find_misses(all).empty());
  EXPECT_EQ(all[0].held, 1);
  ASSERT_TRUE(all[0].worst);
  EXPECT_NEAR(all[0].worst->has / all[0].worst->asked, 1, 1e-9);
}

TEST(WingMeasure, of_cells_that_grow_is_the_length_at_the_edge) {
  std::vector<double> x{0};
  for (double length = 0.04; x.back() + length < 0.5; length *= 1.2) x.push_back(x.back() + length);
  for (int i = static_cast<int>(x.size()) - 1; i >= 0; --i) x.push_back(1 - x[i]);
  const WingRecord wing = record(0.04);
  for (const WingStationMeasure& s : measure_wings(test::plank_of(x, 80, 0), {&wing, 1})[0].stations)
    for (const LengthsAt& at : {s.nose, s.trailing}) {
      EXPECT_GE(at.normal, 0.04);
      EXPECT_LT(at.normal, 0.046) << "with two rows more it is 0.05";
    }
}

TEST(WingMeasure, of_triangles_that_scatter_is_the_mean_of_several_along_the_span) {
  std::vector<double> x;
  for (int i = 0; i <= kChordwise; ++i) x.push_back(0.05 * i);
  SurfaceMesh mesh = test::plank_of(x, 80, 0);
  for (Vec3& node : mesh.node_xyz)  // one column has rows of 0.1 at the nose
    if (node.x < 0.4 && std::abs(node.y - 2) < 0.01) node.x *= 2;
  const WingRecord wing = record(0.05);
  const std::vector<WingMeasure> all = measure_wings(mesh, {&wing, 1});
  ASSERT_TRUE(all[0].worst);
  EXPECT_LT(all[0].worst->has, 0.067) << "of half as many sides it is 0.07";
}

TEST(WingMeasure, of_half_a_fin_counts_the_lengths_of_its_only_side) {
  SurfaceMesh half = plank();
  half.triangles.resize(half.triangles.size() / 2);
  half.triangle_face.resize(half.triangles.size());
  const WingRecord wing = record(0.05);
  for (const WingStationMeasure& s : measure_wings(half, {&wing, 1})[0].stations)
    EXPECT_NEAR(s.chord_cells, kChordwise, 1e-6);
}

TEST(WingMeasure, of_stretched_rows_has_their_heights) {
  std::vector<double> x{0};
  for (double height = 0.001; x.back() + height < 0.5; height *= 1.2) x.push_back(x.back() + height);
  const auto n_half = static_cast<int>(x.size());
  for (int i = n_half - 1; i >= 0; --i) x.push_back(1 - x[i]);
  const WingRecord wing = record(0.001);
  const std::vector<WingMeasure> all = measure_wings(test::plank_of(x, 16, 0.1), {&wing, 1});
  EXPECT_EQ(all[0].held, 1);
  for (const WingStationMeasure& s : all[0].stations) {
    EXPECT_GE(s.nose.normal, 0.001);
    EXPECT_LT(s.nose.normal, 0.0013);
    EXPECT_LT(s.trailing.normal, 0.0013);
    EXPECT_NEAR(s.chord_cells, 2 * n_half - 1, 1);
  }
  EXPECT_TRUE(find_misses(all).empty());
}

/// A row's stations may run askew, and its diagonals either way.
TEST(WingMeasure, of_sheared_rows_has_their_heights) {
  std::vector<double> x{0};
  for (double height = 0.001; x.back() + height < 0.5; height *= 1.2) x.push_back(x.back() + height);
  for (int i = static_cast<int>(x.size()) - 1; i >= 0; --i) x.push_back(1 - x[i]);
  SurfaceMesh mesh = test::plank_of(x, 16, 0.1);
  for (Vec3& n : mesh.node_xyz) n.y += 3 * std::min({n.x, 1 - n.x, 0.02});
  const WingRecord wing = record(0.001);
  const std::vector<WingMeasure> all = measure_wings(mesh, {&wing, 1});
  EXPECT_EQ(all[0].held, 1);
  for (const WingStationMeasure& s : all[0].stations) {
    EXPECT_GE(s.nose.normal, 0.001);
    EXPECT_LT(s.nose.normal, 0.00125) << "that row and a part of the next";
    EXPECT_LT(s.trailing.normal, 0.00125);
  }
}

/// A strut's rows, where the surface that it joins runs across it.
TEST(WingMeasure, of_rows_that_leave_the_span_has_their_heights) {
  std::vector<double> x{0};
  for (double height = 0.001; x.back() + height < 0.5; height *= 1.2) x.push_back(x.back() + height);
  for (int i = static_cast<int>(x.size()) - 1; i >= 0; --i) x.push_back(1 - x[i]);
  WingRecord wing = record(0.001);
  for (const double far : {50.0, 100.0}) wing.stations.push_back({{far - 1, 2, 0}, {far, 2, 0}, 1, 0});
  const SurfaceMesh mesh = test::plank_of(x, 16, 0.1);
  EXPECT_EQ(measure_wings(mesh, {&wing, 1})[0].held, 1);
  EXPECT_TRUE(find_unheld(mesh, {&wing, 1}).empty());
}

TEST(WingMeasure, of_noses_alone_counts_for_what_is_held) {
  WingRecord wing = record(0.05);
  for (WingRecord::Station& s : wing.stations)
    if (s.nose.y > 3) s = {s.nose, s.nose, 4, 0.025};  // steps of a twentieth of the chord
  const std::vector<WingMeasure> all = measure_wings(plank(), {&wing, 1});
  EXPECT_NEAR(all[0].held, 0.75, 0.02);
  ASSERT_TRUE(all[0].worst);
  EXPECT_STREQ(all[0].worst->what, "nose") << "there is no trailing edge behind it";
  EXPECT_NEAR(all[0].worst->has / all[0].worst->asked, 2, 1e-9);
  EXPECT_EQ(all[0].worst->place.x, 0);
  for (const WingStationMeasure& s : all[0].stations) EXPECT_LT(s.place.y, 3) << "of the trailing edge";
}

/// What lies between two runs of them is on no nose, as between a pylon and a tip.
TEST(WingMeasure, of_noses_alone_counts_no_way_between_their_runs) {
  WingRecord wing = record(0.05);
  for (const double y : {0.3, 0.35, 3.5, 3.55})
    wing.stations.push_back({{0, y, 0}, {0, y, 0}, 1, y < 1 ? 0.025 : 0.05});
  const double way = distance(wing.stations.front().trailing, wing.stations[wing.stations.size() - 5].trailing);
  EXPECT_NEAR(measure_wings(plank(), {&wing, 1})[0].held, 1 - 0.05 / (way + 0.1), 1e-9);
}

/// Stations of both edges of a base take turns along the span, and one edge has its noses elsewhere.
TEST(WingMeasure, of_rows_goes_along_the_noses_of_one_edge) {
  std::vector<double> x{0};
  for (double height = 0.001; x.back() + height < 0.5; height *= 1.2) x.push_back(x.back() + height);
  for (int i = static_cast<int>(x.size()) - 1; i >= 0; --i) x.push_back(1 - x[i]);
  WingRecord wing = record(0.001);
  WingRecord other = wing;
  for (WingRecord::Station& s : other.stations) s = {{0.1, s.nose.y, 0}, s.trailing + Vec3{0, 0.09, 0}, 1, 0};
  wing.stations.insert(wing.stations.end(), other.stations.begin(), other.stations.end());
  const SurfaceMesh mesh = test::plank_of(x, 16, 0.1);
  for (const WingStationMeasure& s : measure_wings(mesh, {&wing, 1})[0].stations)
    EXPECT_TRUE(s.asked == 0 || s.nose.normal < 0.0013);
  EXPECT_TRUE(find_unheld(mesh, {&wing, 1}).empty());
}

/// As on the end of a wing.
TEST(WingMeasure, of_a_flat_triangle_square_to_the_span_is_no_longer_than_its_sides) {
  SurfaceMesh mesh = test::plank();
  const auto n = static_cast<NodeId>(mesh.node_xyz.size());
  for (const Vec3 x : {Vec3{0, 3.95, 0}, {0.01, 3.95, 0}, {0, 3.95, 0.001}}) mesh.node_xyz.push_back(x);
  mesh.triangles.push_back({{n, n + 1, n + 2}});
  mesh.triangle_face.push_back(0);
  const WingRecord wing = record(0.05);
  const std::vector<WingMeasure> all = measure_wings(mesh, {&wing, 1});
  ASSERT_TRUE(all[0].worst);
  EXPECT_LT(all[0].worst->has, 0.06);
  EXPECT_EQ(all[0].held, 1);
}

TEST(WingMeasure, holds_on_the_share_of_the_span_where_no_place_is_too_coarse) {
  WingRecord wing = record(0.05);
  for (WingRecord::Station& s : wing.stations)
    if (s.trailing.y > 3) s.asked = 0.037;  // has 1.35 times that
  wing.stations[5].asked = 0.03;
  const std::vector<WingMeasure> all = measure_wings(plank(), {&wing, 1});
  EXPECT_NEAR(all[0].held, 0.75, 0.01);
  ASSERT_TRUE(all[0].worst);
  EXPECT_NEAR(all[0].worst->has / all[0].worst->asked, 0.05 / 0.03, 1e-9);
  const std::vector<WingMiss> misses = find_misses(all);
  ASSERT_EQ(misses.size(), 1u) << "between the five stations, and above 1.5";
  EXPECT_NEAR(misses[0].place.y, wing.stations[5].nose.y, 1e-12);
}

TEST(WingMeasure, finds_places_that_are_not_held) {
  SurfaceMesh mesh = plank();
  mesh.triangle_face.clear();
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.node_xyz[t.n[2]].y > 3.25; });
  for (const Triangle& t : mesh.triangles) mesh.triangle_face.push_back(mesh.node_xyz[t.n[0]].z > 0 ? 0 : 1);
  WingRecord wing = record(0.05);
  wing.stations[6].asked = 0.03;  // at y = 3.35, where no triangle is left
  wing.stations[15].asked = 0.03;
  wing.stations[17].asked = 0;
  const std::vector<UnheldPlace> all = find_unheld(mesh, {&wing, 1});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(std::ranges::count(all, wing.stations[15].nose, &UnheldPlace::xyz), 1);
  EXPECT_EQ(std::ranges::count(all, wing.stations[15].trailing, &UnheldPlace::xyz), 1);
  EXPECT_NEAR(all[0].radius, 0.09, 1e-12) << "three lengths";
  wing.stations.erase(wing.stations.begin() + 16, wing.stations.begin() + 19);
  EXPECT_NEAR(find_unheld(mesh, {&wing, 1}).at(0).radius, 0.09, 1e-12) << "however far the next ones are";
}

TEST(WingMeasure, finds_them_on_wings_held_on_less_than_99_percent) {
  const SurfaceMesh mesh = plank();
  for (const double share : {0.015, 0.005}) {
    WingRecord wing = record(0.05);
    wing.stations[15].asked = 0.03;
    const double part = share * distance(wing.stations.front().trailing, wing.stations.back().trailing);
    for (const int step : {-1, 1})
      for (const auto place : {&WingRecord::Station::nose, &WingRecord::Station::trailing})
        wing.stations[15 + step].*place = wing.stations[15].*place + step * Vec3{0, part, 0};
    if (wing.stations[16].nose.y < wing.stations[14].nose.y) std::swap(wing.stations[14], wing.stations[16]);
    EXPECT_NEAR(measure_wings(mesh, {&wing, 1})[0].held, 1 - share, 1e-6);
    EXPECT_EQ(find_unheld(mesh, {&wing, 1}).empty(), share < 0.01) << share;
  }
}

/// Cells of 0.05 along the chord and `n_around` around a ring of radius 2 about x, 0.1 thick: face 0 outside, 1 inside.
SurfaceMesh ring_mesh(int n_around) {
  SurfaceMesh mesh;
  for (int side = 0; side < 2; ++side) {
    const auto first = static_cast<NodeId>(mesh.node_xyz.size());
    for (int j = 0; j < n_around; ++j)
      for (int i = 0; i <= kChordwise; ++i) {
        const double angle = 2 * kPi * j / n_around, r = side == 0 ? 2.05 : 1.95;
        mesh.node_xyz.push_back({0.05 * i, r * std::cos(angle), r * std::sin(angle)});
      }
    const auto node = [&](int i, int j) { return first + (j % n_around) * (kChordwise + 1) + i; };
    for (int j = 0; j < n_around; ++j)
      for (int i = 0; i < kChordwise; ++i)
        for (const Triangle& t : {Triangle{{node(i, j), node(i + 1, j), node(i + 1, j + 1)}},
                                  Triangle{{node(i, j), node(i + 1, j + 1), node(i, j + 1)}}}) {
          mesh.triangles.push_back(t);
          mesh.triangle_face.push_back(side);
        }
  }
  return mesh;
}

TEST(WingMeasure, goes_around_a_ring) {
  constexpr int kAround = 120;
  for (const int n_stations : {kAround, kAround * 9 / 10}) {  // whole, and open by 36 degrees
    WingRecord wing;
    for (int j = 0; j < n_stations; ++j) {
      const double angle = 2 * kPi * (j + 0.5) / kAround;
      const Vec3 nose = {0, 2 * std::cos(angle), 2 * std::sin(angle)};
      wing.stations.push_back({nose, nose + Vec3{1, 0, 0}, 1, 0.05});
    }
    wing.edges = {4};
    wing.faces = {0, 1};
    const std::vector<WingMeasure> all = measure_wings(ring_mesh(kAround), {&wing, 1});
    EXPECT_EQ(all[0].stations.size(), 5u);
    for (const WingStationMeasure& s : all[0].stations) {
      EXPECT_NEAR(s.chord_cells, kChordwise, 1e-6) << "at " << s.share;
      EXPECT_NEAR(s.nose.normal, 0.05, 1e-3) << "at " << s.share;
      EXPECT_NEAR(s.nose.along, 0.5 * (0.1 + std::hypot(0.05, 0.1)), 0.01) << "at " << s.share;
    }
    EXPECT_EQ(all[0].held, 1);
    wing.stations[0].asked = 0.03;  // around the end of the list
    EXPECT_NEAR(measure_wings(ring_mesh(kAround), {&wing, 1})[0].held,
                1 - (n_stations == kAround ? 1.0 : 0.5) / n_stations, 2e-3);
  }
}

TEST(WingMeasure, says_where_more_was_asked_for) {
  const WingRecord wing = record(0.03);
  std::vector<WingMeasure> all = measure_wings(plank(), {&wing, 1});
  const std::vector<WingMiss> misses = find_misses(all);
  EXPECT_EQ(misses.size(), 11u) << "noses and trailing edges at five stations, and the worst of all";
  EXPECT_EQ(misses.front().what, std::string("nose"));
  EXPECT_NEAR(misses.front().has, 0.05, 1e-9);
  all[0].stations.resize(1);
  all[0].worst.reset();
  all[0].stations[0].asked = 0;
  EXPECT_TRUE(find_misses(all).empty()) << "rules say what it gets";
  all[0].stations[0].base_cells = 2;
  all[0].stations[0].asked_base_cells = 4;
  ASSERT_EQ(find_misses(all).size(), 1u);
  EXPECT_EQ(find_misses(all)[0].what, std::string("base"));
}

TEST(WingMeasure, of_a_kink_inside_a_face_is_its_angle) {
  SurfaceMesh mesh = plank();
  for (Vec3& x : mesh.node_xyz)
    if (x.x < 0.02) x.z *= 0.2;  // bends the first row down
  WingRecord wing = record(0.05);
  for (WingRecord::Station& s : wing.stations) s.nose.x = s.trailing.x - (s.chord = 5), s.nose.x = 0.05;
  const std::vector<WingMeasure> all = measure_wings(mesh, {&wing, 1});
  EXPECT_NEAR(all[0].stations[2].turning, std::atan2(0.04, 0.05), 1e-6);
}

TEST(WingMeasure, of_a_surface_without_noses_has_its_trailing_edge) {
  WingRecord wing = record(0.05);
  wing.faces.clear();
  wing.has_noses = false;
  const std::vector<WingMeasure> all = measure_wings(plank(), {&wing, 1});
  ASSERT_EQ(all[0].stations.size(), 5u);
  EXPECT_NEAR(all[0].stations[0].trailing.normal, 0.05, 1e-9);
  EXPECT_EQ(all[0].stations[0].nose.normal, 0);
  EXPECT_EQ(all[0].n_triangles, 0);
}

}  // namespace
}  // namespace st
