#include "stages/report_stage.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/base64.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"
#include "stages/report_page.h"

namespace st {
namespace {

std::string in_temp(const std::string& name) { return testing::TempDir() + name; }

/// A tetrahedron of two groups, the second with a name that could end a script; `n_faces` of its four triangles.
MeshArtifact tetrahedron(int n_faces) {
  MeshArtifact artifact;
  SurfaceMesh& m = artifact.mesh;
  m.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  m.node_entity_dim = {0, 0, 0, 0};
  m.node_entity = {0, 1, 2, 3};
  m.node_t = {0, 0, 0, 0};
  m.node_size = {1, 1, 1, 1};
  m.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}};
  m.triangles.resize(static_cast<std::size_t>(n_faces));
  for (FaceId f = 0; f < n_faces; ++f) {
    m.triangle_face.push_back(f);
    m.triangle_group.push_back(f == 0 ? 1 : 0);
    m.corner_uv.insert(m.corner_uv.end(), 3, Vec2{0, 0});
  }
  m.labels.face_name.resize(4);
  m.labels.group_name = {"body", "</script><b>"};
  return artifact;
}

std::string page_of(int n_faces, ExitCode& code) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  ReportStageOptions o;
  o.artifacts = {in_temp(test + ".mesh.hdf")};
  o.output = in_temp(test + ".html");
  write_mesh(o.artifacts[0], tetrahedron(n_faces));
  code = run_report(o).code;
  return read_text_file(o.output);
}

TEST(Report, is_one_page_without_a_place_left_empty) {
  ExitCode code;
  const std::string page = page_of(4, code);
  EXPECT_EQ(code, ExitCode::kOk);
  for (const char* place : {"@META@", "@CHECK@", "@BEFORE@", "@INFO@", "@NODES@", "@CORNERS@", "@VALUES@", "@CAUSES@",
                            "@CELLS@", "@LEVELS@", "@LENGTHS@"}) {
    EXPECT_NE(report_page().find(place), std::string::npos) << place;
    EXPECT_EQ(page.find(place), std::string::npos) << place;
  }
  EXPECT_NE(page.find("\"passes\": true"), std::string::npos);
}

TEST(Report, no_name_ends_a_script) {
  ExitCode code;
  EXPECT_EQ(page_of(4, code).find("</script><b>"), std::string::npos);
}

TEST(Report, triangles_are_in_the_order_of_their_groups) {
  ExitCode code;
  const std::string page = page_of(4, code);
  EXPECT_NE(page.find(R"("name":"body","role":"wall","first":0,"count":3)"), std::string::npos);
  EXPECT_NE(page.find(R"("first":3,"count":1)"), std::string::npos);
  const std::vector<std::uint32_t> corners = {0, 1, 3, 1, 2, 3, 0, 3, 2, 0, 2, 1};  // the first triangle is the last
  EXPECT_NE(page.find(">" + base64(std::as_bytes(std::span(corners))) + "<"), std::string::npos);
}

TEST(Report, is_written_of_a_mesh_that_does_not_pass) {
  ExitCode code;
  const std::string page = page_of(3, code);
  EXPECT_EQ(code, ExitCode::kOk);
  EXPECT_NE(page.find("\"passes\": false"), std::string::npos);
}

}  // namespace
}  // namespace st
