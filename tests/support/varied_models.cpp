// Writes CAD models of many kinds, the same for the same numbers: varied_models DIR FIRST LAST
//
// Model n has kind n % 24 and parameters drawn from n. It is written as BREP, STEP (mm, m, inch) or IGES (faces or
// solids). A model that OpenCASCADE cannot make, not within 20 s, or not as a valid shape is left out and named.
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepLib.hxx>
#include <BRepOffsetAPI_MakeOffsetShape.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Line.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <gp_Circ.hxx>
#include <gp_Elips.hxx>
#include <gp_GTrsf.hxx>
#include <gp_Pln.hxx>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using Points = std::vector<gp_Pnt>;

/// A linear congruential generator: the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(2 * seed + 1) {
    for (int k = 0; k < 10; ++k) (*this)(0, 1);
  }
  double operator()(double lo, double hi) {
    state_ = 6364136223846793005u * state_ + 1442695040888963407u;
    return lo + (hi - lo) * static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }
  int whole(int lo, int hi) { return lo + static_cast<int>((*this)(0, hi - lo + 0.999999)); }
  gp_Pnt point(double reach) {
    const double x = (*this)(-reach, reach), y = (*this)(-reach, reach), z = (*this)(-reach, reach);
    return {x, y, z};
  }
  gp_Dir direction() {
    for (;;) {
      const gp_Pnt p = point(1);
      const double length = p.XYZ().Modulus();
      if (length > 0.1 && length < 1) return gp_Dir(p.XYZ());
    }
  }

 private:
  std::uint64_t state_;
};

// --- pieces; lengths about 10 ---

TopoDS_Shape made(BRepBuilderAPI_MakeShape&& maker) { return maker.Shape(); }

TopoDS_Shape primitive(Random& r) {
  const gp_Ax2 frame(r.point(4), r.direction());
  switch (r.whole(0, 4)) {
    case 0:
      return made(BRepPrimAPI_MakeBox(frame, r(4, 12), r(4, 12), r(4, 12)));
    case 1:
      return made(BRepPrimAPI_MakeCylinder(frame, r(1.5, 5), r(5, 14)));
    case 2:
      return made(BRepPrimAPI_MakeSphere(frame, r(3, 7)));
    case 3:
      return made(BRepPrimAPI_MakeCone(frame, r(3, 6), r.whole(0, 1) * r(0.5, 2.5), r(5, 12)));
    default:
      return made(BRepPrimAPI_MakeTorus(frame, r(5, 8), r(1, 3)));
  }
}

TopoDS_Shape block(Random& r) { return made(BRepPrimAPI_MakeBox(r(8, 14), r(8, 14), r(5, 12))); }

TopoDS_Shape booleans(Random& r) {
  TopoDS_Shape body = block(r);
  for (int k = r.whole(1, 4); k > 0; --k) {
    const TopoDS_Shape tool = primitive(r);
    body = r.whole(0, 1) ? made(BRepAlgoAPI_Fuse(body, tool)) : made(BRepAlgoAPI_Cut(body, tool));
  }
  return body;
}

Handle(Geom_BSplineCurve) spline(const Points& points, bool is_closed = false) {
  Handle(TColgp_HArray1OfPnt) array = new TColgp_HArray1OfPnt(1, static_cast<int>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) array->SetValue(static_cast<int>(k) + 1, points[k]);
  GeomAPI_Interpolate interpolate(array, is_closed, 1e-7);
  interpolate.Perform();
  return interpolate.Curve();
}

TopoDS_Wire wavy_ring(Random& r, double radius, double z) {
  Points points;
  const int n = r.whole(5, 9);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * M_PI * k / n, at = radius * r(0.75, 1.25);
    points.emplace_back(at * std::cos(angle), at * std::sin(angle), z);
  }
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(spline(points, true)).Edge()).Wire();
}

TopoDS_Face disc(gp_Ax2 frame, double radius) {
  return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(frame, radius)).Edge()).Wire(),
                                 true)
      .Face();
}

// --- kinds ---

TopoDS_Shape filleted(Random& r) {
  const TopoDS_Shape body = r.whole(0, 1) ? block(r) : made(BRepAlgoAPI_Cut(block(r), primitive(r)));
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(body, TopAbs_EDGE, edges);
  BRepFilletAPI_MakeFillet maker(body);
  const double radius = r(0.05, 1.2);
  const int step = r.whole(1, 3);
  for (int k = 1; k <= edges.Extent(); k += step) maker.Add(radius, TopoDS::Edge(edges(k)));
  return maker.Shape();
}

