#include "geometry/reader/step_entities.h"

#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <Interface_UndefinedContent.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepGeom_Surface.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepSelect_StepType.hxx>
#include <StepShape_BrepWithVoids.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_CsgSolid.hxx>
#include <StepShape_Edge.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_EdgeLoop.hxx>
#include <StepShape_FaceBasedSurfaceModel.hxx>
#include <StepShape_FaceBound.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_HArray1OfFace.hxx>
#include <StepShape_OrientedClosedShell.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <StepShape_OrientedOpenShell.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <StepShape_SolidModel.hxx>
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
#include <iterator>
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
#include "geometry/import/part_names.h"
#include "geometry/import/ring_edges.h"
#include "geometry/import/seam_curves.h"
#include "geometry/import/swapped_seams.h"
#include "geometry/import/text_encoding.h"
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

/// "ADVANCED_FACE #17", and its name.
std::string label_of(const Handle(XSControl_WorkSession) & session, const Handle(Standard_Transient) & entity) {
  const auto other = Handle(StepData_UndefinedEntity)::DownCast(entity);
  const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity);
  StepSelect_StepType type;
  type.SetProtocol(session->Protocol());
  std::string label = other.IsNull() ? type.Value(entity, session->Model()) : other->StepType();
  label.append(" ").append(session->Model()->StringLabel(entity)->ToCString());
  std::string name;
  if (!item.IsNull() && !item->Name().IsNull()) name = item->Name()->ToCString();
  if (!other.IsNull()) {  // in quotes
    name = other->UndefinedContent()->ParamValue(1)->ToCString();
    name = name.size() < 2 ? "" : name.substr(1, name.size() - 2);
  }
  return is_junk(name.c_str()) ? label : label.append(" \"").append(valid_utf8(name)).append("\"");
}

/// A body of facets that stands for no exact body, which OpenCASCADE leaves out.
bool is_tessellated_alone(const Handle(Standard_Transient) & entity) {
  constexpr int kLink = 3;  // TESSELLATED_SOLID(name, items, geometric_link)
  const auto other = Handle(StepData_UndefinedEntity)::DownCast(entity);
  if (other.IsNull() || other->UndefinedContent()->NbParams() < kLink) return false;
  const std::string type = other->StepType();
  if (type != "TESSELLATED_SOLID" && type != "TESSELLATED_SHELL") return false;
  return other->UndefinedContent()->ParamType(kLink) != Interface_ParamIdent;
}

bool is_body(const Handle(Standard_Transient) & item) {
  if (item.IsNull()) return false;  // of a damaged file
  return item->IsKind(STANDARD_TYPE(StepShape_SolidModel)) || item->IsKind(STANDARD_TYPE(StepShape_CsgSolid)) ||
         item->IsKind(STANDARD_TYPE(StepShape_ShellBasedSurfaceModel)) ||
         item->IsKind(STANDARD_TYPE(StepShape_FaceBasedSurfaceModel));
}

/// Null also for an oriented shell: another one has its faces.
Handle(StepShape_ConnectedFaceSet) shell_of(const Handle(Standard_Transient) & entity) {
  if (entity->IsKind(STANDARD_TYPE(StepShape_OrientedClosedShell))) return {};
  if (entity->IsKind(STANDARD_TYPE(StepShape_OrientedOpenShell))) return {};
  return Handle(StepShape_ConnectedFaceSet)::DownCast(entity);
}

/// What two faces have in common that are one: the surface, its side, and the edges with their directions.
using FacePlace = std::pair<const void*, std::multiset<std::pair<const void*, bool>>>;

FacePlace place_of(const StepShape_FaceSurface& face) {
  FacePlace place(face.FaceGeometry().get(), {{nullptr, face.SameSense()}});
  for (int b = 1; b <= face.NbBounds(); ++b) {
    const Handle(StepShape_FaceBound) bound = face.BoundsValue(b);
    if (bound.IsNull()) continue;  // of a damaged file
    const auto loop = Handle(StepShape_EdgeLoop)::DownCast(bound->Bound());
    if (loop.IsNull()) place.second.emplace(bound->Bound().get(), true);
    for (int e = 1; !loop.IsNull() && e <= loop->NbEdgeList(); ++e) {
      const Handle(StepShape_OrientedEdge) use = loop->EdgeListValue(e);
      if (!use.IsNull()) place.second.emplace(use->EdgeElement().get(), use->Orientation() == bound->Orientation());
    }
  }
  return place;
}

