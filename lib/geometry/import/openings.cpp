#include "geometry/import/openings.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/plane_loops.h"

namespace st::occt {
namespace {

constexpr double kInPlane = 1e-4;  // of the diagonal: a rim this near lies in a plane, which is 1 mm in a ship of 10 m
constexpr double kLeastArea = 1e-6;   // of the squared length of a run: less is a line, which lies in many planes
constexpr std::size_t kMostRuns = 3;  // planes of one rim: three meet in a point
constexpr int kSamples = 10;          // intervals of an edge

struct Plane {
  Vec3 place, normal;
  double distance(Vec3 x) const { return std::abs(dot(normal, x - place)); }
  gp_Pln shape() const { return {{place.x, place.y, place.z}, {normal.x, normal.y, normal.z}}; }
};

/// An edge of a rim, in the direction of the rim.
struct RimEdge {
  TopoDS_Edge edge;
  std::vector<Vec3> points;  // its end is the begin of the next one
  TopoDS_Vertex begin() const { return TopExp::FirstVertex(edge, true); }
};
using Rim = std::vector<RimEdge>;

Rim rim_of(const TopoDS_Wire& wire) {
  Rim rim;
  for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next()) {
    RimEdge& edge = rim.emplace_back();
    edge.edge = TopoDS::Edge(e.Current());
    const BRepAdaptor_Curve curve(edge.edge);
    const double first = curve.FirstParameter(), way = curve.LastParameter() - first;
    for (int k = 0; k < kSamples; ++k) edge.points.push_back(vec(curve.Value(first + way * k / kSamples)));
    edge.points.push_back(vec(curve.Value(curve.LastParameter())));
    if (edge.edge.Orientation() == TopAbs_REVERSED) std::reverse(edge.points.begin(), edge.points.end());
  }
  return rim;
}

/// Edges of a rim in one plane.
struct Run {
  std::size_t first = 0, n = 0;
  std::optional<Plane> plane;
};

/// The plane of an edge and those after it, as long as all lie in one. It is found anew where an edge leaves it: what
/// the first edges tell of it is the less exact the shorter they are.
class RunGrower {
 public:
  RunGrower(const Rim& rim, std::size_t first, double tolerance) : rim_(rim), tolerance_(tolerance) {
    run_.first = first;
  }
  /// Takes the next edge; false, once and for all, where no plane has it and those before.
  bool take() {
    const RimEdge& edge = rim_[(run_.first + run_.n) % rim_.size()];
    points_.insert(points_.end(), edge.points.begin(), edge.points.end());
    if (!run_.plane || !all_in(*run_.plane, edge.points)) {
      const std::optional<Plane> plane = plane_of(points_);
      if (plane ? !all_in(*plane, points_) : run_.plane || !is_line(points_)) return false;
      run_.plane = plane;
    }
    ++run_.n;
    return true;
  }
  const Run& run() const { return run_; }

 private:
  /// By the area that the points and the straight way back enclose; none for points on a line.
  static std::optional<Plane> plane_of(const std::vector<Vec3>& points) {
    Vec3 area, middle;
    double length = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 a = points[i] - points[0], b = points[(i + 1) % points.size()] - points[0];
      area += 0.5 * cross(a, b);
      middle += points[i];
      length += norm(b - a);
    }
    if (norm(area) <= kLeastArea * length * length) return std::nullopt;
    return Plane{middle / static_cast<double>(points.size()), area / norm(area)};
  }
  bool all_in(const Plane& plane, const std::vector<Vec3>& points) const {
    return std::ranges::all_of(points, [&](Vec3 x) { return plane.distance(x) <= tolerance_; });
  }
  bool is_line(const std::vector<Vec3>& points) const {
    const Vec3 from = points[0], way = points.back() - from;
    const auto off = [&](Vec3 x) { return norm(way) > 0 ? norm(cross(x - from, way)) / norm(way) : distance(x, from); };
    return std::ranges::all_of(points, [&](Vec3 x) { return off(x) <= tolerance_; });
  }

