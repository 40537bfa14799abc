// Shares of a curve's length.
#include "features/arc_table.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(ArcTable, knows_the_length_of_every_edge_of_a_solid_with_curved_ones) {
  for (const char* shape : {"box", "cylinder", "wave", "drilled_cylinder"}) {
    const Model model = test::make_model(shape);
    const ModelTables& t = model.tables();
    for (EdgeId e = 0; e < t.n_edges(); ++e) {
      if (t.edge_is_degenerate[e]) continue;
      EXPECT_NEAR(ArcTable(*model.curve(e)).length(), t.edge_length[e], 1e-3 * t.edge_length[e]) << shape << " " << e;
    }
  }
}

TEST(ArcTable, takes_shares_and_parameters_back_and_forth) {
  const Model model = test::make_model("wave");
  const auto curve = model.curve(0);
  const ArcTable table(*curve);
  EXPECT_EQ(table.parameter_at(0), curve->t_min());
  EXPECT_EQ(table.parameter_at(1), curve->t_max());
  EXPECT_EQ(table.share_at(curve->t_min()), 0);
  EXPECT_EQ(table.share_at(curve->t_max()), 1);
  double last = curve->t_min() - 1;
  for (int i = 0; i <= 1000; ++i) {
    const double share = 0.001 * i, t = table.parameter_at(share);
    EXPECT_GT(t, last) << "monotone";
    EXPECT_NEAR(table.share_at(t), share, 1e-12);
    last = t;
  }
  EXPECT_EQ(table.parameter_at(-1), curve->t_min()) << "beyond the ends: the ends";
  EXPECT_EQ(table.parameter_at(2), curve->t_max());
}

TEST(ArcTable, cuts_a_circle_into_equal_chords) {
  const Model model = test::make_model("disc");
  const auto circle = model.curve(0);
  const ArcTable table(*circle);
  for (int i = 0; i < 8; ++i)
    EXPECT_NEAR(distance(circle->point(table.parameter_at(i / 8.0)), circle->point(table.parameter_at((i + 1) / 8.0))),
                2 * (table.length() / (2 * kPi)) * std::sin(kPi / 8), 2e-3 * table.length());
}

}  // namespace
}  // namespace st
