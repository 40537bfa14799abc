#include "geometry/import/openings.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/sort_once.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/plane_loops.h"

namespace st::occt {
namespace {

constexpr double kInPlane = 1e-4;  // of the diagonal: a rim this near lies in a plane, which is 1 mm in a ship of 10 m
constexpr double kLeastArea = 1e-6;   // of the squared length of a rim: less is a line, which lies in many planes
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

struct Fit {
  bool is_flat = false;
  std::optional<Plane> plane;  // none: all lies on a line, in many planes
};

/// Of `n` edges from `first` on, around the rim; closed by the straight way back.
Fit fit(const Rim& rim, std::size_t first, std::size_t n, double tolerance) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < n; ++k) {
    const RimEdge& edge = rim[(first + k) % rim.size()];
    points.insert(points.end(), edge.points.begin(), edge.points.end());
  }
  Vec3 area, middle;
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 a = points[i] - points[0], b = points[(i + 1) % points.size()] - points[0];
    area += 0.5 * cross(a, b);
    middle += points[i];
    length += norm(b - a);
  }
  const Vec3 from = points[0], way = points.back() - from;
  if (norm(area) <= kLeastArea * length * length) {
    const auto off_line = [&](Vec3 x) {
      return norm(way) > 0 ? norm(cross(x - from, way)) / norm(way) : distance(x, from);
    };
    return {std::ranges::all_of(points, [&](Vec3 x) { return off_line(x) <= tolerance; }), std::nullopt};
  }
  const Plane plane{middle / static_cast<double>(points.size()), area / norm(area)};
  return {std::ranges::all_of(points, [&](Vec3 x) { return plane.distance(x) <= tolerance; }), plane};
}

/// Edges of a rim in one plane.
struct Run {
  std::size_t first = 0, n = 0;
  std::optional<Plane> plane;
};

/// Each run as long as it can be, from this edge on; none where there are too many, or an edge lies in no plane.
std::vector<Run> runs_from(const Rim& rim, std::size_t start, double tolerance) {
  std::vector<Run> runs;
  for (std::size_t done = 0; done < rim.size();) {
    if (runs.size() == kMostRuns) return {};
    Run run{(start + done) % rim.size(), 0, std::nullopt};
    for (std::size_t n = 1; done + n <= rim.size(); ++n) {
      const Fit found = fit(rim, run.first, n, tolerance);
      if (!found.is_flat) break;
      run.n = n;
      run.plane = found.plane;
    }
    if (!run.plane) return {};
    done += run.n;
    runs.push_back(run);
  }
  return runs;
}

