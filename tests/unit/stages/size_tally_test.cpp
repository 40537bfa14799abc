// What a size field requires of groups of faces, and why.
#include "stages/size_tally.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "stages/expected_triangles.h"
#include "stages/size_report.h"
#include "support/staged.h"

namespace st {
namespace {

const std::int32_t kWing = pack_cause(CauseKind::kFace, 0), kTip = pack_cause(CauseKind::kEdge, 4);
const CauseNames kNames{{"", "", "", "", "TE"}, {"wing", "body", ""}, {}};

/// A part of this face with one length.
SizedPart part_of(FaceId face, std::int32_t cause, double area, double length) {
  return {face, cause, area, length, {area / (length * length), 0}};
}

double sum_of_shares(const GroupSizes& group) {
  double sum = 0;
  for (const CauseShare& c : group.causes) sum += group.share(c);
  return sum;
}

/// Three faces: two in the first group, one that is left out.
SizeTally wing_and_body() {
  SizeTally tally({"WING", "BODY", "EMPTY"}, {0, 1, kNone});
  tally.add(part_of(0, kWing, 4, 1));
  tally.add(part_of(0, kTip, 1, 0.1));
  tally.add(part_of(0, kWing, 2, 2));
  tally.add(part_of(1, kWing, 9, 3));
  tally.add(part_of(2, kTip, 100, 0.01));
  return tally;
}

TEST(SizeTally, sums_triangles_by_group_and_cause_most_first) {
  const std::vector<GroupSizes> groups = wing_and_body().groups(1, 1);
  ASSERT_EQ(groups.size(), 2U) << "groups without area are left out";
  EXPECT_EQ(groups[0].name, "WING");
  EXPECT_NEAR(groups[0].triangles, kTrianglesPerWeight * (100 + 4 + 0.5), 1e-9);
  ASSERT_EQ(groups[0].causes.size(), 2U);
  EXPECT_EQ(groups[0].causes[0].cause, kTip);
  EXPECT_NEAR(groups[0].share(groups[0].causes[0]), 100 / 104.5, 1e-12);
  EXPECT_NEAR(sum_of_shares(groups[0]), 1, 1e-12);
  EXPECT_EQ(groups[0].causes[1].least, 1);
  EXPECT_NEAR(groups[1].triangles, kTrianglesPerWeight, 1e-9);
}

TEST(SizeTally, takes_the_median_by_area) {
  const std::vector<GroupSizes> groups = wing_and_body().groups(1, 1);
  EXPECT_EQ(groups[0].least, 0.1);
  EXPECT_EQ(groups[0].median, 1);
  EXPECT_EQ(groups[1].least, 3);
  EXPECT_EQ(groups[1].median, 3);
}

TEST(SizeTally, scales_lengths_and_triangles_and_moves_lengths_alone) {
  const std::vector<GroupSizes> once = wing_and_body().groups(1, 1), half = wing_and_body().groups(0.5, 10);
  EXPECT_NEAR(half[0].triangles, 4 * once[0].triangles, 1e-9);
  EXPECT_NEAR(half[0].least, 5 * once[0].least, 1e-12);
  EXPECT_NEAR(half[0].median, 5 * once[0].median, 1e-12);
}

TEST(SizeTally, shows_the_groups_with_most_triangles_and_counts_the_others) {
  const std::vector<GroupSizes> groups = wing_and_body().groups(1, 1);
  EXPECT_EQ(group_lines(groups, kNames, 2),
            (std::vector<std::string>{"  group  triangles  least length  median  most because of",
                                      "  WING         241           0.1       1  edge 5 \"TE\" (96 %)",
                                      "  BODY           2             3       3  face 1 \"wing\" (100 %)"}));
  EXPECT_EQ(group_lines(groups, kNames, 1).back(), "  and 1 more");
  EXPECT_NE(group_lines(groups, kNames, 1, "mm")[0].find("least length, mm  median, mm"), std::string::npos);
  EXPECT_NE(range_text(groups, "mm").find(" mm on the faces"), std::string::npos);
  EXPECT_EQ(groups_json(groups, kNames)[0]["cause"], "edge 5 \"TE\"");
}

TEST(SizeTally, shows_the_causes_with_most_triangles_and_unites_the_others) {
  const GroupSizes wing = wing_and_body().groups(1, 1)[0];
  EXPECT_EQ(cause_lines(wing, kNames, 1), (std::vector<std::string>{"  cause        triangles   share  least length",
                                                                    "  edge 5 \"TE\"        231  95.7 %           0.1",
                                                                    "  1 more              10   4.3 %             1"}));
  EXPECT_EQ(cause_lines(wing, kNames, 2).size(), 3U);
}

class SizesOfModel : public testing::Test {
 protected:
  void SetUp() override { staged_.make_raster("drilled_block"); }