  const Rim& rim_;
  double tolerance_;
  Run run_;
  std::vector<Vec3> points_;  // of its edges
};

/// As long as it can be, of at most so many edges.
Run grown_run(const Rim& rim, std::size_t first, std::size_t most, double tolerance) {
  RunGrower grower(rim, first % rim.size(), tolerance);
  while (grower.run().n < most && grower.take()) {
  }
  return grower.run();
}

/// Each run as long as it can be, from this edge on; none where there are too many, or an edge lies in no plane.
std::vector<Run> runs_from(const Rim& rim, std::size_t start, double tolerance) {
  std::vector<Run> runs;
  for (std::size_t done = 0; done < rim.size();) {
    if (runs.size() == kMostRuns) return {};
    runs.push_back(grown_run(rim, start + done, rim.size() - done, tolerance));
    if (!runs.back().plane) return {};
    done += runs.back().n;
  }
  return runs;
}

/// The fewest runs. The first edge may lie inside a run, so it is looked for again from where a run ends.
std::vector<Run> fewest_runs(const Rim& rim, double tolerance) {
  std::vector<Run> best;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= kMostRuns; ++i) {
    std::vector<Run> runs = runs_from(rim, start, tolerance);
    if (runs.size() == 1) return runs;
    if (!runs.empty() && (best.empty() || runs.size() < best.size())) best = std::move(runs);
    start = (start + std::max<std::size_t>(grown_run(rim, start, rim.size(), tolerance).n, 1)) % rim.size();
  }
  return best;
}

std::optional<Vec3> common_point(const Plane& a, const Plane& b, const Plane& c) {
  constexpr double kParallel = 1e-3;
  const double volume = dot(a.normal, cross(b.normal, c.normal));
  if (std::abs(volume) < kParallel) return std::nullopt;
  return (dot(a.normal, a.place) * cross(b.normal, c.normal) + dot(b.normal, b.place) * cross(c.normal, a.normal) +
          dot(c.normal, c.place) * cross(a.normal, b.normal)) /
         volume;
}

TopoDS_Wire wire_of(const Rim& rim, const Run& run, const std::vector<TopoDS_Shape>& way_back) {
  BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (std::size_t k = 0; k < run.n; ++k) builder.Add(wire, rim[(run.first + k) % rim.size()].edge);
  for (const TopoDS_Shape& edge : way_back) builder.Add(wire, edge);
  wire.Closed(true);
  return wire;
}

/// Closed, in one plane.
struct FlatWire {
  TopoDS_Wire wire;
  Plane plane;
};

std::optional<TopoDS_Edge> straight_edge(const TopoDS_Vertex& a, const TopoDS_Vertex& b) {
  BRepBuilderAPI_MakeEdge make(a, b);
  return make.IsDone() ? std::optional(make.Edge()) : std::nullopt;
}

/// A wire for each run, closed by straight edges in which two planes meet; none where that cannot be within `reach`.
std::vector<FlatWire> flat_wires(const Rim& rim, const std::vector<Run>& runs, double reach) {
  if (runs.empty()) return {};
  if (runs.size() == 1) return {{wire_of(rim, runs[0], {}), *runs[0].plane}};
  std::vector<TopoDS_Vertex> corners;  // where each run begins
  for (const Run& run : runs) corners.push_back(rim[run.first].begin());
  if (runs.size() == 2) {
    const std::optional<TopoDS_Edge> joint = straight_edge(corners[0], corners[1]);
    if (!joint) return {};
    return {{wire_of(rim, runs[0], {joint->Reversed()}), *runs[0].plane},
            {wire_of(rim, runs[1], {*joint}), *runs[1].plane}};
  }
  const std::optional<Vec3> apex = common_point(*runs[0].plane, *runs[1].plane, *runs[2].plane);
  if (!apex || distance(*apex, rim[0].points[0]) > reach) return {};
  const TopoDS_Vertex top = BRepBuilderAPI_MakeVertex(gp_Pnt(apex->x, apex->y, apex->z));
  std::vector<TopoDS_Edge> joints;
  for (const TopoDS_Vertex& corner : corners)
    if (const std::optional<TopoDS_Edge> joint = straight_edge(corner, top)) joints.push_back(*joint);
  if (joints.size() < corners.size()) return {};
  std::vector<FlatWire> wires;
  for (std::size_t i = 0; i < runs.size(); ++i)
    wires.push_back({wire_of(rim, runs[i], {joints[(i + 1) % 3], joints[i].Reversed()}), *runs[i].plane});
  return wires;
}