/// The fewest runs, from whatever edge on.
std::vector<Run> fewest_runs(const Rim& rim, double tolerance) {
  if (const Fit all = fit(rim, 0, rim.size(), tolerance); all.is_flat && all.plane) return {{0, rim.size(), all.plane}};
  std::vector<Run> best;
  for (std::size_t start = 0; start < rim.size(); ++start) {
    std::vector<Run> runs = runs_from(rim, start, tolerance);
    if (!runs.empty() && (best.empty() || runs.size() < best.size())) best = std::move(runs);
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

using FlatWires = std::vector<std::pair<TopoDS_Wire, Plane>>;

/// A wire for each run, closed by straight edges in which two planes meet; none where that cannot be.
FlatWires flat_wires(const Rim& rim, const std::vector<Run>& runs) {
  if (runs.size() == 1) return {{wire_of(rim, runs[0], {}), *runs[0].plane}};
  std::vector<TopoDS_Vertex> corners;  // where each run begins
  for (const Run& run : runs) corners.push_back(rim[run.first].begin());
  std::vector<TopoDS_Edge> joints;  // from the corner to the next one, or to the point common to all planes
  if (runs.size() == 2) {
    joints = {BRepBuilderAPI_MakeEdge(corners[0], corners[1])};
    return {{wire_of(rim, runs[0], {joints[0].Reversed()}), *runs[0].plane},
            {wire_of(rim, runs[1], {joints[0]}), *runs[1].plane}};
  }
  const std::optional<Vec3> apex = common_point(*runs[0].plane, *runs[1].plane, *runs[2].plane);
  if (!apex) return {};
  const TopoDS_Vertex top = BRepBuilderAPI_MakeVertex(gp_Pnt(apex->x, apex->y, apex->z));
  for (const TopoDS_Vertex& corner : corners) {
    BRepBuilderAPI_MakeEdge make(corner, top);
    if (!make.IsDone()) return {};
    joints.push_back(make.Edge());
  }
  FlatWires wires;
  for (std::size_t i = 0; i < runs.size(); ++i)
    wires.emplace_back(wire_of(rim, runs[i], {joints[(i + 1) % 3], joints[i].Reversed()}), *runs[i].plane);
  return wires;
}

Vec3 middle_of(const Rim& rim) {
  Vec3 sum;
  for (const RimEdge& e : rim) sum += e.points[0];
  return sum / static_cast<double>(rim.size());
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
    for (std::size_t i = 0; i < wires_.size(); ++i)
      for (TopoDS_Face& face : faces_beside(i)) faces.push_back(std::move(face));
    std::ranges::stable_sort(faces, std::greater<>(), [](const TopoDS_Face& f) { return area_of(f); });
    return faces;
  }

 private:
  void add_rim(const TopoDS_Wire& wire) {
    const Rim rim = rim_of(wire);
    const std::vector<Run> runs = BRep_Tool::IsClosed(wire) ? fewest_runs(rim, tolerance_) : std::vector<Run>();
    FlatWires flat;
    if (!runs.empty()) flat = flat_wires(rim, runs);
    if (flat.empty()) leave(rim);
    wires_.insert(wires_.end(), flat.begin(), flat.end());
  }
  void leave(const Rim& rim) {
    findings_.push_back({FindingKind::kOpeningLeft, "", middle_of(rim), diagonal_, false,
                         std::to_string(rim.size()) + (rim.size() == 1 ? " edge" : " edges")});
  }
  /// Of the wire and all others in its plane; none where an earlier wire has had them.
  Faces faces_beside(std::size_t first) {
    if (is_done(first)) return {};
    const Plane plane = wires_[first].second;
    std::vector<PlaneLoop> loops;
    for (std::size_t i = first; i < wires_.size(); ++i) {
      const std::vector<RimEdge> rim = rim_of(wires_[i].first);
      const bool is_in_it = std::ranges::all_of(rim, [&](const RimEdge& e) {
        return std::ranges::all_of(e.points, [&](Vec3 x) { return plane.distance(x) <= tolerance_; });
      });
      if (is_done(i) || !is_in_it) continue;
      done_.push_back(i);
      std::optional<PlaneLoop> loop = loop_in_plane(wires_[i].first, plane.shape());
      if (!loop)
        leave(rim);
      else if (std::ranges::none_of(rim, [&](const RimEdge& e) { return is_outline(e, plane, loop->face); }))
        loops.push_back(*std::move(loop));
    }
    Faces faces = faces_between(loops, plane.shape());
    std::erase_if(faces, [&](const TopoDS_Face& face) {
      if (BRepCheck_Analyzer(face).IsValid()) return false;
      leave(rim_of(TopoDS::Wire(TopExp_Explorer(face, TopAbs_WIRE).Current())));
      return true;
    });
    return faces;
  }
  /// Whether the face beside the edge lies within the loop: a flat sheet, not an opening.
  bool is_outline(const RimEdge& e, const Plane& plane, const TopoDS_Face& loop) const {
    constexpr double kBeside = 0.05;
    if (!owners_.Contains(e.edge)) return false;  // a joint
    const Vec3 a = e.points[kSamples / 2], way = e.points[kSamples / 2 + 1] - a;
    const TopoDS_Face owner = TopoDS::Face(owners_.FindFromKey(e.edge).First());
    for (const double side : {-kBeside, kBeside}) {
      const Vec3 x = a + side * cross(plane.normal, way);
      const gp_Pnt p(x.x, x.y, x.z);
      if (is_in(p, loop) && is_in(p, owner)) return true;
    }
    return false;
  }
  bool is_done(std::size_t i) const { return std::ranges::find(done_, i) != done_.end(); }

  double diagonal_, tolerance_;
  std::vector<ImportFinding>& findings_;
  TopTools_IndexedDataMapOfShapeListOfShape owners_;  // of edges
  FlatWires wires_;
  std::vector<std::size_t> done_;
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