  test::StagedModel staged_;
};

TEST_F(SizesOfModel, parts_sum_up_to_the_weights_of_the_faces) {
  staged_.make_sizing();
  const RasterArtifact raster = read_raster(staged_.raster.output);
  const MappedSizing sizing = map_sizing(staged_.prolong.output);
  SizeTally tally = tally_by_group(raster.model.labels, raster.model.faces.n_faces());
  std::vector<double> weight(sizing.face_weight.size(), 0), area(weight.size(), 0);
  face_weights(raster.model.faces, raster.octree.shape.view(), *sizing.field, [&](const SizedPart& p) {
    EXPECT_LE(p.least, p.length());
    weight[p.face] += p.weight.at(1);
    area[p.face] += p.area;
    tally.add(p);
  });
  for (std::size_t f = 0; f < weight.size(); ++f) {
    EXPECT_NEAR(weight[f] / sizing.face_weight[f], 1, 1e-9);
    double in_cells = 0;
    for (std::int64_t k = raster.model.faces.offsets[f]; k < raster.model.faces.offsets[f + 1]; ++k)
      in_cells += static_cast<double>(raster.model.faces.area[static_cast<std::size_t>(k)]);
    EXPECT_NEAR(area[f] / in_cells, 1, 1e-9);
  }
  double triangles = 0;
  for (const GroupSizes& g : tally.groups(1, 1)) {
    triangles += g.triangles;
    EXPECT_LE(g.least, g.median);
    EXPECT_NEAR(sum_of_shares(g), 1, 1e-12);
  }
  EXPECT_NEAR(triangles / expected_triangles(sizing.face_weight), 1, 1e-9);
}

TEST_F(SizesOfModel, of_the_samples_are_at_least_those_of_the_field) {
  staged_.make_sizing();
  const RasterArtifact raster = read_raster(staged_.raster.output);
  const MappedSizing sizing = map_sizing(staged_.prolong.output);
  const std::vector<GroupSizes> sampled = sampled_groups(raster);
  SizeTally tally = tally_by_group(raster.model.labels, raster.model.faces.n_faces());
  face_weights(raster.model.faces, raster.octree.shape.view(), *sizing.field,
               [&](const SizedPart& p) { tally.add(p); });
  const std::vector<GroupSizes> groups = tally.groups(1, 1);
  ASSERT_EQ(sampled.size(), groups.size());
  for (const GroupSizes& g : sampled) {
    const auto same =
        std::find_if(groups.begin(), groups.end(), [&](const GroupSizes& other) { return other.name == g.name; });
    ASSERT_NE(same, groups.end());
    EXPECT_LE(g.least, g.median);
    EXPECT_GE(g.least, raster.numbers.min_length * (1 - 1e-6));
    EXPECT_LE(same->least, g.least * (1 + 5e-2))
        << "growth makes lengths smaller only; beside a sample they are larger";
    EXPECT_NEAR(sum_of_shares(g), 1, 1e-12);
  }
  const std::vector<std::string> lines = sampled_lines(sampled, raster.model.cause_names(), 12);
  EXPECT_EQ(lines.size(), 1 + sampled.size());
  EXPECT_EQ(lines[0].find("triangles"), std::string::npos);
}

TEST_F(SizesOfModel, stand_in_the_summary_and_follow_the_scale) {
  for (const double scale : {1.0, 0.7}) {
    staged_.prolong.scale = scale;
    const nlohmann::json json = staged_.make_sizing();
    double triangles = 0;
    for (const nlohmann::json& g : json["groups"]) {
      triangles += g["expected_triangles"].get<double>();
      EXPECT_LE(g["least"], g["median"]);
      EXPECT_LE(g["median"], json["lmax"]);
      EXPECT_TRUE(g["share"] > 0 && g["share"] <= 1 + 1e-12) << g;
    }
    EXPECT_NEAR(triangles, json["expected_triangles"].get<double>(), 1);
  }
}

}  // namespace
}  // namespace st
