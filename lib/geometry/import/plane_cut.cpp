#include "geometry/import/plane_cut.h"

#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pln.hxx>
#include <limits>
#include <map>
#include <stdexcept>

#include "base/axis.h"
#include "base/disjoint_sets.h"
#include "base/error.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/boolean_child.h"
#include "geometry/import/edge_places.h"
#include "geometry/import/face_probe.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr int kIntervals = 10;                   // of an edge
constexpr double kFuzzy[] = {1e-6, 1e-5, 1e-7};  // of the diagonal, one after the other until the parts are sound
constexpr double kCpuSeconds = 60;               // for dividing

TopoDS_Shape forward(const TopoDS_Shape& shape) { return shape.Oriented(TopAbs_FORWARD); }

/// Smallest and largest height of points over the plane.
struct Reach {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
  void add(double height) {
    lo = std::min(lo, height);
    hi = std::max(hi, height);
  }
  PlaneSide side(double tolerance) const {
    const bool is_below = lo<-tolerance, is_above = hi> tolerance;
    return is_below && is_above ? PlaneSide::kBoth
           : is_below           ? PlaneSide::kBelow
           : is_above           ? PlaneSide::kAbove
                                : PlaneSide::kIn;
  }
};

void add_edge(const TopoDS_Edge& edge, const SymmetryPlane& plane, Reach& reach) {
  double t0, t1;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  for (int k = 0; k <= kIntervals && !curve.IsNull(); ++k)
    reach.add(component(vec(curve->Value(t0 + (t1 - t0) * k / kIntervals)), plane.axis) - plane.value);
}

PlaneSide side_of(const TopoDS_Face& face, const SymmetryPlane& plane, double tolerance) {
  Reach reach;
  const Box3 box = rough_box(face);
  const double lo = component(box.lo, plane.axis) - plane.value, hi = component(box.hi, plane.axis) - plane.value;
  if (lo > tolerance) return PlaneSide::kAbove;
  if (hi < -tolerance) return PlaneSide::kBelow;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) add_edge(TopoDS::Edge(e.Current()), plane, reach);
  for (const Vec3 p : FaceProbe(face, tolerance).samples()) reach.add(component(p, plane.axis) - plane.value);
  return reach.side(tolerance);
}

TopoDS_Shape large_face(const ImportedShape& model, const SymmetryPlane& plane) {
  const double reach = model.box().diagonal();
  gp_XYZ normal(0, 0, 0);
  normal.SetCoord(plane.axis + 1, 1);
  const Vec3 middle = model.box().center();
  gp_XYZ origin(middle.x, middle.y, middle.z);
  origin.SetCoord(plane.axis + 1, plane.value);
  return BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(origin), gp_Dir(normal)), -reach, reach, -reach, reach).Shape();
}

/// Faces that have vertices in common, group by group: what bodies that touch have at one place stays apart.
std::vector<std::vector<int>> connected_faces(const ImportedShape& model) {
  DisjointSets sets(model.faces.Extent() + 1);
  TopTools_IndexedMapOfShape vertices;
  std::vector<int> first{0};  // face of each vertex
  for (int f = 1; f <= model.faces.Extent(); ++f)
    for (TopExp_Explorer v(model.faces(f), TopAbs_VERTEX); v.More(); v.Next()) {
      const auto i = static_cast<std::size_t>(vertices.Add(v.Current()));
      if (i == first.size()) first.push_back(f);
      sets.join(first[i], f);
    }
  std::map<int, std::vector<int>> groups;
  for (int f = 1; f <= model.faces.Extent(); ++f) groups[sets.find(f)].push_back(f);
  std::vector<std::vector<int>> result;
  for (auto& [root, faces] : groups) result.push_back(std::move(faces));
  return result;
}

/// All faces, divided at the plane; images of them, then of the edges that have names. The faces of a group are one
/// argument: they are not compared with each other.
BooleanResult divide(const ImportedShape& model, const SymmetryPlane& plane, double fuzzy) {
  BooleanResult result;
  for (int f = 1; f <= model.faces.Extent(); ++f)
    result.images.push_back(compound_of(std::vector<TopoDS_Shape>{forward(model.faces(f))}));
  for (const auto& [edge, name] : model.edge_names)
    result.images.push_back(compound_of(std::vector<TopoDS_Shape>{edge}));
  const std::vector<PlaneSide> sides = sides_of(model, plane, fuzzy);
  for (const std::vector<int>& group : connected_faces(model)) {
    if (std::none_of(group.begin(), group.end(), [&](int f) { return sides[f - 1] == PlaneSide::kBoth; })) continue;
    std::vector<TopoDS_Shape> faces;
    for (const int f : group) faces.push_back(forward(model.faces(f)));
    TopTools_ListOfShape arguments, tools;
    arguments.Append(compound_of(faces));
    tools.Append(large_face(model, plane));
    BRepAlgoAPI_Splitter splitter;
    splitter.SetArguments(arguments);
    splitter.SetTools(tools);
    splitter.SetNonDestructive(true);
    splitter.SetFuzzyValue(fuzzy);
    splitter.Build();
    if (!splitter.IsDone() || splitter.HasErrors()) throw std::runtime_error("OpenCASCADE cannot divide it");
    for (std::size_t k = 0; k < group.size(); ++k) result.images[group[k] - 1] = image_of(splitter, faces[k]);
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(arguments.First(), TopAbs_EDGE, edges);
    for (std::size_t k = 0; k < model.edge_names.size(); ++k)
      if (const TopoDS_Shape& edge = model.edge_names[k].first; edges.Contains(edge))
        result.images[model.faces.Extent() + k] = image_of(splitter, edge);
  }
  const auto first_edge = result.images.begin() + model.faces.Extent();
  result.shape = compound_of(std::vector<TopoDS_Shape>(result.images.begin(), first_edge));
  return result;
}

