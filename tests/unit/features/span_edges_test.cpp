// Edges along thin bodies.
#include "features/span_edges.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

std::vector<EdgeWithChord> span_edges_of(const Model& model, std::span<const LiftingSurface> wings = {}) {
  return find_span_edges(model, face_roles(model.tables()), wings);
}

TEST(SpanEdges, are_seams_along_thin_bodies) {
  for (const char* shape : {"closed_wing", "oval_bar"}) {
    const Model model = test::make_model(shape);
    const std::vector<EdgeWithChord> found = span_edges_of(model);
    ASSERT_EQ(found.size(), 1u) << shape;
    EXPECT_NEAR(model.tables().edge_length[found[0].edge], 30, 1e-6);
    EXPECT_NEAR(found[0].chord, 10, 1) << "by samples";
  }
}

TEST(SpanEdges, are_none_of_known_wings) {
  const Model model = test::make_model("closed_wing");
  LiftingSurface wing;
  for (FaceId f = 0; f < model.tables().n_faces(); ++f) wing.faces.push_back(f);
  EXPECT_TRUE(span_edges_of(model, {&wing, 1}).empty());
}

TEST(SpanEdges, are_none_of_tubes_sheets_and_analytic_faces) {
  for (const char* shape : {"closed_tube", "periodic_tube", "cylinder", "wave", "torus"})
    EXPECT_TRUE(span_edges_of(test::make_model(shape)).empty()) << shape;
}

}  // namespace
}  // namespace st
