#include "geometry/import/touching_bodies.h"

#include <BOPTools_AlgoTools.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
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
#include <numeric>
#include <optional>
#include <set>

#include "base/boxes.h"
#include "base/disjoint_sets.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/boolean_child.h"
#include "geometry/import/face_probe.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr double kSameCurve = 1e-3;   // of an edge's length: where another one has its ends, middle and length
constexpr double kSameVolume = 1e-5;  // relative, of all solids
constexpr double kCpuSeconds = 60;    // for one attempt
constexpr int kAttempts = 3;
constexpr int kStations = 5;               // along u and v, of surfaces without a formula
constexpr std::size_t kMostSampled = 500;  // pairs of faces without a formula: a millisecond each

constexpr double Vec3::*kAxes[] = {&Vec3::x, &Vec3::y, &Vec3::z};

// --- faces on each other ---

Box3 common_box(const Box3& a, const Box3& b) {
  Box3 box;
  for (const auto axis : kAxes) {
    box.lo.*axis = std::max(a.lo.*axis, b.lo.*axis);
    box.hi.*axis = std::min(a.hi.*axis, b.hi.*axis);
  }
  return box;
}

/// Can two surfaces lie on each other in this box? Its second extent is more than a line's.
bool has_room(const Box3& box, double tolerance) {
  int n = 0;
  for (const auto axis : kAxes) {
    if (box.hi.*axis - box.lo.*axis < -tolerance) return false;
    n += box.hi.*axis - box.lo.*axis > 2 * tolerance;
  }
  return n >= 2;
}

bool are_one_axis(const gp_Ax1& a, const gp_Ax1& b, double reach, double tolerance) {
  return a.Direction().XYZ().CrossMagnitude(b.Direction().XYZ()) * reach <= tolerance &&
         gp_Lin(a).Distance(b.Location()) <= tolerance;
}

/// Whether surfaces of one kind are the same within `reach` of the middle `p`; nullopt for kinds without a formula.
std::optional<bool> are_one_surface(const BRepAdaptor_Surface& a, const BRepAdaptor_Surface& b, const gp_Pnt& p,
                                    double reach, double tolerance) {
  const auto same = [&](double x, double y) { return std::abs(x - y) <= tolerance; };
  switch (a.GetType()) {
    case GeomAbs_Plane: {
      const gp_Ax1 m = a.Plane().Axis(), n = b.Plane().Axis();
      return m.Direction().XYZ().CrossMagnitude(n.Direction().XYZ()) * reach <= tolerance &&
             a.Plane().Distance(b.Plane().Location()) <=
                 tolerance + m.Direction().XYZ().CrossMagnitude(n.Direction().XYZ()) * p.Distance(b.Plane().Location());
    }
    case GeomAbs_Cylinder:
      return are_one_axis(a.Cylinder().Axis(), b.Cylinder().Axis(), reach, tolerance) &&
             same(a.Cylinder().Radius(), b.Cylinder().Radius());
    case GeomAbs_Sphere:
      return a.Sphere().Location().Distance(b.Sphere().Location()) <= tolerance &&
             same(a.Sphere().Radius(), b.Sphere().Radius());
    case GeomAbs_Torus:
      return are_one_axis(a.Torus().Axis(), b.Torus().Axis(), reach, tolerance) &&
             a.Torus().Location().Distance(b.Torus().Location()) <= tolerance &&
             same(a.Torus().MajorRadius(), b.Torus().MajorRadius()) &&
             same(a.Torus().MinorRadius(), b.Torus().MinorRadius());
    case GeomAbs_Cone:
      return are_one_axis(a.Cone().Axis(), b.Cone().Axis(), reach, tolerance) &&
             a.Cone().Apex().Distance(b.Cone().Apex()) <= 10 * tolerance &&
             std::abs(std::abs(a.Cone().SemiAngle()) - std::abs(b.Cone().SemiAngle())) * reach <= tolerance;
    default:
      return std::nullopt;
  }
}

