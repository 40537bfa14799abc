// What hangs together in a model, and which planes are its hull.
#include "geometry/import/air_pieces.h"

#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp.hxx>

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
