// Which faces belong to one body.
#include "geometry/model/bodies.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(Bodies, are_solids_with_the_shells_of_their_holes) {
  const Model ball = test::make_model("thin_ball");
  const std::vector<std::int32_t> body = bodies_of(ball.tables());
  ASSERT_EQ(body.size(), 2u);
  EXPECT_EQ(body[0], body[1]) << "inside and outside of one solid";
  EXPECT_NE(ball.tables().face_shell[0], ball.tables().face_shell[1]);
}

TEST(Bodies, differ_between_solids_and_between_shells_without_one) {
  const Model pin = test::make_model("pin_in_bore");
  const std::vector<std::int32_t> body = bodies_of(pin.tables());
  EXPECT_NE(body.front(), body.back());
  ModelTables loose = pin.tables();
  loose.face_solid.assign(loose.n_faces(), kNone);
  const std::vector<std::int32_t> shells = bodies_of(loose);
  EXPECT_NE(shells.front(), shells.back());
  loose.face_shell.assign(loose.n_faces(), kNone);
  EXPECT_EQ(bodies_of(loose), std::vector<std::int32_t>(loose.n_faces(), kNone));
}

TEST(Bodies, meet_within_what_the_cad_leaves_open) {
  const Model pin = test::make_model("pin_in_bore");
  const double least = meeting_distance(pin.tables(), 0, 1);
  EXPECT_NEAR(least, 1e-6 * pin.tables().box().diagonal(), 1e-7 * pin.tables().box().diagonal());
}

}  // namespace
}  // namespace st