/// Points of `of` in the box, all of which are on `on`: three at least.
bool lies_on(const Surface& of, const Surface& on, const Box3& box, double tolerance) {
  int n = 0;
  for (int i = 0; i < kStations; ++i)
    for (int k = 0; k < kStations; ++k) {
      const Vec3 p = of.point({of.u_min() + (of.u_max() - of.u_min()) * (i + 0.5) / kStations,
                               of.v_min() + (of.v_max() - of.v_min()) * (k + 0.5) / kStations});
      if (!contains(box, p, tolerance)) continue;
      if (closest_point(on, p).distance > tolerance) return false;
      ++n;
    }
  return n >= 3;
}

/// Solids that have edges in common with others (0-based). Instances of one solid at different places have none.
std::set<int> edge_sharers(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape numbers, edges;
  TopExp::MapShapes(shape, TopAbs_SOLID, numbers);
  std::vector<int> owner(1, 0);  // by 1-based edge
  std::set<int> sharers;
  for (int i = 1; i <= numbers.Extent(); ++i)
    for (TopExp_Explorer e(numbers(i), TopAbs_EDGE); e.More(); e.Next()) {
      const int k = edges.Add(e.Current());
      if (k == static_cast<int>(owner.size())) owner.push_back(i);
      if (owner[k] != i) sharers.insert({i - 1, owner[k] - 1});
    }
  return sharers;
}

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

/// Points on the edges of a face in a box, edge by edge.
std::vector<Vec3> points_on_edges(const TopoDS_Face& face, const Box3& box, double tolerance) {
  constexpr int kSamples = 17;
  std::vector<Vec3> points;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    const double first = curve.FirstParameter(), way = curve.LastParameter() - first;
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 x = vec(curve.Value(first + way * i / (kSamples - 1)));
      if (distance2(x, box) <= tolerance * tolerance) points.push_back(x);
    }
  }
  return points;
}

/// A face to compare with several others; made once.
struct ProbedFace {
  FaceProbe probe;
  std::vector<Vec3> samples;

  ProbedFace(const TopoDS_Face& face, double tolerance) : probe(face, tolerance), samples(probe.samples()) {}
};

/// Of faces of one surface: neighbours do not.
bool lie_on_each_other(ProbedFace& a, ProbedFace& b) {
  return a.probe.distance_of(b.samples) || b.probe.distance_of(a.samples);
}

/// Finds pairs of solids whose faces lie on each other.
class FaceContacts {
 public:
  FaceContacts(const ImportedShape& model, const ModelTables& tables, double tolerance)
      : model_(model), t_(tables), tolerance_(tolerance), sharers_(edge_sharers(model.shape)) {}

