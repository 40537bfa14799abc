// Noses on the rims of plates and holes.
#include "features/rim_edges.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

/// The rim of a cylinder's end, as a hole before a trailing edge has it.
struct Rim {
  Model model = test::make_model("cylinder");
  EdgeId edge = kNone;
  FaceId face = kNone;
  std::unique_ptr<Curve> curve;

  Rim() {
    const ModelTables& t = model.tables();
    for (EdgeId e = 0; e < t.n_edges() && edge == kNone; ++e)
      if (t.edge_vertices[2 * e] == t.edge_vertices[2 * e + 1]) edge = e;
    for (FaceId f = 0; f < t.n_faces(); ++f)
      for (const EdgeId e : t.edges_of(f))
        if (e == edge) face = f;
    curve = model.curve(edge);
  }
  double parameter(double share) const { return curve->t_min() + share * (curve->t_max() - curve->t_min()); }
  ChordStation nose(double share, double chord = 1) const {
    return {
        .trailing = {}, .chord = chord, .is_measured = true, .nose = curve->point(parameter(share)), .nose_face = face};
  }
};

TEST(RimEdges, are_followed_between_noses_on_them) {
  const Rim rim;
  const auto piece = RimEdges(rim.model).between(rim.nose(0.6), rim.nose(0.4));
  ASSERT_TRUE(piece);
  EXPECT_NEAR(piece->length(), 0.2 * arc_length(*rim.curve, rim.curve->t_min(), rim.curve->t_max()), 0.01);
  EXPECT_LT(distance(piece->at(0), rim.nose(0.6).nose), 1e-6);
  EXPECT_LT(distance(piece->at(0.5), rim.nose(0.5).nose), 1e-6);
  EXPECT_LT(distance(piece->at(1), rim.nose(0.4).nose), 1e-6);
}

TEST(RimEdges, are_not_followed_far_around_or_where_a_nose_is_off_them) {
  const Rim rim;
  EXPECT_FALSE(RimEdges(rim.model).between(rim.nose(0.1), rim.nose(0.9)));
  ChordStation beside = rim.nose(0.4);
  beside.nose += Vec3{0, 0, 0.001};
  EXPECT_TRUE(RimEdges(rim.model).between(rim.nose(0.6), beside));
  beside.nose += Vec3{0, 0, 0.005};
  EXPECT_FALSE(RimEdges(rim.model).between(rim.nose(0.6), beside));
}

}  // namespace
}  // namespace st
