// A patch in sections is the whole patch.
#include "mesh/patch_section.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "base/packer.h"

#include "mesh/corner_uv.h"
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
  p.triangles = {{{0, 1, 6}}, {{1, 7, 6}}, {{1, 2, 7}}, {{2, 3, 7}},
                 {{3, 4, 7}}, {{4, 6, 7}}, {{4, 5, 6}}, {{5, 0, 6}}};
  for (std::int32_t c = 0; c < 24; ++c)
    if (const NodeId n = p.triangles[c / 3].n[c % 3]; n < 6) {
      p.uv_corner.push_back(c);
      p.own_uv.push_back({static_cast<double>(n), static_cast<double>(c)});
    }
  return p;
}

/// Triangles [0, 3) with nodes 0, 1, 2 of the boundary and both inner nodes; then the rest, which has neither of these.
std::vector<PatchSection> in_two(const FacePatch& whole) {
  std::vector<PatchSection> two(2);
  FacePatch& a = two[0].patch;
  a = whole;
  a.n_boundary = 3;
  a.boundary_dim.resize(3);
  a.boundary_entity.resize(3);
  a.boundary_index.resize(3);
  a.triangles = {{{0, 1, 3}}, {{1, 4, 3}}, {{1, 2, 4}}};
  two[0].is_whole_boundary = false;
  two[0].boundary_number = {0, 1, 2};
  two[0].shared = {0, 1};
  two[0].shared_key = {inner_key(0, 0), inner_key(0, 1)};
  FacePatch& b = two[1].patch;
  b = whole;
  b.triangles.erase(b.triangles.begin(), b.triangles.begin() + 3);
  two[1].n_foreign = 2;
  two[1].shared = {0, 1};
  two[1].shared_key = two[0].shared_key;
  const std::vector<Vec2> all = corner_uvs(whole);
  set_corner_uvs(std::span(all).first(9), a);
  set_corner_uvs(std::span(all).subspan(9), b);
  return two;
}

TEST(PatchSection, rows_of_all_are_the_patch) {
  const FacePatch whole = whole_patch();
  std::vector<PatchSection> sections = in_two(whole);
  EXPECT_EQ(sections[0].n_own(), 2);
  EXPECT_EQ(sections[1].n_own(), 0);
  const SectionBegin begins[] = {{}, {2, 3, static_cast<std::int64_t>(sections[0].patch.uv_corner.size())}};
  std::vector<SectionRows> rows;
  for (std::size_t i = 0; i < 2; ++i) rows.push_back(rows_of(std::move(sections[i]), begins, i, 6));
  EXPECT_FALSE(rows[0].has_boundary);
  EXPECT_TRUE(rows[0].rows.boundary_dim.empty());
  EXPECT_TRUE(rows[1].has_boundary);
  EXPECT_EQ(packed(join_rows(std::move(rows))), packed(whole));
}

TEST(PatchSection, alone_is_the_patch) {
  const FacePatch whole = whole_patch();
  PatchSection section;
  section.patch = whole;
  const SectionBegin begins[] = {{}};
  std::vector<SectionRows> rows;
  rows.push_back(rows_of(std::move(section), begins, 0, 6));
  EXPECT_EQ(packed(rows[0].rows), packed(whole));
  EXPECT_EQ(packed(join_rows(std::move(rows))), packed(whole));
}

TEST(PatchSection, keys_of_inner_nodes_differ_from_each_other_and_from_those_on_boundaries) {
  constexpr std::int32_t kMost = (std::int64_t{1} << 31) - 1;
  std::set<std::int64_t> keys;
  for (const std::int32_t section : {0, 1, 7000, kMost})
    for (const std::int32_t number : {0, 1, 7000, kMost}) keys.insert(inner_key(section, number));
  EXPECT_EQ(keys.size(), 16u);
  EXPECT_LT(*keys.rbegin(), boundary_key(EntityDim::kVertex, 0, 0));
}

TEST(PatchSection, parts_of_one_face_have_common_nodes_where_they_share_them_and_those_of_two_faces_do_not) {
  const std::vector<PatchSection> two = in_two(whole_patch());
  const std::vector<Vec3> vertices = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0},
                                      {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0},
                                      {3, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 1, 0}};
  const EdgeMesh edges = EdgeMesh::of_edges(0);
  const PatchBlocks a(edges, vertices, two[0].patch), b(edges, vertices, two[1].patch);
  for (const bool is_of_one_face : {true, false}) {
    const PatchPart of_a = part_of(edges, vertices, two[0], a, a.meeting(b), is_of_one_face),
                    of_b = part_of(edges, vertices, two[1], b, b.meeting(a), is_of_one_face);
    const TwoParts both = join_parts(of_a, of_b);
    ASSERT_EQ(both.triangles.size(), 8u);
    std::map<std::array<double, 2>, std::set<NodeId>> at;
    for (const Triangle& t : both.triangles)
      for (const NodeId n : t.n) at[{both.points[n].x, both.points[n].y}].insert(n);
    EXPECT_EQ((at[{2, 0}].size()), 1u) << "on the boundary";
    EXPECT_EQ((at[{2, 1}].size()), is_of_one_face ? 1u : 5u) << "inside";
  }
}

}  // namespace
}  // namespace st
