#include "geometry/import/imprints.h"

#include <BOPTools_AlgoTools.hxx>
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <IntTools_Context.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "base/disjoint_sets.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/boolean_child.h"
#include "geometry/import/edge_places.h"
#include "geometry/import/face_probe.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr int kStations = 9;                     // along an edge, and both ways over a face,
constexpr double kRoom = 1.1;                    // times the largest distance measured: the fuzzy value
constexpr double kFuzzy[] = {1e-7, 1e-6, 1e-5};  // of the diagonal, at least: one after the other, while faces are left
                                                 // that lie on others
constexpr double kCpuSeconds = 10;               // for dividing
constexpr std::size_t kMostNamed = 3;            // faces on which one ends

/// A face that lies, or ends, on the inside of another.
struct Contact {
  int face = 0, on = 0;  ///< 1-based
  double distance = 0;   ///< the largest
};

/// Faces that have edges in common, group by group.
class FaceGroups {
 public:
  explicit FaceGroups(const ImportedShape& model) : first_(model.faces.Extent() + 1) {
    DisjointSets groups(model.faces.Extent() + 1);
    edge_faces_.emplace_back();
    for (int f = 1; f <= model.faces.Extent(); ++f)
      for (TopExp_Explorer e(model.faces(f), TopAbs_EDGE); e.More(); e.Next()) {
        const int i = edges_.Add(e.Current());
        if (i == static_cast<int>(edge_faces_.size())) edge_faces_.emplace_back();
        std::vector<int>& faces = edge_faces_[i];
        faces.push_back(f);  // twice for a seam
        groups.join(faces.front(), f);
      }
    for (int f = 0; f <= model.faces.Extent(); ++f) first_[f] = groups.find(f);
    for (const std::vector<int>& faces : edge_faces_)
      if (std::set<int>(faces.begin(), faces.end()).size() > 2) with_third_.insert(root(faces.front()));
  }

  int root(int face) const { return first_[face]; }
  /// And all faces that have an edge in common with one of them.
  std::set<int> with_neighbours(const std::set<int>& faces) const {
    std::set<int> result = faces;
    for (const std::vector<int>& of_edge : edge_faces_)
      if (std::any_of(of_edge.begin(), of_edge.end(), [&](int f) { return faces.count(f) > 0; }))
        result.insert(of_edge.begin(), of_edge.end());
    return result;
  }
  bool has_third_face(int face) const { return with_third_.count(root(face)) > 0; }
  int n_edges() const { return edges_.Extent(); }
  TopoDS_Edge edge(int i) const { return TopoDS::Edge(edges_(i)); }
  const std::vector<int>& faces_of(int i) const { return edge_faces_[i]; }

 private:
  std::vector<int> first_;  ///< face of a face's group
  TopTools_IndexedMapOfShape edges_;
  std::vector<std::vector<int>> edge_faces_;  ///< by 1-based edge
  std::set<int> with_third_;
};

class ContactSearch {
 public:
  ContactSearch(const ImportedShape& model, const FaceGroups& groups, double tolerance)
      : model_(model), groups_(groups), tolerance_(tolerance), probes_(model.faces.Extent() + 1) {
    for (int f = 1; f <= model.faces.Extent(); ++f) boxes_.push_back(rough_box(model.faces(f)));
  }

  std::vector<Contact> find(Imprints which) {
    std::vector<Contact> found;
    for (int i = 1; i <= groups_.n_edges(); ++i) {
      const std::vector<int>& own = groups_.faces_of(i);
      if (own.size() != 1 || BRep_Tool::Degenerated(groups_.edge(i))) continue;
      add_contacts(own.front(), stations_of(groups_.edge(i)), found);
    }
    for (int f = 1; f <= model_.faces.Extent(); ++f)
      if (which == Imprints::kEdgesAndFaces && groups_.has_third_face(f)) add_contacts(f, probe(f).samples(), found);
    return found;
  }

 private:
  static std::vector<Vec3> stations_of(const TopoDS_Edge& edge) {
    double t0, t1;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
    std::vector<Vec3> at;
    for (int k = 1; k <= kStations && !curve.IsNull(); ++k)
      at.push_back(vec(curve->Value(t0 + (t1 - t0) * k / (kStations + 1))));
    return at;
  }

  void add_contacts(int face, const std::vector<Vec3>& at, std::vector<Contact>& found) {
    for (int f = 1; f <= model_.faces.Extent(); ++f) {
      if (f == face || !may_lie_on(boxes_[f - 1], at, tolerance_)) continue;
      if (const std::optional<double> distance = probe(f).distance_of(at)) found.push_back({face, f, *distance});
    }
  }

  FaceProbe& probe(int f) {
    if (!probes_[f])
      probes_[f] = std::make_unique<FaceProbe>(TopoDS::Face(model_.faces(f).Oriented(TopAbs_FORWARD)), tolerance_);
    return *probes_[f];
  }

  const ImportedShape& model_;
  const FaceGroups& groups_;
  double tolerance_;
  std::vector<Box3> boxes_;
  std::vector<std::unique_ptr<FaceProbe>> probes_;  ///< by 1-based face, made when first asked
};

