// Module: STEP files with colours, layers, names of faces, assemblies or references to other files.
#include <Interface_Static.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_ExternFile.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/ids.h"
#include "geometry/import/part_names.h"
#include "geometry/import/text_encoding.h"
#include "geometry/reader/document_parts.h"
#include "geometry/reader/step_entities.h"

namespace st::occt {
namespace {

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

/// Files that the STEP file refers to and that could not be read.
std::vector<std::string> missing_files(const STEPCAFControl_Reader& reader) {
  std::set<std::string> names;
  for (NCollection_DataMap<TCollection_AsciiString, Handle(STEPCAFControl_ExternFile)>::Iterator i(
           reader.ExternFiles());
       i.More(); i.Next())
    if (i.Value()->GetLoadStatus() != IFSelect_RetDone) names.insert(valid_utf8(i.Key().ToCString()));
  return {names.begin(), names.end()};
}

}  // namespace

extern "C" void st_read_cad_file(const std::string& path, CadFile& file) {
  STEPCAFControl_Controller::Init();
  mend_loops_before_healing();
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  Interface_Static::SetCVal("read.step.codepage", step_codepage(file_encoding(path)));
  Handle(TDocStd_Document) document = new_document();
  STEPCAFControl_Reader reader;
  reader.SetNameMode(true);
  reader.SetColorMode(true);
  reader.SetLayerMode(true);
  // Parts in files of their own are looked for beside it, of a relative path in the wrong folder.
  read_step_file(std::filesystem::absolute(path), reader.ChangeReader());
  file.format = "STEP";
  read_step_units(reader.Reader().WS()->Model(), file);
  keep_names_beyond_ascii(reader.Reader().WS()->Model());
  if (!reader.Transfer(document))
    throw Error(
        ExitCode::kInput,
        path + ": no shape could be made of the STEP file; export surfaces or solids, not tessellated faces alone");
  refuse_scaled_parts(reader.Reader().WS(), path);
  file.missing_files = missing_files(reader);
  file.parts = document_parts(document);
  name_faces_by_entity(reader.Reader().WS(), file);
  read_senses(reader.Reader().WS(), file);
  find_unread(reader.Reader().WS(), file);
  close_document(document);
}

}  // namespace st::occt
