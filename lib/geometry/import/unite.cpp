#include "geometry/import/unite.h"

#include <BRepAlgoAPI_Fuse.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>

#include "base/boxes.h"
#include "base/progress.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/boolean_child.h"
#include "geometry/import/plane_loops.h"

namespace st::occt {
namespace {

constexpr double kFuzzy[] = {0, 1e-6, 1e-5, 1e-4};  // of the diagonal of both, the first that gives a sound union
constexpr double kVolume = 1e-4;                    // relative slack of volumes
constexpr double kCpuSeconds = 15;                  // for one attempt

/// Solids that are one by now.
struct Body {
  TopoDS_Shape solid;
  Box3 box;
  std::set<std::string> names;
  double volume = 0;
  bool is_gone = false;  ///< in another one
};

std::string words(const std::set<std::string>& names) {
  constexpr std::size_t kShown = 3;
  std::string text;
  std::size_t n = 0;
  for (const std::string& name : names)
    if (n++ < kShown) text += (text.empty() ? "" : ", ") + name;
  return names.size() > kShown ? text + " ..." : text;
}

/// One solid, or nothing where the two are apart; throws where the union is not sound.
BooleanResult fuse(const Body& a, const Body& b, const std::vector<TopoDS_Shape>& tracked, double fuzzy) {
  BRepAlgoAPI_Fuse fuse;
  TopTools_ListOfShape arguments, tools;
  arguments.Append(a.solid);
  tools.Append(b.solid);
  fuse.SetArguments(arguments);
  fuse.SetTools(tools);
  fuse.SetFuzzyValue(fuzzy);
  fuse.Build();
  if (!fuse.IsDone() || fuse.HasErrors()) throw std::runtime_error("OpenCASCADE cannot unite them");
  std::vector<TopoDS_Shape> solids;
  for (TopExp_Explorer e(fuse.Shape(), TopAbs_SOLID); e.More(); e.Next()) solids.push_back(e.Current());
  if (solids.empty()) throw std::runtime_error("their union has no solid");
  if (count_free_edges(fuse.Shape()) > 0) throw std::runtime_error("their union is open");
  const double volume = volume_of(fuse.Shape()), slack = kVolume * (a.volume + b.volume);
  if (volume < std::max(a.volume, b.volume) - slack || volume > a.volume + b.volume + slack)
    throw std::runtime_error("their union has another volume");
  BooleanResult result{solids.size() == 1 ? solids[0] : TopoDS_Shape(compound_of(solids)), {}};
  for (const TopoDS_Shape& shape : tracked) result.images.push_back(image_of(fuse, shape));
  return result;
}

/// All unions, and what becomes of faces and named edges on the way.
class Unions {
 public:
  Unions(const ImportedShape& model, const ModelTables& t, double seconds)
      : seconds_(seconds), tolerance_(1e-6 * t.box().diagonal()) {
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(model.shape, TopAbs_SOLID, solids);
    for (int i = 1; i <= solids.Extent(); ++i) {
      Body body{solids(i), rough_box(solids(i)), {}, volume_of(solids(i))};
      for (TopExp_Explorer e(solids(i), TopAbs_FACE); e.More(); e.Next())
        body.names.insert(name_of(model, model.faces.FindIndex(e.Current()) - 1));
      bodies_.push_back(body);
    }
    for (int i = 1; i <= model.faces.Extent(); ++i) images_.push_back({model.faces(i)});
    for (const auto& [edge, name] : model.edge_names) images_.push_back({edge});
  }

  void unite(std::vector<ImportFinding>& findings) {
    Progress progress("uniting bodies", static_cast<double>(bodies_.size()));
    for (std::size_t k = 1; k < bodies_.size(); ++k) {
      progress.update(static_cast<double>(k));
      for (std::size_t i = 0; i < k; ++i)
        if (!bodies_[i].is_gone && meet(bodies_[i].box, bodies_[k].box, tolerance_)) unite_pair(i, k, findings);
    }
  }
  int n_united() const {
    return static_cast<int>(std::count_if(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.is_gone; }));
  }
  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<std::vector<TopoDS_Shape>>& images() const { return images_; }

 private:
  static std::string name_of(const ImportedShape& model, int face) {
    const FaceAttributes& a = model.attributes[face];
    const bool has_path = a.part_index >= 0 && !model.parts[a.part_index].path.empty();
    return has_path ? model.parts[a.part_index].path : !a.part.empty() ? a.part : !a.name.empty() ? a.name : "unnamed";
  }

