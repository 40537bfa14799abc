#include "geometry/model/brep_facets.h"

#include <BRepMesh_Context.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepMesh_MeshAlgoFactory.hxx>
#include <IMeshData_Face.hxx>
#include <IMeshTools_ModelAlgo.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Standard_Failure.hxx>
#include <cstddef>

#include "base/threads.h"

namespace st {
namespace {

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
      const Handle(IMeshTools_MeshAlgo) algorithm =
          BRepMesh_MeshAlgoFactory().GetAlgo(face->GetSurface()->GetType(), parameters);
      if (algorithm.IsNull())
        face->SetStatus(IMeshData_Failure);
      else
        algorithm->Perform(face, parameters, Message_ProgressRange());
    } catch (const Standard_Failure&) {
      face->SetStatus(IMeshData_Failure);
    }
  }
};

}  // namespace

void put_facets(const TopoDS_Shape& shape, const FacetLimits& limits, FacetsGo go) {
  const Handle(BRepMesh_Context) context = new BRepMesh_Context();
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
