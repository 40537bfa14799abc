// The number of triangles that a sizing will give is refused when it cannot be numbered.
#include "stages/expected_triangles.h"

#include "sizing/size_field.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

TEST(UsualTile, is_a_sixteenth_of_the_mesh_between_its_bounds) {
  EXPECT_EQ(usual_tile(0), 8000);
  EXPECT_EQ(usual_tile(128'000), 8000);
  EXPECT_EQ(usual_tile(160'000), 10'000);
  EXPECT_EQ(usual_tile(1e6), 25'000);
}

class ExpectedTriangles : public testing::Test {
 protected:
  std::string refusal(std::vector<double> triangles, std::vector<FaceId> faces, double limit) const {
    for (double& t : triangles) t /= kTrianglesPerWeight;
    try {
      require_countable_mesh(model_.tables(), triangles, faces, "sizing.hdf", limit);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage);
      return e.what();
    }
    return "";
  }
  const Model model_ = test::make_model("box");
  const std::vector<double> triangles_{100, 100, 100, 300, 100, 100};
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(ExpectedTriangles, are_taken_up_to_the_limit) {
  EXPECT_EQ(refusal(triangles_, {}, 801), "");
  EXPECT_NE(refusal(triangles_, {}, 799), "");
  EXPECT_EQ(refusal({}, {}, 1), "") << "no weights: nothing is known";
}

TEST_F(ExpectedTriangles, count_on_the_faces_that_are_meshed) {
  EXPECT_EQ(refusal(triangles_, {0, 1}, 201), "");
  EXPECT_NE(refusal(triangles_, {0, 3}, 201), "");
}

TEST_F(ExpectedTriangles, name_the_number_the_heaviest_face_and_what_to_do) {
  const std::string whole = refusal(triangles_, {}, 500), one = refusal(triangles_, {}, 200);
  EXPECT_TRUE(has(whole, "sizing.hdf: these sizes need about 800 triangles (300 of them on face 4") &&
              has(whole, "at most 500") && has(whole, "--faces"))
      << whole;
  EXPECT_TRUE(has(one, "larger --scale") && !has(one, "--faces")) << one;
}

TEST_F(ExpectedTriangles, are_as_many_as_sides_of_32_bits_and_most_of_the_memory_allow) {
  EXPECT_EQ(most_triangles_in(1.5e9), 8e6);
  EXPECT_EQ(most_triangles_in(1e13), static_cast<double>(kMaxTriangles));
  EXPECT_NE(refusal(std::vector<double>(6, 1e300), {}, most_triangles_in(1e300)), "");
}

/// Edges four times as long along x.
class Stretched : public UniformField {
 public:
  using UniformField::UniformField;
  LocalSize local(Vec3 x, int& hint) const override { return {size(x, hint), 4 * size(x, hint), {1, 0, 0}}; }
  bool is_stretched() const override { return true; }
};

TEST(ExpectedTrianglesOfAMesh, come_from_its_areas_and_the_lengths_of_the_field) {
  SurfaceMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}};
  for (int i = 0; i < 50000; ++i) {
    mesh.triangles.push_back({{0, 1, 2}});  // area 3
    mesh.triangle_face.push_back(1);
  }
  mesh.triangles.push_back({{0, 2, 3}});
  mesh.triangle_face.push_back(0);
  const std::vector<double> weight = face_weights_on(mesh, UniformField(0.5), 3);
  EXPECT_NEAR(weight[1], 50000 * 3 / 0.25, 50) << "from some of many triangles";
  EXPECT_EQ(weight[2], 0);
  EXPECT_NEAR(face_weights_on(mesh, Stretched(0.5), 3)[1], weight[1] / 4, 50);
  mesh.triangles = {{{0, 2, 3}}};
  mesh.triangle_face = {0};
  EXPECT_DOUBLE_EQ(face_weights_on(mesh, UniformField(0.5), 1)[0], 7.5 / 0.25);
}

TEST_F(ExpectedTriangles, above_what_is_usual_name_the_five_heaviest_faces) {
  const std::vector<double> weight{1, 5, 2, 10, 3, 4};
  const std::vector<std::string> name{"", "", "", "fillet", "", ""};
  EXPECT_EQ(heaviest_faces(weight, name),
            "40 % on face 4 \"fillet\", 20 % on face 2, 16 % on face 6, 12 % on face 5, 8 % on face 3");
  EXPECT_NO_THROW(report_expected_triangles(weight, name, 1000, "sizing.hdf"));
  try {
    report_expected_triangles(weight, name, 10, "sizing.hdf");
    ADD_FAILURE() << "taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    EXPECT_TRUE(has(e.what(), "face 4 \"fillet\"") && has(e.what(), "--target-triangles")) << e.what();
  }
}

}  // namespace
}  // namespace st