  void add_to(DisjointSets& joined) {
    std::vector<FaceId> order;
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      if (t_.face_solid[f] != kNone) order.push_back(f);
    std::sort(order.begin(), order.end(), [&](FaceId a, FaceId b) {
      const double x = t_.face_box[a].lo.x, y = t_.face_box[b].lo.x;
      return x != y ? x < y : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size(); ++k) {
        const FaceId f = order[i], g = order[k];
        if (t_.face_box[g].lo.x > t_.face_box[f].hi.x + tolerance_) break;
        const int a = t_.face_solid[f], b = t_.face_solid[g];
        if (joined.find(a) != joined.find(b) && coincide(f, g)) joined.join(a, b);
      }
  }

 private:
  bool coincide(FaceId f, FaceId g) {
    const double tolerance = std::max({tolerance_, t_.face_tolerance[f], t_.face_tolerance[g]});
    const Box3 box = common_box(t_.face_box[f], t_.face_box[g]);
    if (!has_room(box, tolerance)) return false;
    const TopoDS_Face a = TopoDS::Face(model_.faces(f + 1)), b = TopoDS::Face(model_.faces(g + 1));
    if (t_.face_type[f] == t_.face_type[g]) {
      const Vec3 p = box.center();
      const BRepAdaptor_Surface sa(a, false), sb(b, false);
      const auto same = are_one_surface(sa, sb, {p.x, p.y, p.z}, box.diagonal(), tolerance);
      if (same && *same && are_sharers(f, g)) {
        ProbedFace first(a, tolerance), second(b, tolerance);
        return lie_on_each_other(first, second);
      }
      if (same) return *same && (!look_alike(a, b) || overlap(f, g, box, tolerance));
    }
    if (t_.face_type[f] != t_.face_type[g] && is_plane(f) && is_plane(g)) return false;
    if (n_sampled_++ >= kMostSampled) return false;
    const auto on_a = surface_of(a, f), on_b = surface_of(b, g);
    return lies_on(*on_a, *on_b, box, tolerance) || lies_on(*on_b, *on_a, box, tolerance);
  }
  /// Planes that bound their solids on the same side, such as the end caps of two bodies beside each other. Faces that
  /// touch look opposite ways; only bodies at one place look alike.
  static bool look_alike(const TopoDS_Face& a, const TopoDS_Face& b) {
    const BRepAdaptor_Surface sa(a, false), sb(b, false);
    if (sa.GetType() != GeomAbs_Plane || sb.GetType() != GeomAbs_Plane) return false;
    const auto normal = [](const BRepAdaptor_Surface& s, const TopoDS_Face& face) {
      const gp_Ax3 axes = s.Plane().Position();
      const bool is_turned = (face.Orientation() == TopAbs_REVERSED) != !axes.Direct();
      return is_turned ? axes.Direction().Reversed() : axes.Direction();
    };
    return normal(sa, a).Dot(normal(sb, b)) > 0;
  }

  /// Of faces of one surface whose boxes have `box` in common: coplanar faces beside each other do not. Where one is
  /// not within the other, the edges of one run through the other. True for faces that cannot be measured.
  bool overlap(FaceId f, FaceId g, const Box3& box, double tolerance) {
    try {
      ProbedFace &a = probed(f), &b = probed(g);
      const auto edges_of = [&](FaceId id) {
        return points_on_edges(TopoDS::Face(model_.faces(id + 1)), box, tolerance);
      };
      return lie_on_each_other(a, b) || a.probe.distance_of(edges_of(g)) || b.probe.distance_of(edges_of(f));
    } catch (const Standard_Failure&) {
      return true;
    }
  }
  ProbedFace& probed(FaceId f) {
    const auto [at, is_new] = probed_.try_emplace(f);
    if (is_new)
      at->second =
          std::make_unique<ProbedFace>(TopoDS::Face(model_.faces(f + 1)), std::max(tolerance_, t_.face_tolerance[f]));
    return *at->second;
  }

  bool are_sharers(FaceId f, FaceId g) const {
    return sharers_.count(t_.face_solid[f]) > 0 && sharers_.count(t_.face_solid[g]) > 0;
  }
  bool is_plane(FaceId f) const { return t_.face_type[f] == SurfaceType::kPlane; }
  std::unique_ptr<Surface> surface_of(const TopoDS_Face& face, FaceId f) const {
    const double* b = &t_.face_uv_bounds[4 * static_cast<std::size_t>(f)];
    return make_surface(BRep_Tool::Surface(face), {b[0], b[1], b[2], b[3]});
  }

  const ImportedShape& model_;
  const ModelTables& t_;
  double tolerance_;
  std::set<int> sharers_;
  std::size_t n_sampled_ = 0;
  std::map<FaceId, std::unique_ptr<ProbedFace>> probed_;
};

// --- edges on each other ---

/// For each vertex the first one at its place.
std::vector<VertexId> first_at_place(const ModelTables& t, double tolerance) {
  std::vector<VertexId> order(t.n_vertices()), first(t.n_vertices(), kNone);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](VertexId a, VertexId b) {
    return t.vertex_xyz[a].x != t.vertex_xyz[b].x ? t.vertex_xyz[a].x < t.vertex_xyz[b].x : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (first[order[i]] != kNone) continue;
    first[order[i]] = order[i];
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      if (t.vertex_xyz[order[k]].x - t.vertex_xyz[order[i]].x > tolerance) break;
      if (first[order[k]] == kNone && distance(t.vertex_xyz[order[i]], t.vertex_xyz[order[k]]) <= tolerance)
        first[order[k]] = order[i];
    }
  }
  return first;
}

