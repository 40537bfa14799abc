// Patches that stay where they are made.
#include "meshing/engine/patch_store.h"

#include <gtest/gtest.h>

#include "support/meshed.h"

namespace st {
namespace {

using test::Meshed;

TEST(PatchStore, gives_back_what_was_put_by_face_and_version) {
  const Meshed m("box", 8);
  PatchStore store(test::one_rank);
  const auto put = [&](FaceId f, std::int64_t version) {
    return store.put(FacePatch(m.result.patches[f]), version, m.result.edges, m.model.tables().vertex_xyz);
  };
  const PatchPlace a = put(0, 1), b = put(0, 2), c = put(3, 1);
  EXPECT_TRUE(store.is_own(a));
  EXPECT_EQ(a.n_triangles, static_cast<std::int32_t>(m.result.patches[0].triangles.size()));
  EXPECT_LT(distance(c.box.center(), m.model.tables().face_box[3].center()), 1e-9);
  EXPECT_EQ(packed(store.get(3, 1)->patch), packed(m.result.patches[3]));
  const std::vector<FacePatch> copies = store.bring({{3, c}, {0, b}});
  ASSERT_EQ(copies.size(), 2u);
  EXPECT_EQ(copies[0].face, 3);
  EXPECT_EQ(packed(copies[1]), packed(m.result.patches[0]));
  EXPECT_EQ(packed(store.take(0, 2)), packed(m.result.patches[0]));
}

TEST(PatchStore, drops_what_is_not_to_be_kept_and_keeps_nothing_of_an_empty_patch) {
  const Meshed m("box", 8);
  PatchStore store(test::one_rank);
  const PatchPlace a = store.put(FacePatch(m.result.patches[0]), 1, m.result.edges, m.model.tables().vertex_xyz);
  store.put(FacePatch(m.result.patches[1]), 1, m.result.edges, m.model.tables().vertex_xyz);
  store.keep_only({{0, a}});
  EXPECT_NO_THROW(store.get(0, 1));
  EXPECT_THROW(store.get(1, 1), std::out_of_range);
  FacePatch empty;
  empty.face = 2;
  EXPECT_FALSE(store.put(std::move(empty), 1, m.result.edges, m.model.tables().vertex_xyz).is_there());
}

}  // namespace
}  // namespace st
