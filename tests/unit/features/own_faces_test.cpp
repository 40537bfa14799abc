// What belongs to a lifting surface.
#include "features/own_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/concave_edges.h"
#include "features/strip.h"
#include "support/shapes.h"

namespace st {
namespace {

TEST(OwnFaces, end_at_concave_edges) {
  const Model model = test::make_model("wing_on_body");
  const FaceRoles roles = face_roles(model.tables());
  std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  ASSERT_EQ(wings.size(), 1u);
  const std::vector<FaceId> own = wings[0].faces;
  wings[0].faces.clear();
  for (FaceId f = 0; f < model.tables().n_faces(); ++f) wings[0].faces.push_back(f);  // as if profiles crossed all
  ChordStation& on_body = wings[0].trailing[0].stations[1];
  on_body.is_measured = true;
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    if (model.tables().face_box[f].lo.x < -2.9 && model.tables().face_box[f].hi.x > 12) on_body.nose_face = f;
  keep_own(model.tables(), find_concave_edges(model, roles), {}, wings[0]);
  EXPECT_LT(wings[0].faces.size(), static_cast<std::size_t>(model.tables().n_faces()));
  EXPECT_TRUE(std::ranges::includes(wings[0].faces, own));
  EXPECT_FALSE(on_body.is_measured) << "its nose lies on the body";
}

TEST(OwnFaces, of_a_body_are_no_faces_beyond_a_concave_edge_even_where_others_lead_there) {
  const Model model = test::make_model("wing_on_body");
  const FaceRoles roles = face_roles(model.tables());
  const std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  ASSERT_EQ(wings.size(), 1u);
  const std::vector<std::uint8_t> walls(static_cast<std::size_t>(model.tables().n_faces()), 1);
  std::vector<std::uint8_t> is_concave = find_concave_edges(model, roles);
  const auto count = [&] {
    return std::ranges::count(find_body_faces(model.tables(), is_concave, walls, wings[0]), std::uint8_t{1});
  };
  const auto n_own = count();
  EXPECT_LT(n_own, model.tables().n_faces());
  *std::ranges::find(is_concave, std::uint8_t{1}) = 0;  // as where the wing's root passes an end of the body
  EXPECT_EQ(count(), n_own);
}

}  // namespace
}  // namespace st
