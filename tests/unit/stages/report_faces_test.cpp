#include "stages/report_faces.h"

#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace st {
namespace {

/// Two groups; face 2 comes before face 0 in the list of triangles.
SurfaceMesh mesh_of_report_faces() {
  SurfaceMesh m;
  m.triangles.resize(5);
  m.triangle_face = {2, 0, 2, 1, 0};
  m.triangle_group = {0, 0, 0, 1, 0};
  m.labels.face_name = {"nose", "", "tail"};
  m.labels.face_part = {1, kNone, 0};
  m.labels.part_path = {"a", "b"};
  return m;
}

TEST(ReportFaces, are_in_the_order_of_groups_and_then_of_faces) {
  EXPECT_EQ(by_group_and_face(mesh_of_report_faces()), (std::vector<TriangleId>{1, 4, 0, 2, 3}));
}

TEST(ReportFaces, have_number_triangles_name_and_part) {
  const SurfaceMesh m = mesh_of_report_faces();
  EXPECT_EQ(faces_to_pick(m, by_group_and_face(m), nullptr).dump(),
            R"([[1,2,"nose",1,0.0],[3,2,"tail",0,0.0],[2,1,"",-1,0.0]])");
}

TEST(ReportFaces, have_the_areas_of_the_cad) {
  SurfaceMesh m = mesh_of_report_faces();
  m.labels.face_part.clear();  // of an older file
  ModelTables tables;
  tables.face_area = {4, 5, 6};
  EXPECT_EQ(faces_to_pick(m, by_group_and_face(m), &tables).dump(),
            R"([[1,2,"nose",-1,4.0],[3,2,"tail",-1,6.0],[2,1,"",-1,5.0]])");
}

TEST(ReportFaces, without_a_mesh_say_why) {
  FaceFailure failure;
  failure.face = 2;
  failure.cause = "its loop crosses itself";
  failure.xyz = {1, 2, 3};
  const auto list = unmeshed_faces(std::span(&failure, 1), mesh_of_report_faces().labels);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["face"], 3);
  EXPECT_EQ(list[0]["name"], "tail");
  EXPECT_EQ(list[0]["cause"], "its loop crosses itself");
  EXPECT_EQ(list[0]["xyz"].dump(), "[1.0,2.0,3.0]");
}

}  // namespace
}  // namespace st
