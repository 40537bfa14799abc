// Module: IGES files.
#include <IGESBasic_Name.hxx>
#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "geometry/import/part_names.h"
#include "geometry/import/text_encoding.h"
#include "geometry/reader/document_parts.h"
#include "geometry/reader/step_entities.h"

namespace st::occt {
namespace {

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

/// OpenCASCADE leaves out what is placed with a scale. Throws Error(kGeometry) where a file does so.
void refuse_scaled_instances(const Handle(Interface_InterfaceModel) & model, const std::string& path) {
  constexpr double kSame = 1e-9;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto instance = Handle(IGESBasic_SingularSubfigure)::DownCast(model->Value(i));
    if (!instance.IsNull() && instance->HasScaleFactor() && std::abs(instance->ScaleFactor() - 1) > kSame)
      fail_at_scale(path, instance->ScaleFactor());
  }
}

}  // namespace

extern "C" void st_read_cad_file(const std::string& path, CadFile& file) {
  IGESControl_Controller::Init();
  mend_loops_before_healing();
  Handle(TDocStd_Document) document = new_document();
  IGESCAFControl_Reader reader;
  reader.SetNameMode(true);
  reader.SetColorMode(true);
  reader.SetLayerMode(true);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    throw Error(ExitCode::kInput, path + ": the IGES file cannot be parsed; export the model again");
  file.format = "IGES";
  const auto model = Handle(IGESData_IGESModel)::DownCast(reader.WS()->Model());
  file.unit_in_mm = model->GlobalSection().UnitValue();
  file.resolution_mm = model->GlobalSection().Resolution() * model->GlobalSection().UnitValue();
  if (!(*file.unit_in_mm > 0)) file.unit_in_mm = 1.0;
  refuse_scaled_instances(model, path);
  if (!reader.Transfer(document))
    throw Error(ExitCode::kInput, path + ": no shape could be made of the IGES file; export the model again");
  file.parts = document_parts(document);
  name_by_iges_property(reader.WS(), file_encoding(path), file);
  close_document(document);
}

}  // namespace st::occt