Vec3 middle_of(const TopoDS_Shape& edge) {
  const BRepAdaptor_Curve curve(TopoDS::Edge(edge));
  return vec(curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter())));
}

bool passes(const TopoDS_Shape& edge, Vec3 p, double tolerance) {
  double t0, t1;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edge), t0, t1);
  return !curve.IsNull() && closest_point(*make_curve(curve, t0, t1), p).distance <= tolerance;
}

/// Joins solids with edges between the same points; returns those with two such edges of their own.
std::set<int> add_edge_contacts(const ImportedShape& model, const ModelTables& t, double tolerance,
                                DisjointSets& joined) {
  std::set<int> self_touching;
  const std::vector<VertexId> first = first_at_place(t, tolerance);
  std::vector<int> solid(t.n_edges(), kNone);
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const EdgeId e : t.edges_of(f))
      if (solid[e] == kNone) solid[e] = t.face_solid[f];
  std::map<std::pair<VertexId, VertexId>, std::vector<EdgeId>> by_ends;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e] || solid[e] == kNone) continue;
    by_ends[std::minmax(first[t.edge_vertices[2 * e]], first[t.edge_vertices[2 * e + 1]])].push_back(e);
  }
  TopTools_IndexedMapOfShape edges;
  for (const auto& [ends, members] : by_ends)
    for (std::size_t i = 0; i < members.size(); ++i)
      for (std::size_t k = i + 1; k < members.size(); ++k) {
        const EdgeId a = members[i], b = members[k];
        if (solid[a] != solid[b] && joined.find(solid[a]) == joined.find(solid[b])) continue;
        // a far field makes a place of a short edge
        const double place = std::min(tolerance, kSameCurve * t.edge_length[a]);
        if (std::abs(t.edge_length[a] - t.edge_length[b]) > 10 * place + kSameCurve * t.edge_length[a]) continue;
        if (edges.IsEmpty()) TopExp::MapShapes(model.shape, TopAbs_EDGE, edges);
        const double near = std::max({place, t.edge_tolerance[a], t.edge_tolerance[b]});
        if (solid[a] == solid[b] && t.edge_length[a] <= near) continue;  // a point, which all edges there have
        if (!passes(edges(b + 1), middle_of(edges(a + 1)), near)) continue;
        joined.join(solid[a], solid[b]);
        if (solid[a] == solid[b]) self_touching.insert(solid[a]);
      }
  return self_touching;
}

// --- joining ---

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

TouchingGroups find_touching_solids(const ImportedShape& model, const ModelTables& tables) {
  DisjointSets joined(tables.n_solids);
  const double tolerance = kSamePlace * tables.box().diagonal();
  if (tables.n_solids > 1) FaceContacts(model, tables, tolerance).add_to(joined);
  TouchingGroups result;
  result.self_touching = add_edge_contacts(model, tables, tolerance, joined);
  for (std::vector<int>& group : joined.groups())
    if (group.size() > 1 || result.self_touching.count(group[0])) result.groups.push_back(std::move(group));
  return result;
}

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
  const ModelTables& t = model_tables.tables;
  DisjointSets joined(t.n_solids);
  std::set<int> self_touching = add_edge_contacts(model, t, kSamePlace * t.box().diagonal(), joined);
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
