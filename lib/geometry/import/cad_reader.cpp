#include "geometry/import/cad_reader.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_ExternFile.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_Edge.hxx>
#include <StepShape_EdgeLoop.hxx>
#include <StepShape_FaceBound.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TCollection_AsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "base/error.h"
#include "base/face_labels.h"
#include "base/ids.h"
#include "geometry/flite/flite_file.h"
#include "geometry/flite/flite_reader.h"
#include "geometry/import/text_encoding.h"

namespace st::occt {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw Error(ExitCode::kInput, path + ": " + why);
}

/// "a PNG image, " for files that are often taken for another; empty for anything else.
std::string what_else(const std::string& head) {
  static const std::pair<const char*, const char*> kKinds[] = {{"\x89PNG", "a PNG image"},
                                                               {"\xff\xd8\xff", "a JPEG image"},
                                                               {"PK\x03\x04", "a zip archive"},
                                                               {"\x1f\x8b", "a gzip archive"},
                                                               {"%PDF", "a PDF document"},
                                                               {"<!DOCTYPE", "a web page"},
                                                               {"<html", "a web page"},
                                                               {"<?xml", "an XML file"},
                                                               {"solid", "an STL mesh"},
                                                               {"\x7f"
                                                                "ELF",
                                                                "a program"}};
  for (const auto& [start, kind] : kKinds)
    if (head.compare(0, std::strlen(start), start) == 0) return std::string(kind) + ", ";
  return {};
}

/// The last bytes of the file, blanks at its end left out.
std::string tail_of(const std::string& path, std::streamoff n) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - n));
  std::string text(static_cast<std::size_t>(std::min(size, n)), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  const std::size_t end = text.find_last_not_of(std::string(" \t\r\n\0\x1a", 6));
  return end == std::string::npos ? std::string() : text.substr(0, end + 1);
}

/// OpenCASCADE takes what it finds of a file that is cut off: the end must be there.
void require_end(const std::string& path, const std::string& format) {
  const std::string tail = tail_of(path, 4096);
  bool is_whole = true;
  if (format == "STEP") is_whole = tail.find("END-ISO-10303-21") != std::string::npos;
  if (format == "IGES") {
    const std::size_t line = tail.find_last_of("\r\n"), start = line == std::string::npos ? 0 : line + 1;
    is_whole = tail.size() > start + 72 && tail[start + 72] == 'T';
    if (line == std::string::npos)
      is_whole = tail.size() >= 8 && tail[tail.size() - 8] == 'T';  // records without line ends
  }
  if (!is_whole) fail(path, "the " + format + " file is cut off: its last section is missing; export the model again");
}

/// A damaged file is for the reader that its suffix names to complain about, if it is text at all.
bool has_flite_suffix(const std::string& path, const std::string& head) {
  const std::string suffix = std::filesystem::path(path).extension();
  return suffix == ".fli" && head.find('\0') == std::string::npos;
}

std::string format_of(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (!fs::exists(path, code)) fail(path, "no such file; check the path");
  if (fs::is_directory(path, code)) fail(path, "is a directory; give a STEP, IGES or BREP file");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, "cannot be opened; check its permissions");
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.empty()) fail(path, "empty file; export the model again");
  if (const std::string kind = what_else(head); !kind.empty() && kind != "an STL mesh, ")
    fail(path, kind + "not a STEP, IGES or BREP file; export the model as STEP");
  if (head.find("ISO-10303-21") != std::string::npos) return "STEP";
  if (head.find("DBRep_DrawableShape") != std::string::npos || head.find("CASCADE Topology V") != std::string::npos)
    return "BREP";
  if (head.compare(0, 8, "\x89HDF\r\n\x1a\n") == 0)
    fail(path, "is an HDF5 artifact, not a CAD file; give a STEP, IGES or BREP file");
  const std::size_t line_end = head.find_first_of("\r\n");
  if (line_end != std::string::npos && line_end >= 73 && (head[72] == 'S' || head[72] == 'F' || head[72] == 'C'))
    return "IGES";
  if (head.size() >= 80 && head[72] == 'S' && std::strchr(" 0123456789", head[79])) return "IGES";
  if (is_flite(head) || has_flite_suffix(path, head)) return "FLITE";
  fail(path, what_else(head) + "not a STEP, IGES or BREP file; export the model as STEP");
}