/// The model made of the parts.
ImportedShape taken(const ImportedShape& model, const BooleanResult& result) {
  ImportedShape divided = model;
  const auto image = [&](const TopoDS_Shape& face) { return result.images[model.faces.FindIndex(face) - 1]; };
  const TopoDS_Shape shape = with_faces(model.shape, [&](const TopoDS_Shape& face) {
    std::vector<TopoDS_Shape> parts;
    for (TopExp_Explorer f(image(face), TopAbs_FACE); f.More(); f.Next()) parts.push_back(f.Current());
    return parts;
  });
  divided.replace(shape, image);
  divided.edge_names.clear();
  for (std::size_t k = 0; k < model.edge_names.size(); ++k)
    for (TopExp_Explorer e(result.images[model.faces.Extent() + k], TopAbs_EDGE); e.More(); e.Next())
      divided.edge_names.emplace_back(e.Current(), model.edge_names[k].second);
  return divided;
}

/// Why the parts cannot be taken; empty where they can.
std::string fault_of(const ImportedShape& model, const BooleanResult& result, const ImportedShape& divided,
                     const SymmetryPlane& plane, double tolerance) {
  for (int f = 1; f <= model.faces.Extent(); ++f) {
    const double was = area_of_faces(model.faces(f));
    if (std::abs(area_of_faces(result.images[f - 1]) - was) > kSameArea * was)
      return "it would change the area of " + model.file_label(f);
  }
  if (const int n_free = count_free_edges(divided.shape); n_free > 0 && count_free_edges(model.shape) == 0)
    return std::to_string(n_free) + " edges would be free";
  const std::vector<PlaneSide> sides = sides_of(divided, plane, tolerance);
  const auto left = std::find(sides.begin(), sides.end(), PlaneSide::kBoth);
  if (left == sides.end()) return "";
  return divided.file_label(static_cast<int>(left - sides.begin()) + 1) + " still is on both sides";
}

}  // namespace

std::vector<PlaneSide> sides_of(const ImportedShape& model, const SymmetryPlane& plane, double tolerance) {
  std::vector<PlaneSide> sides;
  for (int f = 1; f <= model.faces.Extent(); ++f)
    sides.push_back(side_of(TopoDS::Face(forward(model.faces(f))), plane, tolerance));
  return sides;
}

bool lies_in(const TopoDS_Shape& edge, const SymmetryPlane& plane, double tolerance) {
  Reach reach;
  add_edge(TopoDS::Edge(edge), plane, reach);
  return reach.side(tolerance) == PlaneSide::kIn && reach.lo <= reach.hi;
}

TopoDS_Shape with_faces(const TopoDS_Shape& shape,
                        const std::function<std::vector<TopoDS_Shape>(const TopoDS_Shape&)>& now) {
  const BRep_Builder builder;
  const auto add_faces = [&](const TopoDS_Shape& from, TopoDS_Shape& to) {
    for (TopExp_Explorer f(from, TopAbs_FACE); f.More(); f.Next())
      for (const TopoDS_Shape& face : now(forward(f.Current())))
        builder.Add(to, f.Current().Orientation() == TopAbs_REVERSED ? face.Reversed() : face);
  };
  const auto shell_of = [&](const TopoDS_Shape& from) {
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    add_faces(from, shell);
    shell.Closed(BRep_Tool::IsClosed(shell));
    return shell;
  };
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& piece : pieces_of(shape)) {
    TopoDS_Shape made;
    if (piece.ShapeType() == TopAbs_FACE) {
      add_faces(piece, all);
      continue;
    }
    if (piece.ShapeType() == TopAbs_SHELL) {
      made = shell_of(piece);
    } else {
      made = TopoDS_Solid();
      builder.MakeSolid(TopoDS::Solid(made));
      for (TopExp_Explorer s(piece, TopAbs_SHELL); s.More(); s.Next())
        if (const TopoDS_Shell shell = shell_of(s.Current()); shell.NbChildren() > 0) builder.Add(made, shell);
    }
    if (made.NbChildren() > 0) builder.Add(all, made);
  }
  return all;
}

int cut_at_plane(ImportedShape& model, const SymmetryPlane& plane, double diagonal, const std::string& path) {
  const std::vector<PlaneSide> sides = sides_of(model, plane, kInSymmetryPlane * diagonal);
  const auto n_both = std::count(sides.begin(), sides.end(), PlaneSide::kBoth);
  if (n_both == 0) return 0;
  std::string fault;
  for (const double fuzzy : kFuzzy) {
    const BooleanAttempt done = run_boolean([&] { return divide(model, plane, fuzzy * diagonal); }, kCpuSeconds);
    fault = done.failure;
    if (!fault.empty()) continue;
    ImportedShape divided = taken(model, done.result);
    fault = fault_of(model, done.result, divided, plane, kInSymmetryPlane * diagonal);
    if (!fault.empty()) continue;
    model = std::move(divided);
    return static_cast<int>(n_both);
  }
  throw Error(ExitCode::kGeometry, path + ": the model cannot be divided at the mirror's plane: " + fault +
                                       "; divide it there in the CAD system");
}

}  // namespace st::occt