  /// Body i goes into body k, unless they are apart or cannot be united.
  void unite_pair(std::size_t i, std::size_t k, std::vector<ImportFinding>& findings) {
    Body &a = bodies_[i], &b = bodies_[k];
    const std::vector<std::pair<std::size_t, std::size_t>> places = places_of(a, b);
    std::vector<TopoDS_Shape> tracked;
    for (const auto& [image, piece] : places) tracked.push_back(images_[image][piece]);
    Box3 box = a.box;
    box.add(b.box);
    std::string failure;
    for (const double fuzzy : kFuzzy) {
      const double left = seconds_left();
      if (left <= 0 && failure.empty()) failure = "the unions before took " + format_number(seconds_) + " s";
      if (left <= 0) break;
      const BooleanAttempt done =
          run_boolean([&] { return fuse(a, b, tracked, fuzzy * box.diagonal()); }, std::min(kCpuSeconds, left));
      failure = done.failure;
      if (!failure.empty()) continue;
      if (done.result.shape.ShapeType() == TopAbs_SOLID) take(a, b, places, done.result);
      return;
    }
    findings.push_back({FindingKind::kNotUnited, words(a.names) + " and " + words(b.names), box.center(),
                        box.diagonal(), false, failure});
  }

  /// Faces and edges of two bodies: (of images_, piece).
  std::vector<std::pair<std::size_t, std::size_t>> places_of(const Body& a, const Body& b) const {
    TopTools_IndexedMapOfShape own;
    for (const TopoDS_Shape& solid : {a.solid, b.solid})
      for (const TopAbs_ShapeEnum kind : {TopAbs_FACE, TopAbs_EDGE}) TopExp::MapShapes(solid, kind, own);
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t k = 0; k < images_.size(); ++k)
      for (std::size_t p = 0; p < images_[k].size(); ++p)
        if (own.Contains(images_[k][p])) places.emplace_back(k, p);
    return places;
  }

  void take(Body& a, Body& b, const std::vector<std::pair<std::size_t, std::size_t>>& places,
            const BooleanResult& result) {
    std::vector<std::vector<TopoDS_Shape>> now = images_;
    for (const auto& [image, piece] : places) now[image].clear();
    for (std::size_t k = 0; k < places.size(); ++k)
      for (TopoDS_Iterator e(result.images[k]); e.More(); e.Next()) now[places[k].first].push_back(e.Value());
    images_ = std::move(now);
    b.solid = result.shape;
    b.box.add(a.box);
    b.names.insert(a.names.begin(), a.names.end());
    b.volume = volume_of(b.solid);
    a.is_gone = true;
  }

  double seconds_left() const {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    return seconds_ - elapsed.count();
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_;  // for all
  double tolerance_;
  std::vector<Body> bodies_;
  std::vector<std::vector<TopoDS_Shape>> images_;  ///< of faces, then of named edges
};

/// The shape without its solids, then what they became.
TopoDS_Shape with_unions(const TopoDS_Shape& shape, const std::vector<Body>& bodies) {
  std::vector<TopoDS_Shape> parts;
  for (const Body& b : bodies)
    if (!b.is_gone) parts.push_back(b.solid);
  for (TopExp_Explorer e(shape, TopAbs_SHELL, TopAbs_SOLID); e.More(); e.Next()) parts.push_back(e.Current());
  for (TopExp_Explorer e(shape, TopAbs_FACE, TopAbs_SHELL); e.More(); e.Next()) parts.push_back(e.Current());
  return compound_of(parts);
}

}  // namespace

void unite_solids(ImportedShape& model, ModelOfFile& tables, double seconds, std::vector<ImportFinding>& findings,
                  const std::string& path) {
  if (tables.tables.n_solids < 2) return;
  Unions unions(model, tables.tables, seconds);
  unions.unite(findings);
  if (unions.n_united() == 0) return;
  const TopTools_IndexedMapOfShape originals = model.faces;
  std::vector<std::pair<TopoDS_Shape, std::string>> edge_names;
  for (std::size_t k = 0; k < model.edge_names.size(); ++k)
    for (const TopoDS_Shape& edge : unions.images()[originals.Extent() + k])
      edge_names.emplace_back(edge, model.edge_names[k].second);
  model.replace(with_unions(model.shape, unions.bodies()), [&](const TopoDS_Shape& face) -> TopoDS_Shape {
    return compound_of(unions.images()[originals.FindIndex(face) - 1]);
  });
  model.edge_names = std::move(edge_names);
  const int n_before = tables.tables.n_solids;
  tables = make_tables(model, path);
  const Box3 box = tables.tables.box();
  findings.push_back(
      {FindingKind::kUnited, "", box.center(), box.diagonal(), true,
       std::to_string(n_before) + " bodies before, " + std::to_string(tables.tables.n_solids) + " after"});
}

}  // namespace st::occt
