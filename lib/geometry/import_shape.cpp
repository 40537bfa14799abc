#include "geometry/import_shape.h"

#include <BRepBndLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <map>
#include <sstream>

#include "base/error.h"

namespace st::occt {

bool ImportedShape::replace(const TopoDS_Shape& changed, const std::function<TopoDS_Shape(const TopoDS_Shape&)>& image) {
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

ImportedShape collect_parts(const CadFile& file, const std::string& path) {
  ImportedShape result;
  BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const auto& part : file.parts)
    if (!part.faces.empty()) builder.Add(compound, part.shape);
  result.shape = compound;
  TopExp::MapShapes(result.shape, TopAbs_FACE, result.faces);
  if (result.faces.Extent() == 0)
    throw Error(ExitCode::kGeometry,
                path + ": no face in the file (" + file.format + "); export surfaces or solids, not wireframe or a mesh");
  result.attributes.resize(result.faces.Extent());
  for (const CadPart& part : file.parts) {
    std::map<std::string, std::int32_t> index_of_body;
    for (const auto& face : part.faces) {
      const auto [body, is_new] = index_of_body.emplace(face.body, static_cast<std::int32_t>(result.parts.size()));
      if (is_new) result.parts.push_back({part.name, face.body.empty() || part.path.empty() ? part.path : part.path + "/" + face.body});
      if (const int i = result.faces.FindIndex(face.face); i > 0)
        result.attributes[i - 1] = {face.name, face.layer, part.name, face.color, body->second};
    }
    for (const auto& edge : part.edges) result.edge_names.emplace_back(edge.edge, edge.name);
  }
  return result;
}

Box3 rough_box(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  Box3 result;
  if (box.IsVoid()) return result;
  result.add(vec(box.CornerMin()));
  result.add(vec(box.CornerMax()));
  return result;
}

bool is_constraint(const TopoDS_Shape& edge) { return edge.Orientation() == TopAbs_INTERNAL || edge.Orientation() == TopAbs_EXTERNAL; }

std::vector<int> edge_uses(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& edges) {
  edges.Clear();
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<int> uses(edges.Extent(), 0);
  for (int f = 1; f <= faces.Extent(); ++f)
    for (TopExp_Explorer e(faces(f).Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next())
      if (!is_constraint(e.Current())) ++uses[edges.FindIndex(e.Current()) - 1];
  return uses;
}

int count_free_edges(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(shape, edges);
  int n = 0;
  for (int i = 0; i < edges.Extent(); ++i) n += uses[i] == 1 && !BRep_Tool::Degenerated(TopoDS::Edge(edges(i + 1)));
  return n;
}

double max_edge_tolerance(const TopoDS_Shape& shape) {
  double tolerance = 0;
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next())
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(e.Current())));
  return tolerance;
}

std::string format_number(double x) {
  std::ostringstream s;
  s.precision(4);
  s << x;
  return s.str();
}

}  // namespace st::occt
