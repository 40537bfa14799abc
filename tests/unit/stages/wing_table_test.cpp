// How lifting surfaces are told of.
#include "stages/wing_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/stages/plank.h"

namespace st {
namespace {

using test::plank;
using test::record;

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

TEST(WingTable, names_the_group_that_most_triangles_are_in) {
  SurfaceMesh mesh = plank();
  mesh.labels.group_name = {"default", "fin", "wing"};
  const std::vector<WingRecord> wings = {record(0.05)};
  for (const auto& [lower, expected] : {std::pair{2, ", wing"}, {1, ", fin"}, {0, ""}}) {
    mesh.triangle_group.assign(static_cast<std::size_t>(mesh.n_triangles()), lower);
    mesh.triangle_group[0] = 1;
    const std::string text = wing_lines(measure_wings(mesh, wings));
    EXPECT_EQ(text.find("  wing at edge 5" + std::string(expected) + " "), 0u) << text;
  }
}

}  // namespace
}  // namespace st
