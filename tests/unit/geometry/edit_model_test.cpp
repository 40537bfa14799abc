#include "geometry/model/edit_model.h"
#include "geometry/import/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/shapes.h"
#include "unit/geometry/consistent_model.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const char* const kShapes[] = {
    "box",           "sphere",        "drilled_cylinder", "cone",       "torus",     "wave",
    "rational_wave", "periodic_tube", "plate_with_hole",  "revolution", "extrusion", "offset",
    "bezier",        "tube_window",   "two_boxes"};

/// Unit normal out of the solid in the middle of a face.
Vec3 outward(const Model& m, FaceId f) {
  const auto s = m.surface(f);
  return (m.tables().face_is_reversed[f] ? -1.0 : 1.0) *
         surface_normal(*s, {0.5 * (s->u_min() + s->u_max()), 0.5 * (s->v_min() + s->v_max())});
}

/// Face f of `part` is face g of `whole`, to the bit.
void expect_same_face(const Model& part, FaceId f, const Model& whole, FaceId g) {
  const ModelTables &a = part.tables(), &b = whole.tables();
  EXPECT_EQ(a.face_type[f], b.face_type[g]);
  EXPECT_EQ(a.face_area[f], b.face_area[g]);
  EXPECT_EQ(a.face_is_reversed[f], b.face_is_reversed[g]);
  EXPECT_EQ(a.labels.face_name[f], b.labels.face_name[g]);
  EXPECT_EQ(a.labels.group_name[a.labels.face_group[f]], b.labels.group_name[b.labels.face_group[g]]);
  const auto s = part.surface(f), t = whole.surface(g);
  EXPECT_EQ(s->u_min(), t->u_min());
  const Vec2 uv{0.3 * s->u_min() + 0.7 * s->u_max(), 0.6 * s->v_min() + 0.4 * s->v_max()};
  EXPECT_LE(distance(s->point(uv), t->point(uv)), 1e-13 * b.box().diagonal());
  const auto n_loops = [](const ModelTables& m, FaceId i) {
    return m.face_loop_offsets[i + 1] - m.face_loop_offsets[i];
  };
  EXPECT_EQ(n_loops(a, f), n_loops(b, g));
}

TEST(Extract, gives_faces_with_their_edges_and_vertices_only) {
  for (const char* shape : kShapes) {
    const Model whole = test::make_model(shape);
    const ModelTables& t = whole.tables();
    std::vector<FaceId> faces;
    for (FaceId f = t.n_faces() - 1; f >= 0; f -= 2) faces.push_back(f);  // backwards: the order asked for is kept
    const SubModel part = extract(whole, faces);
    EXPECT_EQ(part.faces, faces);
    test::expect_consistent(part.model);
    std::vector<char> is_used(t.n_edges(), 0);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      expect_same_face(part.model, static_cast<FaceId>(i), whole, faces[i]);
      EXPECT_LE(distance(outward(part.model, static_cast<FaceId>(i)), outward(whole, faces[i])), 1e-12) << shape;
      for (LoopId l = t.face_loop_offsets[faces[i]]; l < t.face_loop_offsets[faces[i] + 1]; ++l)
        for (const CoedgeId c : t.loop_coedges(l)) is_used[t.coedge_edge[c]] = 1;
    }
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), 1), part.model.tables().n_edges()) << shape;
    for (EdgeId e = 0; e < part.model.tables().n_edges(); ++e) {
      EXPECT_TRUE(is_used[part.edges[e]]);
      EXPECT_EQ(part.model.tables().edge_length[e], t.edge_length[part.edges[e]]);
      for (int end = 0; end < 2; ++end)
        EXPECT_EQ(part.vertices[part.model.tables().edge_vertices[2 * e + end]],
                  t.edge_vertices[2 * part.edges[e] + end]);
    }
  }
}

TEST(Extract, refuses_faces_that_are_not_there_or_named_twice) {
  const Model box = test::make_model("box");
  EXPECT_ERROR(extract(box, std::vector<FaceId>{6}), kUsage, "face 7 is not in the model");
  EXPECT_ERROR(extract(box, std::vector<FaceId>{-1}), kUsage, "6 faces");
  EXPECT_ERROR(extract(box, std::vector<FaceId>{2, 2}), kUsage, "named twice");
  EXPECT_ERROR(extract(box, {}), kUsage, "no face");
}

TEST(Extract, of_some_faces_opens_the_shell) {
  const Model box = test::make_model("box");
  const SubModel open = extract(box, std::vector<FaceId>{1, 3, 4, 5});
  EXPECT_EQ(open.faces, (std::vector<FaceId>{1, 3, 4, 5}));
  test::expect_consistent(open.model);
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  open.model.tables().edge_faces(offsets, faces);
  int n_free = 0;
  for (EdgeId e = 0; e < open.model.tables().n_edges(); ++e) n_free += offsets[e + 1] - offsets[e] == 1;
  EXPECT_GE(n_free, 6);
  EXPECT_FALSE(open.model.tables().volume);
}

