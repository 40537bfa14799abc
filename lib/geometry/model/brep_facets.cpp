#include "geometry/model/brep_facets.h"

#include <BRepMesh_Context.hxx>
#include <BRepMesh_EdgeDiscret.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepMesh_MeshAlgoFactory.hxx>
#include <BRepTools.hxx>
#include <IMeshData_Edge.hxx>
#include <IMeshData_Face.hxx>
#include <IMeshData_Model.hxx>
#include <IMeshTools_ModelAlgo.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Standard_Failure.hxx>
#include <cstddef>
#include <gp_Torus.hxx>

#include "base/threads.h"

namespace st {
namespace {

// Length over width of strips of tori from which they are taken for free-form surfaces: BRepMesh puts a row of nodes
// along a torus with at most five widths between two, so 200 here, and takes time with the square of their number.
constexpr double kThinTorus = 1000;

/// One edge of a model, for an algorithm that does all of them one after the other.
class OneEdge : public IMeshData_Model {
 public:
  OneEdge(const Handle(IMeshData_Model) & model, int edge)
      : IMeshData_Model(model->GetShape()), model_(model), edge_(edge) {}
  Standard_Real GetMaxSize() const override { return model_->GetMaxSize(); }
  Standard_Integer FacesNb() const override { return model_->FacesNb(); }
  const IMeshData::IFaceHandle& AddFace(const TopoDS_Face& face) override { return model_->AddFace(face); }
  const IMeshData::IFaceHandle& GetFace(const Standard_Integer i) const override { return model_->GetFace(i); }
  Standard_Integer EdgesNb() const override { return 1; }
  const IMeshData::IEdgeHandle& AddEdge(const TopoDS_Edge& edge) override { return model_->AddEdge(edge); }
  const IMeshData::IEdgeHandle& GetEdge(const Standard_Integer) const override { return model_->GetEdge(edge_); }

 private:
  const Handle(IMeshData_Model) model_;
  const int edge_;
};

/// BRepMesh_EdgeDiscret on the threads of the project. No edge needs another one's points.
class EdgeFacets : public IMeshTools_ModelAlgo {
 protected:
  Standard_Boolean performInternal(const Handle(IMeshData_Model) & model, const IMeshTools_Parameters& parameters,
                                   const Message_ProgressRange&) override {
    parallel_for(static_cast<std::size_t>(model->EdgesNb()), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Handle(IMeshData_Model) one = new OneEdge(model, static_cast<int>(i));
        const Handle(IMeshTools_ModelAlgo) algorithm = new BRepMesh_EdgeDiscret();
        algorithm->Perform(one, parameters, Message_ProgressRange());
      }
    });
    return true;
  }
};

/// In place of BRepMesh_FaceDiscret, whose threads are not those of the project. No face needs another one's triangles.
class FaceFacets : public IMeshTools_ModelAlgo {
 protected:
  Standard_Boolean performInternal(const Handle(IMeshData_Model) & model, const IMeshTools_Parameters& parameters,
                                   const Message_ProgressRange&) override {
    parallel_for(static_cast<std::size_t>(model->FacesNb()), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) put(model->GetFace(static_cast<int>(i)), parameters);
    });
    return true;
  }

 private:
  static void put(const IMeshData::IFaceHandle& face, const IMeshTools_Parameters& parameters) {
    if (face->IsSet(IMeshData_Failure) || face->IsSet(IMeshData_Reused)) return;
    try {
      const Handle(IMeshTools_MeshAlgo) algorithm = BRepMesh_MeshAlgoFactory().GetAlgo(
          is_thin_torus(face) ? GeomAbs_OtherSurface : face->GetSurface()->GetType(), parameters);
      if (algorithm.IsNull())
        face->SetStatus(IMeshData_Failure);
      else
        algorithm->Perform(face, parameters, Message_ProgressRange());
    } catch (const Standard_Failure&) {
      face->SetStatus(IMeshData_Failure);
    }
  }

  static bool is_thin_torus(const IMeshData::IFaceHandle& face) {
    if (face->GetSurface()->GetType() != GeomAbs_Torus) return false;
    const gp_Torus torus = face->GetSurface()->Torus();
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    BRepTools::UVBounds(face->GetFace(), u0, u1, v0, v1);
    const double length = (u1 - u0) * (torus.MajorRadius() + torus.MinorRadius());
    return length > kThinTorus * (v1 - v0) * torus.MinorRadius();
  }
};

}  // namespace

void put_facets(const TopoDS_Shape& shape, const FacetLimits& limits, FacetsGo go) {
  const Handle(BRepMesh_Context) context = new BRepMesh_Context();
  context->SetEdgeDiscret(new EdgeFacets());
  context->SetFaceDiscret(new FaceFacets());
  if (go == FacetsGo::kToFaces) context->SetPostProcessor(nullptr);
  BRepMesh_IncrementalMesh mesher;
  mesher.SetShape(shape);
  IMeshTools_Parameters& parameters = mesher.ChangeParameters();
  parameters.Deflection = limits.deflection;
  parameters.Angle = limits.angle;
  parameters.ControlSurfaceDeflection = limits.is_exact;
  mesher.Perform(context);
}

}  // namespace st