bool is_junk(const std::string& name) {
  return name.empty() || name == "NONE" || name == "FACE" || name == "''" || name == " " || name == "SHELL" ||
         name == "SOLID" || name == "COMPOUND" || name == "EDGE" || name.rfind("=>", 0) == 0;  // "=>[0:1:1:2]": XCAF's
                                                                                               // word for an instance
                                                                                               // without a name
}

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) attribute;
  if (label.IsNull() || !label.FindAttribute(TDataStd_Name::GetID(), attribute)) return {};
  const TCollection_ExtendedString wide = attribute->Get();
  std::vector<char> utf8(static_cast<std::size_t>(wide.LengthOfCString()) + 1, '\0');
  Standard_PCharacter out = utf8.data();
  wide.ToUTF8CString(out);
  const std::string text = valid_utf8(utf8.data());
  return is_junk(text) ? std::string() : text;
}

std::int32_t rgb(const Quantity_Color& c) {
  double r, g, b;
  c.Values(r, g, b, Quantity_TOC_sRGB);
  const auto byte = [](double x) {
    return static_cast<std::int32_t>(std::lround(255 * std::min(1.0, std::max(0.0, x))));
  };
  return byte(r) << 16 | byte(g) << 8 | byte(b);
}

/// Names of siblings, each its own: "bolt#1", "bolt#2" where there are several; '/' in them becomes '_', an empty one
/// "unnamed".
std::vector<std::string> numbered_names(std::vector<std::string> names) {
  std::vector<std::string> result;
  std::map<std::string, int> n_all, n_before;
  for (std::string& name : names) {
    std::replace(name.begin(), name.end(), '/', '_');
    if (name.empty()) name = "unnamed";
    ++n_all[name];
  }
  for (const std::string& name : names)
    result.push_back(unique_path(n_all[name] > 1 ? name + "#" + std::to_string(++n_before[name]) : name, result));
  return result;
}

/// Colours, layers and names of one document, inherited face <- shell/solid <- part.
class DocumentReader {
 public:
  explicit DocumentReader(const Handle(TDocStd_Document) & document)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colors_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
        layers_(XCAFDoc_DocumentTool::LayerTool(document->Main())) {}

  std::vector<CadPart> parts() {
    std::vector<CadPart> result;
    TDF_LabelSequence free;
    shapes_->GetFreeShapes(free);
    visit_all(free, TopLoc_Location(), {}, "", result);
    for (CadPart& part : result)
      if (part.name.empty()) part.path.clear();
    return result;
  }

 private:
  struct Style {
    std::int32_t color = -1;
    std::string layer, name;
  };

  Style style_of(const TDF_Label& label, Style inherited) {
    Quantity_Color color;
    if (colors_->GetColor(label, XCAFDoc_ColorSurf, color) || colors_->GetColor(label, XCAFDoc_ColorGen, color))
      inherited.color = rgb(color);
    Handle(TColStd_HSequenceOfExtendedString) names;
    if (layers_->GetLayers(label, names) && !names.IsNull() && names->Length() > 0)
      inherited.layer = TCollection_AsciiString(names->Value(1)).ToCString();
    if (std::string name = name_of(label); !name.empty()) inherited.name = name;
    return inherited;
  }

  /// Name of what a label stands for: of the product, else of the instance.
  std::string product_name(const TDF_Label& label) const {
    TDF_Label product;
    std::string name;
    if (XCAFDoc_ShapeTool::IsReference(label) && XCAFDoc_ShapeTool::GetReferredShape(label, product))
      name = name_of(product);
    return name.empty() ? name_of(label) : name;
  }

  std::vector<std::string> sibling_names(const TDF_LabelSequence& labels) const {
    std::vector<std::string> names;
    for (int i = 1; i <= labels.Length(); ++i) names.push_back(product_name(labels.Value(i)));
    return numbered_names(std::move(names));
  }

  void visit_all(const TDF_LabelSequence& labels, const TopLoc_Location& location, const Style& inherited,
                 const std::string& path, std::vector<CadPart>& result) {
    const std::vector<std::string> names = sibling_names(labels);
    for (int i = 1; i <= labels.Length(); ++i) visit(labels.Value(i), location, inherited, path + names[i - 1], result);
  }

