// A patch in sections is the whole patch.
#include "mesh/patch_section.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "base/packer.h"

#include "mesh/corner_uv.h"
#include "mesh/node_key.h"
#include "mesh/patch_blocks.h"

namespace st {
namespace {

/// Two rows of squares, cut to triangles: nodes 0 to 5 around it are on the boundary; two are inside.
FacePatch whole_patch() {
  FacePatch p;
  p.face = 4;
  p.n_boundary = 6;
  for (std::int32_t i = 0; i < 6; ++i) {
    p.boundary_dim.push_back(static_cast<std::uint8_t>(EntityDim::kVertex));
    p.boundary_entity.push_back(10 + i);
    p.boundary_index.push_back(0);
  }
  p.inner_xyz = {{1, 1, 0}, {2, 1, 0}};
  p.inner_uv = {{0.1, 0.1}, {0.2, 0.1}};
  p.inner_size = {0.5, 0.7};
  p.triangles = {{{4, 5, 6}}, {{5, 0, 6}}, {{0, 1, 6}}, {{2, 3, 7}},
                 {{3, 4, 7}}, {{1, 7, 6}}, {{1, 2, 7}}, {{4, 6, 7}}};
  for (std::int32_t c = 0; c < 24; ++c)
    if (const NodeId n = p.triangles[c / 3].n[c % 3]; n < 6) {
      p.uv_corner.push_back(c);
      p.own_uv.push_back({static_cast<double>(n), static_cast<double>(c)});
    }
  return p;
}

/// Those about node 6, those about node 7, and those between, which have neither of these nodes.
std::vector<FacePatch> in_three(const FacePatch& whole) {
  const std::vector<Vec2> uv = corner_uvs(whole);
  std::vector<FacePatch> sections(3);
  const auto fill = [&](std::int32_t number, const std::vector<std::int32_t>& boundary, std::int32_t inner,
                        const std::vector<Triangle>& triangles, std::size_t first) {
    FacePatch& p = sections[number];
    p.face = whole.face;
    p.n_boundary = static_cast<std::int32_t>(boundary.size());
    for (const std::int32_t b : boundary) {
      p.boundary_dim.push_back(whole.boundary_dim[b]);
      p.boundary_entity.push_back(whole.boundary_entity[b]);
      p.boundary_index.push_back(whole.boundary_index[b]);
    }
    p.inner_xyz = {whole.inner_xyz[inner]};
    p.inner_uv = {whole.inner_uv[inner]};
    p.inner_size = {whole.inner_size[inner]};
    p.triangles = triangles;
    p.boundary_number = boundary;
    set_corner_uvs(std::span(uv).subspan(3 * first, 3 * triangles.size()), p);
  };
  fill(0, {0, 1, 4, 5}, 0, {{{2, 3, 4}}, {{3, 0, 4}}, {{0, 1, 4}}}, 0);
  fill(1, {2, 3, 4}, 1, {{{0, 1, 3}}, {{1, 2, 3}}}, 3);
  FacePatch& last = sections[2];
  last = whole;
  last.triangles.erase(last.triangles.begin(), last.triangles.begin() + 5);
  last.owner = {{0, 0}, {1, 0}};
  set_corner_uvs(std::span(uv).subspan(15), last);
  return sections;
}

TEST(PatchSection, rows_of_all_are_the_patch) {
  const FacePatch whole = whole_patch();
  std::vector<FacePatch> sections = in_three(whole);
  std::vector<PatchPlace> places(3);
  for (std::size_t i = 0; i < 3; ++i) places[i].n_inner = sections[i].n_own();
  places[2].n_boundary = 6;
  for (std::size_t i = 1; i < 3; ++i) {
    const FacePatch& before = sections[i - 1];
    places[i].inner_begin = places[i - 1].inner_begin + before.n_own();
    places[i].triangle_begin = places[i - 1].triangle_begin + std::ssize(before.triangles);
    places[i].own_uv_begin = places[i - 1].own_uv_begin + std::ssize(before.uv_corner);
  }
  EXPECT_EQ(places[2].inner_begin + sections[2].n_own(), 2);
  std::vector<FacePatch> rows;
  for (std::size_t i = 0; i < 3; ++i) rows.push_back(rows_of(std::move(sections[i]), places, i));
  EXPECT_TRUE(rows[0].boundary_dim.empty());
  EXPECT_EQ(rows[2].boundary_dim.size(), 6u);
  EXPECT_EQ(packed(join_rows(std::move(rows))), packed(whole));
}

TEST(PatchSection, alone_is_the_patch) {
  const FacePatch whole = whole_patch();
  FacePatch section = whole;
  const PatchPlace places[1] = {};
  std::vector<FacePatch> rows;
  rows.push_back(rows_of(std::move(section), places, 0));
  EXPECT_EQ(packed(rows[0]), packed(whole));
  EXPECT_EQ(packed(join_rows(std::move(rows))), packed(whole));
}

TEST(PatchSection, keys_of_inner_nodes_differ_from_each_other_and_from_those_on_boundaries) {
  constexpr std::int32_t kMost = (std::int64_t{1} << 31) - 1;
  std::set<NodeKey> keys;
  for (const std::int32_t section : {0, 1, 7000, kMost})
    for (const std::int32_t number : {0, 1, 7000, kMost}) {
      keys.insert(inner_key({section, number}));
    }
  EXPECT_EQ(keys.size(), 16u);
  EXPECT_LT(*keys.rbegin(), boundary_key(EntityDim::kVertex, 0, 0));
}

TEST(PatchSection, parts_of_one_face_have_common_nodes_where_they_share_them_and_those_of_two_faces_do_not) {
  const std::vector<FacePatch> all = in_three(whole_patch());
  const FacePatch &one = all[0], &other = all[2];
  const std::vector<Vec3> vertices = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0},
                                      {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0},
                                      {3, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 1, 0}};
  const EdgeMesh edges = EdgeMesh::of_edges(0);
  const PatchBlocks of_one(edges, vertices, one), of_other(edges, vertices, other);
  for (const bool is_of_one_face : {true, false}) {
    const auto number = [&](std::int32_t n) { return is_of_one_face ? n : kNone; };
    const SectionPart of_a = part_of(edges, vertices, one, of_one, of_one.meeting(of_other), number(0)),
                      of_b = part_of(edges, vertices, other, of_other, of_other.meeting(of_one), number(2));
    const SurfaceMesh both = weld_parts(edges, vertices, of_a.patch, of_b.patch);
    ASSERT_EQ(both.triangles.size(), 6u);
    std::map<std::array<double, 2>, std::set<NodeId>> at;
    for (const Triangle& t : both.triangles)
      for (const NodeId n : t.n) at[{both.node_xyz[n].x, both.node_xyz[n].y}].insert(n);
    EXPECT_EQ((at[{2, 0}].size()), 1u) << "on the boundary";
    EXPECT_EQ((at[{1, 1}].size()), is_of_one_face ? 1u : 2u) << "inside";
  }
}

}  // namespace
}  // namespace st
