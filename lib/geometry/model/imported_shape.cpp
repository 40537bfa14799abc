#include "geometry/model/imported_shape.h"

#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <map>

#include "base/error.h"

namespace st::occt {

bool ImportedShape::replace(const TopoDS_Shape& changed,
                            const std::function<TopoDS_Shape(const TopoDS_Shape&)>& image) {
  TopTools_IndexedMapOfShape new_faces;
  TopExp::MapShapes(changed, TopAbs_FACE, new_faces);
  if (new_faces.Extent() == 0) return false;
  std::vector<FaceAttributes> new_attributes(new_faces.Extent());
  for (int i = 1; i <= faces.Extent(); ++i)
    for (TopExp_Explorer e(image(faces(i)), TopAbs_FACE); e.More(); e.Next())
      if (const int k = new_faces.FindIndex(e.Current()); k > 0) new_attributes[k - 1] = attributes[i - 1];
  shape = changed;
  faces = new_faces;
  attributes = std::move(new_attributes);
  return true;
}

const Box3& ImportedShape::box() const {
  if (!boxed_.IsEqual(shape)) box_ = rough_box(boxed_ = shape);
  return box_;
}

std::string file_label(std::int32_t file_face) {
  return file_face == kNone ? "face that the import made" : "face " + std::to_string(file_face + 1) + " of the file";
}

namespace {

/// The first names, and how many more.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > kNamed ? text + " and " + std::to_string(names.size() - kNamed) + " more" : text;
}

}  // namespace

ImportedShape collect_parts(const CadFile& file, const std::string& path) {
  ImportedShape result;
  BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const auto& part : file.parts)
    if (!part.faces.empty()) builder.Add(compound, part.shape);
  result.shape = compound;
  TopExp::MapShapes(result.shape, TopAbs_FACE, result.faces);
  if (result.faces.Extent() == 0 && !file.missing_files.empty())
    throw Error(ExitCode::kGeometry, path + ": no face in the file; its parts are in files that are missing: " +
                                         listed(file.missing_files) + "; put them beside it, or export it as one file");
  if (result.faces.Extent() == 0)
    throw Error(ExitCode::kGeometry, path + ": no face in the file (" + file.format +
                                         "); export surfaces or solids, not wireframe or a mesh");
  result.attributes.resize(result.faces.Extent());
  for (const CadPart& part : file.parts) {
    std::map<std::string, std::int32_t> index_of_body;
    for (const auto& face : part.faces) {
      const auto [body, is_new] = index_of_body.emplace(face.body, static_cast<std::int32_t>(result.parts.size()));
      if (is_new)
        result.parts.push_back(
            {part.name, face.body.empty() || part.path.empty() ? part.path : part.path + "/" + face.body});
      if (const int i = result.faces.FindIndex(face.face); i > 0)
        result.attributes[i - 1] = {face.name, face.layer, part.name, face.color, body->second, false, kNone};
    }
    for (const auto& edge : part.edges) result.edge_names.emplace_back(edge.edge, edge.name);
  }
  for (std::size_t f = 0; f < result.attributes.size(); ++f)
    result.attributes[f].file_face = static_cast<std::int32_t>(f);
  return result;
}

}  // namespace st::occt
