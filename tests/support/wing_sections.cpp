#include "wing_sections.h"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace st::wing_models {

namespace {

/// NACA 4-digit, closed.
double half_thickness(const Foil& foil, double x) {
  const double own = 0.2969 * std::sqrt(x) - x * (0.1260 + x * (0.3516 - x * (0.2843 - x * 0.1036)));
  return 5 * foil.thickness * own + 0.5 * foil.base * x;
}

}  // namespace

gp_Pnt at(const Section& s, double x, double side) {
  const double middle = 4 * s.foil.camber * x * (1 - x), slope = std::atan(4 * s.foil.camber * (1 - 2 * x));
  const double h = side * half_thickness(s.foil, x);
  return s.frame(x - h * std::sin(slope), middle + h * std::cos(slope));
}

TopoDS_Edge line(gp_Pnt a, gp_Pnt b) { return BRepBuilderAPI_MakeEdge(a, b).Edge(); }

TopoDS_Wire outline(const Section& s) {
  constexpr int kPoints = 24;  // of a side
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, 2 * kPoints + 1);
  std::vector<double> ways;
  for (int i = 0; i <= 2 * kPoints; ++i) {
    const double x = 0.5 * (1 + std::cos(M_PI * i / kPoints)), side = i <= kPoints ? 1 : -1;
    points->SetValue(i + 1, at(s, x, side));
    ways.push_back(side * x);
  }
  GeomAPI_Interpolate fit(points, false, 1e-9);
  fit.Perform();
  const Handle(Geom_BSplineCurve) curve = fit.Curve();
  std::vector<double> ends = {curve->FirstParameter(), curve->LastParameter()};
  for (const double cut : s.foil.cuts)
    for (int i = 1; i < 2 * kPoints; ++i)
      if (ways[i] < cut + 1e-12 && ways[i - 1] > cut + 1e-12) ends.push_back(curve->Knot(i + 1));
  std::sort(ends.begin(), ends.end());
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 1; i < ends.size(); ++i) wire.Add(BRepBuilderAPI_MakeEdge(curve, ends[i - 1], ends[i]).Edge());
  gp_Pnt from;
  gp_Vec along;
  curve->D1(curve->LastParameter(), from, along);
  const gp_Pnt to = curve->Value(curve->FirstParameter());
  if (s.foil.tail == Tail::kRound)
    wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(from, along, to).Value()).Edge());
  if (s.foil.tail == Tail::kBlunt)
    for (int i = 0; i < s.foil.base_pieces; ++i) {
      const auto part = [&](int k) {
        const double share = static_cast<double>(k) / s.foil.base_pieces;
        return gp_Pnt(from.XYZ() * (1 - share) + to.XYZ() * share);
      };
      wire.Add(line(part(i), part(i + 1)));
    }
  return wire.Wire();
}

Frame straight(gp_Pnt nose, double chord, double angle_deg, double twist_deg) {
  const double a = angle_deg * M_PI / 180, b = twist_deg * M_PI / 180;
  const gp_Vec up0(0, -std::sin(a), std::cos(a)), along0(1, 0, 0);
  const gp_Vec along = along0 * std::cos(b) - up0 * std::sin(b), up = up0 * std::cos(b) + along0 * std::sin(b);
  const gp_Pnt middle = nose.Translated(0.5 * chord * along0);
  return [=](double x, double h) { return middle.Translated(chord * ((x - 0.5) * along + h * up)); };
}

Frame along_line(const std::function<gp_Pnt(double)>& middle, double scale) {
  return [=](double x, double h) {
    const gp_Vec along(middle(x - 1e-4), middle(x + 1e-4));
    return middle(x).Translated(scale * h * gp_Vec(0, 0, 1).Crossed(along.Normalized()));
  };
}

