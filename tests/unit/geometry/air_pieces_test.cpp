// What hangs together in a model, and which planes are its hull.
#include "geometry/import/air_pieces.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <gp_Pln.hxx>

#include <numeric>

#include "geometry/brep/compound.h"
#include "geometry/model/model_tables.h"

namespace st::occt {
namespace {

TopoDS_Shape box(double x, double size) { return BRepPrimAPI_MakeBox(gp_Pnt(x, 0, 0), size, size, size).Shape(); }

/// A model and what is known of it.
struct Pieces {
  explicit Pieces(const TopoDS_Shape& s) {
    shape.shape = s;
    TopExp::MapShapes(s, TopAbs_FACE, shape.faces);
    shape.attributes.resize(shape.faces.Extent());
    tables = make_tables(shape, "test").tables;
  }
  AirPieces pieces() const { return {shape, tables}; }
  std::size_t count(const AirPieces& all, FaceId left_out = kNone) const {
    std::vector<char> is_left_out(tables.n_faces(), 0);
    if (left_out != kNone) is_left_out[left_out] = 1;
    return all.pieces_without(is_left_out).size();
  }
  ImportedShape shape;
  ModelTables tables;
};

TEST(AirPieces, of_boxes_apart_are_two_and_every_side_of_one_is_a_hull_plane) {
  const Pieces one(box(0, 1)), two(compound_of(std::vector<TopoDS_Shape>{box(0, 1), box(5, 1)}));
  EXPECT_EQ(one.count(one.pieces()), 1u);
  EXPECT_EQ(one.pieces().hull_planes().size(), 6u);
  EXPECT_EQ(two.count(two.pieces()), 2u);
  EXPECT_EQ(two.pieces().hull_planes().size(), 0u) << "small faces are none";
}

TEST(AirPieces, of_boxes_that_touch_are_the_outside_and_the_wall_between_them) {
  const Pieces two(compound_of(std::vector<TopoDS_Shape>{box(0, 1), box(1, 1)}));
  const AirPieces all = two.pieces();
  EXPECT_EQ(two.count(all), 2u) << "each has edges and a wall of its own, at one place";
  EXPECT_EQ(all.hull_planes().size(), 6u);
  std::size_t n_crowded = 0;
  for (EdgeId e = 0; e < two.tables.n_edges(); ++e) n_crowded += all.is_crowded(e);
  EXPECT_EQ(n_crowded, 8u) << "four edges, each twice";
}

/// The shells of a shape, cut by the plane across x and planes beside it.
TopoDS_Shape cut_across_x(const TopoDS_Shape& shape, std::initializer_list<double> places) {
  BRepAlgoAPI_Splitter splitter;
  TopTools_ListOfShape shells, planes;
  for (TopExp_Explorer e(shape, TopAbs_SHELL); e.More(); e.Next()) shells.Append(e.Current());
  for (const double x : places)
    planes.Append(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(x, 0.1, 0.2), gp_Dir(1, 0.1, 0.2)), -9, 9, -9, 9).Face());
  splitter.SetArguments(shells);
  splitter.SetTools(planes);
  splitter.Build();
  return splitter.Shape();
}

TEST(AirPieces, find_a_hull_plane_whose_faces_are_all_small) {
  const Pieces cut(cut_across_x(box(0, 1), {0.1, 0.3, 0.5, 0.7, 0.9}));
  EXPECT_GT(cut.tables.n_faces(), 20);
  const std::vector<HullPlane> planes = cut.pieces().hull_planes();
  ASSERT_EQ(planes.size(), 6u);
  for (const HullPlane& plane : planes) EXPECT_NEAR(plane.area, 1, 1e-9);
}

TEST(AirPieces, know_which_way_a_face_goes_from_its_edge_and_how_it_bends) {
  const Pieces one(BRepPrimAPI_MakeCylinder(2, 3).Shape());
  const AirPieces all = one.pieces();
  int n_bent = 0;
  for (FaceId f = 0; f < one.tables.n_faces(); ++f)
    for (const EdgeId e : one.tables.edges_of(f))
      for (const FaceRim& rim : all.rims(f, e)) {
        EXPECT_NEAR(norm(rim.into), 1, 1e-9);
        n_bent += norm(rim.bend) > 0;
        EXPECT_NEAR(norm(rim.bend), norm(rim.bend) > 0 ? 0.5 : 0, 1e-9) << "across the seam";
      }
  EXPECT_EQ(n_bent, 4) << "both sides of the seam, seen once from each of its uses";
}

TEST(AirPieces, have_samples_in_the_face_and_a_size_that_does_not_depend_on_axes) {
  const Pieces one(box(0, 1));
  const AirPieces all = one.pieces();
  for (FaceId f = 0; f < one.tables.n_faces(); ++f) EXPECT_EQ(sample_face(all.face(f)).size(), 64u);
  std::vector<FaceId> faces(6);
  std::iota(faces.begin(), faces.end(), 0);
  EXPECT_NEAR(size_of(all.edge_points(faces)), std::sqrt(3.0), 1e-9);
  EXPECT_EQ(size_of({}), 0);
}

}  // namespace
}  // namespace st::occt
