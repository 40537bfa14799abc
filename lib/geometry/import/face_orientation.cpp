#include "geometry/import/face_orientation.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/brep/face_integral.h"
#include "geometry/brep/occt_evaluators.h"

namespace st::occt {
namespace {

constexpr double kMostOpen = 0.5;    // of the area: the opening of a surface that has an inside
constexpr double kLeastBody = 1e-4;  // of the area to the power of 3/2: its volume
constexpr int kSamples = 16;         // of a free edge

/// A use of an edge by a face that belongs to no solid.
struct Use {
  int face;
  bool runs_forward;  // along the edge, the face oriented as it is
};

/// Faces that hang together across edges of two.
struct Component {
  std::vector<int> faces;
  std::vector<TopoDS_Edge> free_edges;  // oriented as their face uses them
  bool is_one_sided = false;
};

class FaceTurner {
 public:
  explicit FaceTurner(const ImportedShape& model) : model_(model) {
    const int n = model.faces.Extent();
    is_turned_.assign(n, 0);
    is_reversed_.assign(n, kUnseen);
    for (TopExp_Explorer e(model.shape, TopAbs_FACE, TopAbs_SOLID); e.More(); e.Next()) {
      char& own = is_reversed_[model.faces.FindIndex(e.Current()) - 1];
      if (own == kUnseen) own = e.Current().Orientation() == TopAbs_REVERSED;
    }
    for (TopExp_Explorer e(model.shape, TopAbs_SOLID); e.More(); e.Next())
      for (TopExp_Explorer f(e.Current(), TopAbs_FACE); f.More(); f.Next())
        is_reversed_[model.faces.FindIndex(f.Current()) - 1] = kUnseen;
    take_solids_that_disagree();
    is_in_shell_.assign(n, 0);
    for (TopExp_Explorer e(model.shape, TopAbs_SHELL); e.More(); e.Next())
      for (TopExp_Explorer f(e.Current(), TopAbs_FACE); f.More(); f.Next())
        is_in_shell_[model.faces.FindIndex(f.Current()) - 1] = 1;
    collect_uses();
  }

  void run() {
    std::vector<char> is_done(is_turned_.size(), 0);
    shell_.assign(is_turned_.size(), kNone);
    for (int f = 0; f < static_cast<int>(is_turned_.size()); ++f) {
      if (is_reversed_[f] == kUnseen || is_done[f]) continue;
      const Component component = flood(f, is_done);
      if (component.is_one_sided)
        for (const int face : component.faces) is_turned_[face] = 0;
      else
        turn(component);
      if (component.faces.size() > 1 && std::ranges::none_of(component.faces, [&](int g) { return is_in_shell_[g]; }))
        for (const int face : component.faces) shell_[face] = f;
    }
  }

  /// [n_faces] 1: to be turned.
  const std::vector<char>& is_turned() const { return is_turned_; }
  /// [n_faces] The first face of those with which it makes a shell; kNone: stays alone, or is in a shell.
  const std::vector<int>& shell() const { return shell_; }
  /// Whether faces in it may be turned.
  bool is_open_to_change(const TopoDS_Shape& solid) const { return solids_.Contains(solid); }
  bool is_in_solid(std::size_t f) const { return is_in_solid_[f] != 0; }
  /// After turning.
  bool points_back(std::size_t f) const { return is_turned_[f] != is_reversed_[f]; }

 private:
  static constexpr char kUnseen = 2;  // or in a solid

  TopoDS_Face face(int f) const { return TopoDS::Face(model_.faces(f + 1).Oriented(TopAbs_FORWARD)); }

  /// Solids with an edge that both its faces run along the same way, none of whose faces is in another one.
  void take_solids_that_disagree() {
    is_in_solid_.assign(is_reversed_.size(), 0);
    std::vector<int> n_sides(is_reversed_.size(), 0);
    for (TopExp_Explorer f(model_.shape, TopAbs_FACE); f.More(); f.Next())
      ++n_sides[model_.faces.FindIndex(f.Current()) - 1];
    for (TopExp_Explorer s(model_.shape, TopAbs_SOLID); s.More(); s.Next()) {
      if (!disagrees(s.Current(), n_sides)) continue;
      solids_.Add(s.Current());
      for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More(); f.Next()) {
        const int i = model_.faces.FindIndex(f.Current()) - 1;
        is_reversed_[i] = f.Current().Orientation() == TopAbs_REVERSED;
        is_in_solid_[i] = 1;
      }
    }
  }