TopoDS_Shape chamfered(Random& r) {
  const TopoDS_Shape body = block(r);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(body, TopAbs_EDGE, edges);
  BRepFilletAPI_MakeChamfer maker(body);
  const double width = r(0.02, 1.5);
  for (int k = 1; k <= edges.Extent(); k += r.whole(1, 4)) maker.Add(width, TopoDS::Edge(edges(k)));
  return maker.Shape();
}

TopoDS_Shape lofted(Random& r) {
  BRepOffsetAPI_ThruSections maker(true, r.whole(0, 1) == 1);
  const int n = r.whole(2, 5);
  for (int k = 0; k < n; ++k) maker.AddWire(wavy_ring(r, r(2, 5), 4.0 * k));
  return maker.Shape();
}

TopoDS_Shape offset_body(Random& r) {
  BRepOffsetAPI_MakeOffsetShape maker;
  maker.PerformByJoin(made(BRepAlgoAPI_Fuse(block(r), made(BRepPrimAPI_MakeCylinder(3, 16)))), r(0.2, 1), 1e-4,
                      BRepOffset_Skin, false, false, r.whole(0, 1) ? GeomAbs_Arc : GeomAbs_Intersection);
  return maker.Shape();
}

TopoDS_Shape hollow(Random& r) {
  const TopoDS_Shape body = r.whole(0, 1) ? block(r) : made(BRepPrimAPI_MakeCylinder(r(3, 6), r(6, 12)));
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(body, TopAbs_FACE, faces);
  TopTools_ListOfShape open;
  open.Append(faces(r.whole(1, faces.Extent())));
  BRepOffsetAPI_MakeThickSolid maker;
  maker.MakeThickSolidByJoin(body, open, -r(0.1, 1), 1e-4);
  return maker.Shape();
}

TopoDS_Shape revolved(Random& r) {
  Points points;
  const int n = r.whole(4, 8);
  for (int k = 0; k < n; ++k) points.emplace_back(r(2, 6), 0, 3.0 * k);
  const gp_Pnt top(0, 0, points.back().Z()), bottom(0, 0, 0);
  BRepBuilderAPI_MakeWire wire(
      BRepBuilderAPI_MakeEdge(spline(points)).Edge(), BRepBuilderAPI_MakeEdge(points.back(), top).Edge(),
      BRepBuilderAPI_MakeEdge(top, bottom).Edge(), BRepBuilderAPI_MakeEdge(bottom, points.front()).Edge());
  const TopoDS_Face profile = BRepBuilderAPI_MakeFace(wire.Wire(), true).Face();
  const gp_Ax1 axis(bottom, gp::DZ());
  return r.whole(0, 1) ? made(BRepPrimAPI_MakeRevol(profile, axis))
                       : made(BRepPrimAPI_MakeRevol(profile, axis, r(0.5, 6)));
}

TopoDS_Shape swept(Random& r) {
  Points points;
  const int n = r.whole(3, 6);
  for (int k = 0; k < n; ++k) points.emplace_back(r(-4, 4), r(-4, 4), 8.0 * k);
  const Handle(Geom_BSplineCurve) path = spline(points);
  gp_Pnt start;
  gp_Vec along;
  path->D1(path->FirstParameter(), start, along);
  const TopoDS_Wire spine = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(path).Edge()).Wire();
  return made(BRepOffsetAPI_MakePipe(spine, disc(gp_Ax2(start, gp_Dir(along)), r(0.4, 1.5))));
}

/// A profile of a NACA thickness in the plane y; with a blunt trailing edge two curves and a line.
TopoDS_Wire profile(double x, double y, double z, double chord, double thickness, double blunt) {
  Points upper, lower;
  for (int k = 0; k <= 16; ++k) {
    const double s = 0.5 * (1 - std::cos(M_PI * k / 16)), half = blunt * s / 2;
    const double t =
        5 * thickness *
            (0.2969 * std::sqrt(s) - 0.126 * s - 0.3516 * s * s + 0.2843 * s * s * s - 0.1036 * s * s * s * s) +
        half;
    upper.emplace_back(x + chord * s, y, z + chord * (k == 16 ? half : t));
    lower.emplace_back(x + chord * s, y, z - chord * (k == 16 ? half : t));
  }
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(spline(upper)).Edge());
  if (blunt > 0) wire.Add(BRepBuilderAPI_MakeEdge(upper.back(), lower.back()).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(spline(lower)).Edge());
  return wire.Wire();
}

