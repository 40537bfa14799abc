#include "geometry/reader/step_entities.h"

#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <StepBasic_Product.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepShape_Edge.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_EdgeLoop.hxx>
#include <StepShape_FaceBound.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TransferBRep.hxx>
#include <XSAlgo.hxx>
#include <XSAlgo_AlgoContainer.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/ids.h"
#include "geometry/brep/faces_of.h"
#include "geometry/import/meridians.h"
#include "geometry/import/ring_edges.h"
#include "geometry/import/seam_curves.h"
#include "geometry/import/swapped_seams.h"
#include "geometry/import/vertex_loops.h"

namespace st::occt {
namespace {

bool is_beyond_ascii(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return c >= 0x80 || c == ' '; }) &&
         name.find_first_not_of(' ') != std::string::npos;
}

/// Whether a loop passes an edge twice.
bool has_seam(const StepShape_FaceSurface& face) {
  for (int b = 1; b <= face.NbBounds(); ++b) {
    const auto loop = Handle(StepShape_EdgeLoop)::DownCast(face.BoundsValue(b)->Bound());
    std::set<const StepShape_Edge*> seen;
    for (int e = 1; !loop.IsNull() && e <= loop->NbEdgeList(); ++e)
      if (!seen.insert(loop->EdgeListValue(e)->EdgeElement().get()).second) return true;
  }
  return false;
}

/// The curve in space of an edge, as it is stored: the same one in all copies of an edge.
Handle(Geom_Curve) stored_curve(const TopoDS_Shape& edge) {
  TopLoc_Location location;
  double t0, t1;
  return BRep_Tool::Curve(TopoDS::Edge(edge), location, t0, t1);
}

/// Whether a face runs along each curve of its edges forward, the face seen forward; no curve of a seam.
std::map<const Geom_Curve*, bool> directions_in(const TopoDS_Face& face) {
  std::map<const Geom_Curve*, bool> forward;
  std::set<const Geom_Curve*> twice;
  for (TopExp_Explorer e(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next()) {
    const Handle(Geom_Curve) curve = stored_curve(e.Current());
    if (!forward.emplace(curve.get(), e.Current().Orientation() == TopAbs_FORWARD).second) twice.insert(curve.get());
  }
  twice.insert(nullptr);
  for (const Geom_Curve* curve : twice) forward.erase(curve);
  return forward;
}

/// Whether the face lies on the side of its loops that the file says: edges run around it as there, and it faces so, or
/// neither. nullopt where that is not known.
std::optional<bool> lies_as_said(const StepShape_FaceSurface& entity, const TopoDS_Face& face,
                                 const Handle(Transfer_TransientProcess) & process) {
  const std::map<const Geom_Curve*, bool> forward = directions_in(face);
  int n_same = 0, n_other = 0;
  for (int b = 1; b <= entity.NbBounds(); ++b) {
    const Handle(StepShape_FaceBound) bound = entity.BoundsValue(b);
    const auto loop = Handle(StepShape_EdgeLoop)::DownCast(bound->Bound());
    for (int e = 1; !loop.IsNull() && e <= loop->NbEdgeList(); ++e) {
      const Handle(StepShape_OrientedEdge) use = loop->EdgeListValue(e);
      const auto curve = Handle(StepShape_EdgeCurve)::DownCast(use->EdgeElement());
      if (curve.IsNull()) continue;
      const TopoDS_Shape edge = TransferBRep::ShapeResult(process, curve);
      if (edge.IsNull() || edge.ShapeType() != TopAbs_EDGE) continue;
      const auto found = forward.find(stored_curve(edge).get());
      if (found == forward.end()) continue;
      const bool is_said_forward = (use->Orientation() == bound->Orientation()) == curve->SameSense();
      ++(found->second == is_said_forward ? n_same : n_other);
    }
  }
  if (n_same == n_other) return std::nullopt;
  return (n_same > n_other) == entity.SameSense();
}

/// OpenCASCADE's healing of what its readers make, once outer loops and seams are right.
class HealingOfLoops : public XSAlgo_AlgoContainer {
 public:
  TopoDS_Shape ProcessShape(const TopoDS_Shape& shape, Standard_Real precision, Standard_Real tolerance,
                            Standard_CString resource, Standard_CString sequence, Handle(Standard_Transient) & info,
                            const Message_ProgressRange& progress, Standard_Boolean is_non_manifold) const override {
    if (std::string(sequence) == "read.step.sequence") {
      const std::vector<TopoDS_Face> faces = faces_of(shape);
      trim_meridians(faces);
      trim_bare_meridians(shape);
      bound_whole_surfaces(faces);
      give_seams_curves(faces);
      move_curves_between_poles(faces);
      swap_seams(faces);
    } else if (std::string(sequence) == "read.iges.sequence") {
      const std::vector<TopoDS_Face> faces = faces_of(shape);
      join_ring_ends(faces, precision);
      make_seams(faces);
    }
    return XSAlgo_AlgoContainer::ProcessShape(shape, precision, tolerance, resource, sequence, info, progress,
                                              is_non_manifold);
  }
};

}  // namespace

