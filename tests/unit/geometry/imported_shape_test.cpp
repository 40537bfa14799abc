#include "geometry/model/imported_shape.h"

#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp.hxx>

namespace st {
namespace {

TEST(ImportedShape, has_the_box_of_its_own_shape) {
  occt::ImportedShape model;
  model.shape = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  TopExp::MapShapes(model.shape, TopAbs_FACE, model.faces);
  model.attributes.resize(6);
  EXPECT_EQ(model.box().hi, occt::rough_box(model.shape).hi);
  EXPECT_EQ(model.box().hi, occt::rough_box(model.shape).hi);
  const occt::ImportedShape copy = model;
  ASSERT_TRUE(model.replace(BRepPrimAPI_MakeBox(4, 5, 6).Shape(), [](const TopoDS_Shape& face) { return face; }));
  EXPECT_NEAR(model.box().hi.x, 4, 1e-6);
  EXPECT_NEAR(copy.box().hi.x, 1, 1e-6);
}

}  // namespace
}  // namespace st
