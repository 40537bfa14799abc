#include "geometry/import/original_order.h"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <vector>

#include "geometry/brep/compound.h"

namespace st::occt {
namespace {

TopTools_IndexedMapOfShape faces_in(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  return faces;
}

/// These faces as a closed shell, in this order.
TopoDS_Shape shell_from(const std::vector<TopoDS_Shape>& faces) {
  TopoDS_Shell shell;
  BRep_Builder().MakeShell(shell);
  for (const TopoDS_Shape& face : faces) BRep_Builder().Add(shell, face);
  shell.Closed(true);
  return shell;
}

TEST(OriginalOrder, is_that_of_faces_in_shells_of_shells_and_of_loose_faces) {
  const auto first = faces_in(BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  const auto second = faces_in(BRepPrimAPI_MakeBox(2, 2, 2).Shape());
  const TopoDS_Shape later = shell_from({second(4), second(2), second(3)});
  const TopoDS_Shape earlier = shell_from({first(3), first(1), first(2)});
  const TopoDS_Shape sewn = compound_of(std::vector<TopoDS_Shape>{second(1), later, earlier});
  const std::vector<TopoDS_Shape> images = {first(1), second(1), first(2), second(2), first(3), second(3), second(4)};
  const TopoDS_Shape ordered = in_original_order(sewn, images);
  const auto faces = faces_in(ordered);
  ASSERT_EQ(faces.Extent(), 7);
  const std::vector<TopoDS_Shape> expected = {first(1), first(2), first(3), second(1), second(2), second(3), second(4)};
  for (int i = 1; i <= 7; ++i) EXPECT_TRUE(faces(i).IsSame(expected[i - 1])) << i;
  int n_shells = 0;
  for (TopExp_Explorer e(ordered, TopAbs_SHELL); e.More(); e.Next(), ++n_shells) EXPECT_TRUE(e.Current().Closed());
  EXPECT_EQ(n_shells, 2);
}

}  // namespace
}  // namespace st::occt
