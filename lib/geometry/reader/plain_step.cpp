#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <StepBasic_DocumentFile.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepData_StepModel.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepShape_TopologicalRepresentationItem.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "geometry/import/part_names.h"
#include "geometry/import/reader_module.h"
#include "geometry/import/text_encoding.h"
#include "geometry/reader/step_entities.h"

namespace st::occt {
namespace {

constexpr const char* kWords[] = {"STYLED_ITEM", "PRESENTATION_LAYER_ASSIGNMENT", "NEXT_ASSEMBLY_USAGE_OCCURRENCE",
                                  "DOCUMENT_FILE"};

bool is_of_document(const Handle(Standard_Transient) & entity) {
  return entity->IsKind(STANDARD_TYPE(StepVisual_StyledItem)) ||
         entity->IsKind(STANDARD_TYPE(StepVisual_PresentationLayerAssignment)) ||
         entity->IsKind(STANDARD_TYPE(StepRepr_NextAssemblyUsageOccurrence)) ||
         entity->IsKind(STANDARD_TYPE(StepBasic_DocumentFile));
}

/// Whether the file's text has such entities: most files that need a document are not read twice.
bool has_words_of_document(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(0, in.tellg())), '\0');
  in.seekg(0);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

bool is_named(const Handle(Standard_Transient) & entity) {
  const auto item = Handle(StepShape_TopologicalRepresentationItem)::DownCast(entity);
  return !item.IsNull() && !item->Name().IsNull() && !is_junk(item->Name()->ToCString());
}

/// The product, where it is the only one and the file says nothing that a document is needed for.
Handle(StepBasic_Product) only_product(const Handle(Interface_InterfaceModel) & model) {
  Handle(StepBasic_ProductDefinition) definition;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    if (is_of_document(entity) || is_named(entity)) return nullptr;
    if (!entity->IsKind(STANDARD_TYPE(StepBasic_ProductDefinition))) continue;
    if (!definition.IsNull()) return nullptr;
    definition = Handle(StepBasic_ProductDefinition)::DownCast(entity);
  }
  if (definition.IsNull() || definition->Formation().IsNull()) return nullptr;
  return definition->Formation()->OfProduct();
}

/// Its name, else its id, as XCAF takes them; nullopt where one has characters beyond ASCII.
std::optional<std::string> name_of(const StepBasic_Product& product) {
  std::string name;
  for (const Handle(TCollection_HAsciiString) & text : {product.Name(), product.Id()}) {
    if (text.IsNull()) continue;
    const std::string bytes = text->ToCString();
    if (std::any_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
      return std::nullopt;
    if (name.empty() && text->UsefullLength() > 0) name = bytes;
  }
  name = valid_utf8(name);
  return is_junk(name) ? std::string() : name;
}

/// Whether representations of the file became the whole shape or none: another one is a part of an assembly.
bool is_one_representation(const Handle(XSControl_WorkSession) & session, const TopoDS_Shape& shape) {
  const Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
  for (int i = 1; i <= session->Model()->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = session->Model()->Value(i);
    if (!entity->IsKind(STANDARD_TYPE(StepShape_ShapeRepresentation))) continue;
    const TopoDS_Shape of_it = TransferBRep::ShapeResult(process, entity);
    if (!of_it.IsNull() && !of_it.IsSame(shape)) return false;
  }
  return true;
}

CadPart part_of(const TopoDS_Shape& shape, const std::string& name) {
  CadPart part;
  part.shape = shape;
  part.name = name;
  if (!name.empty()) part.path = numbered_names({name})[0];
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) part.faces.push_back({faces(i), {}, {}, -1});
  name_bodies(
      shape, [](const TopoDS_Shape&) { return std::string(); }, part);
  return part;
}

}  // namespace

/// A file that holds the shape of one product and says no more of it than its name: what the reader of documents would
/// make of it, without its libraries. The format stays empty where that one is needed: for colours, layers, names of
/// faces, edges or solids, assemblies, several products or references to other files.
extern "C" void st_read_cad_file(const std::string& path, CadFile& file) {
  if (has_words_of_document(path)) return;
  STEPControl_Controller::Init();
  mend_loops_before_healing();
  STEPControl_Reader reader;
  read_step_file(path, reader);
  const Handle(StepBasic_Product) product = only_product(reader.WS()->Model());
  const std::optional<std::string> name = product.IsNull() ? std::nullopt : name_of(*product);
  if (!name) return;
  read_step_units(reader.WS()->Model(), file);
  reader.TransferRoots();
  refuse_scaled_parts(reader.WS(), path);
  if (reader.NbShapes() != 1) return;
  const TopoDS_Shape shape = reader.Shape(1);
  if (shape.IsNull() || !shape.Location().IsIdentity() || !is_one_representation(reader.WS(), shape)) return;
  file.format = "STEP";
  file.parts.push_back(part_of(shape, *name));
  read_senses(reader.WS(), file);
  find_unread(reader.WS(), file);
}

}  // namespace st::occt
