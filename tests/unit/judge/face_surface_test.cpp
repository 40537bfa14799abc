#include "judge/face_surface.h"

#include <gtest/gtest.h>

#include "unit/meshing/shape_mesh.h"

namespace st {
namespace {

TEST(FaceSurface, is_that_of_the_face_asked_for_and_stays_while_the_face_does) {
  const test::ShapeMesh box("box");
  const Model& model = box.model;
  FaceSurface surface(model);
  const Vec3 first = surface.of(0).point({0.3, 0.4});
  EXPECT_EQ(first.x, model.surface(0)->point({0.3, 0.4}).x);
  const Surface* kept = &surface.of(0);
  EXPECT_EQ(kept, &surface.of(0));
  for (const FaceId f : {1, 0, 3}) {
    const Vec3 here = surface.of(f).point({0.3, 0.4}), there = model.surface(f)->point({0.3, 0.4});
    EXPECT_EQ(distance(here, there), 0);
  }
}

}  // namespace
}  // namespace st
