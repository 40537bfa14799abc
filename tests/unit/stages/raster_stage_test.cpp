// What st-raster and st-prolong do at their limits: parts that cannot be sampled, octrees that would be too large or
// too deep.
#include "stages/raster_stage.h"
#include "geometry/import/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "stages/prolong_stage.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const Communicator& one_rank() {
  static const Communicator comm;
  return comm;
}

class RasterStage : public testing::Test {
 protected:
  void SetUp() override {
    set_verbosity(Verbosity::kQuiet);
    options_.geometry = dir_ / "geometry.hdf";
    options_.output = dir_ / "raster.hdf";
  }
  void write(ImportResult&& import) {
    GeometryArtifact a;
    a.header.schema = "geometry";
    a.header.tool = "test";
    a.tables = std::move(import.tables);
    a.brep = std::move(import.brep);
    write_geometry(options_.geometry, a);
  }
  /// A block with a hole, in whose loop an edge of the block stands: it has no trimming curve there.
  void write_block_with_a_broken_face() {
    ImportResult import = test::import_shape("drilled_block");
    ModelTables& t = import.tables;
    for (FaceId f = 0; f < t.n_faces(); ++f) {
      if (t.face_type[f] != SurfaceType::kCylinder) continue;
      const CoedgeId first = t.loop_coedge_offsets[t.face_loop_offsets[f]],
                     last = t.loop_coedge_offsets[t.face_loop_offsets[f + 1]];
      const auto begin = t.coedge_edge.begin() + first, end = t.coedge_edge.begin() + last;
      EdgeId elsewhere = 0;
      while (std::find(begin, end, elsewhere) != end) ++elsewhere;
      *begin = elsewhere;
    }
    write(std::move(import));
  }
  nlohmann::json run() const { return nlohmann::json::parse(run_raster(options_, one_rank()).json); }

  TemporaryDirectory dir_;
  RasterStageOptions options_;
};

std::string error_of(const std::function<void()>& work, ExitCode code) {
  try {
    work();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    return e.what();
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(RasterStage, of_a_model_with_a_face_that_cannot_be_sampled_is_incomplete_and_keeps_its_artifact) {
  write_block_with_a_broken_face();
  const StageSummary summary = run_raster(options_, one_rank());
  EXPECT_EQ(summary.code, ExitCode::kIncomplete);
  EXPECT_TRUE(mentions(summary.line, "INCOMPLETE: 1 part not sampled")) << summary.line;
  EXPECT_EQ(nlohmann::json::parse(summary.json)["not_sampled"], 1);
  EXPECT_EQ(read_raster(options_.output).n_not_sampled, 1);
}

TEST_F(RasterStage, passes_with_allow_incomplete_but_flags_the_artifact_all_the_same) {
  write_block_with_a_broken_face();
  run();
  const std::string refused = read_bytes(options_.output);
  options_.allow_incomplete = true;
  EXPECT_EQ(run_raster(options_, one_rank()).code, ExitCode::kOk);
  EXPECT_EQ(read_bytes(options_.output), refused);
}

TEST_F(RasterStage, that_is_incomplete_is_refused_by_prolongation_unless_allowed) {
  write_block_with_a_broken_face();
  run();
  ProlongStageOptions prolong;
  prolong.raster = options_.output;
  prolong.output = dir_ / "sizing.hdf";
  const std::string refusal = error_of([&] { run_prolong(prolong); }, ExitCode::kIncomplete);
  EXPECT_TRUE(mentions(refusal, "raster.hdf: incomplete, 1 part") && mentions(refusal, "--allow-incomplete"))
      << refusal;
  prolong.allow_incomplete = true;
  EXPECT_EQ(run_prolong(prolong).code, ExitCode::kOk);
  EXPECT_EQ(map_sizing(prolong.output).face_weight.size(),
            static_cast<std::size_t>(read_geometry(options_.geometry).tables.n_faces()));
}

TEST_F(RasterStage, with_max_cells_takes_as_many_and_not_one_less_and_stores_nothing_of_it) {
  write(test::import_shape("drilled_block"));
  const int n = run()["cells"];
  const std::string unlimited = read_bytes(options_.output);
  options_.max_cells = n;
  EXPECT_EQ(run()["cells"], n);
  EXPECT_EQ(read_bytes(options_.output), unlimited);
  options_.max_cells = n - 1;
  EXPECT_TRUE(mentions(error_of([&] { run(); }, ExitCode::kUsage), "--max-cells"));
}

TEST_F(RasterStage, refuses_lengths_that_would_fill_any_memory_before_it_samples) {
  write(test::import_shape("drilled_block"));
  options_.lmin = options_.lmax = "1e-9";
  const std::string refusal = error_of([&] { run(); }, ExitCode::kUsage);
  EXPECT_TRUE(mentions(refusal, "at least") && mentions(refusal, "cells (") && mentions(refusal, "GB") &&
              mentions(refusal, "larger lengths"))
      << refusal;
}

TEST_F(RasterStage, refuses_samples_that_grow_beyond_the_limit_though_no_area_told_so) {
  write(test::import_shape("sphere"));
  options_.lmin = "1e-9";
  options_.alpha_deg = 0.01;
  options_.max_cells = 100000;
  EXPECT_TRUE(mentions(error_of([&] { run(); }, ExitCode::kUsage), "samples"));
}

TEST_F(RasterStage, tells_of_samples_that_the_octree_is_not_deep_enough_for) {
  write(test::import_shape("thin_plate"));
  EXPECT_EQ(run()["beyond_depth"]["samples"], 0);
  const ModelTables tables = read_geometry(options_.geometry).tables;
  EdgeId shortest = 0;
  const auto length = [&](EdgeId e) {
    return distance(tables.vertex_xyz[tables.edge_vertices[2 * e]], tables.vertex_xyz[tables.edge_vertices[2 * e + 1]]);
  };
  for (EdgeId e = 0; e < tables.n_edges(); ++e)
    if (length(e) < length(shortest)) shortest = e;
  options_.cell_per_length = 1;
  options_.sizes = dir_ / "sizes.toml";
  std::ofstream(options_.sizes) << "[[size]]\nedges = " << shortest + 1 << "\nlmin = 9e-6\nlmax = 9e-6\n";
  const nlohmann::json depth = run()["beyond_depth"];
  EXPECT_GT(depth["samples"], 1000);
  EXPECT_NEAR(depth["smallest_length"], 9e-6, 1e-9);
  EXPECT_NEAR(depth["smallest_cell"], 10.2 / (1 << 20), 1e-8);
  EXPECT_EQ(depth["deepest_level"], 20);
}

}  // namespace
}  // namespace st
