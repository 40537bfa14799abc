#include "geometry/model/parted_composites.h"

#include <gtest/gtest.h>

#include <vector>

#include "geometry/model/edge_faces.h"
#include "geometry/model/joined_tables.h"
#include "unit/geometry/joined_models.h"

namespace st {
namespace {

/// A wing whose upper and lower skins are one face each.
struct Skins {
  ImportResult cad = test::import_shape("wing_of_8");
  Composites composites = found();
  Model model{cad.tables, cad.brep, composites};

 private:
  Composites found() const {
    const Model whole(cad.tables, cad.brep);
    JoinRequest request = test::curved_request(whole);
    const EdgeFaces faces_at(cad.tables);
    const auto is_above = [&](FaceId f) { return cad.tables.face_box[f].center().y > 0; };
    for (EdgeId e = 0; e < cad.tables.n_edges(); ++e)
      if (request.may_join[e]) request.may_join[e] = is_above(faces_at[e][0]) == is_above(faces_at[e][1]);
    return find_composites(whole, request).composites;
  }
};

TEST(PartedComposites, leave_the_others_as_they_are) {
  const Skins joined;
  const Composites &all = joined.composites, kept = without(all, {1, 0}, joined.cad.tables);
  ASSERT_EQ(kept.size(), 1);
  EXPECT_EQ(kept.contradiction(joined.cad.tables), "");
  EXPECT_TRUE(std::ranges::equal(kept.members(0), all.members(1)));
  EXPECT_EQ(kept.chart(0).uv, all.chart(1).uv);
  EXPECT_EQ(count_left(join_tables(joined.cad.tables, kept).tables).faces, 7) << "10 of the CAD, 4 are one";
  const Model model(joined.cad.tables, joined.cad.brep, kept);
  const FaceId skin = kept.members(0).front();
  for (const Vec2 uv : kept.chart(0).uv)
    EXPECT_EQ(model.surface(skin)->point(uv), joined.model.surface(skin)->point(uv));
}

TEST(PartedComposites, have_edges_that_end_at_faces_that_are_alone) {
  const Skins joined;
  EXPECT_FALSE(joined.composites.joined_vertices.empty());
  const Composites upper = without(joined.composites, {0, 1}, joined.cad.tables);
  EXPECT_EQ(upper.contradiction(joined.cad.tables), "");
  const ModelTables& t = joined.cad.tables;
  for (const FaceId f : joined.composites.members(1))
    for (const EdgeId e : t.edges_of(f))
      for (const std::size_t k : {0, 1})
        EXPECT_FALSE(
            std::ranges::binary_search(upper.joined_vertices, t.edge_vertices[2 * static_cast<std::size_t>(e) + k]));
  EXPECT_FALSE(upper.joined_vertices.empty()) << "at the tips";
  EXPECT_EQ(without(joined.composites, {0, 0}, joined.cad.tables).joined_vertices, joined.composites.joined_vertices);
  EXPECT_TRUE(without(joined.composites, {1, 1}, joined.cad.tables).empty());
}

TEST(PartedComposites, are_known_by_faces_that_are_no_more_where_they_are_one) {
  const Skins joined;
  const Composites& c = joined.composites;
  const auto marked = [&](const std::vector<FaceId>& faces) {
    std::vector<std::uint8_t> is_apart(static_cast<std::size_t>(c.size()), 0);
    mark_apart(c, faces, is_apart);
    return is_apart;
  };
  EXPECT_EQ(marked({c.members(0)[0], c.members(1)[0], 1000}), (std::vector<std::uint8_t>{0, 0}));
  EXPECT_EQ(marked({c.members(0)[0], c.members(1)[2]}), (std::vector<std::uint8_t>{0, 1}));
}

}  // namespace
}  // namespace st
