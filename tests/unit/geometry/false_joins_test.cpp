// Edges that no correct sewing leaves.
#include "geometry/import/false_joins.h"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pln.hxx>

#include "unit/geometry/bare_models.h"

namespace st {
namespace {

constexpr double kLimit = 0.1;

/// Two triangles with the same three edges, the third one of which is the shortest.
class Pillow {
 public:
  Pillow() {
    const TopoDS_Vertex a = vertex(0, 0), b = vertex(10, 0), c = vertex(0, 3);
    edges_ = {BRepBuilderAPI_MakeEdge(a, b).Edge(), BRepBuilderAPI_MakeEdge(b, c).Edge(),
              BRepBuilderAPI_MakeEdge(c, a).Edge()};
  }

  TopoDS_Edge edge(int i) const { return edges_[i]; }
  /// In the plane at z; `is_reversed`: of each edge.
  TopoDS_Face face(double z, std::vector<bool> is_reversed) const {
    BRep_Builder builder;
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (int i = 0; i < 3; ++i)
      builder.Add(wire, edges_[i].Oriented(is_reversed[i] ? TopAbs_REVERSED : TopAbs_FORWARD));
    TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1))).Face();
    builder.Add(face, wire);
    return face;
  }

 private:
  static TopoDS_Vertex vertex(double x, double y) { return BRepBuilderAPI_MakeVertex(gp_Pnt(x, y, 0)).Vertex(); }

  std::vector<TopoDS_Edge> edges_;
};

TEST(FalseJoins, are_not_where_both_faces_can_agree) {
  const Pillow p;
  const TopoDS_Face front = p.face(0, {false, false, false}), back = p.face(0, {true, true, true});
  EXPECT_TRUE(occt::find_false_joins(occt::compound_of({front, back}), kLimit).empty());
  EXPECT_TRUE(occt::find_false_joins(occt::compound_of({front, TopoDS::Face(back.Reversed())}), kLimit).empty());
}

TEST(FalseJoins, of_a_twisted_body_are_at_its_shortest_edge) {
  const Pillow p;
  const TopoDS_Face front = p.face(0, {false, false, false}), back = p.face(0, {true, true, false});
  const auto found = occt::find_false_joins(occt::compound_of({front, back}), kLimit);
  ASSERT_EQ(found.size(), 2u);
  for (const occt::FalseJoin& join : found) {
    EXPECT_TRUE(join.edge.IsSame(p.edge(2)));
    EXPECT_EQ(join.distance, 0);
  }
  EXPECT_TRUE(found[0].face.IsSame(front));
  EXPECT_TRUE(found[1].face.IsSame(back));
}

TEST(FalseJoins, are_not_in_an_open_sheet_with_one_side) {
  const Pillow p, other;
  BRep_Builder builder;
  TopoDS_Face back = p.face(0, {true, true, false});
  TopoDS_Wire hole;
  builder.MakeWire(hole);
  builder.Add(hole, other.edge(0));
  builder.Add(back, hole);
  EXPECT_TRUE(occt::find_false_joins(occt::compound_of({p.face(0, {false, false, false}), back}), kLimit).empty());
}

TEST(FalseJoins, are_edges_further_from_a_face_than_the_limit) {
  const Pillow p;
  const TopoDS_Face front = p.face(0, {false, false, false}), far = p.face(5, {true, true, true});
  const TopoDS_Shape both = occt::compound_of({front, far});
  EXPECT_TRUE(occt::find_false_joins(both, kLimit).empty());  // their tolerance says that they are near
  BRep_Builder().UpdateEdge(p.edge(1), 6);
  const auto found = occt::find_false_joins(both, kLimit);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].edge.IsSame(p.edge(1)));
  EXPECT_TRUE(found[0].face.IsSame(far));
  EXPECT_NEAR(found[0].distance, 5, 1e-9);
  EXPECT_TRUE(occt::find_false_joins(both, 5.5).empty());
}

}  // namespace
}  // namespace st
