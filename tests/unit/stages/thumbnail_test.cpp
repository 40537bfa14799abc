#include "stages/thumbnail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace st {
namespace {

constexpr const char* kStart = "data:image/bmp;base64,";

SurfaceMesh one_triangle() {
  SurfaceMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, -1, 1}};
  mesh.triangles = {{{0, 1, 2}}};
  mesh.triangle_face = {0};
  return mesh;
}

/// Points of the picture that are not white, roughly: white is "////" in base64.
double share_of_ink(const std::string& uri) {
  const std::string pixels = uri.substr(std::string(kStart).size() + (54 + 1024) / 3 * 4);
  const auto n = std::count_if(pixels.begin(), pixels.end(), [](char c) { return c != '/'; });
  return static_cast<double>(n) / static_cast<double>(pixels.size());
}

TEST(Thumbnail, shows_a_triangle) {
  const std::string uri = thumbnail(one_triangle());
  ASSERT_TRUE(uri.starts_with(kStart));
  EXPECT_EQ(uri.size(), std::string(kStart).size() + (54 + 1024 + 160 * 120 + 2) / 3 * 4);
  EXPECT_GT(share_of_ink(uri), 0.1);
  EXPECT_LT(share_of_ink(uri), 0.9);
}

TEST(Thumbnail, leaves_out_the_far_field) {
  SurfaceMesh mesh = one_triangle();
  const std::string alone = thumbnail(mesh);
  std::swap(mesh.triangles[0].n[1], mesh.triangles[0].n[2]);  // normals of a domain point into the body
  mesh.node_xyz.insert(mesh.node_xyz.end(), {{-90, 0, 0}, {90, 0, 0}, {0, -90, 90}});
  mesh.triangles.push_back({{3, 4, 5}});
  mesh.triangle_face.push_back(1);
  mesh.triangle_group = {0, 1};  // as a mesh that was read has them
  mesh.labels.group_name = {"wing", "farfield"};
  mesh.labels.group_role = {"wall", "farfield"};
  EXPECT_EQ(thumbnail(mesh), alone);
}

TEST(Thumbnail, looks_at_the_outside_of_a_half) {
  // a roof over the plane y = 0, with its ridge at y = 1 or -1: seen from the other side it has the same picture
  const auto roof = [](double y) {
    SurfaceMesh mesh;
    mesh.node_xyz = {{0, 0, 0}, {2, 0, 0}, {1, 0, 1}, {1, y, 0.3}};
    for (const Triangle t : {Triangle{{0, 1, 3}}, Triangle{{1, 2, 3}}, Triangle{{2, 0, 3}}})
      mesh.triangles.push_back(t);
    if (y > 0)
      for (Triangle& t : mesh.triangles) std::swap(t.n[0], t.n[1]);
    mesh.triangle_face = {0, 1, 2};
    return mesh;
  };
  const SurfaceMesh ahead = roof(-1), behind = roof(1);
  const std::string own = thumbnail(ahead), other = thumbnail(behind);
  EXPECT_NE(own, other);
  SurfaceMesh turned = behind;  // its normals say that the half is on the other side: seen from inside
  for (Triangle& t : turned.triangles) std::swap(t.n[0], t.n[1]);
  EXPECT_NE(thumbnail(turned), other);
}

TEST(Thumbnail, there_is_none_of_nothing) { EXPECT_EQ(thumbnail(SurfaceMesh()), ""); }

}  // namespace
}  // namespace st
