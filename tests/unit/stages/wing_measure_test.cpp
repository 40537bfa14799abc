// What a mesh has at noses and trailing edges.
#include "stages/wing_measure.h"

#include <gtest/gtest.h>

#include "stages/wing_table.h"

namespace st {
namespace {

constexpr int kChordwise = 20, kSpanwise = 40;  // cells of 0.05 by 0.1

/// A wing of chord 1 and span 4 along y: face 0 above and face 1 below, one apart from the other by 0.1.
SurfaceMesh plank() {
  SurfaceMesh mesh;
  for (int side = 0; side < 2; ++side) {
    const auto first = static_cast<NodeId>(mesh.node_xyz.size());
    for (int j = 0; j <= kSpanwise; ++j)
      for (int i = 0; i <= kChordwise; ++i) mesh.node_xyz.push_back({0.05 * i, 0.1 * j, side == 0 ? 0.05 : -0.05});
    const auto node = [&](int i, int j) { return first + j * (kChordwise + 1) + i; };
    for (int j = 0; j < kSpanwise; ++j)
      for (int i = 0; i < kChordwise; ++i)
        for (const Triangle& t : {Triangle{{node(i, j), node(i + 1, j), node(i + 1, j + 1)}},
                                  Triangle{{node(i, j), node(i + 1, j + 1), node(i, j + 1)}}}) {
          mesh.triangles.push_back(t);
          mesh.triangle_face.push_back(side);
        }
  }
  return mesh;
}

/// Stations at each cell's middle, in whatever order.
WingRecord record(double asked) {
  WingRecord wing;
  for (int j = kSpanwise - 1; j >= 0; --j) {
    const double y = 0.1 * (j + 0.5);
    wing.stations.push_back({{0, y, 0}, {1, y, 0}, 1, asked});
  }
  wing.edges = {4};
  wing.faces = {0, 1};
  wing.span = 4;
  return wing;
}

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
}

TEST(WingMeasure, says_where_more_was_asked_for) {
  const WingRecord wing = record(0.03);
  std::vector<WingMeasure> all = measure_wings(plank(), {&wing, 1});
  const std::vector<WingMiss> misses = find_misses(all);
  EXPECT_EQ(misses.size(), 10u) << "noses and trailing edges at five stations";
  EXPECT_EQ(misses.front().what, std::string("nose"));
  EXPECT_NEAR(misses.front().has, 0.05, 1e-9);
  all[0].stations.resize(1);
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

TEST(WingTable, has_a_line_for_each_surface) {
  EXPECT_EQ(wing_table({}, false), "");
  const std::vector<WingRecord> wings = {record(0.05), record(0.05)};
  const std::vector<WingMeasure> all = measure_wings(plank(), wings);
  const std::string text = wing_table(all, false);
  EXPECT_EQ(std::ranges::count(text, '\n'), 4);
  EXPECT_NE(text.find("edge 5"), std::string::npos) << text;
  EXPECT_NE(text.find("5 5 5 5 5"), std::string::npos) << text;
  EXPECT_NE(wing_table(all, true).find("nose along"), std::string::npos);
  const nlohmann::json json = wing_measures_json(all);
  EXPECT_EQ(json.size(), 2u);
  EXPECT_EQ(json[1]["stations"].size(), 5u);
  EXPECT_NEAR(json[1]["stations"][0]["nose"]["normal"].get<double>(), 0.05, 1e-9);
}

}  // namespace
}  // namespace st
