#include "meshing/face/patch_parameters.h"

#include <gtest/gtest.h>

#include "support/meshed.h"

namespace st {
namespace {

/// All (u,v) of a shape's patches, which were made with them, found again from places alone.
void expect_same_parameters(const std::string& shape, double length) {
  const test::Meshed meshed(shape, length);
  for (const FacePatch& p : meshed.result.patches) {
    const auto surface = meshed.model.surface(p.face);
    const FaceBoundary boundary = make_face_boundary(meshed.model, *surface, p.face, meshed.numbering());
    FacePatch again = p;
    again.inner_uv.assign(p.inner_uv.size(), {});
    again.own_uv.assign(p.own_uv.size(), {});
    EXPECT_LT(set_parameters(*surface, boundary, meshed.numbering(), again).distance, 1e-6);
    ASSERT_EQ(again.uv_corner, p.uv_corner);
    double most = 0;
    for (std::size_t i = 0; i < p.own_uv.size(); ++i)
      most = std::max({most, std::abs(again.own_uv[i].x - p.own_uv[i].x), std::abs(again.own_uv[i].y - p.own_uv[i].y)});
    EXPECT_LT(most, 1e-6) << shape << " face " << p.face + 1;
    for (std::size_t i = 0; i < p.inner_uv.size(); ++i)
      EXPECT_LT(distance(surface->point(again.inner_uv[i]), p.inner_xyz[i]), 1e-6);
  }
}

TEST(PatchParameters, are_found_again_on_planes_splines_and_across_a_seam) {
  expect_same_parameters("box", 8);
  expect_same_parameters("passage", 4);
  expect_same_parameters("cylinder", 3);
}

TEST(PatchParameters, say_how_far_a_node_is_off) {
  const test::Meshed meshed("box", 8);
  FacePatch p = meshed.result.patches[0];
  const auto surface = meshed.model.surface(0);
  const FaceBoundary boundary = make_face_boundary(meshed.model, *surface, 0, meshed.numbering());
  p.inner_xyz[3] += 0.25 * normalized(surface_normal(*surface, p.inner_uv[3]));
  EXPECT_NEAR(set_parameters(*surface, boundary, meshed.numbering(), p).distance, 0.25, 1e-9);
}

}  // namespace
}  // namespace st