Box3 box_of(const Rim& rim) {
  Box3 box;
  for (const RimEdge& e : rim)
    for (const Vec3 x : e.points) box.add(x);
  return box;
}

/// Makes the faces of all rims.
class CapMaker {
 public:
  CapMaker(const Faces& open, double diagonal, std::vector<ImportFinding>& findings)
      : diagonal_(diagonal), tolerance_(kInPlane * diagonal), findings_(findings) {
    TopExp::MapShapesAndAncestors(compound_of(open), TopAbs_EDGE, TopAbs_FACE, owners_);
    for (const TopoDS_Wire& wire : simple_wires(free_edges(open))) add_rim(wire);
  }

  /// The largest first.
  Faces caps() {
    Faces faces;
    while (!flat_.empty())
      for (TopoDS_Face& face : take_plane()) faces.push_back(std::move(face));
    std::ranges::stable_sort(faces, std::greater<>(), [](const TopoDS_Face& f) { return area_of(f); });
    return faces;
  }

 private:
  struct FlatLoop {
    PlaneLoop loop;
    Plane plane;
    Rim rim;
  };

  /// All loops of a rim, or none.
  void add_rim(const TopoDS_Wire& wire) {
    const Rim rim = rim_of(wire);
    if (!BRep_Tool::IsClosed(wire)) return leave(rim, "is not closed");
    std::vector<FlatLoop> loops;
    for (const FlatWire& flat : flat_wires(rim, fewest_runs(rim, tolerance_), diagonal_)) {
      std::optional<PlaneLoop> loop = loop_in_plane(flat.wire, flat.plane.shape());
      if (!loop || !BRepCheck_Analyzer(loop->face).IsValid()) return leave(rim, "crosses itself in its plane");
      Rim own = rim_of(flat.wire);
      if (std::ranges::any_of(own, [&](const RimEdge& e) { return is_outline(e, flat.plane, loop->face); }))
        return leave(rim, "is the outline of a flat face");
      loops.push_back({*std::move(loop), flat.plane, std::move(own)});
    }
    if (loops.empty()) return leave(rim, "lies in no plane, nor in two or three");
    std::ranges::move(loops, std::back_inserter(flat_));
  }
  void leave(const Rim& rim, const std::string& why) {
    const Box3 box = box_of(rim);
    findings_.push_back({FindingKind::kOpeningLeft, "", box.center(), box.diagonal(), false,
                         std::to_string(rim.size()) + (rim.size() == 1 ? " edge " : " edges ") + why});
  }

  /// The faces of the first loop and all others in its plane, which go.
  Faces take_plane() {
    const Plane plane = flat_.front().plane;
    const auto is_in_it = [&](const FlatLoop& flat) {
      return std::ranges::all_of(flat.rim, [&](const RimEdge& e) {
        return std::ranges::all_of(e.points, [&](Vec3 x) { return plane.distance(x) <= tolerance_; });
      });
    };
    std::vector<FlatLoop> rest;
    std::vector<PlaneLoop> loops;
    for (FlatLoop& flat : flat_)
      if (&flat == &flat_.front() || is_in_it(flat))
        loops.push_back(std::move(flat.loop));
      else
        rest.push_back(std::move(flat));
    flat_ = std::move(rest);
    return faces_between(loops, plane.shape());
  }