/// Leaves out faces that a shell has twice: OpenCASCADE's healing makes several shells of it, with faces turned.
void leave_out_twins(StepShape_ConnectedFaceSet& shell) {
  std::set<FacePlace> places;
  std::vector<Handle(StepShape_Face)> faces;
  for (int k = 1; k <= shell.NbCfsFaces(); ++k) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(shell.CfsFacesValue(k));
    if (face.IsNull() || places.insert(place_of(*face)).second) faces.push_back(shell.CfsFacesValue(k));
  }
  if (static_cast<int>(faces.size()) == shell.NbCfsFaces()) return;
  const Handle(StepShape_HArray1OfFace) kept = new StepShape_HArray1OfFace(1, static_cast<int>(faces.size()));
  for (std::size_t k = 0; k < faces.size(); ++k) kept->SetValue(static_cast<int>(k) + 1, faces[k]);
  shell.SetCfsFaces(kept);
}

/// The text of a file, but for what OpenCASCADE does not know: a byte order mark, tabs, which crash it, and the
/// parameters of the data section that ISO 10303-21:2002 allows.
std::string text_for_opencascade(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::replace(text.begin(), text.end(), '\t', ' ');
  constexpr std::string_view kEndOfHeader = "ENDSEC;", kData = "DATA";
  const std::size_t end = text.find(kEndOfHeader);
  const std::size_t data = end == std::string::npos ? end : text.find_first_not_of(" \r\n", end + kEndOfHeader.size());
  if (data == std::string::npos || text.compare(data, kData.size(), kData) != 0) return text;
  const std::size_t open = data + kData.size(), close = text.find(';', open);
  if (text[open] == '(' && close != std::string::npos) text.erase(open, close - open);
  return text;
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
  std::istringstream text(text_for_opencascade(path));
  if (reader.ReadStream(path.c_str(), text) != IFSelect_RetDone)
    throw Error(ExitCode::kInput, path + ": the STEP file cannot be parsed; export the model again");
  const Handle(Interface_InterfaceModel) model = reader.Model();
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto shell = shell_of(model->Value(i)); !shell.IsNull()) leave_out_twins(*shell);
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
    else
      file.has_voids = file.has_voids || session->Model()->Value(i)->IsKind(STANDARD_TYPE(StepShape_BrepWithVoids));
  for (CadPart& part : file.parts)
    for (auto& face : part.faces)
      if (const std::int32_t k = faces.find(face.face); k != kNone) {
        face.lies_as_said =
            lies_as_said(*entities[k], TopoDS::Face(face.face), session->TransferReader()->TransientProcess());
        face.has_seam = has_seam(*entities[k]);
      }
}

void find_unread(const Handle(XSControl_WorkSession) & session, CadFile& file) {
  const Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
  const auto is_read = [&](const Handle(Standard_Transient) & entity) {
    return !TransferBRep::ShapeResult(process, entity).IsNull();
  };
  const auto add = [&](const Handle(Standard_Transient) & entity) { file.unread.push_back(label_of(session, entity)); };
  for (int i = 1; i <= session->Model()->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = session->Model()->Value(i);
    if (is_tessellated_alone(entity)) add(entity);
    if (const auto shape = Handle(StepShape_ShapeRepresentation)::DownCast(entity); !shape.IsNull())
      for (int k = 1; k <= shape->NbItems(); ++k)
        if (const Handle(Standard_Transient) item = shape->ItemsValue(k); is_body(item) && !is_read(item)) add(item);
    const auto shell = shell_of(entity);
    std::vector<Handle(Standard_Transient)> lost;
    for (int k = 1; !shell.IsNull() && k <= shell->NbCfsFaces(); ++k)
      if (const Handle(Standard_Transient) face = shell->CfsFacesValue(k); !face.IsNull() && !is_read(face))
        lost.push_back(face);
    if (!lost.empty() && static_cast<int>(lost.size()) < shell->NbCfsFaces())
      for (const auto& face : lost) add(face);
  }
}

}  // namespace st::occt