Similarity turned(double scale, bool is_mirrored) {
  const Similarity turn = rotation_about({0, 0, 1}, std::atan2(0.6, 0.8));
  return (is_mirrored ? reflection_at({0, 0, 1}).then(turn) : turn).then({.scale = scale, .translation = {10, -20, 5}});
}

TEST(Transform, moves_every_point_and_keeps_names_and_normals) {
  for (const char* shape : kShapes)
    for (const Similarity& map : {turned(1, false), turned(1, true), turned(0.001, false), turned(2.5, true)}) {
      Model before = test::make_model(shape);
      const Model after = transform(before, map);
      const ModelTables &a = after.tables(), &b = before.tables();
      const double scale = map.scale, size = scale * b.box().diagonal() + 23;
      ASSERT_EQ(a.n_faces(), b.n_faces());
      ASSERT_EQ(a.n_edges(), b.n_edges());
      test::expect_consistent(after);
      EXPECT_EQ(a.labels.face_group, b.labels.face_group);
      for (VertexId v = 0; v < b.n_vertices(); ++v)
        EXPECT_LE(distance(a.vertex_xyz[v], map(b.vertex_xyz[v])), 1e-12 * size);
      for (EdgeId e = 0; e < b.n_edges(); ++e) EXPECT_NEAR(a.edge_length[e], scale * b.edge_length[e], 1e-6 * size);
      for (FaceId f = 0; f < b.n_faces(); ++f) {
        EXPECT_EQ(a.face_type[f], b.face_type[f]);
        EXPECT_NEAR(a.face_area[f], scale * scale * b.face_area[f], 1e-6 * size * size) << shape;
        const auto s = after.surface(f);
        const Vec3 x = s->point({0.5 * (s->u_min() + s->u_max()), 0.5 * (s->v_min() + s->v_max())});
        const auto old = before.surface(f);
        const Vec3 y = map(old->point({0.5 * (old->u_min() + old->u_max()), 0.5 * (old->v_min() + old->v_max())}));
        EXPECT_LE(distance(x, y), 1e-10 * size) << shape << " face " << f;
        EXPECT_LE(distance(outward(after, f), map.rotated(outward(before, f))), 1e-9) << shape << " face " << f;
      }
    }
}

TEST(Transform, of_a_part_keeps_its_shells_and_solids) {
  const Model whole = test::make_model("two_boxes");
  const SubModel part = extract(whole, std::vector<FaceId>{6, 7, 8, 9, 10, 11});
  const Model moved = transform(part.model, turned(2, false));
  EXPECT_EQ(moved.tables().face_shell, part.model.tables().face_shell);
  EXPECT_EQ(moved.tables().face_solid, std::vector<std::int32_t>(6, 1));
  EXPECT_EQ(moved.tables().n_solids, 2);
}

TEST(TransformFaces, moves_one_body_and_keeps_every_number_and_all_of_the_other) {
  const Model before = test::make_model("two_boxes");
  const ModelTables& b = before.tables();
  std::vector<FaceId> faces;
  for (FaceId f = b.n_faces() - 1; f >= 0; --f)
    if (b.face_solid[f] == b.face_solid[0]) faces.push_back(f);
  ASSERT_EQ(faces.size(), 6u);
  for (const Similarity& motion : {turned(1, false), turned(2, true)}) {
    const SubModel result = transform_faces(before, faces, motion);
    const ModelTables& a = result.model.tables();
    test::expect_consistent(result.model);
    ASSERT_EQ(a.n_faces(), b.n_faces());
    EXPECT_EQ(a.face_solid, b.face_solid);
    EXPECT_EQ(a.face_shell, b.face_shell);
    EXPECT_EQ(a.n_solids, 2);
    EXPECT_EQ(a.labels.group_name, b.labels.group_name);
    EXPECT_TRUE(a.labels == b.labels);
    EXPECT_EQ(a.volume.has_value(), motion.scale == 1);
    std::vector<char> moves(b.n_faces(), 0);
    for (const FaceId f : faces) moves[f] = 1;
    for (FaceId f = 0; f < b.n_faces(); ++f) {
      EXPECT_EQ(result.faces[f], f);
      if (!moves[f]) {
        expect_same_face(result.model, f, before, f);
        continue;
      }
      EXPECT_NEAR(a.face_area[f], motion.scale * motion.scale * b.face_area[f], 1e-9 * b.face_area[f]);
      EXPECT_LE(distance(outward(result.model, f), motion.rotated(outward(before, f))), 1e-12);
    }
    for (EdgeId e = 0; e < b.n_edges(); ++e) EXPECT_EQ(result.edges[e], e);
    for (VertexId v = 0; v < b.n_vertices(); ++v) {
      EXPECT_EQ(result.vertices[v], v);
      const bool is_moved = a.vertex_xyz[v] != b.vertex_xyz[v];
      EXPECT_LE(distance(a.vertex_xyz[v], is_moved ? motion(b.vertex_xyz[v]) : b.vertex_xyz[v]),
                1e-12 * a.box().diagonal());
    }
  }
}

