#include "broken/narrow_shapes.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gp_Pln.hxx>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace st::test {
namespace {

/// A solid of plane faces that share vertices and edges.
class Polyhedron {
 public:
  explicit Polyhedron(const std::vector<gp_Pnt>& places) : places_(places) {
    for (const gp_Pnt& p : places) vertices_.push_back(BRepBuilderAPI_MakeVertex(p).Vertex());
    BRep_Builder().MakeShell(shell_);
  }

  /// Makes one vertex of two; edges to either are two still.
  void join_vertices(int keep, int gone) { vertices_[gone] = vertices_[keep]; }

  /// The edge between two vertices.
  void bend(int a, int b, const Handle(Geom_Curve) & curve) {
    edges_[{a, b}] = BRepBuilderAPI_MakeEdge(curve, vertices_[a], vertices_[b]).Edge();
  }

  /// Of any form; the trimming curve of each side, with the edge's parameters. From a vertex to itself: a pole.
  void add_face(const Handle(Geom_Surface) & surface,
                const std::vector<std::pair<std::pair<int, int>, Handle(Geom2d_Curve)>>& sides) {
    BRep_Builder builder;
    TopoDS_Face face;
    TopoDS_Wire wire;
    builder.MakeFace(face, surface, 1e-7);
    builder.MakeWire(wire);
    for (const auto& [ends, curve] : sides) {
      const TopoDS_Edge side = ends.first == ends.second ? pole(ends.first) : edge(ends.first, ends.second);
      builder.UpdateEdge(side, curve, face, 1e-7);
      builder.Range(side, face, curve->FirstParameter(), curve->LastParameter());
      builder.Add(wire, side);
    }
    wire.Closed(true);
    builder.Add(face, wire);
    builder.Add(shell_, face);
  }

  /// Counter-clockwise as seen from outside, a hole clockwise; the first three places give the plane.
  void add_face(const std::vector<int>& corners, const std::vector<int>& hole = {}) {
    const gp_Vec u(places_[corners[0]], places_[corners[1]]), v(places_[corners[0]], places_[corners[2]]);
    TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(places_[corners[0]], u.Crossed(v))).Face();
    for (const std::vector<int>& loop : {corners, hole}) {
      if (loop.empty()) continue;
      TopoDS_Wire wire;
      BRep_Builder().MakeWire(wire);
      for (std::size_t k = 0; k < loop.size(); ++k)
        BRep_Builder().Add(wire, edge(loop[k], loop[(k + 1) % loop.size()]));
      wire.Closed(true);
      BRep_Builder().Add(face, wire);
    }
    BRep_Builder().Add(shell_, face);
  }

  TopoDS_Shape solid(double tolerance) {
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(shell_, TopAbs_EDGE, edges);
    for (int e = 1; e <= edges.Extent(); ++e) BRep_Builder().UpdateEdge(TopoDS::Edge(edges(e)), tolerance);
    for (const TopoDS_Vertex& v : vertices_) BRep_Builder().UpdateVertex(v, tolerance);
    shell_.Closed(true);
    TopoDS_Solid result;
    BRep_Builder().MakeSolid(result);
    BRep_Builder().Add(result, shell_);
    return result;
  }

 private:
  TopoDS_Edge edge(int a, int b) {
    if (const auto it = edges_.find({b, a}); it != edges_.end()) return TopoDS::Edge(it->second.Reversed());
    if (!edges_.contains({a, b})) edges_[{a, b}] = BRepBuilderAPI_MakeEdge(vertices_[a], vertices_[b]).Edge();
    return edges_[{a, b}];
  }

  TopoDS_Edge pole(int a) {
    TopoDS_Edge result;
    BRep_Builder().MakeEdge(result);
    BRep_Builder().Degenerated(result, true);
    BRep_Builder().Add(result, vertices_[a].Oriented(TopAbs_FORWARD));
    BRep_Builder().Add(result, vertices_[a].Oriented(TopAbs_REVERSED));
    return result;
  }

  std::vector<gp_Pnt> places_;
  std::vector<TopoDS_Vertex> vertices_;
  std::map<std::pair<int, int>, TopoDS_Edge> edges_;
  TopoDS_Shell shell_;
};

TopoDS_Shape wall_twice(double far) {
  constexpr double kHeight = 0.5;
  std::vector<gp_Pnt> places;
  for (const double z : {0., kHeight}) {
    const double beside = z > 0 ? far : -far;
    for (const auto& [x, y] : {std::pair{-5., 0.}, {0., 0.}, {0., 10.}, {-5., 10.}, {beside, 8.}, {5., 8.}, {5., 10.}})
      places.emplace_back(x, y, z);
  }
  Polyhedron solid(places);
  solid.bend(2, 9, GC_MakeArcOfCircle(places[2], gp_Pnt(0, 9.8, 0.5 * kHeight), places[9]).Value());
  solid.add_face({0, 3, 2, 1});
  solid.add_face({4, 2, 6, 5});
  solid.add_face({7, 8, 9, 10});
  solid.add_face({11, 12, 13, 9});
  solid.add_face({0, 1, 8, 7});
  solid.add_face({3, 0, 7, 10});
  solid.add_face({13, 6, 2, 3, 10, 9});
  solid.add_face({5, 6, 13, 12});
  solid.add_face({4, 5, 12, 11});
  solid.add_face({8, 1, 2, 9});
  solid.add_face({11, 9, 2, 4});
  return solid.solid(0.001);
}

