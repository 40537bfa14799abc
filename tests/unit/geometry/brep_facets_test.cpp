// Triangles on the faces of OpenCASCADE's shapes.
#include "geometry/model/brep_facets.h"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include <vector>

#include "base/threads.h"
#include "geometry/model/model_editor.h"
#include "support/shapes.h"

namespace st {
namespace {

/// All numbers of the triangles of a shape's faces, and how many edges have polygons on them.
struct PutFacets {
  std::vector<double> number;
  int n_polygons = 0;

  explicit PutFacets(const TopoDS_Shape& shape) {
    TopTools_IndexedMapOfShape faces, edges;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    for (int f = 1; f <= faces.Extent(); ++f) add(TopoDS::Face(faces(f)), edges);
  }

 private:
  void add(const TopoDS_Face& face, const TopTools_IndexedMapOfShape& edges) {
    TopLoc_Location at;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, at);
    ASSERT_FALSE(mesh.IsNull());
    for (int i = 1; i <= mesh->NbNodes(); ++i)
      for (int k = 1; k <= 3; ++k) number.push_back(mesh->Node(i).Coord(k));
    for (int i = 1; i <= mesh->NbTriangles(); ++i)
      for (int k = 1; k <= 3; ++k) number.push_back(mesh->Triangle(i).Value(k));
    for (int e = 1; e <= edges.Extent(); ++e)
      n_polygons += !BRep_Tool::PolygonOnTriangulation(TopoDS::Edge(edges(e)), mesh, at).IsNull();
  }
};

constexpr double kDeflection = 1e-3;

PutFacets put(const Model& model, FacetsGo go, int n_threads) {
  set_thread_count(n_threads);
  BRepBuilderAPI_Copy copy(ModelEditor::brep(model).shape, false);
  put_facets(copy.Shape(), {.deflection = kDeflection}, go);
  set_thread_count(1);
  return PutFacets(copy.Shape());
}

TEST(BrepFacets, are_those_of_opencascade_at_any_number_of_threads) {
  const Model model = test::make_model("wing_with_pod");
  BRepBuilderAPI_Copy copy(ModelEditor::brep(model).shape, false);
  IMeshTools_Parameters parameters;
  parameters.Deflection = kDeflection;
  parameters.Angle = FacetLimits().angle;
  parameters.ControlSurfaceDeflection = false;
  const BRepMesh_IncrementalMesh mesher(copy.Shape(), parameters);
  const PutFacets expected(copy.Shape());
  EXPECT_GT(expected.number.size(), 1000u);
  for (const int n_threads : {1, 2, 7})
    EXPECT_EQ(put(model, FacetsGo::kToFaces, n_threads).number, expected.number) << n_threads << " threads";
}

TEST(BrepFacets, give_edges_their_polygons_only_where_asked) {
  const Model model = test::make_model("box");
  EXPECT_EQ(put(model, FacetsGo::kToAllEdges, 2).n_polygons, 24);
  EXPECT_EQ(put(model, FacetsGo::kToFaces, 2).n_polygons, 0);
}

TEST(BrepFacets, of_a_strip_of_a_torus_are_few) {
  const Handle(Geom_ToroidalSurface) torus = new Geom_ToroidalSurface(gp_Ax3(), 1318.4, 3442);
  const TopoDS_Face strip = BRepBuilderAPI_MakeFace(torus, 0, 3, 5.46888, 5.46888 + 1e-6, 1e-9);
  put_facets(strip, {.deflection = 16}, FacetsGo::kToFaces);
  TopLoc_Location at;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(strip, at);
  ASSERT_FALSE(mesh.IsNull());
  EXPECT_GT(mesh->NbTriangles(), 10);
  EXPECT_LT(mesh->NbNodes(), 1000);
}

}  // namespace
}  // namespace st
