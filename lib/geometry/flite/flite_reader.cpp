#include "geometry/flite/flite_reader.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Wire.hxx>
#include <array>
#include <map>
#include <memory>
#include <set>

#include "base/error.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/flite/flite_bspline.h"
#include "geometry/flite/flite_file.h"
#include "geometry/flite/flite_loops.h"
#include "geometry/flite/flite_trim.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr double kLargestMisfit = 0.1;  // of a segment's length: further off it isn't on its region's surface
constexpr int kMisfitSamples = 8;       // segments that decide on the order of a grid

gp_Pnt point(Vec3 p) { return {p.x, p.y, p.z}; }

/// A segment of a loop with its trimming curve.
struct TrimmedSegment {
  int segment;
  bool is_reversed;
  Handle(Geom2d_BSplineCurve) pcurve;
  Vec2 head() const { return at(!is_reversed); }
  Vec2 tail() const { return at(is_reversed); }
  Vec2 at(bool first) const {
    const gp_Pnt2d p = pcurve->Value(first ? pcurve->FirstParameter() : pcurve->LastParameter());
    return {p.X(), p.Y()};
  }
};
using TrimmedLoop = std::vector<TrimmedSegment>;

constexpr double kSmall = 1e-4;       // of the diagonal: distances that short segments may be off
constexpr double kMuchShorter = 0.8;  // lines of a grid taken the right way

class ShapeBuilder {
 public:
  ShapeBuilder(const FliteFile& file, const std::string& path)
      : file_(file), path_(path), topology_(flite_topology(file, path)), diagonal_(flite_box(file).diagonal()) {}

  CadPart build() {
    make_vertices();
    make_edges();
    surfaces_.resize(file_.surfaces.size());
    for (std::size_t r = 0; r < file_.regions.size(); ++r) faces_.push_back(make_face(static_cast<int>(r)));
    CadPart part;
    part.shape = shells();
    for (std::size_t r = 0; r < faces_.size(); ++r)
      part.faces.push_back({faces_[r], "region " + std::to_string(file_.regions[r].id), {}, -1});
    return part;
  }

 private:
  void make_vertices() {
    vertices_.resize(topology_.vertices.size());
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      builder_.MakeVertex(vertices_[v], point(topology_.vertices[v]),
                          1.01 * topology_.vertex_gap[v] + least_tolerance());
  }

  double least_tolerance() const { return std::max(1e-9 * diagonal_, 1e-12); }

  void make_edges() {
    edges_.resize(file_.segments.size());
    for (std::size_t s = 0; s < edges_.size(); ++s) {
      const auto& [start, end, is_point] = topology_.segments[s];
      if (is_point) continue;
      const Handle(Geom_BSplineCurve) curve = bspline_curve(file_.curves[file_.segments[s].curve].points);
      builder_.MakeEdge(edges_[s], curve, least_tolerance());
      builder_.Add(edges_[s], vertices_[start].Oriented(TopAbs_FORWARD));
      builder_.Add(edges_[s], vertices_[end].Oriented(TopAbs_REVERSED));
      builder_.Range(edges_[s], curve->FirstParameter(), curve->LastParameter());
    }
  }