  void visit(const TDF_Label& label, const TopLoc_Location& location, const Style& inherited, const std::string& path,
             std::vector<CadPart>& result) {
    Style style = style_of(label, inherited);
    TDF_Label target = label;
    TopLoc_Location place = location;
    if (XCAFDoc_ShapeTool::IsReference(label)) {
      XCAFDoc_ShapeTool::GetReferredShape(label, target);
      place = location * XCAFDoc_ShapeTool::GetLocation(label);
      Style own = style_of(target, Style());
      if (style.color < 0) style.color = own.color;
      if (style.layer.empty()) style.layer = own.layer;
      if (!own.name.empty()) style.name = own.name;
    }
    if (XCAFDoc_ShapeTool::IsAssembly(target)) {
      TDF_LabelSequence children;
      XCAFDoc_ShapeTool::GetComponents(target, children);
      visit_all(children, place, style, path + "/", result);
      return;
    }
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(target);
    if (shape.IsNull()) return;
    result.push_back(leaf(target, shape, place, style));
    result.back().path = path;
  }

  CadPart leaf(const TDF_Label& label, const TopoDS_Shape& shape, const TopLoc_Location& place, const Style& style) {
    CadPart part;
    part.shape = shape.Moved(place);
    part.name = style.name;
    // sub-shape styles: solids and shells first, faces override
    struct Sub {
      TopTools_IndexedMapOfShape members;
      Style style;
    };
    std::vector<Sub> subs;
    for (const auto kind : {TopAbs_SOLID, TopAbs_SHELL}) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(shape, kind, map);
      for (int i = 1; i <= map.Extent(); ++i) {
        TDF_Label sub;
        if (!shapes_->FindSubShape(label, map(i), sub)) continue;
        subs.emplace_back();
        subs.back().style = style_of(sub, Style());
        TopExp::MapShapes(map(i), TopAbs_FACE, subs.back().members);
      }
    }
    TopTools_IndexedMapOfShape faces, edges;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    for (int i = 1; i <= faces.Extent(); ++i) {
      Style s;
      s.color = style.color;
      s.layer = style.layer;
      for (const Sub& sub : subs)
        if (sub.members.Contains(faces(i))) {
          if (sub.style.color >= 0) s.color = sub.style.color;
          if (!sub.style.layer.empty()) s.layer = sub.style.layer;
        }
      TDF_Label sub;
      if (shapes_->FindSubShape(label, faces(i), sub)) s = style_of(sub, s);
      part.faces.push_back({faces(i).Moved(place), s.name, s.layer, s.color});
    }
    name_bodies(label, shape, part);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i) {
      TDF_Label sub;
      if (!shapes_->FindSubShape(label, edges(i), sub)) continue;
      if (std::string name = name_of(sub); !name.empty()) part.edges.push_back({edges(i).Moved(place), name});
    }
    return part;
  }

  /// The solids of a part that has several: "body#1", "body#2" or as they are named.
  void name_bodies(const TDF_Label& label, const TopoDS_Shape& shape, CadPart& part) const {
    TopTools_IndexedMapOfShape solids, faces;
    TopExp::MapShapes(shape, TopAbs_SOLID, solids);
    if (solids.Extent() < 2) return;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    std::vector<std::string> names;
    for (int i = 1; i <= solids.Extent(); ++i) {
      TDF_Label sub;
      const std::string name = shapes_->FindSubShape(label, solids(i), sub) ? name_of(sub) : std::string();
      names.push_back(name.empty() ? "body" : name);
    }
    names = numbered_names(std::move(names));
    for (int i = 1; i <= solids.Extent(); ++i)
      for (TopExp_Explorer e(solids(i), TopAbs_FACE); e.More(); e.Next())
        if (auto& face = part.faces[faces.FindIndex(e.Current()) - 1]; face.body.empty()) face.body = names[i - 1];
  }

  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colors_;
  Handle(XCAFDoc_LayerTool) layers_;
};

Handle(TDocStd_Document) new_document() {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  return document;
}