/// What is divided, and what has edges in common with it.
struct Task {
  std::vector<int> divided;  ///< faces, 1-based, ascending, and their neighbours, which get their new edges
  std::vector<int> all;      ///< of all their groups
  std::vector<TopoDS_Shape> edges;
  double fuzzy = 0;
};

TopoDS_Shape forward(const TopoDS_Shape& shape) { return shape.Oriented(TopAbs_FORWARD); }

/// Edges and vertices of `arguments` stand for what the operation made of them in all other faces, too.
void replace_parts(const TopoDS_Shape& arguments, BRepAlgoAPI_BuilderAlgo& builder,
                   const Handle(BRepTools_ReShape) & reshape) {
  const Handle(IntTools_Context) context = new IntTools_Context;
  for (const TopAbs_ShapeEnum kind : {TopAbs_EDGE, TopAbs_VERTEX}) {
    TopTools_IndexedMapOfShape parts;
    TopExp::MapShapes(arguments, kind, parts);
    for (int i = 1; i <= parts.Extent(); ++i) {
      const TopoDS_Shape part = forward(parts(i));
      std::vector<TopoDS_Shape> images;
      for (const TopoDS_Shape& image : builder.Modified(part)) {
        const bool is_turned =
            kind == TopAbs_EDGE && BOPTools_AlgoTools::IsSplitToReverse(forward(image), part, context);
        images.push_back(image.Oriented(is_turned ? TopAbs_REVERSED : TopAbs_FORWARD));
      }
      if (images.empty() || (images.size() == 1 && images[0].IsSame(part))) continue;
      reshape->Replace(part, images.size() == 1 ? images[0] : TopoDS_Shape(compound_of(images)));
    }
  }
}

/// The faces of `task.all`, the divided ones in their parts; images of all these, then of the edges.
BooleanResult divide(const ImportedShape& model, const Task& task) {
  BRepAlgoAPI_BuilderAlgo builder;
  TopTools_ListOfShape arguments;
  for (const int f : task.divided) arguments.Append(forward(model.faces(f)));
  builder.SetArguments(arguments);
  builder.SetGlue(BOPAlgo_GlueShift);
  builder.SetFuzzyValue(task.fuzzy);
  builder.Build();
  if (builder.HasErrors()) throw std::runtime_error("OpenCASCADE cannot divide them");
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  replace_parts(compound_of(arguments), builder, reshape);
  BooleanResult result;
  std::vector<TopoDS_Shape> faces;
  const auto is_divided = [&](int f) { return std::binary_search(task.divided.begin(), task.divided.end(), f); };
  for (const int f : task.all) {
    const TopoDS_Shape face = forward(model.faces(f));
    result.images.push_back(is_divided(f) ? image_of(builder, face)
                                          : compound_of(std::vector<TopoDS_Shape>{reshape->Apply(face)}));
    faces.push_back(result.images.back());
  }
  for (const TopoDS_Shape& edge : task.edges) result.images.push_back(image_of(builder, edge));
  result.shape = compound_of(faces);
  return result;
}

std::string label(const ImportedShape& model, int face) {
  const FaceAttributes& a = model.attributes[face - 1];
  const std::string& name = a.name.empty() ? a.part : a.name;
  const std::string number = "face " + std::to_string(face);
  return name.empty() ? number : number + " \"" + name + "\"";
}

/// One finding for each face with such edges; `why`: the cause where they are not joined.
void say(const ImportedShape& model, const std::vector<Contact>& contacts, const std::string& why,
         std::vector<ImportFinding>& findings) {
  std::map<int, std::set<int>> ends;
  for (const Contact& c : contacts) ends[c.face].insert(c.on);
  for (const auto& [face, on] : ends) {
    std::string names;
    std::size_t n = 0;
    for (const int f : on)
      if (n++ < kMostNamed) names += (names.empty() ? "" : ", ") + label(model, f);
    if (n > kMostNamed) names += " and " + std::to_string(n - kMostNamed) + " more";
    const Box3 box = rough_box(model.faces(face));
    findings.push_back({why.empty() ? FindingKind::kImprint : FindingKind::kNoImprint, label(model, face), box.center(),
                        box.diagonal(), why.empty(), why.empty() ? names : names + ": " + why});
  }
}

/// Solids with more than one shell.
std::set<int> faces_around_voids(const ImportedShape& model) {
  std::set<int> faces;
  for (TopExp_Explorer s(model.shape, TopAbs_SOLID); s.More(); s.Next()) {
    if (s.Current().NbChildren() < 2) continue;
    for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More(); f.Next())
      faces.insert(model.faces.FindIndex(f.Current()));
  }
  return faces;
}

