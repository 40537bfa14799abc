#include "geometry/import/touching_bodies.h"

#include <BOPTools_AlgoTools.hxx>
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRep_Builder.hxx>
#include <IntTools_Context.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/boolean_child.h"
#include "geometry/import/solid_contacts.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr double kCpuSeconds = 60;  // for one attempt
constexpr int kAttempts = 3;

/// Solids that have common edges with others in the file, or are instances of one, are not joined alone.
void leave_out_sharers(const TopoDS_Shape& shape, std::set<int>& solids) {
  TopTools_IndexedMapOfShape numbers;
  TopExp::MapShapes(shape, TopAbs_SOLID, numbers);
  std::map<const TopoDS_TShape*, int> owner;
  for (int i = 1; i <= numbers.Extent(); ++i)
    for (TopExp_Explorer e(numbers(i), TopAbs_EDGE); e.More(); e.Next()) {
      const auto [it, is_new] = owner.emplace(e.Current().TShape().get(), i - 1);
      if (!is_new && it->second != i - 1) solids.erase(i - 1), solids.erase(it->second);
    }
}

/// Solids of `model` and what of it is followed through the operation: these, their faces, all named edges.
struct Fuse {
  std::vector<TopoDS_Shape> solids, faces, edges;
  std::vector<char> touches_itself;  ///< [solids] its faces are fused with each other, too
  std::vector<TopoDS_Shape> tracked() const {
    std::vector<TopoDS_Shape> all = solids;
    all.insert(all.end(), faces.begin(), faces.end());
    all.insert(all.end(), edges.begin(), edges.end());
    return all;
  }
};

/// The solid of what became of its faces.
TopoDS_Shape rebuilt(const TopoDS_Shape& solid, BRepAlgoAPI_BuilderAlgo& builder) {
  const Handle(IntTools_Context) context = new IntTools_Context;
  BRep_Builder make;
  TopoDS_Solid result;
  make.MakeSolid(result);
  for (TopExp_Explorer s(solid, TopAbs_SHELL); s.More(); s.Next()) {
    TopoDS_Shell shell;
    make.MakeShell(shell);
    for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More(); f.Next()) {
      const TopTools_ListOfShape& images = builder.Modified(f.Current());
      if (images.IsEmpty()) make.Add(shell, f.Current());
      for (const TopoDS_Shape& image : images) {
        const bool is_turned = BOPTools_AlgoTools::IsSplitToReverse(image, f.Current(), context);
        make.Add(shell, is_turned ? image.Reversed() : image);
      }
    }
    shell.Closed(true);
    make.Add(result, shell);
  }
  return result;
}

BooleanResult fuse(const Fuse& fuse) {
  BRepAlgoAPI_BuilderAlgo builder;
  TopTools_ListOfShape arguments;
  for (std::size_t i = 0; i < fuse.solids.size(); ++i) {
    if (!fuse.touches_itself[i]) arguments.Append(fuse.solids[i]);
    for (TopExp_Explorer e(fuse.solids[i], TopAbs_FACE); fuse.touches_itself[i] && e.More(); e.Next())
      arguments.Append(e.Current());
  }
  builder.SetArguments(arguments);
  builder.SetGlue(BOPAlgo_GlueShift);
  builder.Build();
  if (builder.HasErrors()) return {};
  BooleanResult result{builder.Shape(), {}};
  const std::vector<TopoDS_Shape> tracked = fuse.tracked();
  for (std::size_t k = 0; k < tracked.size(); ++k) {
    const TopoDS_Shape& shape = tracked[k];
    if (k < fuse.solids.size() && fuse.touches_itself[k]) {
      result.images.push_back(compound_of(std::vector<TopoDS_Shape>{rebuilt(shape, builder)}));
      continue;
    }
    result.images.push_back(image_of(builder, shape));
  }
  return result;
}

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return map.Extent();
}

/// Joins groups of solids, one after the other.
class TouchingSolids {
 public:
  TouchingSolids(ImportedShape& model, ModelOfFile& tables, std::vector<ImportFinding>& findings,
                 const std::string& path)
      : model_(model), tables_(tables), findings_(findings), path_(path) {
    TopExp::MapShapes(model.shape, TopAbs_SOLID, solids_);
  }

  void join(std::vector<int> group, const std::set<int>& self_touching) {
    std::string failure;
    for (int attempt = 0; attempt < kAttempts && !group.empty(); ++attempt) {
      const Fuse shapes = shapes_of(group, self_touching);
      const BooleanAttempt done = run_boolean([&] { return fuse(shapes); }, kCpuSeconds);
      if (failure = done.failure; !failure.empty()) break;
      std::set<int> spoiled;
      if (take_over(group, shapes, done.result, spoiled)) return;
      if (spoiled.empty()) return;  // they only seemed to touch
      failure = "it would change " + std::to_string(spoiled.size()) + " of them";
      std::erase_if(group, [&](int i) { return spoiled.count(i) > 0; });
    }
    const Box3 box = rough_box(solids_(group.empty() ? 1 : group.front() + 1));
    findings_.push_back({FindingKind::kTouchingApart, "", box.center(), box.diagonal(), false, failure});
  }

