// Faces with a kink inside become several.
#include "geometry/import/kinked_faces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "broken/kinked_shapes.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;

ImportResult import_kinked(const std::string& name) {
  const TemporaryDirectory dir;
  test::write_kinked(name, dir / "model.brep");
  return import_model(dir / "model.brep", {});
}

constexpr const char* kDividedAtKinks = "surface divided at its kinks";

TEST(KinkedFaces, of_closed_bodies_are_divided_with_their_neighbours) {
  struct Body {
    const char* name;
    int n_faces, n_edges;
    double area, volume;
  };
  const double cones = 2 * kPi * 4 * std::sqrt(8.0);
  for (const Body& b :
       {Body{"kink_prism", 6, 12, 52, 24}, Body{"kink_cubic", 6, 12, 52, 24}, Body{"kink_twice", 12, 24, 104, 48},
        Body{"kink_tube", 7, 15, 64, 32}, Body{"kink_turned", 4, 5, cones + 2 * kPi, 52 * kPi / 3}}) {
    const ImportResult r = import_kinked(b.name);
    EXPECT_TRUE(r.is_closed) << b.name;
    EXPECT_EQ(r.tables.n_faces(), b.n_faces) << b.name;
    EXPECT_EQ(r.tables.n_edges(), b.n_edges) << b.name;
    EXPECT_NEAR(r.area, b.area, 1e-4 * b.area) << b.name;
    EXPECT_NEAR(r.volume, b.volume, 1e-4 * b.volume) << b.name;
    EXPECT_FALSE(findings_of(r, kDividedAtKinks).empty()) << b.name;
  }
}

TEST(KinkedFaces, with_holes_trims_and_edges_on_a_kink_keep_their_area) {
  const double steep = std::sqrt(1.5);
  struct Sheet {
    const char* name;
    int n_faces;
    double area;
  };
  for (const Sheet& s : {Sheet{"kink_ridge", 4, 16 * steep}, Sheet{"kink_hole", 4, (16 - kPi) * steep},
                         Sheet{"kink_trimmed", 4, 10.5 * steep}, Sheet{"kink_notch", 4, 13 * steep}}) {
    const ImportResult r = import_kinked(s.name);
    EXPECT_EQ(r.tables.n_faces(), s.n_faces) << s.name;
    EXPECT_NEAR(r.area, s.area, 1e-4 * s.area) << s.name;
    ASSERT_EQ(findings_of(r, kDividedAtKinks).size(), 1u) << s.name;
    EXPECT_EQ(findings_of(r, kDividedAtKinks)[0].what(), kDividedAtKinks + std::string(": 4 faces: 1, 2, 3, 4"))
        << s.name;
    EXPECT_TRUE(findings_of(r, "loop crosses").empty()) << s.name;
  }
}

TEST(KinkedFaces, that_only_seem_to_be_stay_as_they_are) {
  for (const char* name : {"no_kink_flat", "no_kink_smooth", "no_kink_side"})
    EXPECT_TRUE(findings_of(import_kinked(name), kDividedAtKinks).empty()) << name;
  for (const char* name : {"rational_torus", "periodic_tube", "closed_tube"})
    EXPECT_TRUE(findings_of(test::import_shape(name), kDividedAtKinks).empty()) << name;
}

}  // namespace
}  // namespace st
