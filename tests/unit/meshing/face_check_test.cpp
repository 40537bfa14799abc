#include "meshing/face/face_check.h"

#include <gtest/gtest.h>

#include "unit/meshing/face_work.h"

namespace st {
namespace {

using test::FaceCase;

/// The mesh of a square of side 10.
struct Square {
  UniformField field{2};
  FaceCase face{"square", field};
  FaceMesh mesh = face.mesh(field);
  FailureCause judge() {
    mesh.cause = FailureCause::kNone;
    mesh.refinement.clear();
    check_edges(face.boundary, mesh);
    return mesh.cause;
  }
};

TEST(FaceCheck, accepts_a_whole_mesh) {
  Square square;
  EXPECT_EQ(square.judge(), FailureCause::kNone);
  EXPECT_TRUE(square.mesh.refinement.empty());
}

TEST(FaceCheck, sees_a_side_of_the_loop_without_triangle) {
  Square square;
  const auto n_boundary = static_cast<std::int32_t>(square.face.boundary.nodes.size());
  std::vector<std::int32_t>& c = square.mesh.corners;
  std::size_t i = 0;
  while (!(c[i] < n_boundary && c[i + 1] < n_boundary) && !(c[i + 1] < n_boundary && c[i + 2] < n_boundary)) i += 3;
  c.erase(c.begin() + static_cast<std::ptrdiff_t>(i), c.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  EXPECT_NE(square.judge(), FailureCause::kNone);
  EXPECT_FALSE(square.mesh.refinement.empty());
}

TEST(FaceCheck, sees_a_triangle_that_is_there_twice_or_repeats_a_node) {
  Square twice;
  std::vector<std::int32_t>& c = twice.mesh.corners;
  const auto n_boundary = static_cast<std::int32_t>(twice.face.boundary.nodes.size());
  std::size_t i = 0;
  while (c[i] >= n_boundary && c[i + 1] >= n_boundary && c[i + 2] >= n_boundary) i += 3;
  const std::vector<std::int32_t> again(c.begin() + static_cast<std::ptrdiff_t>(i),
                                        c.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  c.insert(c.end(), again.begin(), again.end());
  EXPECT_NE(twice.judge(), FailureCause::kNone);
  Square repeated;
  repeated.mesh.corners[1] = repeated.mesh.corners[0];
  EXPECT_EQ(repeated.judge(), FailureCause::kNarrowPart);
}

TEST(FaceCheck, says_of_a_corner_without_node_that_it_lies_outside) {
  Square square;
  square.mesh.corners[4] = kNone;
  EXPECT_EQ(square.judge(), FailureCause::kOutsideLoops);
}

TEST(FaceCheck, counts_a_triangle_turned_against_the_surface) {
  const UniformField field(3);
  const FaceCase face("square", field);
  test::Prepared prepared(*face.surface, face.boundary, field);
  const std::int32_t inner = prepared.insert({5.1, 4.9});
  ASSERT_NE(inner, kNone);
  FaceMesh mesh;
  check_folds(prepared.work.mesh, mesh);
  EXPECT_EQ(mesh.n_folds, 0);
  prepared.work.mesh.nodes[inner].x = {-20, 5, 0};
  check_folds(prepared.work.mesh, mesh);
  EXPECT_GT(mesh.n_folds, 0);
  EXPECT_FALSE(mesh.refinement.empty());
}

}  // namespace
}  // namespace st