TopoDS_Shape wing(Random& r) {
  BRepOffsetAPI_ThruSections maker(true, true);
  const double blunt = r.whole(0, 1) * r(0.002, 0.02), sweep = r(0, 0.5), thickness = r(0.06, 0.18);
  double chord = r(4, 8), y = 0;
  for (int k = r.whole(2, 4); k > 0; --k) {
    maker.AddWire(profile(sweep * y, y, 0.05 * y, chord, thickness, blunt));
    y += r(6, 15), chord *= r(0.4, 0.9);
  }
  return maker.Shape();
}

TopoDS_Shape mirrored(Random& r) {
  const TopoDS_Shape half = booleans(r);
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp::DX()));
  const TopoDS_Shape other = BRepBuilderAPI_Transform(half, mirror, r.whole(0, 1) == 1).Shape();
  return r.whole(0, 1) ? made(BRepAlgoAPI_Fuse(half, other)) : other;
}

TopoDS_Shape extruded(Random& r) {
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(wavy_ring(r, 8, 0), true).Face();
  TopoDS_Shape body = made(BRepPrimAPI_MakePrism(face, gp_Vec(r(-2, 2), r(-2, 2), r(2, 12))));
  for (int k = r.whole(0, 3); k > 0; --k)
    body = made(BRepAlgoAPI_Cut(
        body, made(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(r(-4, 4), r(-4, 4), -5), gp::DZ()), r(0.2, 1), 30))));
  return body;
}

TopoDS_Compound together(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& s : shapes) builder.Add(all, s);
  return all;
}

TopoDS_Shape moved(const TopoDS_Shape& shape, gp_Vec by) {
  gp_Trsf shift;
  shift.SetTranslation(by);
  return BRepBuilderAPI_Transform(shape, shift, true).Shape();
}

/// Two or three parts, apart or with faces that lie on each other.
TopoDS_Shape parts(Random& r) {
  const TopoDS_Shape base = made(BRepPrimAPI_MakeBox(10, 10, 5));
  const double gap = r.whole(0, 1) * r(0.01, 2);
  std::vector<TopoDS_Shape> all{base, moved(made(BRepPrimAPI_MakeCylinder(r(1, 4), r(2, 8))), gp_Vec(5, 5, 5 + gap))};
  if (r.whole(0, 1)) all.push_back(moved(booleans(r), gp_Vec(40, 0, 0)));
  return together(all);
}

TopoDS_Shape far_away(Random& r) { return moved(booleans(r), gp_Vec(r(-5000, 5000), r(-5000, 5000), r(0, 9000))); }

Handle(Geom_BSplineSurface) wavy_surface(Random& r) {
  TColgp_Array2OfPnt points(1, r.whole(4, 7), 1, r.whole(4, 7));
  for (int i = 1; i <= points.UpperRow(); ++i)
    for (int j = 1; j <= points.UpperCol(); ++j) points(i, j) = gp_Pnt(3 * i, 3 * j, r(-1.2, 1.2));
  GeomAPI_PointsToBSplineSurface maker;
  maker.Interpolate(points);
  return maker.Surface();
}

TopoDS_Shape sheet(Random& r) {
  const TopoDS_Shape face = BRepBuilderAPI_MakeFace(wavy_surface(r), 1e-6).Face();
  if (r.whole(0, 1)) return face;
  const gp_Ax2 axis(gp_Pnt(r(6, 8), r(6, 8), -9), gp::DZ());
  return made(BRepAlgoAPI_Cut(face, made(BRepPrimAPI_MakeCylinder(axis, r(0.3, 2), 30))));
}

TopoDS_Shape with_void(Random& r) {
  const TopoDS_Shape outer =
      r.whole(0, 1) ? made(BRepPrimAPI_MakeSphere(8)) : made(BRepPrimAPI_MakeBox(gp_Pnt(-8, -8, -8), 16, 16, 16));
  const TopoDS_Shape inner =
      r.whole(0, 1) ? made(BRepPrimAPI_MakeSphere(r(2, 6))) : made(BRepPrimAPI_MakeTorus(r(3, 4), r(0.5, 2)));
  return made(BRepAlgoAPI_Cut(outer, inner));
}

