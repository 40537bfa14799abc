// Boolean operations that fail, crash or hang end with a cause.
#include "geometry/import/boolean_child.h"

#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeBox.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Iterator.hxx>

#include <cstdlib>

#include "geometry/brep/compound.h"

namespace st::occt {
namespace {

TEST(BooleanChild, gives_a_shape_back_whose_images_are_still_in_it) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  const auto work = [&] {
    const TopoDS_Shape face = TopExp_Explorer(box, TopAbs_FACE).Current();
    return BooleanResult{box, {compound_of(std::vector<TopoDS_Shape>{face}), compound_of(std::vector<TopoDS_Shape>{})}};
  };
  const BooleanAttempt done = run_boolean(work, 10);
  EXPECT_EQ(done.failure, "");
  ASSERT_EQ(done.result.shape.ShapeType(), TopAbs_SOLID);
  ASSERT_EQ(done.result.images.size(), 2u);
  const TopoDS_Shape image = TopoDS_Iterator(done.result.images[0]).Value();
  EXPECT_TRUE(image.IsSame(TopExp_Explorer(done.result.shape, TopAbs_FACE).Current()));
  EXPECT_FALSE(TopoDS_Iterator(done.result.images[1]).More());
}

TEST(BooleanChild, names_a_failure_a_crash_and_a_hang) {
  const auto cause = [](const std::function<BooleanResult()>& work) { return run_boolean(work, 0.2).failure; };
  EXPECT_NE(cause([]() -> BooleanResult { throw Standard_Failure("no"); }), "");
  EXPECT_NE(cause([] { return BooleanResult(); }), "");
  EXPECT_NE(cause([]() -> BooleanResult { std::abort(); }), "");
  EXPECT_EQ(cause([]() -> BooleanResult {
              for (;;) BRepPrimAPI_MakeBox(1, 1, 1).Shape();
            }),
            "OpenCASCADE needs more than 0.2 s");
}

}  // namespace
}  // namespace st::occt
