// Lines inside a face along which its normal jumps.
#include "geometry/import/surface_kinks.h"

#include <gtest/gtest.h>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include "broken/kinked_shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// Kinks of all faces: numbers of lines of constant u and of constant v.
std::pair<std::size_t, std::size_t> kinks_of(const std::string& name) {
  const TemporaryDirectory dir;
  test::write_kinked(name, dir / "model.brep");
  TopoDS_Shape shape;
  BRep_Builder builder;
  EXPECT_TRUE(BRepTools::Read(shape, (dir / "model.brep").c_str(), builder));
  std::pair<std::size_t, std::size_t> found{0, 0};
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next())
    if (const auto kinks = occt::find_kinks(TopoDS::Face(f.Current().Oriented(TopAbs_FORWARD))))
      found.first += kinks->u.size(), found.second += kinks->v.size();
  return found;
}

using Numbers = std::pair<std::size_t, std::size_t>;

TEST(SurfaceKinks, are_found_where_the_normal_turns) {
  EXPECT_EQ(kinks_of("kink_prism"), Numbers(2, 0));
  EXPECT_EQ(kinks_of("kink_cubic"), Numbers(2, 0));
  EXPECT_EQ(kinks_of("kink_tube"), Numbers(4, 0));
  EXPECT_EQ(kinks_of("kink_turned"), Numbers(0, 1));
  for (const char* name : {"kink_ridge", "kink_hole", "kink_trimmed", "kink_notch"})
    EXPECT_EQ(kinks_of(name), Numbers(1, 1)) << name;
}

TEST(SurfaceKinks, are_not_at_knots_where_it_is_smooth_nor_beside_the_face) {
  for (const char* name : {"no_kink_flat", "no_kink_smooth", "no_kink_side"})
    EXPECT_EQ(kinks_of(name), Numbers(0, 0)) << name;
}

}  // namespace
}  // namespace st
