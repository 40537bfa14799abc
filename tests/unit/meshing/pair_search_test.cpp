#include "meshing/topology/pair_search.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/shapes.h"

namespace st {
namespace {

TEST(PairSearch, finds_three_translations_of_a_box) {
  const Model box = test::make_model("box");
  const std::vector<FacePair> pairs = find_pairs(box);
  ASSERT_EQ(pairs.size(), 3u);
  double volume = 1;
  for (const FacePair& p : pairs) {
    EXPECT_EQ(p.motion.rotation, Similarity().rotation);
    volume *= norm(p.motion.translation);
  }
  EXPECT_NEAR(volume, 60. * 40 * 20, 1e-6);
}

TEST(PairSearch, finds_the_rotation_of_a_passage_to_the_last_digit_and_its_ends) {
  const Model passage = test::make_model("passage");
  int n_turned = 0;
  for (const FacePair& p : find_pairs(passage)) {
    if (p.motion.rotation == Similarity().rotation) continue;
    ++n_turned;
    EXPECT_EQ(std::abs(p.motion.rotation[1].z), std::sin(2 * kPi / 9));
  }
  EXPECT_EQ(n_turned, 1);
}

TEST(PairSearch, takes_periodic_groups_alone_where_there_are_some) {
  const Model box = test::make_model("box");
  const FacePair first = find_pairs(box)[0];
  ModelTables t = box.tables();
  t.labels.group_name = {"wall", "sides"};
  t.labels.group_role = {"wall", "periodic"};
  for (FaceId f = 0; f < t.n_faces(); ++f) t.labels.face_group[f] = f == first.a || f == first.b;
  EXPECT_EQ(find_pairs(Model(t, box.brep())), std::vector<FacePair>{first});
}

TEST(PairSearch, refuses_models_without_a_pair_and_sides_of_unequal_numbers) {
  EXPECT_THROW(find_pairs(test::make_model("sphere")), Error);
  const Model box = test::make_model("box");
  const std::vector<FaceId> one = {0}, two = {1, 2};
  EXPECT_THROW(pair_faces(box.tables(), one, two, {}), Error);
}

}  // namespace
}  // namespace st