TEST(TransformFaces, refuses_to_tear_a_body) {
  const Model box = test::make_model("box");
  EXPECT_ERROR(transform_faces(box, std::vector<FaceId>{0, 1}, turned(1, false)), kGeometry, "tear");
  EXPECT_ERROR(transform_faces(box, std::vector<FaceId>{9}, turned(1, false)), kUsage, "face 10");
  EXPECT_EQ(transform_faces(box, std::vector<FaceId>{0, 1, 2, 3, 4, 5}, turned(1, false)).model.tables().n_faces(), 6);
}

TEST(Append, puts_the_second_behind_the_first) {
  const Model box = test::make_model("drilled_cylinder"), ball = test::make_model("sphere");
  const Model both = append(box, ball);
  const ModelTables &t = both.tables(), &a = box.tables(), &b = ball.tables();
  EXPECT_EQ(t.n_faces(), a.n_faces() + b.n_faces());
  EXPECT_EQ(t.n_vertices(), a.n_vertices() + b.n_vertices());
  EXPECT_EQ(t.n_solids, a.n_solids + b.n_solids);
  test::expect_consistent(both);
  for (FaceId f = 0; f < a.n_faces(); ++f) expect_same_face(both, f, box, f);
  for (FaceId f = 0; f < b.n_faces(); ++f) expect_same_face(both, a.n_faces() + f, ball, f);
  EXPECT_NE(t.face_solid.front(), t.face_solid.back());
  EXPECT_EQ(t.labels.group_name, a.labels.group_name);  // both "default"
}

TEST(Append, of_a_model_to_itself_or_to_its_image_doubles_it) {
  const Model box = test::make_model("box");
  test::expect_consistent(append(box, box));
  EXPECT_EQ(append(box, box).tables().n_edges(), 24);
  const Model pair = append(box, transform(box, reflection_at({0, 1, 0})));
  test::expect_consistent(pair);
  EXPECT_EQ(pair.tables().n_faces(), 12);
}

TEST(Append, takes_back_what_was_extracted) {
  const Model whole = test::make_model("drilled_cylinder");
  std::vector<FaceId> others(whole.tables().n_faces() - 1);
  std::iota(others.begin(), others.end(), 1);
  const SubModel first = extract(whole, std::vector<FaceId>{0}), rest = extract(whole, others);
  const Model again = append(first.model, rest.model);
  test::expect_consistent(again);
  for (FaceId f = 0; f < whole.tables().n_faces(); ++f) expect_same_face(again, f, whole, f);
}

TEST(Append, refuses_models_of_different_units) {
  ImportResult a = test::import_shape("box"), b = test::import_shape("box");
  b.tables.unit = "m";
  b.tables.unit_in_m = 1;
  const Model first(a.tables, a.brep), second(b.tables, b.brep);
  EXPECT_ERROR(append(first, second), kMismatch, "--unit");
}

/// A box whose every edge and vertex is in a group, the first three apart from the others.
Model grouped_box() {
  const Model box = test::make_model("box");
  ModelTables t = box.tables();
  t.labels.edge_groups = {{"first", "", "{}", {0, 1, 2}}, {"rest", "bc", "{}", {}}};
  for (EdgeId e = 3; e < t.n_edges(); ++e) t.labels.edge_groups[1].ids.push_back(e);
  t.labels.vertex_groups = {{"corner", "", "{}", {t.edge_vertices[0]}}};
  return Model(std::move(t), box.brep());
}

/// Names of the groups that have an edge.
std::string groups_of_edge(const ModelTables& t, EdgeId e) {
  std::string names;
  for (const EntityGroup& g : t.labels.edge_groups)
    if (std::binary_search(g.ids.begin(), g.ids.end(), e)) names += g.name;
  return names;
}

TEST(EntityGroups, follow_their_edges_and_vertices_through_every_edit) {
  const Model box = grouped_box();
  const std::vector<FaceId> faces = {3, 0};
  const SubModel part = extract(box, faces);
  for (std::size_t e = 0; e < part.edges.size(); ++e)
    EXPECT_EQ(groups_of_edge(part.model.tables(), static_cast<EdgeId>(e)), part.edges[e] < 3 ? "first" : "rest");
  for (const EntityGroup& g : part.model.tables().labels.vertex_groups)
    for (const VertexId v : g.ids) EXPECT_EQ(part.vertices[v], box.tables().edge_vertices[0]);
  Similarity shift;
  shift.translation = {1, 2, 3};
  EXPECT_EQ(transform(box, shift).tables().labels, box.tables().labels);
  const ModelTables both = append(box, part.model).tables();
  for (EdgeId e = 0; e < both.n_edges(); ++e) {
    const EdgeId original = e < box.tables().n_edges() ? e : part.edges[e - box.tables().n_edges()];
    EXPECT_EQ(groups_of_edge(both, e), original < 3 ? "first" : "rest");
  }
}

}  // namespace
}  // namespace st
