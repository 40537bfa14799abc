#include "stages/run_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"
#include "support/staged.h"

namespace st {
namespace {

class RunStage : public testing::Test {
 protected:
  RunStage() {
    set_verbosity(Verbosity::kQuiet);
    options.output = dir / "mesh.hdf";
    options.on_part = [this](RunPart part) { parts.push_back(tool_of(part)); };
  }
  StageSummary run() {
    return run_all(
        options, [this](const std::string& name, std::uint64_t) { return dir / name; }, Communicator());
  }

  TemporaryDirectory dir;
  RunStageOptions options;
  std::vector<std::string> parts;
};

TEST_F(RunStage, makes_the_mesh_that_the_stages_make_one_by_one) {
  test::StagedModel one_by_one;
  one_by_one.make_sizing("box");
  one_by_one.make_patches();
  MergeStageOptions merge;
  merge.patches = {one_by_one.mesh.output};
  merge.output = one_by_one.dir / "mesh.hdf";
  run_merge(merge);
  options.model = one_by_one.dir / "model.brep";
  const StageSummary s = run();
  EXPECT_EQ(s.code, ExitCode::kOk);
  EXPECT_EQ(read_header(options.output).content_hash, read_header(merge.output).content_hash);
  EXPECT_EQ(parts,
            (std::vector<std::string>{"st-import", "st-raster", "st-prolong", "st-mesh", "st-merge", "st-check"}));
  EXPECT_TRUE(nlohmann::json::parse(s.json)["stages"].contains("st-prolong"));
  EXPECT_NE(s.line.find("passes"), std::string::npos);
}

TEST_F(RunStage, begins_at_the_part_that_an_earlier_try_came_to) {
  test::write_brep("box", dir / "model.brep");
  options.model = dir / "model.brep";
  run();
  parts.clear();
  options.first = RunPart::kMesh;
  EXPECT_EQ(run().code, ExitCode::kOk);
  EXPECT_EQ(parts, (std::vector<std::string>{"st-mesh", "st-merge", "st-check"}));
}

TEST_F(RunStage, makes_the_mesh_anew_where_the_triangles_asked_for_were_missed) {
  test::write_brep("box", dir / "model.brep");
  options.model = dir / "model.brep";
  options.prolong.target_triangles = 250;  // few edges on a side: the first mesh has 224, the second 276
  const nlohmann::json json = nlohmann::json::parse(run().json);
  EXPECT_EQ(std::count(parts.begin(), parts.end(), "st-mesh"), 3);
  EXPECT_EQ(std::count(parts.begin(), parts.end(), "st-prolong"), std::count(parts.begin(), parts.end(), "st-mesh"));
  EXPECT_EQ(std::count(parts.begin(), parts.end(), "st-raster"), 1);
  EXPECT_NEAR(json["triangles"].get<double>(), 250, 0.1 * 250);
}

TEST_F(RunStage, what_is_wrong_without_the_model_is_said_before_it_is_read) {
  const auto code = [&](const std::function<void(RunStageOptions&)>& spoil) {
    RunStageOptions o = options;
    spoil(o);
    try {
      require_run_inputs(o);
    } catch (const Error& e) {
      return e.code();
    }
    return ExitCode::kOk;
  };
  write_text_file(dir / "no_rules.toml", "[[size]]\nlmx = 1\n");
  const std::string none = dir / "none", no_rules = dir / "no_rules.toml";
  EXPECT_EQ(code([](auto&) {}), ExitCode::kOk);
  EXPECT_EQ(code([](auto& o) { o.mesh.pairs = "auto"; }), ExitCode::kOk);
  EXPECT_EQ(code([](auto& o) { o.raster.trailing_edges = "wide"; }), ExitCode::kUsage);
  EXPECT_EQ(code([](auto& o) { o.prolong.slope_of = "WING"; }), ExitCode::kUsage);
  EXPECT_EQ(code([](auto& o) { o.mesh.tile_triangles = 300; }), ExitCode::kUsage);
  EXPECT_EQ(code([&](auto& o) { o.raster.sizes = no_rules; }), ExitCode::kUsage);
  EXPECT_EQ(code([&](auto& o) { o.import_options.groups = none; }), ExitCode::kInput);
  EXPECT_EQ(code([&](auto& o) { o.prolong.sources = {none}; }), ExitCode::kInput);
  EXPECT_EQ(code([&](auto& o) { o.prolong.background = none + ".vtu:size"; }), ExitCode::kInput);
  EXPECT_EQ(code([&](auto& o) { o.prolong.blank = none; }), ExitCode::kInput);
  EXPECT_EQ(code([&](auto& o) { o.mesh.pairs = none; }), ExitCode::kInput);
}

TEST_F(RunStage, an_error_begins_with_the_tool_of_its_part) {
  options.model = dir / "none.step";
  try {
    run();
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kInput);
    EXPECT_TRUE(std::string(e.what()).starts_with("st-import: ")) << e.what();
  }
}

TEST_F(RunStage, outputs_and_thresholds_are_looked_at_before_the_work) {
  options.check.thresholds.min_size_share = 0.5;  // needs sizes, which there will be
  EXPECT_NO_THROW(require_run_outputs(options));
  options.merge.exports = {dir / "m.xyz"};
  EXPECT_THROW(require_run_outputs(options), Error);
  options.merge.exports.clear();
  options.report = "/no/such/folder/r.html";
  EXPECT_THROW(require_run_outputs(options), Error);
}

}  // namespace
}  // namespace st
