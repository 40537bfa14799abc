#include "meshing/engine/last_resorts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/checks.h"
#include "support/meshed.h"
#include "unit/meshing/put_faces.h"

namespace st {
namespace {

/// A box put together again, one of its faces with a fold where asked.
struct Box : test::PutFaces {
  static constexpr FaceId kFace = 2;

  /// `n_counted`: folds that the outcome of the face tells.
  explicit Box(bool has_fold, int n_counted = 1) : PutFaces("box", 4) {
    if (has_fold) fold(n_counted);
    faces.search_crossings();
  }
  std::size_t n_bad() { return faces.bad_triangles(faces.bring(faces.suspects())).size(); }

 private:
  /// Moves a node inside the face over its neighbours.
  void fold(int n_counted) {
    FacePatch patch = meshed.result.patches[kFace];
    const auto is_inside = [&](const auto& t) { return std::ranges::min(t.n) >= patch.n_boundary; };
    const auto it = std::ranges::find_if(patch.triangles, is_inside);
    Vec3& node = patch.inner_xyz[it->n[0] - patch.n_boundary];
    node += 1.5 * (patch.inner_xyz[it->n[1] - patch.n_boundary] - node);
    FaceOutcome outcome;
    outcome.n_folds = n_counted;
    outcome.wanted = {RefinementPoint{}};
    faces.set(kFace, FacePlace(), outcome);
    faces.put(kFace, std::move(patch));
  }
};

TEST(LastResorts, refill_what_a_node_beside_its_place_folds) {
  Box box(true);
  ASSERT_EQ(box.n_bad(), 1u);
  refill_bad(box.faces, test::one_rank);
  EXPECT_EQ(box.n_bad(), 0u);
}

TEST(LastResorts, say_that_nothing_bad_is_left) {
  Box box(true, 0);
  EXPECT_TRUE(refill_all_bad(box.faces, test::one_rank));
  EXPECT_EQ(box.n_bad(), 0u);
}

TEST(LastResorts, go_back_where_something_counts_as_bad) {
  Box box(true, 1);
  const Bytes before = packed(box.faces.places());
  EXPECT_FALSE(refill_all_bad(box.faces, test::one_rank));
  EXPECT_EQ(packed(box.faces.places()), before);
  EXPECT_EQ(box.n_bad(), 1u);
}

TEST(LastResorts, change_nothing_where_nothing_is_bad) {
  Box box(false);
  refill_bad(box.faces, test::one_rank);
  part_touching(box.faces, test::one_rank);
  for (const auto& [f, patch] : box.faces.bring({0, 1, 2, 3, 4, 5}))
    EXPECT_EQ(packed(patch), packed(box.meshed.result.patches[f]));
}

double largest_angle_deg(const test::PutFaces& all, const FacePatch& patch) {
  double most = 0;
  const std::vector<Vec3> x = all.faces.nodes_of(patch);
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k)
      most = std::max(most, angle_between(x[t.n[(k + 1) % 3]] - x[t.n[k]], x[t.n[(k + 2) % 3]] - x[t.n[k]]));
  return degrees(most);
}

TEST(LastResorts, mend_obtuse_triangles_of_the_faces_given) {
  Box box(false);
  FacePatch patch = box.meshed.result.patches[Box::kFace];
  const auto is_inside = [&](const auto& t) { return std::ranges::min(t.n) >= patch.n_boundary; };
  const auto it = std::ranges::find_if(patch.triangles, is_inside);
  const auto x = [&](int k) -> Vec3& { return patch.inner_xyz[it->n[k] - patch.n_boundary]; };
  x(0) = 0.95 * (0.5 * (x(1) + x(2))) + 0.05 * x(0);
  box.faces.put(Box::kFace, std::move(patch));
  box.faces.search_crossings();
  const auto angle = [&] { return largest_angle_deg(box, box.faces.bring({Box::kFace}).at(Box::kFace)); };
  const double before = angle();
  EXPECT_GT(before, 150);
  mend_obtuse(box.faces, {0, 1}, radians(140), test::one_rank);
  mend_obtuse(box.faces, {Box::kFace}, radians(before + 1), test::one_rank);
  EXPECT_EQ(angle(), before);
  mend_obtuse(box.faces, {Box::kFace}, radians(140), test::one_rank);
  EXPECT_LT(angle(), 140);
}

TEST(LastResorts, leave_no_fold_where_the_surface_is_folded) {
  const test::Meshed meshed("crumpled", 0.5);
  ASSERT_TRUE(meshed.result.failures.empty());
  const ShapeReport shape = check_shape(meshed.mesh, edges_of(meshed.mesh));
  EXPECT_EQ(shape.folds.count, 0);
  EXPECT_EQ(shape.zero_area.count, 0);
}

}  // namespace
}  // namespace st