TopoDS_Shape loft(const std::vector<Section>& sections, bool is_ruled) {
  BRepOffsetAPI_ThruSections thru(true, is_ruled, 1e-6);
  thru.CheckCompatibility(false);
  thru.SetParType(Approx_ChordLength);
  for (const Section& s : sections) thru.AddWire(outline(s));
  thru.Build();
  return thru.Shape();
}

TopoDS_Shape loft(const Foil& foil, const std::vector<Frame>& frames, bool is_ruled) {
  std::vector<Section> sections;
  for (const Frame& frame : frames) sections.push_back({foil, frame});
  return loft(sections, is_ruled);
}

TopoDS_Shape box(double x, double y, double z, double dx, double dy, double dz) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}
TopoDS_Shape cylinder(gp_Pnt at, gp_Dir along, double r, double h) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(at, along), r, h).Shape();
}
TopoDS_Shape ball(gp_Pnt at, double r) { return BRepPrimAPI_MakeSphere(at, r).Shape(); }
TopoDS_Shape cut(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Cut(a, b).Shape(); }
TopoDS_Shape fuse(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Fuse(a, b).Shape(); }
TopoDS_Shape common(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Common(a, b).Shape(); }
TopoDS_Shape fuse_all(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Shape all = shapes.front();
  for (std::size_t i = 1; i < shapes.size(); ++i) all = fuse(all, shapes[i]);
  return all;
}
TopoDS_Shape moved(const TopoDS_Shape& shape, const std::function<void(gp_Trsf&)>& set) {
  gp_Trsf t;
  set(t);
  return BRepBuilderAPI_Transform(shape, t, true).Shape();
}
TopoDS_Shape shifted(const TopoDS_Shape& shape, gp_Vec way) {
  return moved(shape, [&](gp_Trsf& t) { t.SetTranslation(way); });
}
TopoDS_Shape turned(const TopoDS_Shape& shape, gp_Dir axis, double angle) {
  return moved(shape, [&](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(), axis), angle); });
}

TopoDS_Shape ring(const Foil& foil, double radius, double chord, double angle) {
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(outline({foil, straight(gp_Pnt(0, 0, radius), chord)})).Face();
  return BRepPrimAPI_MakeRevol(face, gp::OX(), angle).Shape();
}

TopoDS_Face polygon(const std::vector<gp_Pnt>& points) {
  BRepBuilderAPI_MakePolygon wire;
  for (const gp_Pnt& p : points) wire.Add(p);
  wire.Close();
  return BRepBuilderAPI_MakeFace(wire.Wire()).Face();
}
TopoDS_Shape prism(const std::vector<gp_Pnt>& points, double length) {
  return BRepPrimAPI_MakePrism(polygon(points), gp_Vec(0, length, 0)).Shape();
}

TopoDS_Shape polygon_loft(const std::vector<std::vector<gp_Pnt>>& outlines) {
  BRepOffsetAPI_ThruSections thru(true, true, 1e-6);
  for (const std::vector<gp_Pnt>& points : outlines) {
    BRepBuilderAPI_MakePolygon wire;
    for (const gp_Pnt& x : points) wire.Add(x);
    wire.Close();
    thru.AddWire(wire.Wire());
  }
  return thru.Shape();
}

TopoDS_Shape fuselage(const std::vector<std::pair<double, double>>& radii) {
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, static_cast<int>(radii.size()));
  for (std::size_t i = 0; i < radii.size(); ++i)
    points->SetValue(static_cast<int>(i) + 1, gp_Pnt(radii[i].first, 0, radii[i].second));
  GeomAPI_Interpolate fit(points, false, 1e-9);
  fit.Load(gp_Vec(0, 0, 1), gp_Vec(1, 0, radii.back().second > 0 ? 0 : -1), false);
  fit.Perform();
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(fit.Curve()).Edge());
  const gp_Pnt first = points->First(), last = points->Last(), on_axis(last.X(), 0, 0);
  if (last.Distance(on_axis) > 1e-9) wire.Add(line(last, on_axis));
  wire.Add(line(on_axis, first));
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OX()).Shape();
}

}  // namespace st::wing_models
