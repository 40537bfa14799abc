#include "stages/pair_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"
#include "mesh/pair_match.h"
#include "stages/merge_stage.h"
#include "support/staged.h"

namespace st {
namespace {

TEST(PairInput, is_nothing_without_the_option_and_three_pairs_with_auto) {
  const Model box = test::make_model("box");
  EXPECT_TRUE(read_pairs("", box).empty());
  EXPECT_EQ(read_pairs("auto", box).pairs().size(), 3u);
}

TEST(PairInput, that_are_found_are_said) {
  const Model box = test::make_model("box");
  const Verbosity before = verbosity();
  set_verbosity(Verbosity::kNormal);
  testing::internal::CaptureStderr();
  read_pairs("auto", box);
  const std::string said = testing::internal::GetCapturedStderr();
  set_verbosity(before);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 3) << said;
  EXPECT_NE(said.find("  pair: face "), std::string::npos) << said;
  EXPECT_NE(said.find(", moved by "), std::string::npos) << said;
}

TEST(PairInput, names_the_line_of_a_group_that_is_not_there) {
  const test::StagedModel staged;
  write_text_file(staged.dir / "pairs.toml", "[[pair]]\na = \"left\"\nb = \"right\"\ntranslate = [1, 0, 0]\n");
  try {
    read_pairs(staged.dir / "pairs.toml", test::make_model("box"));
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(e.what()).find("pairs.toml:1: pair: "), std::string::npos) << e.what();
  }
}

TEST(PairInput, goes_with_the_mesh) {
  test::StagedModel staged;
  staged.make_sizing("passage");
  staged.mesh.pairs = "auto";
  staged.make_patches();
  MergeStageOptions merge;
  merge.patches = {staged.mesh.output};
  merge.output = staged.dir / "mesh.hdf";
  run_merge(merge);
  const SurfaceMesh mesh = read_mesh(merge.output).mesh;
  ASSERT_FALSE(mesh.merged.pairs.empty());
  for (const FacePair& p : mesh.merged.pairs) {
    const PairMatch match = match_pair(mesh, p, pair_tolerance(mesh));
    EXPECT_FALSE(match.nodes.empty());
    EXPECT_TRUE(match.alone.empty()) << match.alone.size();
    EXPECT_TRUE(match.triangles_alone.empty());
  }
}

}  // namespace
}  // namespace st