TopoDS_Shape wedge(Random& r) {
  const TopoDS_Shape body = made(BRepPrimAPI_MakeWedge(r(6, 12), r(6, 12), r(6, 12), r(0, 5)));
  return made(
      BRepAlgoAPI_Fuse(body, made(BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(3, 3, 3), r.direction()), r(1, 3), 0, r(6, 14)))));
}

TopoDS_Shape spring(Random& r) {
  const double radius = r(3, 6), turns = r(1, 3), pitch = r(3, 5);
  const Handle(Geom_CylindricalSurface) cylinder = new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), radius);
  const Handle(Geom2d_Line) line = new Geom2d_Line(gp_Pnt2d(0, 0), gp_Dir2d(2 * M_PI, pitch));
  const double length = turns * std::hypot(2 * M_PI, pitch);
  TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(line, cylinder, 0, length).Edge();
  BRepLib::BuildCurves3d(edge);
  const TopoDS_Wire spine = BRepBuilderAPI_MakeWire(edge).Wire();
  const gp_Ax2 start(gp_Pnt(radius, 0, 0), gp_Dir(0, 2 * M_PI * radius, pitch));
  return made(BRepOffsetAPI_MakePipe(spine, disc(start, r(0.2, 1))));
}

TopoDS_Shape perforated(Random& r) {
  const int n = r.whole(2, 4);
  const double pitch = 20.0 / n, radius = r(0.02, 0.35) * pitch;
  TopTools_ListOfShape plate, holes;
  plate.Append(made(BRepPrimAPI_MakeBox(20, 20, r(0.2, 3))));
  for (int i = 0; i < n * n; ++i)
    holes.Append(made(BRepPrimAPI_MakeCylinder(
        gp_Ax2(gp_Pnt(pitch * (0.5 + i % n), pitch * (0.5 + i / n), -1), gp::DZ()), radius, 9)));
  BRepAlgoAPI_Cut cut;
  cut.SetArguments(plate);
  cut.SetTools(holes);
  cut.Build();
  return cut.Shape();
}

TopoDS_Shape stretched(Random& r) {
  gp_GTrsf stretch;
  stretch.SetValue(1, 1, r(0.3, 3));
  stretch.SetValue(2, 2, r(0.3, 3));
  stretch.SetValue(3, 3, r(0.3, 3));
  return BRepBuilderAPI_GTransform(r.whole(0, 1) ? primitive(r) : booleans(r), stretch, true).Shape();
}

TopoDS_Shape as_splines(Random& r) { return BRepBuilderAPI_NurbsConvert(booleans(r), true).Shape(); }

/// Each face for itself; in one order or the other, some reversed.
TopoDS_Shape loose(Random& r) {
  const TopoDS_Shape body = r.whole(0, 1) ? booleans(r) : wing(r);
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer it(body, TopAbs_FACE); it.More(); it.Next()) {
    TopoDS_Shape face = BRepBuilderAPI_Copy(it.Current()).Shape();
    if (r.whole(0, 3) == 0) face.Reverse();
    faces.push_back(face);
  }
  return together(r.whole(0, 1) ? faces : std::vector<TopoDS_Shape>(faces.rbegin(), faces.rend()));
}

/// Planes cut the faces of a body.
TopoDS_Shape split(Random& r) {
  TopTools_ListOfShape bodies, planes;
  bodies.Append(booleans(r));
  for (int k = r.whole(1, 3); k > 0; --k)
    planes.Append(BRepBuilderAPI_MakeFace(gp_Pln(r.point(3), r.direction()), -50, 50, -50, 50).Face());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(bodies);
  splitter.SetTools(planes);
  splitter.Build();
  return splitter.Shape();
}

/// Solids with common faces.
TopoDS_Shape partition(Random& r) {
  TopTools_ListOfShape bodies;
  bodies.Append(made(BRepPrimAPI_MakeBox(10, 10, 5)));
  bodies.Append(moved(made(BRepPrimAPI_MakeBox(r(4, 10), r(4, 10), r(2, 8))), gp_Vec(r(0, 3), r(0, 3), 5)));
  BRepAlgoAPI_BuilderAlgo builder;
  builder.SetArguments(bodies);
  builder.Build();
  return builder.Shape();
}

