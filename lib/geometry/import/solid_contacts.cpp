#include "geometry/import/solid_contacts.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "base/boxes.h"
#include "base/disjoint_sets.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/face_probe.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr double kSameCurve = 1e-3;        // of an edge's length: where another one has its ends, middle and length
constexpr int kStations = 5;               // along u and v, of surfaces without a formula
constexpr std::size_t kMostSampled = 500;  // pairs of faces without a formula: a millisecond each

constexpr double Vec3::*kAxes[] = {&Vec3::x, &Vec3::y, &Vec3::z};

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
  SurfaceGrid grid;
  for (int i = 0; i < kStations; ++i)
    for (int k = 0; k < kStations; ++k) {
      const Vec3 p = of.point({of.u_min() + (of.u_max() - of.u_min()) * (i + 0.5) / kStations,
                               of.v_min() + (of.v_max() - of.v_min()) * (k + 0.5) / kStations});
      if (!contains(box, p, tolerance)) continue;
      if (closest_point(on, p, grid).distance > tolerance) return false;
      ++n;
    }
  return n >= 3;
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
    // of one surface, as a wing and a flap that was cut out of it are, with a slot between
    return (lies_on(*on_a, *on_b, box, tolerance) || lies_on(*on_b, *on_a, box, tolerance)) &&
           overlap(f, g, box, tolerance);
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
    return make_surface(BRep_Tool::Surface(face), {{b[0], b[2]}, {b[1], b[3]}});
  }

  const ImportedShape& model_;
  const ModelTables& t_;
  double tolerance_;
  std::set<int> sharers_;
  std::size_t n_sampled_ = 0;
  std::map<FaceId, std::unique_ptr<ProbedFace>> probed_;
};

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

double same_place(const ModelTables& t) { return kSamePlace * t.box().diagonal(); }

}  // namespace

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

TouchingGroups find_touching_solids(const ImportedShape& model, const ModelTables& tables) {
  DisjointSets joined(tables.n_solids);
  const double tolerance = same_place(tables);
  if (tables.n_solids > 1) FaceContacts(model, tables, tolerance).add_to(joined);
  TouchingGroups result;
  result.self_touching = add_edge_contacts(model, tables, tolerance, joined);
  for (std::vector<int>& group : joined.groups())
    if (group.size() > 1 || result.self_touching.count(group[0])) result.groups.push_back(std::move(group));
  return result;
}

std::set<int> find_self_touching(const ImportedShape& model, const ModelTables& tables) {
  DisjointSets joined(tables.n_solids);
  return add_edge_contacts(model, tables, same_place(tables), joined);
}

}  // namespace st::occt