/// A block of 10 x 10 x 2 with a pocket of 4 x 4 above and 2 x 2 below, 1 deep, whose rim lies on the block's.
TopoDS_Shape pocket_at_rim() {
  Polyhedron solid({{0, 0, 0},
                    {10, 0, 0},
                    {10, 10, 0},
                    {0, 10, 0},
                    {0, 0, 2},
                    {10, 0, 2},
                    {10, 10, 2},
                    {0, 10, 2},
                    {0, 3, 2},
                    {0, 7, 2},
                    {4, 3, 2},
                    {4, 7, 2},
                    {1, 4, 1},
                    {3, 4, 1},
                    {3, 6, 1},
                    {1, 6, 1},
                    {0, 3, 2},
                    {0, 7, 2}});
  solid.join_vertices(8, 16);
  solid.join_vertices(9, 17);
  solid.add_face({0, 3, 2, 1});
  solid.add_face({0, 1, 5, 4});
  solid.add_face({1, 2, 6, 5});
  solid.add_face({2, 3, 7, 6});
  solid.add_face({0, 4, 8, 9, 7, 3});
  solid.add_face({4, 5, 6, 7, 9, 8}, {16, 17, 11, 10});
  solid.add_face({17, 16, 12, 15});
  solid.add_face({11, 17, 15, 14});
  solid.add_face({10, 11, 14, 13});
  solid.add_face({16, 10, 13, 12});
  solid.add_face({12, 13, 14, 15});
  return solid.solid(1e-7);
}

constexpr double kLength = 40, kDepth = 20, kTop = 10;

/// The corner of a block of 40 x 20 x 10 along x, cut off between v = 0 (y = 0) and v = 1 (z = 10), so wide at the
/// start and at the end. `bulge`: of the parabola across; at 0.8 nearly an arc that is tangent to both sides.
Handle(Geom_BSplineSurface) blend_surface(double start, double end, double bulge) {
  TColgp_Array2OfPnt poles(1, 2, 1, 3);
  for (int i = 0; i < 2; ++i)
    for (const auto& [j, v, vv] : {std::tuple{1, -2., 4.}, {2, 0.5, -6.}, {3, 3., 9.}}) {  // v and v * v
      const double width = i == 0 ? start : end, out = bulge * (v - vv);
      poles(i + 1, j) = gp_Pnt(kLength * i, (v - out) * width, kTop + (v - 1 + out) * width);
    }
  TColStd_Array1OfReal u_knots(1, 2), v_knots(1, 2);
  TColStd_Array1OfInteger u_multiplicities(1, 2), v_multiplicities(1, 2);
  u_knots(1) = 0, u_knots(2) = kLength, v_knots(1) = -2, v_knots(2) = 3;
  u_multiplicities.Init(2), v_multiplicities.Init(3);
  return new Geom_BSplineSurface(poles, u_knots, v_knots, u_multiplicities, v_multiplicities, 1, 2);
}

/// v = at + off sin(6 pi x / 40) for u = x.
Handle(Geom2d_BSplineCurve) wave(double at, double off) {
  constexpr int kPoints = 96;
  const Handle(TColgp_HArray1OfPnt2d) points = new TColgp_HArray1OfPnt2d(1, kPoints + 1);
  const Handle(TColStd_HArray1OfReal) x = new TColStd_HArray1OfReal(1, kPoints + 1);
  for (int i = 0; i <= kPoints; ++i) {
    x->SetValue(i + 1, kLength * i / kPoints);
    points->SetValue(i + 1, {x->Value(i + 1), at + off * std::sin(6 * M_PI * (i % kPoints) / kPoints)});
  }
  Geom2dAPI_Interpolate maker(points, x, false, 1e-12);
  maker.Perform();
  return maker.Curve();
}

/// On the surface, by the same parameters.
Handle(Geom_BSplineCurve) lifted(const Handle(Geom_Surface) & surface, const Handle(Geom2d_Curve) & curve) {
  constexpr int kPoints = 192;
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kPoints + 1);
  const Handle(TColStd_HArray1OfReal) x = new TColStd_HArray1OfReal(1, kPoints + 1);
  for (int i = 0; i <= kPoints; ++i) {
    x->SetValue(i + 1, kLength * i / kPoints);
    const gp_Pnt2d uv = curve->Value(x->Value(i + 1));
    points->SetValue(i + 1, surface->Value(uv.X(), uv.Y()));
  }
  GeomAPI_Interpolate maker(points, x, false, 1e-9);
  maker.Perform();
  return maker.Curve();
}

