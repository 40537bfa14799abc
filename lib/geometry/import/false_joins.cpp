#include "geometry/import/false_joins.h"

#include <Adaptor3d_CurveOnSurface.hxx>
#include <BRep_Tool.hxx>
#include <Extrema_ExtPC.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/disjoint_sets.h"
#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

constexpr int kSamples = 32;  // of a curve

/// A curve in space or on a surface.
struct Line {
  Handle(Adaptor3d_Curve) curve;
  std::vector<gp_Pnt> points;

  explicit Line(const Handle(Adaptor3d_Curve) & c) : curve(c) {
    const double t0 = c->FirstParameter(), t1 = c->LastParameter();
    for (int k = 0; k <= kSamples; ++k) points.push_back(c->Value(t0 + (t1 - t0) * k / kSamples));
  }
};

double distance_to_chord(const gp_Pnt& p, const gp_Pnt& a, const gp_Pnt& b) {
  const gp_Vec along(a, b), to(a, p);
  const double square = along.SquareMagnitude();
  const double s = square > 0 ? std::clamp(to.Dot(along) / square, 0.0, 1.0) : 0.0;
  return to.Subtracted(along.Multiplied(s)).Magnitude();
}

/// Chords first: they are near enough to most curves.
double distance_to(const Line& line, const gp_Pnt& p, double limit) {
  double least = std::numeric_limits<double>::max();
  for (int k = 0; k < kSamples; ++k) least = std::min(least, distance_to_chord(p, line.points[k], line.points[k + 1]));
  if (least <= limit) return least;
  const Extrema_ExtPC nearest(p, *line.curve, line.curve->FirstParameter(), line.curve->LastParameter());
  for (int k = 1; nearest.IsDone() && k <= nearest.NbExt(); ++k)
    least = std::min(least, std::sqrt(nearest.SquareDistance(k)));
  return least;
}

/// Of the points of each line from the other, the largest; at once when it is above the limit.
double distance_of(const Line& a, const Line& b, double limit) {
  double largest = 0;
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const gp_Pnt& p : from->points) {
      largest = std::max(largest, distance_to(*to, p, limit));
      if (largest > limit) return largest;
    }
  return largest;
}

/// From the edge in space to where the face ends; 0 where that cannot be told.
double distance_of(const TopoDS_Edge& edge, const TopoDS_Face& face, double limit) {
  try {
    double t0 = 0, t1 = 0, p0 = 0, p1 = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, p0, p1);
    if (curve.IsNull() || pcurve.IsNull()) return 0;
    const Line in_space(new GeomAdaptor_Curve(curve, t0, t1));
    const Line on_face(new Adaptor3d_CurveOnSurface(new Geom2dAdaptor_Curve(pcurve, p0, p1),
                                                    new GeomAdaptor_Surface(BRep_Tool::Surface(face))));
    return distance_of(in_space, on_face, limit);
  } catch (const Standard_Failure&) {
    return 0;
  }
}

/// A use of an edge by a face.
struct Use {
  int face = 0;               ///< 0-based
  TopoDS_Edge edge;           ///< as the face oriented forward has it
  bool runs_forward = false;  ///< along the edge, the face oriented as it is in the shape
};

class JoinSearch {
 public:
  JoinSearch(const TopoDS_Shape& shape, double limit) : limit_(limit) {
    TopExp::MapShapes(shape, TopAbs_FACE, faces_);
    for (int f = 0; f < faces_.Extent(); ++f) {
      const TopoDS_Face face = TopoDS::Face(faces_(f + 1).Oriented(TopAbs_FORWARD));
      const bool is_reversed = faces_(f + 1).Orientation() == TopAbs_REVERSED;
      for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
        const TopoDS_Edge edge = TopoDS::Edge(e.Current());
        if (is_constraint(edge) || BRep_Tool::Degenerated(edge)) continue;
        const auto i = static_cast<std::size_t>(edges_.Add(edge)) - 1;
        if (i == uses_.size()) uses_.emplace_back();
        uses_[i].push_back({f, edge, (edge.Orientation() == TopAbs_FORWARD) != is_reversed});
      }
    }
  }

  std::vector<FalseJoin> run() {
    for (const std::vector<Use>& uses : uses_) compare_places(uses);
    compare_sides();
    return std::move(found_);
  }

 private:
  TopoDS_Face face(int f) const { return TopoDS::Face(faces_(f + 1).Oriented(TopAbs_FORWARD)); }

  void compare_places(const std::vector<Use>& uses) {
    if (uses.size() < 2 || BRep_Tool::Tolerance(uses[0].edge) <= limit_) return;
    for (const Use& use : uses)
      if (const double d = distance_of(use.edge, face(use.face), limit_); d > limit_)
        found_.push_back({use.edge, faces_(use.face + 1), d});
  }

  /// Whether both sides of the edge agree with what is joined already; joins the faces where nothing is. `sides`: 2 f
  /// and 2 f + 1 are the sides of face f.
  static bool join(const Use& a, const Use& b, DisjointSets& sides) {
    const int is_one_turned = a.runs_forward == b.runs_forward ? 1 : 0;
    if (sides.find(2 * a.face) == sides.find(2 * b.face + 1 - is_one_turned)) return false;
    sides.join(2 * a.face, 2 * b.face + is_one_turned);
    sides.join(2 * a.face + 1, 2 * b.face + 1 - is_one_turned);
    return true;
  }

  /// In the order of the edges; then, where something contradicts, again from the longest edge on.
  void compare_sides() {
    std::vector<std::size_t> order(uses_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (contradictions(order).empty()) return;
    std::vector<double> length;
    for (const std::vector<Use>& uses : uses_) length.push_back(length_of(uses[0].edge));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
    for (const std::size_t i : contradictions(order))
      for (const Use& use : uses_[i])
        if (&use == uses_[i].data() || use.face != uses_[i][0].face)
          found_.push_back({use.edge, faces_(use.face + 1), 0});
  }

  /// The contradictions among faces that hang together without a free edge.
  std::vector<std::size_t> contradictions(const std::vector<std::size_t>& order) {
    DisjointSets sides(2 * std::int64_t{faces_.Extent()});
    std::vector<std::size_t> result;
    for (const std::size_t i : order)
      if (uses_[i].size() == 2 && !join(uses_[i][0], uses_[i][1], sides)) result.push_back(i);
    std::vector<char> is_open(2 * static_cast<std::size_t>(faces_.Extent()), 0);
    for (const std::vector<Use>& uses : uses_)
      if (uses.size() == 1)
        for (const int side : {0, 1}) is_open[sides.find(2 * uses[0].face + side)] = 1;
    std::erase_if(result, [&](std::size_t i) { return is_open[sides.find(2 * uses_[i][0].face)] != 0; });
    return result;
  }

  static double length_of(const TopoDS_Edge& edge) {
    double t0 = 0, t1 = 0, length = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
    for (int k = 0; k < kSamples && !curve.IsNull(); ++k)
      length += curve->Value(t0 + (t1 - t0) * k / kSamples).Distance(curve->Value(t0 + (t1 - t0) * (k + 1) / kSamples));
    return length;
  }

  double limit_;
  TopTools_IndexedMapOfShape faces_, edges_;
  std::vector<std::vector<Use>> uses_;  // [n_edges]
  std::vector<FalseJoin> found_;
};

}  // namespace

std::vector<FalseJoin> find_false_joins(const TopoDS_Shape& shape, double limit) {
  return JoinSearch(shape, limit).run();
}

}  // namespace st::occt