  /// Whether the face beside the edge goes on in the plane within the loop: a flat sheet, not an opening.
  bool is_outline(const RimEdge& e, const Plane& plane, const TopoDS_Face& loop) const {
    constexpr double kBeside = 0.05, kFlat = 0.02;  // of the step along the edge; sine between the normals
    if (!owners_.Contains(e.edge)) return false;    // a joint
    const TopoDS_Face owner = TopoDS::Face(owners_.FindFromKey(e.edge).First());
    const Vec3 normal = normal_at_middle(e.edge, owner);
    if (norm(cross(normal, plane.normal)) > kFlat * norm(normal)) return false;
    const Vec3 a = e.points[kSamples / 2], way = e.points[kSamples / 2 + 1] - a;
    return std::ranges::any_of(std::array{-kBeside, kBeside}, [&](double side) {
      const Vec3 x = a + side * cross(plane.normal, way);
      const gp_Pnt p(x.x, x.y, x.z);
      return is_in(p, loop) && is_in(p, owner);
    });
  }
  /// None (0, 0, 0) where the edge has no trimming curve there.
  static Vec3 normal_at_middle(const TopoDS_Edge& edge, const TopoDS_Face& face) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (curve.IsNull()) return {};
    const gp_Pnt2d uv = curve->Value(0.5 * (first + last));
    gp_Pnt p;
    gp_Vec du, dv;
    BRepAdaptor_Surface(face, false).D1(uv.X(), uv.Y(), p, du, dv);
    const gp_Vec normal = du.Crossed(dv);
    return {normal.X(), normal.Y(), normal.Z()};
  }

  double diagonal_, tolerance_;
  std::vector<ImportFinding>& findings_;
  TopTools_IndexedDataMapOfShapeListOfShape owners_;  // of edges
  std::vector<FlatLoop> flat_;
};

/// Solids without a free edge, and the faces of all other ones in their order.
struct Bodies {
  std::vector<TopoDS_Shape> closed;
  Faces open;

  explicit Bodies(const ImportedShape& model) {
    TopTools_IndexedMapOfShape in_closed;
    for (TopExp_Explorer s(model.shape, TopAbs_SOLID); s.More(); s.Next()) {
      if (count_free_edges(s.Current()) > 0) continue;
      closed.push_back(s.Current());
      TopExp::MapShapes(s.Current(), TopAbs_FACE, in_closed);
    }
    for (int i = 1; i <= model.faces.Extent(); ++i)
      if (!in_closed.Contains(model.faces(i))) open.push_back(TopoDS::Face(model.faces(i)));
  }
};

}  // namespace

bool cap_openings(ImportedShape& model, double diagonal, std::vector<ImportFinding>& findings) {
  Bodies bodies(model);
  const Faces caps = CapMaker(bodies.open, diagonal, findings).caps();
  if (caps.empty()) return false;
  bodies.open.insert(bodies.open.end(), caps.begin(), caps.end());
  std::vector<TopoDS_Shape> parts = std::move(bodies.closed);
  for (const TopoDS_Shape& shell : shells_of(bodies.open)) parts.push_back(shell);
  model.replace(compound_of(parts), [](const TopoDS_Shape& face) { return face; });
  for (std::size_t i = 0; i < caps.size(); ++i) {
    const int k = model.faces.FindIndex(caps[i]);
    if (k == 0) continue;
    const Box3 box = rough_box(caps[i]);
    model.attributes[k - 1].name = "cap_" + std::to_string(i + 1);
    const std::string of = "area " + format_number(area_of(caps[i]));
    findings.push_back({FindingKind::kCapped, model.attributes[k - 1].name, box.center(), box.diagonal(), true, of});
  }
  return true;
}

}  // namespace st::occt
