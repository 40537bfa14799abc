#include "geometry/import/part_names.h"

#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <algorithm>
#include <map>
#include <utility>

#include "base/face_labels.h"

namespace st::occt {

bool is_junk(const std::string& name) {
  return name.empty() || name == "NONE" || name == "FACE" || name == "''" || name == " " || name == "SHELL" ||
         name == "SOLID" || name == "COMPOUND" || name == "EDGE" || name.rfind("=>", 0) == 0;  // "=>[0:1:1:2]": XCAF's
                                                                                               // word for an instance
                                                                                               // without a name
}

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

void name_bodies(const TopoDS_Shape& shape, const std::function<std::string(const TopoDS_Shape& solid)>& name_of,
                 CadPart& part) {
  TopTools_IndexedMapOfShape solids, faces;
  TopExp::MapShapes(shape, TopAbs_SOLID, solids);
  if (solids.Extent() < 2) return;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<std::string> names;
  for (int i = 1; i <= solids.Extent(); ++i) {
    const std::string name = name_of(solids(i));
    names.push_back(name.empty() ? "body" : name);
  }
  names = numbered_names(std::move(names));
  for (int i = 1; i <= solids.Extent(); ++i)
    for (TopExp_Explorer e(solids(i), TopAbs_FACE); e.More(); e.Next())
      if (auto& face = part.faces[faces.FindIndex(e.Current()) - 1]; face.body.empty()) face.body = names[i - 1];
}

}  // namespace st::occt
