#include "geometry/flite/flite_divide.h"

#include <BinTools.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeUpgrade_ShapeDivideClosed.hxx>
#include <ShapeUpgrade_ShapeDivideContinuity.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "geometry/model/model_impl.h"
#include "geometry/model/model_tables.h"

namespace st {
namespace {

using occt::ImportedShape;

ImportedShape shape_of(const Model& model) {
  const auto& bytes = model.brep();
  std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), std::ios::binary);
  ImportedShape result;
  BinTools::Read(result.shape, stream);
  TopExp::MapShapes(result.shape, TopAbs_FACE, result.faces);
  result.attributes.resize(result.faces.Extent());
  for (int f = 0; f < result.faces.Extent(); ++f) result.attributes[f].name = std::to_string(f);  // to follow it
  return result;
}

/// Runs a division over the whole shape; faces that it leaves alone stay the same.
void apply(ShapeUpgrade_ShapeDivide& division, ImportedShape& shape) {
  if (!division.Perform() || division.Result().IsNull()) return;
  const Handle(ShapeBuild_ReShape) context = division.GetContext();
  shape.replace(division.Result(), [&](const TopoDS_Shape& face) { return context->Apply(face); });
}

DividedModel whole(const Model& model) {
  DividedModel result{Model(model.tables(), model.brep()), std::vector<FaceId>(model.tables().n_faces())};
  std::iota(result.origin.begin(), result.origin.end(), 0);
  return result;
}

}  // namespace

DividedModel divide_for_flite(const Model& model) {
  try {
    ImportedShape shape = shape_of(model);
    const int n_faces = shape.faces.Extent();
    const TopoDS_Shape before = shape.shape;
    ShapeUpgrade_ShapeDivideContinuity kinks(shape.shape);
    kinks.SetTolerance(1e-9 * model.tables().box().diagonal());
    kinks.SetBoundaryCriterion(GeomAbs_C1);
    kinks.SetPCurveCriterion(GeomAbs_C0);
    kinks.SetSurfaceCriterion(GeomAbs_C1);
    apply(kinks, shape);
    ShapeUpgrade_ShapeDivideClosed closed(shape.shape);
    closed.SetNbSplitPoints(1);
    apply(closed, shape);
    if (shape.shape.IsSame(before) && shape.faces.Extent() == n_faces) return whole(model);
    std::vector<FaceId> origin;
    for (const occt::FaceAttributes& a : shape.attributes) origin.push_back(a.name.empty() ? kNone : std::stoi(a.name));
    occt::ModelOfFile tables = occt::make_tables(shape, "the divided model");
    return {Model(std::move(tables.tables), occt::brep_bytes(shape.shape)), std::move(origin)};
  } catch (const Standard_Failure& e) {
    throw Error(ExitCode::kGeometry, std::string("the faces of the model cannot be divided for FLITE (OpenCASCADE: ") +
                                         e.GetMessageString() + "); repair it in the CAD system");
  }
}

}  // namespace st
