#include "stages/check_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

using nlohmann::json;

struct CheckedCube {
  CheckedCube() : mesh(shapes::cube(2)) {
    f.n_triangles = mesh.n_triangles();
    f.topology = check_topology(mesh, edges_of(mesh));
    f.measure = measure_mesh(mesh);
    f.quality = measure_quality(mesh, edges_of(mesh));
  }
  std::string text(ReportDetail detail) const { return check_report_json("cube.hdf", mesh, f, 0.5, detail); }
  json read(ReportDetail detail) const { return json::parse(text(detail)); }

  SurfaceMesh mesh;
  Findings f;
};

TEST(CheckJson, names_what_fails_and_where) {
  CheckedCube cube;
  Check closed, folds;
  closed.name = "closed";
  folds.name = "folds";
  folds.defects.count = 2;
  folds.defects.first.push_back({{1, 2, 3}, 4, kNone});
  cube.f.checks = {closed, folds};
  const json j = cube.read(ReportDetail::kSummary);
  EXPECT_EQ(j.at("mesh"), "cube.hdf");
  EXPECT_FALSE(j.at("passes"));
  EXPECT_EQ(j.at("failed"), json::array({"folds"}));
  EXPECT_EQ(j.at("checks").at("folds").at("first")[0], (json{{"xyz", {1.0, 2.0, 3.0}}, {"faces", {5}}}));
  EXPECT_TRUE(j.at("checks").at("closed").at("passes"));
}

TEST(CheckJson, has_a_genus_only_where_the_surface_is_closed) {
  CheckedCube cube;
  EXPECT_EQ(cube.read(ReportDetail::kSummary).at("genus"), 0);
  cube.f.topology.n_cad_boundary_edges = 1;
  EXPECT_TRUE(cube.read(ReportDetail::kSummary).at("genus").is_null());
}

TEST(CheckJson, is_one_line_or_has_histograms_of_groups_and_faces) {
  const CheckedCube cube;
  EXPECT_EQ(cube.text(ReportDetail::kSummary).find('\n'), std::string::npos);
  const json brief = cube.read(ReportDetail::kSummary), full = cube.read(ReportDetail::kFull);
  EXPECT_FALSE(brief.contains("bins"));
  EXPECT_FALSE(brief.at("faces")[0].contains("quality"));
  EXPECT_TRUE(full.contains("bins"));
  EXPECT_EQ(full.at("faces").size(), cube.f.quality.faces.size());
  EXPECT_EQ(full.at("faces")[0].at("quality").at("histogram"), cube.f.quality.faces[0].histogram);
}

}  // namespace
}  // namespace st