  bool disagrees(const TopoDS_Shape& solid, const std::vector<int>& n_sides) const {
    TopTools_IndexedMapOfShape edges;
    std::vector<int> uses, turns;
    for (TopExp_Explorer f(solid, TopAbs_FACE); f.More(); f.Next()) {
      if (n_sides[model_.faces.FindIndex(f.Current()) - 1] > 1) return false;
      for (TopExp_Explorer e(f.Current(), TopAbs_EDGE); e.More(); e.Next()) {
        if (is_constraint(e.Current()) || BRep_Tool::Degenerated(TopoDS::Edge(e.Current()))) continue;
        const auto i = static_cast<std::size_t>(edges.Add(e.Current())) - 1;
        if (i == uses.size()) uses.push_back(0), turns.push_back(0);
        ++uses[i];
        turns[i] += e.Current().Orientation() == TopAbs_REVERSED ? -1 : 1;
      }
    }
    for (std::size_t i = 0; i < uses.size(); ++i)
      if (uses[i] == 2 && turns[i] != 0) return true;
    return false;
  }

  void collect_uses() {
    TopExp::MapShapes(model_.shape, TopAbs_EDGE, edges_);
    uses_.resize(edges_.Extent());
    for (int f = 0; f < static_cast<int>(is_reversed_.size()); ++f) {
      if (is_reversed_[f] == kUnseen) continue;
      for (TopExp_Explorer e(face(f), TopAbs_EDGE); e.More(); e.Next())
        if (!is_constraint(e.Current()) && !BRep_Tool::Degenerated(TopoDS::Edge(e.Current())))
          uses_[edges_.FindIndex(e.Current()) - 1].push_back(
              {f, (e.Current().Orientation() == TopAbs_FORWARD) != (is_reversed_[f] != 0)});
    }
  }

  /// Neighbours agree with `first`.
  Component flood(int first, std::vector<char>& is_done) {
    Component component{{first}, {}, false};
    is_done[first] = 1;
    for (std::size_t i = 0; i < component.faces.size(); ++i) {
      const int f = component.faces[i];
      for (TopExp_Explorer e(face(f), TopAbs_EDGE); e.More(); e.Next()) {
        const int at = edges_.FindIndex(e.Current()) - 1;
        const std::vector<Use>& uses = uses_[at];
        if (uses.size() == 1) component.free_edges.push_back(TopoDS::Edge(e.Current()));
        if (uses.size() != 2 || uses[0].face == uses[1].face) continue;
        const int g = uses[0].face == f ? uses[1].face : uses[0].face;
        const bool is_turned = (uses[0].runs_forward == uses[1].runs_forward) != (is_turned_[f] != 0);
        component.is_one_sided = component.is_one_sided || (is_done[g] && (is_turned_[g] != 0) != is_turned);
        if (is_done[g]) continue;
        is_done[g] = 1;
        is_turned_[g] = is_turned;
        component.faces.push_back(g);
      }
    }
    return component;
  }

  void turn(const Component& component) {
    bool has_turned = false;
    for (const int f : component.faces) has_turned = has_turned || is_turned_[f];
    if (component.free_edges.empty() && !has_turned) return;  // repair_shells() looks at what is closed
    const Opening opening = measure_opening(component);
    double area = 0, turned_area = 0, volume = 0;
    for (const int f : component.faces) {
      const FaceIntegral own = integrate_face(make_domain(face(f)), opening.center);
      area += std::fabs(own.area);
      if (is_turned_[f]) turned_area += std::fabs(own.area);
      volume += (points_back(f) ? -1 : 1) * own.volume;
    }
    const bool has_inside = !component.free_edges.empty() && norm(opening.area) <= kMostOpen * area &&
                            std::fabs(volume) > kLeastBody * std::pow(area, 1.5);
    if (has_inside ? volume < 0 : turned_area > 0.5 * area)
      for (const int f : component.faces) is_turned_[f] = !is_turned_[f];
  }

  /// What closes a component: of the cone over its free edges from their middle.
  struct Opening {
    Vec3 center, area;
  };