Task task_of(const ImportedShape& model, const FaceGroups& groups, const std::vector<Contact>& contacts,
             double least_fuzzy) {
  Task task;
  std::set<int> divided, roots;
  for (const Contact& c : contacts) {
    for (const int f : {c.face, c.on}) divided.insert(f), roots.insert(groups.root(f));
    task.fuzzy = std::max(task.fuzzy, kRoom * c.distance);
  }
  task.fuzzy = std::max(task.fuzzy, least_fuzzy);
  for (const int f : groups.with_neighbours(divided)) task.divided.push_back(f);
  for (int f = 1; f <= model.faces.Extent(); ++f)
    if (roots.count(groups.root(f)) > 0) task.all.push_back(f);
  for (const auto& [edge, name] : model.edge_names) task.edges.push_back(edge);
  return task;
}

struct Shared {
  int n_faces = 0, n_third = 0;  ///< different faces; edges with three sides of faces and more
};

Shared shared_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces, edges;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  const std::vector<int> sides = edge_sides(shape, edges);
  const auto n_third = std::count_if(sides.begin(), sides.end(), [](int n) { return n > 2; });
  return {faces.Extent(), static_cast<int>(n_third)};
}

/// Why the result cannot be taken; empty where it can.
std::string fault_of(const ImportedShape& model, const Task& task, const BooleanResult& result) {
  std::vector<TopoDS_Shape> before;
  for (const int f : task.all) before.push_back(model.faces(f));
  for (std::size_t k = 0; k < task.all.size(); ++k) {
    const double was = area_of_faces(before[k]);
    if (std::abs(area_of_faces(result.images[k]) - was) > kSameArea * was)
      return "it would change the area of " + label(model, task.all[k]);
  }
  const Shared now = shared_of(result.shape), was = shared_of(compound_of(before));
  return now.n_third > was.n_third || now.n_faces < was.n_faces ? "" : "OpenCASCADE finds nothing in common";
}

/// The model with the faces of the task as they are now.
void take_over(ImportedShape& model, const Task& task, const BooleanResult& result) {
  const auto place = [&](const TopoDS_Shape& face) {
    const auto at = std::lower_bound(task.all.begin(), task.all.end(), model.faces.FindIndex(face));
    return at != task.all.end() && *at == model.faces.FindIndex(face) ? static_cast<int>(at - task.all.begin()) : -1;
  };
  std::vector<TopoDS_Shape> now, pieces;
  TopTools_IndexedMapOfShape seen;
  for (std::size_t k = 0; k < task.all.size(); ++k)
    for (TopExp_Explorer f(result.images[k], TopAbs_FACE); f.More(); f.Next())
      if (!seen.Contains(f.Current())) now.push_back(seen(seen.Add(f.Current())));
  bool is_placed = false;
  for (const TopoDS_Shape& piece : pieces_of(model.shape)) {
    if (place(TopExp_Explorer(piece, TopAbs_FACE).Current()) < 0) {
      pieces.push_back(piece);
    } else if (!is_placed) {
      const std::vector<TopoDS_Shape> shells = shells_of(now);
      pieces.insert(pieces.end(), shells.begin(), shells.end());
      is_placed = true;
    }
  }
  std::vector<std::pair<TopoDS_Shape, std::string>> names;
  for (std::size_t k = 0; k < model.edge_names.size(); ++k)
    for (TopExp_Explorer e(result.images[task.all.size() + k], TopAbs_EDGE); e.More(); e.Next())
      names.emplace_back(e.Current(), model.edge_names[k].second);
  model.replace(compound_of(pieces), [&](const TopoDS_Shape& face) -> TopoDS_Shape {
    const int k = place(face);
    return k < 0 ? face : result.images[k];
  });
  model.edge_names = std::move(names);
}

std::vector<Contact> find_contacts(const ImportedShape& model, const FaceGroups& groups, Imprints which,
                                   double tolerance) {
  try {
    std::vector<Contact> contacts = ContactSearch(model, groups, tolerance).find(which);
    const std::set<int> with_voids = faces_around_voids(model);
    std::erase_if(contacts,
                  [&](const Contact& c) { return with_voids.count(c.face) > 0 || with_voids.count(c.on) > 0; });
    return contacts;
  } catch (const Standard_Failure&) {  // a face that cannot be measured: later stages judge
    return {};
  }
}

}  // namespace

bool imprint_faces(ImportedShape& model, Imprints which, double tolerance, std::vector<ImportFinding>& findings) {
  const double diagonal = model.box().diagonal();
  bool is_changed = false;
  for (const double fuzzy : kFuzzy) {
    const FaceGroups groups(model);
    const std::vector<Contact> contacts = find_contacts(model, groups, which, tolerance);
    if (contacts.empty()) break;
    const Task task = task_of(model, groups, contacts, fuzzy * diagonal);
    const BooleanAttempt done = run_boolean([&] { return divide(model, task); }, kCpuSeconds);
    const std::string fault = done.failure.empty() ? fault_of(model, task, done.result) : done.failure;
    if (!fault.empty() && fuzzy < kFuzzy[std::size(kFuzzy) - 1]) continue;
    if (!is_changed || !fault.empty()) say(model, contacts, fault, findings);
    if (!fault.empty()) break;
    take_over(model, task, done.result);
    is_changed = true;
  }
  return is_changed;
}

}  // namespace st::occt
