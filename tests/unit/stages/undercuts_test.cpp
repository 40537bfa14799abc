// Where lengths are below the least length that is given for them.
#include "stages/undercuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "support/staged.h"

namespace st {
namespace {

constexpr std::int32_t kFace3 = pack_cause(CauseKind::kFace, 2), kEdge1 = pack_cause(CauseKind::kEdge, 0);

TEST(Undercuts, are_counted_by_cause) {
  UndercutTally tally;
  tally.add(kEdge1, 0.5, 0, {});     // nothing is given
  tally.add(kEdge1, 0.9995, 1, {});  // rounding
  tally.add(kEdge1, 0.8, 1, {1, 0, 0});
  tally.add(kFace3, 0.7, 1, {2, 0, 0});
  tally.add(kFace3, 0.6, 1, {3, 0, 0});
  const std::vector<Undercut> all = tally.take();
  EXPECT_EQ(all, (std::vector<Undercut>{{kFace3, 2, 0.6, {2, 0, 0}}, {kEdge1, 1, 0.8, {1, 0, 0}}}));
  EXPECT_EQ(count(all), 3);
  EXPECT_EQ(least_of(all), 0.6);
  EXPECT_EQ(undercut_text(all, {{"TE"}, {"", "", "side"}, {}}, 2),
            "face 3 \"side\" (2, down to 1.2 near (2, 0, 0)), edge 1 \"TE\" (1, down to 1.6 near (1, 0, 0))");
}

class UndercutsOfModel : public testing::Test {
 protected:
  void SetUp() override {
    staged_.raster.lmin = "0.03";
    staged_.make_raster("thin_plate");  // its sides are 0.02 wide
  }
  test::StagedModel staged_;
};

TEST_F(UndercutsOfModel, by_strips_are_stored_in_the_raster) {
  const RasterArtifact raster = read_raster(staged_.raster.output);
  ASSERT_FALSE(raster.model.undercuts.empty());
  EXPECT_EQ(raster.model.face_lmin, std::vector<double>(raster.model.labels.face_name.size(), 0.03));
  for (const Undercut& u : raster.model.undercuts) {
    EXPECT_EQ(cause_kind(u.cause), CauseKind::kFace);
    EXPECT_NEAR(u.least, 0.025, 1e-4);
    EXPECT_NEAR(u.place.z, 0.01, 1e-4);
  }
  staged_.raster.lmin.clear();
  staged_.make_raster("thin_plate");
  EXPECT_TRUE(read_raster(staged_.raster.output).model.undercuts.empty());
  EXPECT_TRUE(read_raster(staged_.raster.output).model.face_lmin.empty());
}

TEST_F(UndercutsOfModel, by_neighbours_and_sources_are_stored_in_the_sizing) {
  staged_.make_sizing();
  const std::vector<Undercut> plain = read_sizing(staged_.prolong.output).model.undercuts;
  ASSERT_FALSE(plain.empty()) << "the plate beside its sides";
  for (const Undercut& u : plain) EXPECT_NE(cause_kind(u.cause), CauseKind::kSource);
  staged_.prolong.sources = {staged_.dir / "s.toml"};
  std::ofstream(staged_.prolong.sources[0])
      << "[[source]]\nname = \"wake\"\ntype = \"point\"\nat = [5, 5, 0.02]\nlength = 0.005\nradius = 0.05\n";
  const nlohmann::json summary = staged_.make_sizing();
  const SizingArtifact sizing = read_sizing(staged_.prolong.output);
  const auto of_source = [](const Undercut& u) { return cause_kind(u.cause) == CauseKind::kSource; };
  const auto found = std::find_if(sizing.model.undercuts.begin(), sizing.model.undercuts.end(), of_source);
  ASSERT_NE(found, sizing.model.undercuts.end());
  EXPECT_NEAR(found->least, 0.005, 1e-6);
  EXPECT_EQ(summary["below_lmin"].size(), sizing.model.undercuts.size());
  staged_.prolong.raster = staged_.prolong.output;  // on the finished field
  staged_.prolong.sources.clear();
  staged_.make_sizing();
  EXPECT_EQ(read_sizing(staged_.prolong.output).model.undercuts, plain);
}

}  // namespace
}  // namespace st
