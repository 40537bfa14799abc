// What a mesh has at noses and trailing edges.
#include "stages/wing_measure.h"

#include <gtest/gtest.h>

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
