#include "features/cut_strips.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "features/smooth_edges.h"
#include "geometry/facet/facet_cuts.h"
#include "geometry/facet/facet_faces.h"
#include "geometry/facet/facet_model.h"
#include "support/shapes.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

constexpr double kRadius = 5, kWidth = 0.2, kTurns = 1.6, kPitch = 3;

/// Both flanks and the narrow crest of a thread without ends. Flanks are cut half way along, the crest is not.
Model thread() {
  constexpr int n = 160;
  FacetInput input = test::grid_facets(n, 3, [](int i, int j) {
    const std::array<Vec2, 4> profile{{{3, -0.5}, {kRadius, -0.5 * kWidth}, {kRadius, 0.5 * kWidth}, {3, 0.5}}};
    const double angle = 2 * kPi * kTurns * i / n;
    return Vec3{profile[j].x * std::cos(angle), profile[j].x * std::sin(angle),
                kPitch * angle / (2 * kPi) + profile[j].y};
  });
  input.part_name = {"", "other"};
  for (std::size_t t = input.part.size() / 2; t < input.part.size(); ++t) input.part[t] = t % 6 / 2 != 1;
  FacetMesh mesh = find_smooth_faces(input, radians(40));
  cut_into_charts(mesh);
  FacetModel made = make_facet_model(mesh, input.part_name, radians(40));
  return {std::move(made.tables), std::move(made.shape)};
}

TEST(CutStrips, go_on_where_cuts_between_charts_end) {
  const Model model = thread();
  const std::vector<Strip> strips = find_cut_strips(model, find_smooth_edges(model));
  ASSERT_EQ(strips.size(), 1u);
  EXPECT_NEAR(strips[0].length, kTurns * std::hypot(2 * kPi * kRadius, kPitch), 0.1);
  for (const Strip::Station& s : strips[0].stations) EXPECT_NEAR(s.width(), kWidth, 0.01);
  EXPECT_TRUE(find_strips(model).empty());
}

TEST(CutStrips, end_where_no_smooth_edge_does) {
  const Model model = thread();
  EXPECT_TRUE(find_cut_strips(model, std::vector<std::uint8_t>(model.tables().n_edges(), 0)).empty());
}

TEST(CutStrips, are_none_of_cad) {
  const Model model = test::make_model("banded_pie");
  EXPECT_TRUE(find_cut_strips(model, find_smooth_edges(model)).empty());
}

}  // namespace
}  // namespace st
