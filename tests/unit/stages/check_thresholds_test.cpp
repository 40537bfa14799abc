// st-check's thresholds: each decides, each says what it needs.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/hdf5/artifact.h"
#include "stages/check_stage.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

namespace fs = std::filesystem;

class CheckThreshold : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "st_check_thresholds_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  StageSummary check(const SurfaceMesh& mesh, const CheckThresholds& thresholds,
                     std::vector<std::string> reports = {}) const {
    MeshArtifact a;
    a.header.schema = "mesh";
    a.header.tool = "test";
    a.header.options_json = "{}";
    a.mesh = mesh;
    write_mesh((folder_ / "mesh.hdf").string(), a);
    CheckStageOptions o;
    o.mesh = (folder_ / "mesh.hdf").string();
    o.thresholds = thresholds;
    o.reports = std::move(reports);
    return run_check(o);
  }
  static std::vector<std::string> failed_checks(const StageSummary& s) {
    return nlohmann::json::parse(s.json).at("failed");
  }
  /// Whether the check `name` is among those that failed.
  static bool fails(const StageSummary& s, const std::string& name) {
    const auto failed = failed_checks(s);
    return std::find(failed.begin(), failed.end(), name) != failed.end();
  }
  /// Passes at `loose`, fails by `name` alone at `strict`.
  void expect_decides(const std::string& name, const std::function<void(CheckThresholds&, double)>& set, double loose,
                      double strict) const {
    const SurfaceMesh cube = shapes::cube(4);  // half squares: quality sqrt(3)/2, angles 45 and 90 degrees
    CheckThresholds t;
    set(t, loose);
    EXPECT_EQ(check(cube, t).code, ExitCode::kOk) << name << " " << loose;
    set(t, strict);
    const StageSummary s = check(cube, t);
    EXPECT_EQ(s.code, ExitCode::kIncomplete) << name << " " << strict;
    EXPECT_EQ(failed_checks(s), std::vector<std::string>{name});
  }

  fs::path folder_;
};

TEST_F(CheckThreshold, of_the_least_quality_decides) {
  expect_decides(
      "min-quality", [](CheckThresholds& t, double v) { t.min_quality = v; }, 0.86, 0.87);
}
TEST_F(CheckThreshold, of_the_mean_quality_decides) {
  expect_decides(
      "min-mean-quality", [](CheckThresholds& t, double v) { t.min_mean_quality = v; }, 0.86, 0.87);
}
TEST_F(CheckThreshold, of_the_first_percentile_decides) {
  expect_decides(
      "min-p1-quality", [](CheckThresholds& t, double v) { t.min_p1_quality = v; }, 0.86, 0.87);
}
TEST_F(CheckThreshold, of_the_least_angle_decides) {
  expect_decides(
      "min-angle", [](CheckThresholds& t, double v) { t.min_angle_deg = v; }, 44.9, 45.1);
}

TEST_F(CheckThreshold, of_growth_decides) {
  SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -9, 0}}, {{{0, 1, 2}}, {{1, 0, 3}}});
  CheckThresholds t;
  t.max_jump = 2.9;
  EXPECT_TRUE(fails(check(m, t), "max-jump"));
  t.max_jump = 3.1;
  EXPECT_FALSE(fails(check(m, t), "max-jump"));
}

TEST_F(CheckThreshold, accepts_as_many_folds_and_crossings_as_asked_and_no_more) {
  SurfaceMesh m = shapes::sphere(8);
  m.node_xyz[m.triangles[0].n[0]] = {0.3, 0.2, 0.1};  // a spike to the other side
  for (const NodeId n : m.triangles[100].n) m.node_xyz[n] = -1.2 * m.node_xyz[n];
  const StageSummary all = check(m, {});
  ASSERT_TRUE(fails(all, "folds") && (fails(all, "crossings") || fails(all, "overlaps"))) << all.line;
  const auto count = [&](const std::string& key) {
    return nlohmann::json::parse(all.json).at("checks").at(key).at("count").get<int>();
  };
  const int folds = count("folds"), crossings = count("crossings") + count("overlaps");
  CheckThresholds t;
  t.max_folds = folds, t.max_crossings = crossings;
  EXPECT_FALSE(fails(check(m, t), "folds"));
  EXPECT_FALSE(fails(check(m, t), "crossings") || fails(check(m, t), "overlaps"));
  t.max_folds = folds - 1, t.max_crossings = crossings - 1;
  EXPECT_TRUE(fails(check(m, t), "folds"));
  EXPECT_TRUE(fails(check(m, t), "crossings") || fails(check(m, t), "overlaps"));
}

TEST_F(CheckThreshold, says_which_input_it_needs) {
  const auto expect_usage = [&](const CheckThresholds& t, const std::string& input) {
    try {
      check(shapes::cube(2), t);
      ADD_FAILURE() << "accepted without " << input;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage);
      EXPECT_NE(std::string(e.what()).find(input), std::string::npos) << e.what();
    }
  };
  CheckThresholds sizes, distance, normals;
  sizes.min_size_share = 0.5;
  distance.max_deviation = "1";
  normals.max_normal_deviation_deg = 10;
  expect_usage(sizes, "--sizing");
  expect_usage(distance, "--geometry");
  expect_usage(normals, "--geometry");
}

TEST_F(CheckThreshold, report_holds_histograms_of_every_face_whatever_the_verdict) {
  CheckThresholds t;
  t.min_quality = 0.99;
  const std::string path = (folder_ / "report.json").string();
  EXPECT_EQ(check(shapes::cube(3), t, {path}).code, ExitCode::kIncomplete);
  std::ifstream file(path);
  const auto report = nlohmann::json::parse(file);
  const auto count = [](const nlohmann::json& of) {
    std::int64_t n = 0;
    for (const std::int64_t bin : of.at("quality").at("angle_histogram")) n += bin;
    return n;
  };
  EXPECT_EQ(count(report), 3 * 108) << "all angles of the model";
  ASSERT_EQ(report.at("groups").size(), 1u);
  EXPECT_EQ(count(report["groups"][0]), 3 * 108);
  ASSERT_EQ(report.at("faces").size(), 6u);
  for (const auto& face : report["faces"]) EXPECT_EQ(count(face), 3 * 18);
}

TEST_F(CheckThreshold, periodic_faces_that_are_no_images_of_one_another_fail) {
  SurfaceMesh cube = shapes::cube(4);
  cube.merged.pairs = {{0, 1, {}}};
  EXPECT_EQ(failed_checks(check(cube, {})), std::vector<std::string>{"pairs"});
}

}  // namespace
}  // namespace st