  Opening measure_opening(const Component& component) const {
    std::vector<std::vector<Vec3>> lines;
    Opening opening;
    double n = 0;
    for (const TopoDS_Edge& edge : component.free_edges) {
      double t0 = 0, t1 = 0;
      const Handle(Geom_Curve) c = BRep_Tool::Curve(edge, t0, t1);
      if (c.IsNull() || BRep_Tool::Degenerated(edge)) continue;
      const auto curve = make_curve(c, t0, t1);
      std::vector<Vec3>& line = lines.emplace_back();
      for (int k = 0; k <= kSamples; ++k) line.push_back(curve->point(t0 + (t1 - t0) * k / kSamples));
      const Use& use = uses_[edges_.FindIndex(edge) - 1][0];
      if (use.runs_forward == (is_turned_[use.face] != 0)) std::reverse(line.begin(), line.end());
      for (const Vec3& x : line) opening.center += x, ++n;
    }
    if (n > 0) opening.center = opening.center / n;
    for (const std::vector<Vec3>& line : lines)
      for (std::size_t k = 1; k < line.size(); ++k)
        opening.area += 0.5 * cross(line[k - 1] - opening.center, line[k] - opening.center);
    return opening;
  }

  const ImportedShape& model_;
  std::vector<char> is_turned_, is_reversed_, is_in_shell_, is_in_solid_;  // [n_faces]
  std::vector<int> shell_;                                                 // [n_faces]
  TopTools_MapOfShape solids_;
  TopTools_IndexedMapOfShape edges_;
  std::vector<std::vector<Use>> uses_;  // [n_edges]
};

/// Makes the shape again with faces turned, and faces that hang together in shells of their own.
class ShapeMaker {
 public:
  ShapeMaker(const ImportedShape& model, const FaceTurner& turner) : model_(model), turner_(turner) {
    for (std::size_t f = 0; f < turner.shell().size(); ++f) {
      const int first = turner.shell()[f];
      if (first == kNone) continue;
      if (!shells_.contains(first)) builder_.MakeShell(shells_[first]);
      const TopoDS_Shape face = model.faces(static_cast<int>(f) + 1);
      builder_.Add(shells_[first], face.Oriented(turner.points_back(f) ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
  }

  TopoDS_Shape run() const { return changed(model_.shape); }

 private:
  TopoDS_Shape changed(const TopoDS_Shape& shape) const {
    if (shape.ShapeType() == TopAbs_FACE) {
      const int f = model_.faces.FindIndex(shape) - 1, first = turner_.shell()[f];
      if (first != kNone) return first == f ? shells_.at(f) : TopoDS_Shell();
      return turner_.is_turned()[f] ? shape.Reversed() : shape;
    }
    if (shape.ShapeType() > TopAbs_FACE) return shape;
    if (shape.ShapeType() == TopAbs_SOLID && !turner_.is_open_to_change(shape)) return shape;
    TopoDS_Shape result = shape.EmptyCopied();
    result.Location(TopLoc_Location());
    for (TopoDS_Iterator child(shape); child.More(); child.Next())
      if (const TopoDS_Shape own = changed(child.Value()); !own.IsNull()) builder_.Add(result, own);
    result.Closed(shape.Closed());
    return result;
  }

  const ImportedShape& model_;
  const FaceTurner& turner_;
  BRep_Builder builder_;
  std::map<int, TopoDS_Shell> shells_;
};

}  // namespace

void orient_faces(ImportedShape& model, std::vector<ImportFinding>& findings) {
  FaceTurner turner(model);
  turner.run();
  std::size_t n[2] = {0, 0};  // outside solids, in solids
  for (std::size_t f = 0; f < turner.is_turned().size(); ++f)
    if (turner.is_turned()[f]) ++n[turner.is_in_solid(f)];
  if (n[0] + n[1] == 0 && std::ranges::all_of(turner.shell(), [](int first) { return first == kNone; })) return;
  model.replace(ShapeMaker(model, turner).run(), [](const TopoDS_Shape& face) { return face; });
  const char* const what[2] = {"faces of open surfaces turned: ", "faces of solids turned as their neighbours: "};
  for (const int k : {0, 1})
    if (n[k] > 0) findings.push_back({FindingKind::kOther, "", {}, 0, true, what[k] + std::to_string(n[k])});
}

}  // namespace st::occt