void mend_loops_before_healing() { XSAlgo::SetAlgoContainer(new HealingOfLoops); }

FacesOfEntities::FacesOfEntities(const Handle(XSControl_WorkSession) & session)
    : process_(session->TransferReader()->TransientProcess()) {}

bool FacesOfEntities::add(const Handle(Standard_Transient) & entity) {
  const TopoDS_Shape shape = TransferBRep::ShapeResult(process_, entity);
  if (shape.IsNull() || shape.ShapeType() != TopAbs_FACE || faces_.Contains(shape.Located({}))) return false;
  faces_.Add(shape.Located({}));
  return true;
}

std::int32_t FacesOfEntities::find(const TopoDS_Shape& face) const {
  const int k = faces_.FindIndex(face.Located({}));
  return k > 0 ? k - 1 : kNone;
}

void read_step_file(const std::string& path, XSControl_Reader& reader) {
  std::ifstream file(path, std::ios::binary);
  if (char mark[3] = {}; !file.read(mark, 3) || std::string_view(mark, 3) != "\xef\xbb\xbf") file.seekg(0);
  if (reader.ReadStream(path.c_str(), file) != IFSelect_RetDone)
    throw Error(ExitCode::kInput, path + ": the STEP file cannot be parsed; export the model again");
}

void read_step_units(const Handle(Interface_InterfaceModel) & model, CadFile& file) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    Handle(StepRepr_GlobalUnitAssignedContext) context;
    if (const auto a =
            Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(model->Value(i)))
      context = a->GlobalUnitAssignedContext();
    else if (const auto b =
                 Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(model->Value(i)))
      context = b->GlobalUnitAssignedContext();
    if (context.IsNull()) continue;
    STEPConstruct_UnitContext units;
    units.ComputeFactors(context);
    if (!units.LengthDone()) continue;
    const double factor = units.LengthFactor();
    if (!file.unit_in_mm)
      file.unit_in_mm = factor;
    else if (std::abs(*file.unit_in_mm - factor) > 1e-9 * factor)
      file.has_mixed_units = true;
  }
  if (!file.unit_in_mm) file.unit_in_mm = 1.0;
}

void keep_names_beyond_ascii(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i));
        !product.IsNull() && !product->Name().IsNull() && is_beyond_ascii(product->Name()->ToCString()))
      product->SetId(product->Name());
}

void fail_at_scale(const std::string& path, double scale) {
  std::ostringstream what;
  what << path << ": a part is placed with the scale " << scale
       << ", which OpenCASCADE leaves out; export it in its true size";
  throw Error(ExitCode::kGeometry, what.str());
}

void refuse_scaled_parts(const Handle(XSControl_WorkSession) & session, const std::string& path) {
  constexpr double kSame = 1e-9;
  for (int i = 1; i <= session->Model()->NbEntities(); ++i) {
    const auto item = Handle(StepRepr_MappedItem)::DownCast(session->Model()->Value(i));
    if (item.IsNull()) continue;
    const auto place = Handle(StepGeom_CartesianTransformationOperator3d)::DownCast(item->MappingTarget());
    if (place.IsNull() || !place->HasScale() || std::abs(place->Scale() - 1) <= kSame) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(session->TransferReader()->TransientProcess(), item);
    if (!TopExp_Explorer(shape, TopAbs_FACE).More()) continue;
    fail_at_scale(path, place->Scale());
  }
}

void read_senses(const Handle(XSControl_WorkSession) & session, CadFile& file) {
  FacesOfEntities faces(session);
  std::vector<Handle(StepShape_FaceSurface)> entities;
  for (int i = 1; i <= session->Model()->NbEntities(); ++i)
    if (const auto entity = Handle(StepShape_FaceSurface)::DownCast(session->Model()->Value(i));
        !entity.IsNull() && faces.add(entity))
      entities.push_back(entity);
  for (CadPart& part : file.parts)
    for (auto& face : part.faces)
      if (const std::int32_t k = faces.find(face.face); k != kNone) {
        face.lies_as_said =
            lies_as_said(*entities[k], TopoDS::Face(face.face), session->TransferReader()->TransientProcess());
        face.has_seam = has_seam(*entities[k]);
      }
}

}  // namespace st::occt