/// Across the surface at `x`, from one v to another.
Handle(Geom2d_Curve) across(double x, double from, double to) {
  TColgp_Array1OfPnt2d poles(1, 2);
  TColStd_Array1OfReal knots(1, 2);
  TColStd_Array1OfInteger multiplicities(1, 2);
  poles(1) = gp_Pnt2d(x, from), poles(2) = gp_Pnt2d(x, to);
  knots(1) = 0, knots(2) = 1;
  multiplicities.Init(2);
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

/// The line of the surface between v = 0 and 1, its parameter v or the other way round from 0.
Handle(Geom_BSplineCurve) surface_line(const Handle(Geom_BSplineSurface) & surface, double x, bool is_reversed) {
  const Handle(Geom_BSplineCurve) line = Handle(Geom_BSplineCurve)::DownCast(surface->UIso(x));
  line->Segment(0, 1);
  if (is_reversed) line->Reverse();
  return line;
}

enum class Crossing { kTrimmingCurves, kEdges, kEdgesBeyondTolerance };

TopoDS_Shape blend(Crossing crossing, double start, double end, double bulge = 0) {
  const bool is_beyond = crossing == Crossing::kEdgesBeyondTolerance;
  const double off = 0.6, tolerance = is_beyond ? 1e-4 : off * M_SQRT2 * std::max(start, end);
  const Handle(Geom_BSplineSurface) surface = blend_surface(start, end, bulge);
  const bool has_tip = end == 0;
  const Handle(Geom2d_Curve) upper = wave(1, off), lower = wave(0, -off);
  std::vector<gp_Pnt> places;
  for (const double x : {0., kLength})
    for (const auto& [y, z] : {std::pair{0., 0.}, {kDepth, 0.}, {kDepth, kTop}}) places.emplace_back(x, y, z);
  for (const auto& [x, width] : {std::pair{0., start}, {kLength, end}})
    for (const double v : {0., 1.}) places.emplace_back(x, v * width, kTop + (v - 1) * width);
  const int low = has_tip ? 9 : 8;  // the lower edge's end: the tip
  Polyhedron solid(places);
  const auto edge_on = [&](const Handle(Geom2d_Curve) & wavy, double at) {
    return lifted(surface, crossing == Crossing::kTrimmingCurves ? wave(at, 0) : wavy);
  };
  solid.bend(7, 9, edge_on(upper, 1));
  solid.bend(6, low, edge_on(lower, 0));
  const Handle(Geom2d_Curve) first = across(0, 1, 0), last = across(kLength, 0, 1);
  solid.bend(7, 6, surface_line(surface, 0, true));
  if (!has_tip) solid.bend(8, 9, surface_line(surface, kLength, false));
  solid.add_face(surface, {{{6, low}, lower}, {{low, 9}, last}, {{9, 7}, upper}, {{7, 6}, first}});
  solid.add_face({0, 1, 4, 3});
  solid.add_face({4, 1, 2, 5});
  solid.add_face({0, 3, low, 6});
  solid.add_face({7, 9, 5, 2});
  solid.add_face({1, 0, 6, 7, 2});
  solid.add_face(has_tip ? std::vector<int>{3, 4, 5, 9} : std::vector<int>{3, 4, 5, 9, 8});
  return solid.solid(tolerance);
}

using Makers = std::map<std::string, std::function<TopoDS_Shape()>>;

Makers makers() {
  return {
      {"blend_beyond", [] { return blend(Crossing::kEdgesBeyondTolerance, 0.04, 0.04); }},
      {"blend_curves", [] { return blend(Crossing::kTrimmingCurves, 0.04, 0.04); }},
      {"blend_edges", [] { return blend(Crossing::kEdges, 0.04, 0.04); }},
      {"blend_round", [] { return blend(Crossing::kEdges, 0.04, 0.04, 0.8); }},
      {"blend_tip", [] { return blend(Crossing::kTrimmingCurves, 0.04, 0); }},
      {"pocket_at_rim", pocket_at_rim},
      {"wall_apart", [] { return wall_twice(0.02); }},
      {"wall_twice", [] { return wall_twice(0.002); }},
  };
}

}  // namespace

std::vector<std::string> narrow_shapes() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

void write_narrow(const std::string& name, const std::string& path) {
  const Makers all = makers();
  const auto maker = all.find(name);
  if (maker == all.end()) throw std::runtime_error("no narrow shape " + name);
  if (!BRepTools::Write(maker->second(), path.c_str())) throw std::runtime_error("cannot write " + path);
}

}  // namespace st::test
