#include "step_file.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPConstruct.hxx>
#include <StepData_StepModel.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <Transfer_FinderProcess.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <stdexcept>

namespace aircraft {
namespace {

Handle(TCollection_HAsciiString) text(const std::string& s) { return new TCollection_HAsciiString(s.c_str()); }

Handle(TDocStd_Document) new_document() {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  return document;
}

TopTools_IndexedMapOfShape faces_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  return faces;
}

void set_unit(const char* parameter, const char* unit) {
  if (!Interface_Static::SetCVal(parameter, unit)) throw std::runtime_error(std::string("cannot set ") + parameter);
}

/// Everything in the header that would differ from run to run or from machine to machine.
void fix_header(const Handle(StepData_StepModel) & model, const std::string& product) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text(product + ".step"));
  header.SetTimeStamp(text("2000-01-01T00:00:00"));
  header.SetAuthorValue(1, text("make_aircraft"));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text("make_aircraft"));
  header.SetAuthorisation(text(""));
  header.Apply(model);
}

}  // namespace

void write_step(const std::string& path, const std::string& product, const TopoDS_Shape& shape, const NameTable& names,
                const char* unit) {
  STEPCAFControl_Controller::Init();
  set_unit("xstep.cascade.unit", unit);
  set_unit("write.step.unit", unit);
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.product.name", product.c_str());

  const Handle(TDocStd_Document) document = new_document();
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const TDF_Label root = shapes->AddShape(shape, /*makeAssembly=*/false);
  TDataStd_Name::Set(root, product.c_str());

  STEPCAFControl_Writer writer;
  if (!writer.Transfer(document, STEPControl_AsIs)) throw std::runtime_error("the shape cannot be translated to STEP");
  const auto process = writer.ChangeWriter().WS()->TransferWriter()->FinderProcess();
  const auto faces = faces_of(shape);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const auto item = STEPConstruct::FindEntity(process, faces(i));
    if (item.IsNull()) throw std::runtime_error("a face was not translated to STEP");
    item->SetName(text(names.of(TopoDS::Face(faces(i)))));
  }
  fix_header(Handle(StepData_StepModel)::DownCast(writer.ChangeWriter().WS()->Model()), product);
  if (writer.Write(path.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot write '" + path + "'");
}

std::map<std::string, int> read_face_names(const std::string& path) {
  STEPCAFControl_Controller::Init();
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  Handle(TDocStd_Document) document = new_document();
  STEPCAFControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone || !reader.Transfer(document))
    throw std::runtime_error("cannot read back '" + path + "'");
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  TDF_LabelSequence roots;
  shapes->GetFreeShapes(roots);
  std::map<std::string, int> count;
  for (int r = 1; r <= roots.Length(); ++r) {
    const auto faces = faces_of(shapes->GetShape(roots(r)));
    for (int i = 1; i <= faces.Extent(); ++i) {
      TDF_Label label;
      Handle(TDataStd_Name) name;
      const bool found =
          shapes->FindSubShape(roots(r), faces(i), label) && label.FindAttribute(TDataStd_Name::GetID(), name);
      ++count[found ? TCollection_AsciiString(name->Get()).ToCString() : ""];
    }
  }
  return count;
}

}  // namespace aircraft
