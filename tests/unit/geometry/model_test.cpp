#include "geometry/model/model.h"
#include "geometry/import/import.h"

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(Model, refuses_bytes_that_are_no_brep) {
  ImportResult r = test::import_shape("box");
  EXPECT_ERROR(Model(r.tables, std::vector<std::byte>()), kInput, "st-import");
  EXPECT_ERROR(Model(r.tables, std::vector<std::byte>(1000, std::byte{'x'})), kInput, "st-import");
  r.brep.resize(r.brep.size() / 2);
  EXPECT_ERROR(Model(r.tables, r.brep), kInput, "st-import");
}

TEST(Model, refuses_the_brep_of_another_model) {
  EXPECT_ERROR(Model(test::import_shape("box").tables, test::import_shape("cylinder").brep), kInput,
               "contradicts its tables");
}

TEST(Model, evaluators_have_the_bounds_of_the_tables) {
  const Model model = test::make_model("drilled_cylinder");
  const ModelTables& t = model.tables();
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const auto s = model.surface(f);
    EXPECT_EQ(s->u_min(), t.face_uv_bounds[4 * f]);
    EXPECT_EQ(s->v_max(), t.face_uv_bounds[4 * f + 3]);
    EXPECT_EQ(s->type(), t.face_type[f]);
  }
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    EXPECT_EQ(model.curve(e)->t_min(), t.edge_range[2 * e]);
    EXPECT_EQ(model.curve(e)->t_max(), t.edge_range[2 * e + 1]);
  }
}

TEST(Model, has_the_kinds_of_its_surfaces) {
  const std::pair<const char*, SurfaceType> kinds[] = {
      {"square", SurfaceType::kPlane},        {"thin_tube", SurfaceType::kCylinder},
      {"cone_side", SurfaceType::kCone},      {"sphere", SurfaceType::kSphere},
      {"torus", SurfaceType::kTorus},         {"bezier", SurfaceType::kBezier},
      {"wave", SurfaceType::kBspline},        {"revolution", SurfaceType::kRevolution},
      {"extrusion", SurfaceType::kExtrusion}, {"offset", SurfaceType::kOffset}};
  for (const auto& [shape, kind] : kinds) EXPECT_EQ(test::import_shape(shape).tables.face_type[0], kind) << shape;
}

TEST(Model, trimming_curves_of_a_seam_lie_apart) {
  const Model model = test::make_model("torus");
  const ModelTables& t = model.tables();
  ASSERT_EQ(t.n_coedges(), 4);
  for (CoedgeId a = 0; a < 4; ++a)
    for (CoedgeId b = a + 1; b < 4; ++b) {
      if (t.coedge_edge[a] != t.coedge_edge[b]) continue;
      EXPECT_NE(t.coedge_is_reversed[a], t.coedge_is_reversed[b]);
      const Vec2 p = model.pcurve(0, a)->point(1), q = model.pcurve(0, b)->point(1);
      EXPECT_NEAR(norm(p - q), 2 * kPi, 1e-9);
    }
}

TEST(ModelTables, label_entities_by_number_and_name) {
  ModelTables t = test::import_shape("box").tables;
  t.labels.face_name[2] = "WING";
  t.edge_name[4] = "TE";
  EXPECT_EQ(t.face_label(2), "face 3 \"WING\"");
  EXPECT_EQ(t.face_label(0), "face 1");
  EXPECT_EQ(t.edge_label(4), "edge 5 \"TE\"");
}

TEST(ModelTables, know_the_faces_of_each_edge) {
  const ModelTables t = test::import_shape("box").tables;
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    ASSERT_EQ(offsets[e + 1] - offsets[e], 2);
    EXPECT_LT(faces[offsets[e]], faces[offsets[e] + 1]);
  }
}

TEST(ModelTables, without_walls_the_reference_is_the_whole_box) {
  ModelTables t = test::import_shape("box").tables;
  t.labels.group_role.assign(t.labels.group_role.size(), "farfield");
  EXPECT_NEAR(t.reference_diagonal(), t.box().diagonal(), 1e-12);
}

}  // namespace
}  // namespace st
