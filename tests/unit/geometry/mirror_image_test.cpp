// A symmetric model of which one half is the image of the other.
#include "geometry/import/mirror_image.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "geometry/model/model.h"
#include "unit/geometry/mirrored_import.h"

namespace st {
namespace {

struct MirrorCase {
  std::string shape;
  char axis;
};

class MirroredModel : public testing::TestWithParam<MirrorCase> {};

void expect_images(const ImportResult& r, double tolerance) {
  const ModelTables& t = r.tables;
  const Mirror& m = r.mirror;
  ASSERT_EQ(m.face.size(), static_cast<std::size_t>(t.n_faces()));
  ASSERT_EQ(m.edge.size(), static_cast<std::size_t>(t.n_edges()));
  ASSERT_EQ(m.vertex.size(), static_cast<std::size_t>(t.n_vertices()));
  const Model model(t, r.brep);
  for (VertexId v = 0; v < t.n_vertices(); ++v)
    EXPECT_LE(distance(t.vertex_xyz[m.vertex[v]], m.image_of(t.vertex_xyz[v])), tolerance) << "vertex " << v + 1;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const EdgeId image = m.edge[e];
    EXPECT_EQ(t.edge_is_degenerate[image], t.edge_is_degenerate[e]);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(t.edge_range[2 * image + k], t.edge_range[2 * e + k]);
      EXPECT_EQ(t.edge_vertices[2 * image + k], m.vertex[t.edge_vertices[2 * e + k]]);
    }
    for (const double s : {0.2, 0.9}) {
      const double at = t.edge_range[2 * e] + s * (t.edge_range[2 * e + 1] - t.edge_range[2 * e]);
      if (t.edge_is_degenerate[e]) continue;
      EXPECT_LE(distance(model.curve(image)->point(at), m.image_of(model.curve(e)->point(at))), tolerance);
    }
  }
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const auto own = model.surface(f), image = model.surface(m.face[f]);
    EXPECT_EQ(m.face[m.face[f]], f);
    EXPECT_EQ(t.edges_of(f).size(), t.edges_of(m.face[f]).size());
    EXPECT_NEAR(t.face_area[f], t.face_area[m.face[f]], 1e-9 * t.face_area[f]);
    for (const double s : {0.3, 0.6}) {
      const Vec2 uv{own->u_min() + s * (own->u_max() - own->u_min()),
                    own->v_min() + (1 - s) * (own->v_max() - own->v_min())};
      EXPECT_LE(distance(image->point(uv), m.image_of(own->point(uv))), tolerance) << "face " << f + 1;
    }
  }
}

TEST_P(MirroredModel, has_its_area_and_volume_and_each_entity_has_an_image_of_the_same_parameters) {
  const auto& [shape, axis] = GetParam();
  const ImportResult before = test::import_shape(shape);
  const ImportResult after = test::import_mirrored(shape, test::middle_plane(shape, axis));
  const double size = before.tables.box().diagonal();
  EXPECT_NEAR(after.area, before.area, 2e-5 * before.area);
  EXPECT_EQ(after.is_closed, before.is_closed);
  EXPECT_NEAR(after.volume, before.volume, 5e-5 * std::abs(before.volume));
  EXPECT_EQ(after.edge_uses.n_free == 0, before.edge_uses.n_free == 0);
  EXPECT_EQ(after.tables.n_solids, before.tables.n_solids);
  expect_images(after, 1e-9 * size);
}

INSTANTIATE_TEST_SUITE_P(Shapes, MirroredModel,
                         testing::Values(MirrorCase{"box", 'y'}, MirrorCase{"sphere", 'x'}, MirrorCase{"sphere", 'y'},
                                         MirrorCase{"sphere", 'z'}, MirrorCase{"cylinder", 'x'},
                                         MirrorCase{"cylinder", 'y'}, MirrorCase{"cylinder", 'z'},
                                         MirrorCase{"cone", 'x'}, MirrorCase{"cone", 'y'}, MirrorCase{"torus", 'x'},
                                         MirrorCase{"torus", 'y'}, MirrorCase{"torus", 'z'}, MirrorCase{"lens", 'z'},
                                         MirrorCase{"drilled_cylinder", 'y'}, MirrorCase{"blunt_wing", 'y'},
                                         MirrorCase{"sharp_wing", 'y'}, MirrorCase{"thin_pipe", 'x'},
                                         MirrorCase{"disc", 'y'}, MirrorCase{"plate_with_hole", 'y'},
                                         MirrorCase{"loose_box", 'y'}, MirrorCase{"rational_torus", 'x'},
                                         MirrorCase{"two_boxes", 'x'}),
                         [](const auto& i) { return i.param.shape + "_" + i.param.axis; });

TEST(MirrorImage, numbers_stay_where_no_face_is_divided_and_faces_keep_theirs_in_the_file) {
  const ImportResult r = test::import_mirrored("two_boxes", test::middle_plane("two_boxes", 'x'));
  for (FaceId f = 0; f < r.tables.n_faces(); ++f) EXPECT_EQ(r.file_faces[f], f);
}

TEST(MirrorImage, parts_of_a_divided_face_keep_its_number_in_the_file) {
  const ImportResult before = test::import_shape("box"),
                     r = test::import_mirrored("box", test::middle_plane("box", 'y'));
  std::vector<double> area(before.tables.n_faces());
  for (FaceId f = 0; f < r.tables.n_faces(); ++f) area[r.file_faces[f]] += r.tables.face_area[f];
  for (FaceId f = 0; f < before.tables.n_faces(); ++f) EXPECT_NEAR(area[f], before.tables.face_area[f], 1e-9);
}

std::string refusal(const std::string& shape, const std::string& plane) {
  try {
    test::import_mirrored(shape, plane);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kGeometry);
    return e.what();
  }
  return "";
}

TEST(MirrorImage, a_model_that_is_not_symmetric_is_refused_with_faces_and_places) {
  const std::string said = refusal("sphere_octant", "x=3");
  EXPECT_NE(said.find("not symmetric about x = 3"), std::string::npos) << said;
  EXPECT_NE(said.find("no image: face "), std::string::npos) << said;
  EXPECT_NE(said.find("off by "), std::string::npos) << said;
  EXPECT_NE(refusal("stepped_box", test::middle_plane("stepped_box", 'x')).find("not symmetric"), std::string::npos);
}

TEST(MirrorImage, a_model_on_one_side_of_the_plane_is_refused) {
  EXPECT_NE(refusal("box", "y=1000").find("on one side of the plane only"), std::string::npos);
}

}  // namespace
}  // namespace st
