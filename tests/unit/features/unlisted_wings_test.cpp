// Wings without an edge that could be their trailing edge.
#include "features/unlisted_wings.h"

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

std::vector<EdgeId> sheet_edges_of(const std::string& shape) {
  const Model model = test::make_model(shape);
  return find_sheet_edges(model, face_roles(model.tables()));
}

TEST(UnlistedWings, end_at_the_border_of_a_sheet) {
  EXPECT_EQ(sheet_edges_of("wave").size(), 4u);
  EXPECT_EQ(sheet_edges_of("square").size(), 4u);
}

TEST(UnlistedWings, do_not_end_where_a_body_is_open) {
  EXPECT_TRUE(sheet_edges_of("cone_side").empty());
  EXPECT_TRUE(sheet_edges_of("box").empty());
}

TEST(UnlistedWings, do_not_end_where_faces_of_a_body_were_not_sewn) {
  const ImportResult r = test::import_broken("gappy_box");
  const Model model(r.tables, r.brep);
  EXPECT_TRUE(find_sheet_edges(model, face_roles(model.tables())).empty());
}

TEST(UnlistedWings, have_seams_but_bodies_of_revolution_and_pipes_do_not) {
  for (const char* shape : {"cylinder", "torus", "thin_pipe", "cone", "periodic_tube", "closed_tube"}) {
    const Model model = test::make_model(shape);
    EXPECT_TRUE(find_seams_of_blades(model, face_roles(model.tables()), {}).empty()) << shape;
  }
}

}  // namespace
}  // namespace st