/// Much smaller than the body, or much longer than wide.
TopoDS_Shape small_on_large(Random& r) {
  const double size = std::pow(10, r(-2.5, -0.5));
  const TopoDS_Shape knob = r.whole(0, 1) ? made(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(4, 4, 4.5), gp::DZ()), size, 2))
                                          : made(BRepPrimAPI_MakeSphere(gp_Pnt(4, 4, 5), 3 * size));
  return made(BRepAlgoAPI_Fuse(made(BRepPrimAPI_MakeBox(10, 10, 5)), knob));
}

using Maker = std::function<TopoDS_Shape(Random&)>;
const std::vector<std::pair<std::string, Maker>>& kinds() {
  static const std::vector<std::pair<std::string, Maker>> all{
      {"booleans", booleans},  {"filleted", filleted},     {"chamfered", chamfered}, {"lofted", lofted},
      {"offset", offset_body}, {"hollow", hollow},         {"revolved", revolved},   {"swept", swept},
      {"wing", wing},          {"mirrored", mirrored},     {"extruded", extruded},   {"parts", parts},
      {"far", far_away},       {"sheet", sheet},           {"void", with_void},      {"wedge", wedge},
      {"spring", spring},      {"perforated", perforated}, {"stretched", stretched}, {"splines", as_splines},
      {"loose", loose},        {"split", split},           {"partition", partition}, {"small", small_on_large}};
  return all;
}

// --- files ---

void require(bool ok, const std::string& what) {
  if (!ok) throw std::runtime_error(what);
}

void write_step(const TopoDS_Shape& shape, const char* unit, const fs::path& path) {
  STEPControl_Controller::Init();
  require(Interface_Static::SetCVal("write.step.unit", unit), "no unit");
  STEPControl_Writer writer;
  require(
      writer.Transfer(shape, STEPControl_AsIs) == IFSelect_RetDone && writer.Write(path.c_str()) == IFSelect_RetDone,
      "not written");
}

void write_iges(const TopoDS_Shape& shape, int mode, const fs::path& path) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", mode);  // 0: loose faces, 1: solids
  require(writer.AddShape(shape) && writer.Write(path.c_str()), "not written");
}

/// Of five models two are STEP, two BREP, one IGES.
void write_model(const TopoDS_Shape& shape, int format, const std::string& stem) {
  switch (format) {
    case 0:
      return write_step(shape, "MM", stem + ".step");
    case 1:
      return write_step(shape, "M", stem + ".step");
    case 2:
      return write_step(shape, "INCH", stem + ".step");
    case 3:
      return write_step(shape, "MM", stem + ".stp");
    case 4:
      return write_iges(shape, 0, stem + ".igs");
    case 5:
      return write_iges(shape, 1, stem + ".iges");
    default:
      return require(BRepTools::Write(shape, (stem + ".brep").c_str()), "not written");
  }
}

void make_model(int number, const fs::path& folder) {
  Random random(static_cast<std::uint64_t>(number));
  const auto& [name, make] = kinds()[static_cast<std::size_t>(number) % kinds().size()];
  TopoDS_Shape shape = make(random);
  require(!shape.IsNull() && TopExp_Explorer(shape, TopAbs_FACE).More(), "nothing made");
  require(BRepCheck_Analyzer(shape).IsValid(), "not valid");
  if (random.whole(0, 2) == 0) {
    gp_Trsf scale;
    scale.SetScale(gp_Pnt(0, 0, 0), std::pow(10, random(-2, 3)));
    shape = BRepBuilderAPI_Transform(shape, scale, true).Shape();
  }
  char stem[64];
  std::snprintf(stem, sizeof stem, "v%04d_%s", number, name.c_str());
  write_model(shape, random.whole(0, 9), (folder / stem).string());
}

/// In a process of its own, since OpenCASCADE may crash or never end.
void make_apart(int number, const fs::path& folder) {
  constexpr unsigned kSeconds = 20;
  const pid_t child = fork();
  if (child == 0) {
    alarm(kSeconds);
    try {
      make_model(number, folder);
    } catch (const Standard_Failure& e) {
      std::fprintf(stderr, "model %d left out: %s\n", number, e.GetMessageString());
    } catch (const std::exception& e) {
      std::fprintf(stderr, "model %d left out: %s\n", number, e.what());
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) std::fprintf(stderr, "model %d left out: ended by signal %d\n", number, status & 127);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: varied_models DIR FIRST LAST\n");
    return 2;
  }
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  fs::create_directories(argv[1]);
  for (int n = std::atoi(argv[2]); n <= std::atoi(argv[3]); ++n) make_apart(n, argv[1]);
  return 0;
}
