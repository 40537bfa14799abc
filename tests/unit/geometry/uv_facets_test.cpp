#include "geometry/model/uv_facets.h"

#include <gtest/gtest.h>

#include "geometry/shape/member_map.h"
#include "support/shapes.h"

namespace st {
namespace {

UvFacets uv_facets_of(const Model& model) {
  const ModelTables& t = model.tables();
  return make_uv_facets(model, std::vector<std::uint8_t>(static_cast<std::size_t>(t.n_faces()), 1),
                        {.deflection = 1e-3 * t.reference_diagonal(), .angle = radians(12), .is_exact = true});
}

TEST(UvFacets, have_corners_at_their_places_and_face_outward) {
  for (const char* shape : {"box", "drilled_cylinder", "mirrored_cylinder", "torus", "wing_of_8", "melon", "cone"}) {
    SCOPED_TRACE(shape);
    const Model model = test::make_model(shape);
    const ModelTables& t = model.tables();
    const UvFacets facets = uv_facets_of(model);
    double volume = 0;
    for (std::size_t i = 0; i < facets.corners.size(); ++i) {
      const FaceId f = facets.face[i];
      const auto surface = model.surface(f);
      const Corners& c = facets.corners[i];
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LE(distance(surface->point(facets.uv[i][k]), facets.x[c[k]]), 1e-6 * t.box().diagonal());
      volume += dot(facets.x[c[0]], cross(facets.x[c[1]], facets.x[c[2]])) / 6;
    }
    EXPECT_NEAR(volume, t.volume.value_or(0), 0.02 * volume);
    for (FaceId f = 0; f < t.n_faces(); ++f) EXPECT_GT(facets.face_offsets[f + 1], facets.face_offsets[f]);
  }
}

TEST(UvFacets, know_their_neighbours_and_the_sides_along_edges) {
  for (const char* shape : {"box", "drilled_cylinder", "torus", "melon", "cone", "sphere"}) {
    SCOPED_TRACE(shape);
    const Model model = test::make_model(shape);
    const UvFacets facets = uv_facets_of(model);
    std::size_t n_free = 0, n_rim = 0;
    for (std::size_t s = 0; s < facets.mate.size(); ++s) {
      const std::int32_t m = facets.mate[s];
      if (m == kNone)
        ++n_free;
      else
        EXPECT_EQ(facets.mate[static_cast<std::size_t>(m)], static_cast<std::int32_t>(s));
    }
    for (std::size_t c = 0; c < facets.rim_side.size(); ++c) {
      n_rim += facets.rim_side[c].size();
      if (!facets.rim_side[c].empty()) {
        EXPECT_EQ(facets.rim_t[c].size(), facets.rim_side[c].size() + 1);
      }
    }
    EXPECT_EQ(n_free, n_rim);
  }
}

TEST(UvFacets, have_their_rims_on_the_trimming_curves_at_seams_too) {
  for (const char* shape : {"cone_on_cylinder", "drilled_cylinder", "mirrored_cylinder", "torus", "thin_pipe"}) {
    SCOPED_TRACE(shape);
    const Model model = test::make_model(shape);
    const ModelTables& t = model.tables();
    const UvFacets facets = uv_facets_of(model);
    for (FaceId f = 0; f < t.n_faces(); ++f)
      for (const CoedgeId c : t.coedges(f)) {
        const auto pcurve = model.pcurve(f, c);
        for (std::size_t i = 0; i < facets.rim_side[c].size(); ++i) {
          const std::int32_t s = facets.rim_side[c][i];
          const auto& uv = facets.uv[static_cast<std::size_t>(s / 3)];
          const Vec2 a = uv[s % 3], b = uv[(s + 1) % 3], p = pcurve->point(facets.rim_t[c][i]),
                     q = pcurve->point(facets.rim_t[c][i + 1]);
          EXPECT_LE(std::min(norm(a - p) + norm(b - q), norm(a - q) + norm(b - p)), 1e-6) << f + 1 << " " << c;
        }
      }
  }
}

TEST(UvFacets, have_one_node_at_a_pole) {
  const Model model = test::make_model("melon");
  const UvFacets facets = uv_facets_of(model);
  EXPECT_GE(std::ranges::count_if(facets.pole, [](std::int32_t pole) { return pole != kNone; }), 6);
  for (std::size_t i = 0; i < facets.corners.size(); ++i) {
    const Corners& c = facets.corners[i];
    EXPECT_GT(norm(cross(facets.x[c[1]] - facets.x[c[0]], facets.x[c[2]] - facets.x[c[0]])), 1e-6);
    if (facets.pole[i] == kNone) continue;
    EXPECT_LE(distance(facets.x[c[PoleCorner::of_code(facets.pole[i]).corner]], {0, 0, 10}), 1e-6);
  }
}

TEST(UvFacets, fill_a_face_between_two_poles_from_edge_to_edge) {
  const Model model = test::make_model("tip_of_2");
  const UvFacets facets = uv_facets_of(model);
  double area = 0;
  for (const Corners& c : facets.corners)
    area += 0.5 * cross(facets.x[c[1]] - facets.x[c[0]], facets.x[c[2]] - facets.x[c[0]]).z;
  const double all = model.tables().face_area[0] + model.tables().face_area[1];
  EXPECT_NEAR(std::abs(area), all, 0.02 * all);  // both seen from the same side
  EXPECT_EQ(std::ranges::count_if(facets.pole, [](std::int32_t pole) { return pole != kNone; }), 4);
}

TEST(UvFacets, are_made_of_wanted_faces_alone) {
  const Model model = test::make_model("box");
  const UvFacets facets = make_uv_facets(model, {0, 1, 0, 0, 1, 0}, {.deflection = 1});
  for (const FaceId f : facets.face) EXPECT_TRUE(f == 1 || f == 4);
  EXPECT_EQ(facets.corners.size(), 4u);
}

TEST(UvFacets, are_exact_on_faces_that_coarse_ones_turn_away_from) {
  const Model model = test::make_model("wing_of_2");
  const ModelTables& t = model.tables();
  const auto facets = [&](double angle, bool is_exact) {
    return make_uv_facets(model, std::vector<std::uint8_t>(static_cast<std::size_t>(t.n_faces()), 1),
                          {.deflection = t.reference_diagonal(), .angle = radians(angle), .is_exact = is_exact});
  };
  EXPECT_NE(facets(30, false).corners, facets(30, true).corners);
  const UvFacets coarse = facets(170, false), exact = facets(170, true);  // edges alone cut the nose off
  EXPECT_EQ(coarse.corners, exact.corners);
  EXPECT_TRUE(coarse.turned.empty());
}

}  // namespace
}  // namespace st