  std::unique_ptr<Curve> curve_of(int segment) const {
    double t0 = 0, t1 = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edges_[segment], t0, t1);
    return make_curve(curve, t0, t1);
  }

  double resolution_at(int segment) const {
    return 2 * flite_resolution(file_.curves[file_.segments[segment].curve].points[0], diagonal_);
  }

  /// Length of all lines of a grid of rows of `n` points.
  static double line_length(const FliteSurface& s, int n) {
    const int n_points = static_cast<int>(s.points.size());
    double length = 0;
    for (int k = 0; k < n_points; ++k) {
      if ((k + 1) % n != 0) length += distance(s.points[k], s.points[k + 1]);
      if (k + n < n_points) length += distance(s.points[k], s.points[k + n]);
    }
    return length;
  }

  /// How far the curves of a surface's regions are from it, half way between their points.
  double misfit(int surface, const Handle(Geom_BSplineSurface) & candidate) const {
    const std::unique_ptr<Surface> s = make_surface(candidate);
    double sum = 0;
    int n = 0;
    for (const FliteRegion& region : file_.regions)
      for (const int segment : region.segments)
        if (region.surface == surface && !topology_.segments[segment].is_point && n < kMisfitSamples) {
          const std::unique_ptr<Curve> curve = curve_of(segment);
          sum += closest_point(*s, curve->point(std::floor(0.5 * curve->t_max()) + 0.37)).distance;
          ++n;
        }
    return sum;
  }

  /// The first count of a grid runs fastest in most files. The second does where the lines of the grid are much shorter
  /// so (a grid taken the wrong way jumps) and the curves are no further off the surface.
  const Handle(Geom_BSplineSurface) & surface(int k) {
    Handle(Geom_BSplineSurface)& made = surfaces_[k];
    if (!made.IsNull()) return made;
    const FliteSurface& s = file_.surfaces[k];
    made = bspline_surface(s.n_first, s.n_second, s.points);
    if (s.n_first != s.n_second && line_length(s, s.n_second) < kMuchShorter * line_length(s, s.n_first)) {
      const Handle(Geom_BSplineSurface) other = bspline_surface(s.n_second, s.n_first, s.points);
      if (misfit(k, other) <= misfit(k, made) + flite_resolution(s.points[0], diagonal_)) made = other;
    }
    return made;
  }

  TrimmedLoop trimmed(const FliteTopology::Loop& loop, const Surface& s, const FliteRegion& region) {
    TrimmedLoop result;
    for (const auto& [segment, is_reversed] : loop) {
      const std::unique_ptr<Curve> curve = curve_of(segment);
      const TrimmingCurve trim = project_curve(s, *curve, resolution_at(segment));
      const double length = arc_length(*curve, curve->t_min(), curve->t_max());
      if (trim.distance > std::max(kLargestMisfit * length, kSmall * diagonal_)) refuse(region, segment, trim);
      builder_.UpdateEdge(edges_[segment], 1.01 * trim.distance);
      for (const int v : {topology_.segments[segment].start, topology_.segments[segment].end})
        builder_.UpdateVertex(vertices_[v], 1.01 * trim.distance + topology_.vertex_gap[v]);
      result.push_back({segment, is_reversed, trim.curve});
    }
    return result;
  }

  [[noreturn]] void refuse(const FliteRegion& region, int segment, const TrimmingCurve& trim) const {
    throw Error(ExitCode::kInput,
                path_ + ": line " + std::to_string(region.line) + ": region " + std::to_string(region.id) +
                    ": segment " + std::to_string(file_.segments[segment].id) + " is " + format_number(trim.distance) +
                    " off surface " + std::to_string(file_.surfaces[region.surface].id) + " at (" +
                    format_number(trim.xyz.x) + ", " + format_number(trim.xyz.y) + ", " + format_number(trim.xyz.z) +
                    "); correct the region's surface or segments");
  }

  /// Twice the area that a loop encloses in (u,v), positive where it runs to the left around it.
  static double signed_area(const TrimmedLoop& loop) {
    constexpr int kSamples = 32;
    double area = 0;
    for (const TrimmedSegment& s : loop) {
      const double t0 = s.pcurve->FirstParameter(), t1 = s.pcurve->LastParameter();
      double part = 0;
      gp_Pnt2d last = s.pcurve->Value(t0);
      for (int k = 1; k <= kSamples; ++k) {
        const gp_Pnt2d p = s.pcurve->Value(t0 + (t1 - t0) * k / kSamples);
        part += last.X() * p.Y() - last.Y() * p.X();
        last = p;
      }
      area += s.is_reversed ? -part : part;
    }
    for (std::size_t k = 0; k < loop.size(); ++k) area += cross(loop[k].tail(), loop[(k + 1) % loop.size()].head());
    return area;
  }

  static void turn(TrimmedLoop& loop) {
    std::reverse(loop.begin(), loop.end());
    for (TrimmedSegment& s : loop) s.is_reversed = !s.is_reversed;
  }

  TopoDS_Face make_face(int r) {
    const FliteRegion& region = file_.regions[r];
    const Handle(Geom_BSplineSurface) support = surface(region.surface);
    const std::unique_ptr<Surface> s = make_surface(support);
    TopoDS_Face face;
    builder_.MakeFace(face, support, least_tolerance());
    std::vector<TrimmedLoop> loops;
    for (const auto& loop : topology_.loops[r]) loops.push_back(trimmed(loop, *s, region));
    std::size_t outer = 0;
    std::vector<double> areas;
    for (const TrimmedLoop& loop : loops) areas.push_back(signed_area(loop));
    for (std::size_t k = 0; k < loops.size(); ++k)
      if (std::fabs(areas[k]) > std::fabs(areas[outer])) outer = k;
    std::swap(loops[0], loops[outer]);
    std::swap(areas[0], areas[outer]);
    for (std::size_t k = 0; k < loops.size(); ++k) {
      if ((areas[k] > 0) != (k == 0)) turn(loops[k]);
      builder_.Add(face, make_wire(loops[k], face, *s));
    }
    return face;
  }

  TopoDS_Wire make_wire(const TrimmedLoop& loop, const TopoDS_Face& face, const Surface& s) {
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      TopoDS_Edge& edge = edges_[loop[k].segment];
      builder_.UpdateEdge(edge, loop[k].pcurve, face, BRep_Tool::Tolerance(edge));
      builder_.Range(edge, face, loop[k].pcurve->FirstParameter(), loop[k].pcurve->LastParameter());
      builder_.Add(wire, edge.Oriented(loop[k].is_reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
      add_pole(wire, loop[k], loop[(k + 1) % loop.size()], face, s);
    }
    wire.Closed(true);
    return wire;
  }

  /// A degenerated edge where the loop goes on elsewhere in (u,v), along a side that is a point in space.
  void add_pole(TopoDS_Wire& wire, const TrimmedSegment& before, const TrimmedSegment& after, const TopoDS_Face& face,
                const Surface& s) {
    const Vec2 from = before.tail(), to = after.head();
    const double unit = 1e-6;
    if (norm(to - from) <= unit) return;
    const auto& ends = topology_.segments[before.segment];
    const int v = before.is_reversed ? ends.start : ends.end;
    double width = 0;
    for (int k = 0; k <= 8; ++k)
      width = std::max(width, distance(s.point(from + (k / 8.0) * (to - from)), topology_.vertices[v]));
    if (width > 4 * resolution_at(before.segment)) return;
    builder_.UpdateVertex(vertices_[v], 1.01 * width);
    const double length = norm(to - from);
    const Handle(Geom2d_BSplineCurve) line = straight_pcurve(from, to, length);
    TopoDS_Edge edge;
    builder_.MakeEdge(edge);
    builder_.UpdateEdge(edge, line, face, BRep_Tool::Tolerance(vertices_[v]));
    builder_.Add(edge, vertices_[v].Oriented(TopAbs_FORWARD));
    builder_.Add(edge, vertices_[v].Oriented(TopAbs_REVERSED));
    builder_.Range(edge, 0, length);
    builder_.Degenerated(edge, true);
    builder_.Add(wire, edge);
  }

  /// Faces that share edges, in shells, each turned to fit its neighbours; faces_ are turned as well.
  TopoDS_Shape shells() {
    const std::vector<int> component = turn_alike();
    TopoDS_Compound compound;
    builder_.MakeCompound(compound);
    std::map<int, TopoDS_Shell> shells;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto [it, is_new] = shells.try_emplace(component[f]);
      if (is_new) builder_.MakeShell(it->second);
      builder_.Add(it->second, faces_[f]);
    }
    for (auto& [_, shell] : shells) {
      shell.Closed(count_free_edges(shell) == 0);
      builder_.Add(compound, shell);
    }
    return compound;
  }

  /// The first face of each face's shell.
  std::vector<int> turn_alike() {
    struct Use {
      int face;
      bool is_reversed;
    };
    std::vector<std::vector<Use>> uses(edges_.size());
    TopTools_IndexedMapOfShape edges;
    std::vector<std::vector<int>> face_edges(faces_.size());
    for (const TopoDS_Edge& edge : edges_)
      if (!edge.IsNull()) edges.Add(edge);
    uses.assign(edges.Extent(), {});
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (TopExp_Explorer e(faces_[f], TopAbs_EDGE); e.More(); e.Next())
        if (const int k = edges.FindIndex(e.Current()); k > 0) {
          uses[k - 1].push_back({static_cast<int>(f), e.Current().Orientation() == TopAbs_REVERSED});
          face_edges[f].push_back(k - 1);
        }
    std::vector<int> component(faces_.size(), -1);
    std::vector<bool> is_turned(faces_.size(), false);
    for (std::size_t first = 0; first < faces_.size(); ++first) {
      if (component[first] >= 0) continue;
      component[first] = static_cast<int>(first);
      std::vector<int> front{static_cast<int>(first)};
      for (std::size_t at = 0; at < front.size(); ++at)
        for (const int e : face_edges[front[at]]) {
          if (uses[e].size() != 2 || uses[e][0].face == uses[e][1].face) continue;
          const Use &own = uses[e][uses[e][0].face == front[at] ? 0 : 1],
                    &other = uses[e][uses[e][0].face == front[at] ? 1 : 0];
          if (component[other.face] >= 0) continue;
          component[other.face] = static_cast<int>(first);
          is_turned[other.face] = is_turned[own.face] != (own.is_reversed == other.is_reversed);
          front.push_back(other.face);
        }
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (is_turned[f]) faces_[f].Reverse();
    return component;
  }

  const FliteFile& file_;
  const std::string& path_;
  FliteTopology topology_;
  double diagonal_;
  BRep_Builder builder_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<TopoDS_Edge> edges_;                     // [segments], null for a point
  std::vector<Handle(Geom_BSplineSurface)> surfaces_;  // [surfaces], null until asked for
  std::vector<TopoDS_Face> faces_;                     // [regions]
};

}  // namespace

CadFile read_flite_shape(const std::string& path) {
  const FliteFile content = read_flite(path);
  CadFile file;
  file.format = "FLITE";
  file.parts.push_back(ShapeBuilder(content, path).build());
  return file;
}

}  // namespace st::occt
