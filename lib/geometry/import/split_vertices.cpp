#include "geometry/import/split_vertices.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "geometry/brep/shape_queries.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr double kOpen = 0.5;      // of an arc's length: way between its ends
constexpr double kTogether = 0.1;  // of that way: between ends that become one vertex
constexpr int kPieces = 16;        // of an arc: to measure its length

/// Places along an edge, from its first to its last.
using Track = std::vector<gp_Pnt>;
/// Where an edge ends: at its first and its last vertex.
using Ends = std::array<gp_Pnt, 2>;

/// By the trimming curves.
std::vector<Track> tracks_of(const TopoDS_Edge& edge) {
  std::vector<Track> tracks;
  for (int k = 1;; ++k) {
    Handle(Geom2d_Curve) pcurve;
    Handle(Geom_Surface) surface;
    TopLoc_Location where;
    double t0 = 0, t1 = 0;
    BRep_Tool::CurveOnSurface(edge, pcurve, surface, where, t0, t1, k);
    if (pcurve.IsNull()) return tracks;
    tracks.emplace_back();
    for (int i = 0; i <= kPieces; ++i) {
      const gp_Pnt2d uv = pcurve->Value(t0 + (t1 - t0) * i / kPieces);
      tracks.back().push_back(surface->Value(uv.X(), uv.Y()).Transformed(where));
    }
  }
}

/// Of an edge that is marked as a pole, and is an arc on all its faces; nothing where it is a pole.
std::optional<Ends> ends_of_arc(const TopoDS_Edge& edge, double harmless) {
  const std::vector<Track> tracks = tracks_of(edge);
  if (tracks.empty()) return std::nullopt;
  const Ends ends{tracks[0].front(), tracks[0].back()};
  const double way = ends[0].Distance(ends[1]);
  double length = 0;
  for (std::size_t i = 1; i < tracks[0].size(); ++i) length += tracks[0][i].Distance(tracks[0][i - 1]);
  if (way <= 10 * harmless || way <= kOpen * length) return std::nullopt;
  for (const Track& other : tracks)
    if (std::max(other.front().Distance(ends[0]), other.back().Distance(ends[1])) > kTogether * way)
      return std::nullopt;
  return ends;
}

class VertexSplitter {
 public:
  explicit VertexSplitter(ImportedShape& model) : model_(model) { TopExp::MapShapes(model.shape, TopAbs_EDGE, edges_); }

  void run(std::vector<ImportFinding>& findings) {
    std::vector<std::size_t> poles;
    for (std::size_t i = 0; i < n_edges(); ++i)
      if (BRep_Tool::Degenerated(edge(i)) && vertex(i, 0).IsSame(vertex(i, 1)) && !vertex(i, 0).IsNull())
        poles.push_back(i);
    if (poles.empty()) return;
    harmless_ = std::max(kHarmless * model_.box().diagonal(), Precision::Confusion());
    for (std::size_t i = 0; i < n_edges(); ++i) vertices_.push_back({vertex(i, 0), vertex(i, 1)});
    for (const std::size_t i : poles)
      if (const std::optional<Ends> ends = ends_of_arc(edge(i), harmless_)) split(i, *ends, findings);
    if (!changed_.empty()) rebuild();
  }

 private:
  struct EdgeEnd {
    std::size_t edge = 0, end = 0;
    gp_Pnt x;
  };

  std::size_t n_edges() const { return static_cast<std::size_t>(edges_.Extent()); }
  TopoDS_Edge edge(std::size_t i) const {
    return TopoDS::Edge(edges_(static_cast<int>(i) + 1).Oriented(TopAbs_FORWARD));
  }
  TopoDS_Vertex vertex(std::size_t i, std::size_t end) const {
    return end == 0 ? TopExp::FirstVertex(edge(i)) : TopExp::LastVertex(edge(i));
  }

  std::optional<Ends> ends_of(std::size_t i) const {
    if (BRep_Tool::Degenerated(edge(i))) return ends_of_arc(edge(i), harmless_);
    double t0 = 0, t1 = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge(i), t0, t1);
    if (curve.IsNull()) return std::nullopt;
    return Ends{curve->Value(t0), curve->Value(t1)};
  }

  /// Nothing where an edge there is a pole, or has no curve.
  std::vector<EdgeEnd> edge_ends_at(const TopoDS_Vertex& at) const {
    std::vector<EdgeEnd> all;
    for (std::size_t i = 0; i < n_edges(); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        if (vertices_[i][k].IsNull() || !vertices_[i][k].IsSame(at)) continue;
        const std::optional<Ends> ends = ends_of(i);
        if (!ends) return {};
        all.push_back({i, k, (*ends)[k]});
      }
    return all;
  }

  void split(std::size_t arc, const Ends& ends, std::vector<ImportFinding>& findings) {
    const TopoDS_Vertex old = vertices_[arc][0];
    if (!old.IsSame(vertices_[arc][1])) return;  // split already
    const double way = ends[0].Distance(ends[1]);
    std::array<double, 2> tolerance{Precision::Confusion(), Precision::Confusion()};
    const std::vector<EdgeEnd> all = edge_ends_at(old);
    const auto side_of = [&](const EdgeEnd& e) -> std::size_t { return e.x.Distance(ends[1]) < e.x.Distance(ends[0]); };
    for (const EdgeEnd& e : all) {
      const std::size_t side = side_of(e);
      const double off = e.x.Distance(ends[side]);
      if (off > kTogether * way) return;
      tolerance[side] = std::max({tolerance[side], off, BRep_Tool::Tolerance(edge(e.edge))});
    }
    if (all.empty()) return;
    std::array<TopoDS_Vertex, 2> own;
    for (std::size_t k = 0; k < 2; ++k) BRep_Builder().MakeVertex(own[k], ends[k], tolerance[k]);
    for (const EdgeEnd& e : all) {
      vertices_[e.edge][e.end] = own[side_of(e)];
      changed_.insert(e.edge);
    }
    findings.push_back({FindingKind::kOther, "", vec(BRep_Tool::Pnt(old)), way, true,
                        "vertex that stood for both ends of an edge, split"});
  }

  void rebuild() {
    const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
    for (const std::size_t i : changed_) {
      TopoDS_Edge own = TopoDS::Edge(edge(i).EmptyCopied());
      BRep_Builder().Add(own, vertices_[i][0].Oriented(TopAbs_FORWARD));
      BRep_Builder().Add(own, vertices_[i][1].Oriented(TopAbs_REVERSED));
      reshape->Replace(edge(i), own);
    }
    for (auto& [named, name] : model_.edge_names) named = reshape->Value(named);
    model_.replace(reshape->Apply(model_.shape), [&](const TopoDS_Shape& face) { return reshape->Apply(face); });
  }

  ImportedShape& model_;
  TopTools_IndexedMapOfShape edges_;
  double harmless_ = 0;                                 // distance, unit of the file
  std::vector<std::array<TopoDS_Vertex, 2>> vertices_;  // of each edge, as they are to be
  std::set<std::size_t> changed_;                       // edges
};

}  // namespace

void split_vertices(ImportedShape& model, std::vector<ImportFinding>& findings) { VertexSplitter(model).run(findings); }

}  // namespace st::occt
