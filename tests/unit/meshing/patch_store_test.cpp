// Patches that stay where they are made.
#include "meshing/engine/patch_store.h"

#include <gtest/gtest.h>

#include "support/meshed.h"
#include "support/patch_sections.h"

namespace st {
namespace {

using test::Meshed;

TEST(PatchStore, gives_back_what_was_put_by_face_and_version) {
  const Meshed m("box", 8);
  PatchStore store(test::one_rank);
  const auto put = [&](FaceId f, std::int64_t version) {
    return store.put(FacePatch(m.result.patches[f]), 0, version, m.result.edges, m.model.tables().vertex_xyz);
  };
  const PatchPlace a = put(0, 1), b = put(0, 2), c = put(3, 1);
  EXPECT_TRUE(store.is_own(a));
  EXPECT_EQ(a.n_triangles, static_cast<std::int32_t>(m.result.patches[0].triangles.size()));
  EXPECT_LT(distance(c.box.center(), m.model.tables().face_box[3].center()), 1e-9);
  EXPECT_EQ(packed(*store.get(c)), packed(m.result.patches[3]));
  const std::vector<FacePatch> copies = store.bring({place_of(c), place_of(b)});
  ASSERT_EQ(copies.size(), 2u);
  EXPECT_EQ(copies[0].face, 3);
  EXPECT_EQ(packed(copies[1]), packed(m.result.patches[0]));
  EXPECT_EQ(packed(store.take(place_of(b), 0)), packed(m.result.patches[0]));
}

TEST(PatchStore, drops_what_is_not_to_be_kept_and_keeps_nothing_of_an_empty_patch) {
  const Meshed m("box", 8);
  PatchStore store(test::one_rank);
  const PatchPlace a = store.put(FacePatch(m.result.patches[0]), 0, 1, m.result.edges, m.model.tables().vertex_xyz);
  const PatchPlace b = store.put(FacePatch(m.result.patches[1]), 0, 1, m.result.edges, m.model.tables().vertex_xyz);
  store.keep_only({a});
  EXPECT_NO_THROW(store.get(a));
  EXPECT_THROW(store.get(b), std::out_of_range);
  FacePatch empty;
  empty.face = 2;
  EXPECT_FALSE(store.put(std::move(empty), 0, 1, m.result.edges, m.model.tables().vertex_xyz).is_there());
}

TEST(FacePlace, has_the_rows_of_its_sections_one_after_the_other) {
  std::vector<PatchPlace> sections(4);
  for (std::int32_t i = 0; i < 4; ++i) {
    PatchPlace& p = sections[i];
    p.rank = i == 1 ? kNone : i;
    p.section = i;
    if (p.is_there()) p.n_inner = 10 + i, p.n_triangles = 100 + i, p.n_own_uv = 1000 + i;
  }
  const FacePlace place = place_of(sections);
  EXPECT_EQ(n_triangles_of(place), 100 + 102 + 103);
  ASSERT_EQ(place.size(), 4u);
  EXPECT_EQ(place[3].inner_begin, 10 + 12);
  EXPECT_EQ(place[3].triangle_begin, 100 + 102);
  EXPECT_EQ(place[3].own_uv_begin, 1000 + 1002);
  EXPECT_TRUE(place_of(PatchPlace()).empty());
}

TEST(PatchStore, keeps_sections_of_a_face_apart_and_brings_them_as_one_patch) {
  const Meshed m("box", 8);
  const FacePatch& whole = m.result.patches[0];
  PatchStore store(test::one_rank);
  std::vector<PatchPlace> places;
  for (FacePatch& s : test::in_two(whole))
    places.push_back(store.put(std::move(s), static_cast<std::int32_t>(places.size()), 1, m.result.edges,
                               m.model.tables().vertex_xyz));
  const FacePlace place = place_of(places);
  EXPECT_EQ(n_triangles_of(place), static_cast<std::int64_t>(whole.triangles.size()));
  EXPECT_EQ(place[1].triangle_begin, static_cast<std::int64_t>(whole.triangles.size() / 2));
  EXPECT_EQ(packed(store.bring({place}).at(0)), packed(whole));
}

}  // namespace
}  // namespace st
