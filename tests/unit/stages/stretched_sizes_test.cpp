// --max-aspect through the whole chain.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "stages/check_stage.h"
#include "stages/merge_stage.h"
#include "support/staged.h"

namespace st {
namespace {

using Json = nlohmann::json;

class StretchedSizes : public testing::Test {
 protected:
  /// The report of st-check on the shape.
  Json checked(const std::string& shape, double aspect) {
    m_.raster.max_aspect = aspect;
    expected_ = m_.make_sizing(shape)["expected_triangles"];
    m_.make_patches();
    MergeStageOptions merge;
    merge.patches = {m_.mesh.output};
    merge.output = m_.dir / "mesh.hdf";
    run_merge(merge);
    CheckStageOptions check;
    check.mesh = merge.output;
    check.geometry = m_.mesh.geometry;
    check.sizing = m_.mesh.sizing;
    const StageSummary summary = run_check(check);
    EXPECT_EQ(summary.code, ExitCode::kOk) << summary.line;
    return Json::parse(summary.json);
  }

  test::StagedModel m_;
  double expected_ = 0;  // triangles, by st-prolong
};

TEST_F(StretchedSizes, a_wing_needs_at_most_a_third_of_the_triangles) {
  for (const char* shape : {"sharp_wing", "blunt_wing"}) {
    const Json plain = checked(shape, 1), stretched = checked(shape, 16);
    const double n = stretched["triangles"];
    EXPECT_LE(3 * n, plain["triangles"].get<double>()) << shape;
    EXPECT_NEAR(expected_, n, 0.15 * n) << shape;
    EXPECT_GE(stretched["quality"]["mean"].get<double>(), 0.85) << shape;  // half a square has 0.866
    EXPECT_GE(stretched["quality"]["p1"].get<double>(), 0.65) << shape;
    EXPECT_EQ(stretched["quality"]["above_150_deg"], 0) << shape;
  }
}

TEST_F(StretchedSizes, are_the_same_in_all_directions_on_a_sphere) {
  const Json plain = checked("sphere", 1), stretched = checked("sphere", 16);
  EXPECT_EQ(plain["triangles"], stretched["triangles"]);
}

TEST_F(StretchedSizes, are_the_same_in_small_cells) {
  const Json large = checked("sharp_wing", 16);
  m_.raster.cell_per_length = 2;
  const Json small = checked("sharp_wing", 16);
  const double n = large["triangles"];
  EXPECT_NEAR(small["triangles"], n, 0.05 * n);
}

TEST_F(StretchedSizes, a_rule_stretches_an_edge_along_itself_and_leaves_the_length_across) {
  const std::string rule = "[[size]]\nedges = 1\nlmax = 0.3\nmax_aspect = 10\n";
  std::ofstream(m_.dir / "rules.toml") << rule;
  m_.raster.sizes = m_.dir / "rules.toml";
  const Json stretched = checked("box", 1);
  std::ofstream(m_.dir / "rules.toml") << rule.substr(0, rule.find("max_aspect"));
  const Json plain = checked("box", 1);
  m_.raster.sizes.clear();
  const double n = checked("box", 1)["triangles"], n_plain = plain["triangles"], n_stretched = stretched["triangles"];
  EXPECT_LT(n_stretched - n, 0.5 * (n_plain - n)) << n << " without the rule";
  EXPECT_GE(stretched["quality"]["mean"].get<double>(), 0.9);
}

}  // namespace
}  // namespace st