 private:
  Fuse shapes_of(const std::vector<int>& group, const std::set<int>& self_touching) const {
    Fuse shapes;
    TopTools_IndexedMapOfShape faces, edges;
    for (const int i : group) {
      shapes.solids.push_back(solids_(i + 1));
      shapes.touches_itself.push_back(self_touching.count(i) > 0);
      TopExp::MapShapes(solids_(i + 1), TopAbs_FACE, faces);
      TopExp::MapShapes(solids_(i + 1), TopAbs_EDGE, edges);
    }
    for (int i = 1; i <= faces.Extent(); ++i) shapes.faces.push_back(faces(i));
    for (const auto& [edge, name] : model_.edge_names)
      if (edges.Contains(edge)) shapes.edges.push_back(edge);
    return shapes;
  }

  /// False where nothing is gained, or `spoiled` solids of the group would not stay as they are.
  bool take_over(const std::vector<int>& group, const Fuse& shapes, const BooleanResult& result,
                 std::set<int>& spoiled) {
    for (std::size_t i = 0; i < group.size(); ++i)
      if (count(result.images[i], TopAbs_SOLID) != 1) spoiled.insert(group[i]);
    if (!spoiled.empty()) return false;
    ImportedShape joined = joined_model(shapes, result);
    const ModelOfFile tables = make_tables(joined, path_);
    spoiled = spoiled_solids(group, shapes, result, joined, tables);
    const int n_common = name_interfaces(shapes, result, joined);
    const int n_edges = tables_.tables.n_edges() - tables.tables.n_edges();
    if (!spoiled.empty() || (n_common == 0 && n_edges <= 0)) return false;
    const Box3 box = rough_box(result.shape);
    findings_.push_back({FindingKind::kJoinedBodies, "", box.center(), box.diagonal(), true,
                         std::to_string(group.size()) + " bodies have " + std::to_string(n_common) +
                             (n_common == 1 ? " common face" : " common faces")});
    model_ = std::move(joined);
    tables_ = make_tables(model_, path_);
    return true;
  }

  ImportedShape joined_model(const Fuse& shapes, const BooleanResult& result) const {
    TopTools_IndexedMapOfShape taken;  // solids at one place have one image
    const auto solid_image = [&](const TopoDS_Shape& solid) -> TopoDS_Shape {
      for (std::size_t i = 0; i < shapes.solids.size(); ++i) {
        if (!solid.IsSame(shapes.solids[i])) continue;
        const TopoDS_Shape image = TopExp_Explorer(result.images[i], TopAbs_SOLID).Current();
        if (taken.Contains(image)) return {};
        taken.Add(image);
        return image;
      }
      return solid;
    };
    std::map<int, const TopoDS_Shape*> face_image;  // by number in the model
    for (std::size_t i = 0; i < shapes.faces.size(); ++i)
      face_image[model_.faces.FindIndex(shapes.faces[i])] = &result.images[shapes.solids.size() + i];
    ImportedShape joined = model_;
    joined.replace(exchanged(model_.shape, solid_image), [&](const TopoDS_Shape& face) {
      const auto it = face_image.find(model_.faces.FindIndex(face));
      return it == face_image.end() ? face : *it->second;
    });
    joined.edge_names.clear();
    for (const auto& [edge, name] : model_.edge_names) {
      const auto is_same = [&of = edge](const TopoDS_Shape& e) { return e.IsSame(of); };
      const auto it = std::find_if(shapes.edges.begin(), shapes.edges.end(), is_same);
      if (it == shapes.edges.end()) {
        joined.edge_names.emplace_back(edge, name);
        continue;
      }
      const std::size_t at = shapes.solids.size() + shapes.faces.size() + (it - shapes.edges.begin());
      for (TopExp_Explorer e(result.images[at], TopAbs_EDGE); e.More(); e.Next())
        joined.edge_names.emplace_back(e.Current(), name);
    }
    return joined;
  }

  template <class Exchange>
  static TopoDS_Shape exchanged(const TopoDS_Shape& shape, const Exchange& exchange) {
    if (shape.ShapeType() == TopAbs_SOLID) return exchange(shape);
    if (shape.ShapeType() != TopAbs_COMPOUND && shape.ShapeType() != TopAbs_COMPSOLID) return shape;
    std::vector<TopoDS_Shape> children;
    for (TopoDS_Iterator child(shape); child.More(); child.Next())
      if (const TopoDS_Shape s = exchanged(child.Value(), exchange); !s.IsNull()) children.push_back(s);
    return compound_of(children);
  }

