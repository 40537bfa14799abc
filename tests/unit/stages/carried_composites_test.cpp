#include "stages/carried_composites.h"

#include <gtest/gtest.h>

#include <vector>

#include "geometry/model/edit_model.h"
#include "geometry/model/joined_tables.h"
#include "stages/compose.h"
#include "support/shapes.h"

namespace st {
namespace {

/// A wing whose skins of 4 pieces are one face each, and what st-edit knows of it.
struct Wing {
  JoinedInput input;
  std::vector<std::byte> brep;
  EditTrace trace;
  std::vector<Similarity> motion;

  explicit Wing(const char* shape = "wing_of_8") {
    ImportResult cad = test::import_shape(shape);
    GeometryArtifact geometry;
    geometry.tables = cad.tables;
    geometry.brep = brep = cad.brep;
    compose(geometry, false);
    input = {cad.tables, geometry.composites};
    trace.append(cad.tables, 0);
    motion.resize(static_cast<std::size_t>(cad.tables.n_faces()));
  }
  Model cad() const { return {input.cad, brep}; }
  Composites carried(const Model& result, int n_left) const {
    int n = 0;
    const Composites c = carry_composites(std::span(&input, 1), trace, result, motion, n);
    EXPECT_EQ(n, n_left);
    EXPECT_EQ(c.contradiction(result.tables()), "");
    return c;
  }
};

TEST(CarryComposites, are_the_same_where_nothing_changes) {
  const Wing wing;
  const Composites c = wing.carried(wing.cad(), 0), &before = wing.input.composites;
  EXPECT_EQ(c.member, before.member);
  EXPECT_EQ(c.joined_edges, before.joined_edges);
  EXPECT_EQ(c.joined_vertices, before.joined_vertices);
  EXPECT_EQ(c.node_uv, before.node_uv);
  EXPECT_EQ(c.rim_coedge, before.rim_coedge);
  EXPECT_EQ(c.rim_t, before.rim_t);
  EXPECT_EQ(c.rim_triangle, before.rim_triangle);
}

TEST(CarryComposites, move_with_their_faces) {
  Wing wing;
  Similarity motion = rotation_about({0, 1, 1}, 0.3);
  motion.translation = {1, 2, 3};
  std::ranges::fill(wing.motion, motion);
  const Model moved = transform(wing.cad(), motion);
  const Model before(wing.input.cad, wing.brep, wing.input.composites),
      after(moved.tables(), moved.brep(), wing.carried(moved, 0));
  const FaceId skin = wing.input.composites.members(0).front();
  for (const Vec2 uv : wing.input.composites.chart(0).uv)
    EXPECT_LE(distance(after.surface(skin)->point(uv), motion(before.surface(skin)->point(uv))), 1e-9);
  EXPECT_EQ(count_left(after.tables()).edges, count_left(before.tables()).edges);
}

TEST(CarryComposites, stand_behind_those_of_an_input_before) {
  Wing wing;
  const Model cad(wing.input.cad, wing.brep);
  Similarity away;
  away.translation = {0, 100, 0};
  const Model both = append(cad, transform(cad, away));
  wing.trace.append(wing.input.cad, 1);
  wing.motion.resize(static_cast<std::size_t>(both.tables().n_faces()), away);
  int n_left = 0;
  const std::vector<JoinedInput> inputs{wing.input, wing.input};
  const Composites c = carry_composites(inputs, wing.trace, both, wing.motion, n_left);
  EXPECT_EQ(n_left, 0);
  EXPECT_EQ(c.size(), 4);
  EXPECT_EQ(c.contradiction(both.tables()), "");
  EXPECT_EQ(count_left(join_tables(both.tables(), c).tables).faces, 8);
}

TEST(CarryComposites, stay_behind_where_a_face_is_gone_or_moves_alone) {
  Wing wing;
  const std::span<const FaceId> skin = wing.input.composites.members(0);
  std::vector<FaceId> kept;
  for (FaceId f = 0; f < wing.input.cad.n_faces(); ++f)
    if (f != skin[2]) kept.push_back(f);
  const SubModel part = extract(Model(wing.input.cad, wing.brep), kept);
  Wing cut = wing;
  cut.trace.select(part.faces, part.edges, part.vertices);
  cut.motion.pop_back();
  EXPECT_EQ(cut.carried(part.model, 1).size(), 1);
  wing.motion[static_cast<std::size_t>(skin[1])].translation = {0, 0, 1};
  EXPECT_EQ(wing.carried(wing.cad(), 1).size(), 1);
}

/// A B-spline's (u,v) stay where it is scaled; a cylinder's v and the parameters of straight edges grow.
TEST(CarryComposites, grow_where_all_is_scaled) {
  for (const char* shape : {"wing_of_8", "cylinder_of_8"}) {
    Wing wing(shape);
    Similarity motion = rotation_about({0, 1, 1}, 0.3);
    motion.translation = {1, 2, 3};
    motion.scale = 2.5;
    std::ranges::fill(wing.motion, motion);
    const Model moved = transform(wing.cad(), motion);
    const Composites carried = wing.carried(moved, 0);
    const Model before(wing.input.cad, wing.brep, wing.input.composites), after(moved.tables(), moved.brep(), carried);
    const Composites& c = wing.input.composites;
    for (std::int32_t i = 0; i < c.size(); ++i) {
      const FaceId face = c.members(i).front();
      for (const Vec2 uv : c.chart(i).uv)
        EXPECT_LE(distance(after.surface(face)->point(2.5 * uv), motion(before.surface(face)->point(uv))), 1e-9);
    }
    for (std::size_t r = 0; r < c.rim_coedge.size(); ++r) {
      const EdgeId e = wing.input.cad.coedge_edge[static_cast<std::size_t>(c.rim_coedge[r])];
      const auto curve = wing.cad().curve(e), scaled = moved.curve(e);
      for (std::int32_t k = c.rim_offsets[r]; k < c.rim_offsets[r + 1]; ++k)
        EXPECT_LE(distance(scaled->point(carried.rim_t[k]), motion(curve->point(c.rim_t[k]))), 1e-9);
    }
  }
}

TEST(CarryComposites, stay_behind_where_all_is_mirrored) {
  Wing wing;
  std::ranges::fill(wing.motion, reflection_at({1, 0, 0}));
  EXPECT_TRUE(wing.carried(wing.cad(), 2).empty());
}

}  // namespace
}  // namespace st