void step_units(const Handle(Interface_InterfaceModel) & model, CadFile& file) {
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

bool is_beyond_ascii(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return c >= 0x80 || c == ' '; }) &&
         name.find_first_not_of(' ') != std::string::npos;
}

/// XCAF takes a product's id where the name has no ASCII letter: the id becomes the name.
void keep_names_beyond_ascii(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i));
        !product.IsNull() && !product->Name().IsNull() && is_beyond_ascii(product->Name()->ToCString()))
      product->SetId(product->Name());
}

/// Faces that were made of entities of a file, wherever they stand.
class FacesOfEntities {
 public:
  explicit FacesOfEntities(const Handle(XSControl_WorkSession) & session)
      : process_(session->TransferReader()->TransientProcess()) {}

  /// Whether an entity became a face that is not yet among them; it is its last then.
  bool add(const Handle(Standard_Transient) & entity) {
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process_, entity);
    if (shape.IsNull() || shape.ShapeType() != TopAbs_FACE || faces_.Contains(shape.Located({}))) return false;
    faces_.Add(shape.Located({}));
    return true;
  }
  /// How many were added before this face; kNone where it is not among them.
  std::int32_t find(const TopoDS_Shape& face) const {
    const int k = faces_.FindIndex(face.Located({}));
    return k > 0 ? k - 1 : kNone;
  }

 private:
  Handle(Transfer_TransientProcess) process_;
  TopTools_IndexedMapOfShape faces_;
};

/// Names that XCAF kept no label for, from the STEP entities themselves.
void name_faces_by_entity(const Handle(XSControl_WorkSession) & session, CadFile& file) {
  FacesOfEntities faces(session);
  std::vector<std::string> names;
  for (int i = 1; i <= session->Model()->NbEntities(); ++i) {
    const auto entity = Handle(StepRepr_RepresentationItem)::DownCast(session->Model()->Value(i));
    if (entity.IsNull() || entity->Name().IsNull() || is_junk(entity->Name()->ToCString())) continue;
    if (faces.add(entity)) names.push_back(valid_utf8(entity->Name()->ToCString()));
  }
  for (CadPart& part : file.parts)
    for (auto& face : part.faces)
      if (const std::int32_t k = face.name.empty() ? faces.find(face.face) : kNone; k != kNone) face.name = names[k];
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

/// What ADVANCED_FACEs say of the side that they face, and of their seams.
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
        face.same_sense = entities[k]->SameSense();
        face.has_seam = has_seam(*entities[k]);
      }
}

/// Files that the STEP file refers to and that could not be read.
std::vector<std::string> missing_files(const STEPCAFControl_Reader& reader) {
  std::set<std::string> names;
  for (NCollection_DataMap<TCollection_AsciiString, Handle(STEPCAFControl_ExternFile)>::Iterator i(
           reader.ExternFiles());
       i.More(); i.Next())
    if (i.Value()->GetLoadStatus() != IFSelect_RetDone) names.insert(valid_utf8(i.Key().ToCString()));
  return {names.begin(), names.end()};
}

CadFile read_step(const std::string& path) {
  STEPCAFControl_Controller::Init();
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  Interface_Static::SetCVal("read.step.codepage", step_codepage(file_encoding(path)));
  Handle(TDocStd_Document) document = new_document();
  STEPCAFControl_Reader reader;
  reader.SetNameMode(true);
  reader.SetColorMode(true);
  reader.SetLayerMode(true);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    fail(path, "the STEP file cannot be parsed; export the model again");
  CadFile file;
  file.format = "STEP";
  step_units(reader.Reader().WS()->Model(), file);
  keep_names_beyond_ascii(reader.Reader().WS()->Model());
  if (!reader.Transfer(document)) fail(path, "no shape could be made of the STEP file; export the model again");
  file.missing_files = missing_files(reader);
  file.parts = DocumentReader(document).parts();
  name_faces_by_entity(reader.Reader().WS(), file);
  read_senses(reader.Reader().WS(), file);
  XCAFApp_Application::GetApplication()->Close(document);
  return file;
}