  /// Solids with a face whose pieces do not have its area, or a loop that crosses itself only now.
  std::set<int> spoiled_solids(const std::vector<int>& group, const Fuse& shapes, const BooleanResult& result,
                               const ImportedShape& joined, const ModelOfFile& tables) const {
    std::set<int> spoiled;
    for (std::size_t i = 0; i < shapes.faces.size(); ++i) {
      const FaceId f = model_.faces.FindIndex(shapes.faces[i]) - 1;
      double area = 0;
      bool is_sound = true;
      for (TopExp_Explorer e(result.images[shapes.solids.size() + i], TopAbs_FACE); e.More(); e.Next()) {
        const FaceId piece = joined.faces.FindIndex(e.Current()) - 1;
        is_sound = is_sound && piece >= 0 && (!tables.measures.crossing[piece] || tables_.measures.crossing[f]);
        if (piece >= 0) area += tables.tables.face_area[piece];
      }
      const double slack = kSameArea * tables_.tables.face_area[f];
      if (!is_sound || std::abs(area - tables_.tables.face_area[f]) > slack)
        for (const int solid : group)
          if (has_face(solids_(solid + 1), shapes.faces[i])) spoiled.insert(solid);
    }
    return spoiled;
  }

  static bool has_face(const TopoDS_Shape& solid, const TopoDS_Shape& face) {
    for (TopExp_Explorer e(solid, TopAbs_FACE); e.More(); e.Next())
      if (e.Current().IsSame(face)) return true;
    return false;
  }

  /// Faces that come from two: their number.
  int name_interfaces(const Fuse& shapes, const BooleanResult& result, ImportedShape& joined) const {
    std::map<int, std::vector<int>> originals;
    for (std::size_t i = 0; i < shapes.faces.size(); ++i)
      for (TopExp_Explorer e(result.images[shapes.solids.size() + i], TopAbs_FACE); e.More(); e.Next())
        if (const int k = joined.faces.FindIndex(e.Current()); k > 0)
          originals[k].push_back(model_.faces.FindIndex(shapes.faces[i]));
    int n = 0;
    for (const auto& [face, sides] : originals) {
      if (sides.size() < 2) continue;
      ++n;
      std::set<std::string> names;
      for (const int side : sides) {
        const FaceAttributes& a = model_.attributes[side - 1];
        names.insert(!a.name.empty() ? a.name : a.part);
      }
      names.erase("");
      std::string name = "interface";
      for (const std::string& side : names) name += "_" + side;
      joined.attributes[face - 1] = model_.attributes[sides.front() - 1];
      joined.attributes[face - 1].name = name;
    }
    return n;
  }

  ImportedShape& model_;
  ModelOfFile& tables_;
  std::vector<ImportFinding>& findings_;
  const std::string& path_;
  TopTools_IndexedMapOfShape solids_;  ///< before anything was joined
};

/// Solids that touch and have edges in common: the file has one edge there, and two faces that lie on each other.
void join_sharers(ImportedShape& model, ModelOfFile& model_tables, const std::set<int>& sharers,
                  std::vector<ImportFinding>& findings, const std::string& path) {
  if (sharers.empty()) return;
  std::vector<std::vector<int>> groups = find_touching_solids(model, model_tables.tables).groups;
  TouchingSolids solids(model, model_tables, findings, path);
  for (std::vector<int>& group : groups) {
    std::erase_if(group, [&](int i) { return sharers.count(i) == 0; });
    if (group.size() > 1) solids.join(group, {});
  }
}

}  // namespace

void join_touching_solids(ImportedShape& model, ModelOfFile& model_tables, const std::set<int>& left_out,
                          std::vector<ImportFinding>& findings, const std::string& path) {
  TouchingGroups touching = find_touching_solids(model, model_tables.tables);
  for (std::vector<int>& group : touching.groups) std::erase_if(group, [&](int i) { return left_out.count(i) > 0; });
  std::erase_if(touching.groups, [&](const std::vector<int>& group) {
    return group.empty() || (group.size() == 1 && touching.self_touching.count(group[0]) == 0);
  });
  if (touching.groups.empty()) return;
  TouchingSolids solids(model, model_tables, findings, path);
  for (const std::vector<int>& group : touching.groups) solids.join(group, touching.self_touching);
}

void join_self_touching_solids(ImportedShape& model, ModelOfFile& model_tables, const std::set<int>& left_out,
                               std::vector<ImportFinding>& findings, const std::string& path) {
  std::set<int> self_touching = find_self_touching(model, model_tables.tables);
  std::set<int> sharers = edge_sharers(model.shape);
  for (const int i : left_out) self_touching.erase(i), sharers.erase(i);
  leave_out_sharers(model.shape, self_touching);
  std::vector<ImportFinding> own;
  join_sharers(model, model_tables, sharers, own, path);
  if (!self_touching.empty()) {
    TouchingSolids solids(model, model_tables, own, path);
    for (const int i : self_touching) solids.join({i}, self_touching);
  }
  std::erase_if(own, [](const ImportFinding& f) { return f.kind == FindingKind::kTouchingApart; });  // nobody asked
  findings.insert(findings.end(), own.begin(), own.end());
}

}  // namespace st::occt
