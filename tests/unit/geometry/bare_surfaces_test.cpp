// Whole spline surfaces are divided where they have kinks, or run back along themselves.
#include "geometry/import/bare_surfaces.h"

#include <gtest/gtest.h>

#include "unit/geometry/bare_models.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_faces;
using test::Points;
using test::spline_face;

/// Around a flat bar 10 wide, 2 high, at x.
Points around(double x) {
  return {gp_Pnt(x, 0, 0), gp_Pnt(x, 5, -1), gp_Pnt(x, 10, 0), gp_Pnt(x, 5, 1), gp_Pnt(x, 0, 0)};
}

/// The middle of such a bar, there and back.
Points middle(double x) {
  return {gp_Pnt(x, 0, 0), gp_Pnt(x, 5, 0), gp_Pnt(x, 10, 0), gp_Pnt(x, 5, 0), gp_Pnt(x, 0, 0)};
}

TEST(BareSurfaces, of_a_body_with_its_caps_close) {
  const ImportResult r = import_faces({spline_face({middle(0), around(0), around(30), middle(30)})});
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.volume, 300, 1e-6);
  EXPECT_NEAR(r.area, 4 * 30 * std::sqrt(26.0) + 20, 1e-6);
  const auto found = findings_of(r, "surface divided at its kinks");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_repair);
}

TEST(BareSurfaces, with_a_kink_alone_are_divided_where_it_is_sharp) {
  const auto bent_by = [](double z) {
    return import_faces({test::polygon({gp_Pnt(0, 0, 0), gp_Pnt(0, 5, 0), gp_Pnt(-5, 0, 0)}),
                         spline_face({{gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(20, 0, z)},
                                      {gp_Pnt(0, 5, 0), gp_Pnt(10, 5, 0), gp_Pnt(20, 5, z)}})});
  };
  EXPECT_EQ(bent_by(0.5).tables.n_faces(), 2);
  EXPECT_EQ(bent_by(10).tables.n_faces(), 3);
}

}  // namespace
}  // namespace st