/// Names of IGES entities (property 406, form 15) for the faces and parts made of them: XCAF has them for parts alone,
/// and only as UTF-8.
void name_by_iges_property(const Handle(XSControl_WorkSession) & session, TextEncoding encoding, CadFile& file) {
  const Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
  TopTools_IndexedMapOfShape shapes;
  std::vector<std::string> names;
  for (int i = 1; i <= session->Model()->NbEntities(); ++i) {
    const auto entity = Handle(IGESData_IGESEntity)::DownCast(session->Model()->Value(i));
    if (entity.IsNull() || entity->NbTypedProperties(STANDARD_TYPE(IGESBasic_Name)) != 1) continue;
    const auto name = Handle(IGESBasic_Name)::DownCast(entity->TypedProperty(STANDARD_TYPE(IGESBasic_Name)));
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (shape.IsNull() || name->Value().IsNull() || is_junk(name->Value()->ToCString()) || shapes.Contains(shape))
      continue;
    shapes.Add(shape);
    names.push_back(to_utf8(name->Value()->ToCString(), encoding));
  }
  std::vector<std::string> part_names;
  for (CadPart& part : file.parts) {
    if (const int k = shapes.FindIndex(part.shape); k > 0) part.name = names[k - 1];
    part_names.push_back(part.name);
    for (auto& face : part.faces)
      if (const int k = face.name.empty() ? shapes.FindIndex(face.face) : 0; k > 0) face.name = names[k - 1];
  }
  const std::vector<std::string> paths = numbered_names(std::move(part_names));  // IGES parts come without assemblies
  for (std::size_t p = 0; p < paths.size(); ++p) file.parts[p].path = file.parts[p].name.empty() ? "" : paths[p];
}

CadFile read_iges(const std::string& path) {
  IGESControl_Controller::Init();
  Handle(TDocStd_Document) document = new_document();
  IGESCAFControl_Reader reader;
  reader.SetNameMode(true);
  reader.SetColorMode(true);
  reader.SetLayerMode(true);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    fail(path, "the IGES file cannot be parsed; export the model again");
  CadFile file;
  file.format = "IGES";
  const auto model = Handle(IGESData_IGESModel)::DownCast(reader.WS()->Model());
  file.unit_in_mm = model->GlobalSection().UnitValue();
  file.resolution_mm = model->GlobalSection().Resolution() * model->GlobalSection().UnitValue();
  if (!(*file.unit_in_mm > 0)) file.unit_in_mm = 1.0;
  if (!reader.Transfer(document)) fail(path, "no shape could be made of the IGES file; export the model again");
  file.parts = DocumentReader(document).parts();
  name_by_iges_property(reader.WS(), file_encoding(path), file);
  XCAFApp_Application::GetApplication()->Close(document);
  return file;
}

CadFile read_brep(const std::string& path) {
  CadFile file;
  file.format = "BREP";
  CadPart part;
  std::ifstream in(path, std::ios::binary);
  std::string head(64, '\0');
  in.read(head.data(), 64);
  in.clear();
  in.seekg(0);
  in.exceptions(std::ios::failbit | std::ios::badbit);  // OpenCASCADE looks for its keywords for ever where the file is
                                                        // cut off
  const bool is_binary =
      head.find("Open CASCADE Topology V") != std::string::npos && head.find("DBRep") == std::string::npos;
  try {
    if (is_binary) {
      BinTools::Read(part.shape, in);
    } else {
      BRep_Builder builder;
      BRepTools::Read(part.shape, in, builder);
    }
  } catch (const std::ios_base::failure&) {
    fail(path, "the BREP file is cut off or damaged; export the model again");
  }
  if (part.shape.IsNull()) fail(path, "the BREP file cannot be parsed; export the model again");
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(part.shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) part.faces.push_back({faces(i), {}, {}, -1});
  file.parts.push_back(std::move(part));
  return file;
}

}  // namespace

CadFile read_cad(const std::string& path) {
  const std::string format = format_of(path);
  require_end(path, format);
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    if (format == "FLITE") return read_flite_shape(path);
    return format == "STEP" ? read_step(path) : format == "IGES" ? read_iges(path) : read_brep(path);
  } catch (const Standard_Failure& e) {
    const char* text = e.GetMessageString();
    fail(path, "reading the " + format + " file failed (" + (text && *text ? text : e.DynamicType()->Name()) +
                   "); export the model again");
  }
}

}  // namespace st::occt
