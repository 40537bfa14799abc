#include "sizing/source_set.h"

#include <gtest/gtest.h>

#include "sizing/octree.h"

namespace st {
namespace {

TEST(SourceSet, makes_one_tree_of_sources_and_background_with_their_causes) {
  SourceSet set;
  EXPECT_EQ(set.tree(), nullptr);
  set.slope = 0.2;
  set.sources.resize(2);
  set.sources[0].spacing[0].length = 0.5;
  set.sources[1].spacing[0].length = 0.1;
  set.sources[1].point[0] = {9, 0, 0};
  set.background.node_xyz = {{0, 5, 0}, {1, 5, 0}, {0, 6, 0}, {0, 5, 1}};
  set.background.node_size.assign(4, {0.2, 0.2, {}});
  set.background.tets = {{0, 1, 2, 3}};
  const auto tree = set.tree();
  const auto cause_at = [&](Vec3 x) {
    std::int32_t winner = kNone;
    tree->size_below(x, 1, &winner);
    return winner == kNone ? kNone : tree->entry(winner).cause;
  };
  EXPECT_EQ(cause_at({0, 0, 0}), pack_cause(CauseKind::kSource, 0));
  EXPECT_EQ(cause_at({9, 0, 1}), pack_cause(CauseKind::kSource, 1));
  EXPECT_EQ(cause_at({0.1, 5.1, 0.1}), pack_cause(CauseKind::kOther, 0));
  EXPECT_EQ(cause_at({99, 0, 0}), kNone);
  EXPECT_EQ(tree->min_size(), 0.1);
  EXPECT_EQ(set.min_size(), 0.1);
}

}  // namespace
}  // namespace st
