// Flow domains around bodies, and machine parts that are none, without names:
//
//   body_in_air BODY KIND SIZE VARIANT OUT      OUT: .brep, .step or .igs
//   body_in_air part NAME OUT
//
// KIND: box, sphere, cylinder, c (half cylinder and box), prism (of six sides), bullet (half sphere and cylinder).
// SIZE: half width or radius over the body's diagonal. VARIANT: whole; half, above y = 0; halfquarter, and above
// its middle; turned, a whole one; halfturned; two, bodies; inner, a box with air on both sides around the body;
// innerhalf, likewise with faces of its own on both sides; solid, the body and the domain are solids over each other;
// wake, narrowwake, and another such box behind it; cut, the air in two blocks; slice, a tenth of the
// span between two planes; disc, a loose sheet; sheets, loose faces; open, half without a symmetry plane.
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <Bnd_Box.hxx>
#include <Geom_BezierCurve.hxx>
#include <IGESControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Solid.hxx>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/brep/compound.h"
#include "geometry/import/import.h"

namespace {

using st::occt::compound_of;

TopoDS_Shape first(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  const TopExp_Explorer e(shape, kind);
  return e.More() ? e.Current() : throw std::runtime_error("an operation of OpenCASCADE left nothing");
}

/// As st-import repairs it.
TopoDS_Shape read_body(const std::string& path, const std::string& symmetry) {
  st::ImportOptions options;
  options.air.symmetry = symmetry;
  const st::ImportResult r = st::import_model(path, options);
  std::istringstream stream(std::string(reinterpret_cast<const char*>(r.brep.data()), r.brep.size()));
  TopoDS_Shape shape;
  BinTools::Read(shape, stream);
  return shape;
}

struct Place {
  gp_Pnt middle;
  double r = 0, x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0, diagonal = 0;
};

Place place_of(const TopoDS_Shape& body, double size) {
  Bnd_Box box;
  BRepBndLib::AddOptimal(body, box, false, false);
  Place p;
  box.Get(p.x0, p.y0, p.z0, p.x1, p.y1, p.z1);
  p.middle = gp_Pnt((p.x0 + p.x1) / 2, (p.y0 + p.y1) / 2, (p.z0 + p.z1) / 2);
  p.diagonal = gp_Pnt(p.x0, p.y0, p.z0).Distance(gp_Pnt(p.x1, p.y1, p.z1));
  p.r = size * p.diagonal;
  return p;
}

TopoDS_Shape box(double x, double y, double z, double dx, double dy, double dz) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}

TopoDS_Shape domain(const std::string& kind, gp_Pnt c, double r) {
  const gp_Ax2 along(gp_Pnt(c.X() - r, c.Y(), c.Z()), gp::DX()), across(gp_Pnt(c.X(), c.Y() - r, c.Z()), gp::DY());
  if (kind == "sphere") return BRepPrimAPI_MakeSphere(c, r).Shape();
  if (kind == "cylinder") return BRepPrimAPI_MakeCylinder(along, r, 2 * r).Shape();
  if (kind == "c")
    return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(across, r, 2 * r).Shape(),
                            box(c.X(), c.Y() - r, c.Z() - r, 2 * r, 2 * r, 2 * r))
        .Shape();
  if (kind == "bullet")
    return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(c, r).Shape(),
                            BRepPrimAPI_MakeCylinder(gp_Ax2(c, gp::DX()), r, 3 * r).Shape())
        .Shape();
  if (kind == "prism") {
    BRepBuilderAPI_MakePolygon outline;
    for (int i = 0; i < 6; ++i) {
      const double angle = M_PI / 3 * i + 0.3;
      outline.Add(gp_Pnt(c.X() + r * std::cos(angle), c.Y() - r, c.Z() + r * std::sin(angle)));
    }
    outline.Close();
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(0, 2 * r, 0)).Shape();
  }
  if (kind == "box") return box(c.X() - r, c.Y() - r, c.Z() - r, 2 * r, 2 * r, 2 * r);
  throw std::runtime_error("no such kind: " + kind);
}

/// One solid: the outer shell, and those of what is inside, turned; faces of open surfaces lie beside it.
TopoDS_Shape with_voids(const TopoDS_Shape& outer, const TopoDS_Shape& inner) {
  BRep_Builder builder;
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, first(outer, TopAbs_SHELL));
  for (TopExp_Explorer s(inner, TopAbs_SOLID); s.More(); s.Next())
    for (TopExp_Explorer e(s.Current(), TopAbs_SHELL); e.More(); e.Next()) builder.Add(solid, e.Current().Reversed());
  std::vector<TopoDS_Shape> all{solid};
  for (TopExp_Explorer e(inner, TopAbs_FACE, TopAbs_SOLID); e.More(); e.Next()) all.push_back(e.Current());
  return compound_of(all);
}

TopoDS_Shape moved(const TopoDS_Shape& shape, const std::function<void(gp_Trsf&)>& set) {
  gp_Trsf t;
  set(t);
  return BRepBuilderAPI_Transform(shape, t, true).Shape();
}

TopoDS_Shape turned(const TopoDS_Shape& shape) {
  return moved(shape, [](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 3)), 0.7); });
}

TopoDS_Shape upper_half(const TopoDS_Shape& shape, const Place& p) {
  const double r = 8 * p.r;
  return BRepAlgoAPI_Common(shape, box(p.middle.X() - r, 0, p.middle.Z() - r, 2 * r, r, 2 * r)).Shape();
}

TopoDS_Shape faces_of(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) faces.push_back(e.Current());
  return compound_of(faces);
}

TopoDS_Shape half_in(const std::string& kind, const TopoDS_Shape& body, Place p, const std::string& variant) {
  p.middle.SetY(0);
  const TopoDS_Shape half = upper_half(domain(kind, p.middle, p.r), p);
  if (variant == "innerhalf") {
    const double m = 0.2 * p.diagonal;
    const TopoDS_Shape inner = box(p.x0 - m, 0, p.z0 - m, p.x1 - p.x0 + 2 * m, p.y1 + m, p.z1 - p.z0 + 2 * m);
    return compound_of({BRepAlgoAPI_Cut(half, inner).Shape(), BRepAlgoAPI_Cut(inner, body).Shape()});
  }
  const TopoDS_Shape air = BRepAlgoAPI_Cut(half, body).Shape();
  if (variant == "halfquarter") {
    const double r = 8 * p.r, z = p.middle.Z();
    return BRepAlgoAPI_Common(air, box(p.middle.X() - r, -r, z, 2 * r, 2 * r, r)).Shape();
  }
  if (variant == "halfturned") return turned(air);
  if (variant != "open") return air;
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer e(air, TopAbs_FACE); e.More(); e.Next()) {
    Bnd_Box own;
    BRepBndLib::AddOptimal(e.Current(), own, false, false);
    if (own.CornerMax().Y() > 1e-6 * p.diagonal) faces.push_back(e.Current());
  }
  return compound_of(faces);
}

/// A box around the body and one behind it in its wake, of `share` of its width and height.
TopoDS_Shape with_wake(const TopoDS_Shape& air, const Place& p, double share) {
  const double m = 0.2 * p.diagonal, w = share * (p.y1 - p.y0 + 2 * m), h = share * (p.z1 - p.z0 + 2 * m);
  TopTools_ListOfShape solids, boxes;
  solids.Append(first(air, TopAbs_SOLID));
  boxes.Append(box(p.x0 - m, p.y0 - m, p.z0 - m, p.x1 - p.x0 + 2 * m, p.y1 - p.y0 + 2 * m, p.z1 - p.z0 + 2 * m));
  boxes.Append(box(p.x1 + m, p.middle.Y() - w / 2, p.middle.Z() - h / 2, p.diagonal, w, h));
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(solids);
  splitter.SetTools(boxes);
  splitter.Build();
  return splitter.Shape();
}

TopoDS_Shape in_air(const std::string& kind, const TopoDS_Shape& body, const Place& p, const std::string& variant) {
  const TopoDS_Shape outer = domain(kind, p.middle, p.r), air = with_voids(outer, body);
  if (variant == "whole") return air;
  if (variant == "turned") return turned(air);
  if (variant == "sheets") return faces_of(air);
  if (variant == "wake") return with_wake(air, p, 1);
  if (variant == "narrowwake") return with_wake(air, p, 0.6);
  if (variant == "solid") return compound_of({outer, body});
  if (variant == "two")
    return with_voids(
        outer, compound_of({body, moved(body, [&](gp_Trsf& t) { t.SetTranslation(gp_Vec(0, 0, 0.6 * p.diagonal)); })}));
  if (variant == "inner") {
    const double m = 0.2 * p.diagonal;
    const TopoDS_Shape inner =
        box(p.x0 - m, p.y0 - m, p.z0 - m, p.x1 - p.x0 + 2 * m, p.y1 - p.y0 + 2 * m, p.z1 - p.z0 + 2 * m);
    return compound_of({with_voids(outer, inner), with_voids(inner, body)});
  }
  if (variant == "slice") {
    const double r = 3 * p.r, y = p.y0 + 0.45 * (p.y1 - p.y0), dy = 0.1 * (p.y1 - p.y0);
    return BRepAlgoAPI_Common(BRepAlgoAPI_Cut(outer, body).Shape(),
                              box(p.middle.X() - r, y, p.middle.Z() - r, 2 * r, dy, 2 * r))
        .Shape();
  }
  if (variant == "disc") {
    const gp_Circ circle(gp_Ax2(gp_Pnt(p.x0 - 0.3 * p.diagonal, p.middle.Y(), p.middle.Z()), gp::DX()),
                         0.2 * p.diagonal);
    const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire();
    return compound_of({air, BRepBuilderAPI_MakeFace(wire).Face()});
  }
  if (variant == "cut") {
    TopTools_ListOfShape solids, planes;
    solids.Append(first(air, TopAbs_SOLID));
    planes.Append(
        BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(p.x1 + 0.3 * p.r, 0, 0), gp::DX()), -9 * p.r, 9 * p.r, -9 * p.r, 9 * p.r)
            .Face());
    BRepAlgoAPI_Splitter splitter;
    splitter.SetArguments(solids);
    splitter.SetTools(planes);
    splitter.Build();
    return splitter.Shape();
  }
  throw std::runtime_error("no such variant: " + variant);
}

// --- machine parts ---

TopoDS_Shape cylinder(double x, double y, double z, gp_Dir along, double r, double h) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), along), r, h).Shape();
}

TopoDS_Shape cut(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Cut(a, b).Shape(); }
TopoDS_Shape fuse(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Fuse(a, b).Shape(); }
TopoDS_Shape ball(double x, double y, double z, double r) { return BRepPrimAPI_MakeSphere(gp_Pnt(x, y, z), r).Shape(); }

TopoDS_Shape rounded(const TopoDS_Shape& shape, double r) {
  BRepFilletAPI_MakeFillet fillet(shape);
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next()) fillet.Add(r, TopoDS::Edge(e.Current()));
  return fillet.Shape();
}

TopoDS_Shape capsule(double r, double h) {
  return fuse(fuse(cylinder(0, 0, 0, gp::DZ(), r, h), ball(0, 0, 0, r)), ball(0, 0, h, r));
}

/// A block with a wavy groove of depth 3.
TopoDS_Shape engraving() {
  TColgp_Array1OfPnt poles(1, 5);
  for (int i = 0; i < 5; ++i) poles(i + 1) = gp_Pnt(120 + 10 * i, 100 + (i % 2 ? 8 : -4), 97);
  const TopoDS_Edge wave = BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge();
  const TopoDS_Shape face = BRepPrimAPI_MakePrism(wave, gp_Vec(0, 5, 0)).Shape();
  return cut(box(0, 0, 0, 300, 200, 100), BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, 9)).Shape());
}

/// A hub with bores, and three twisted plates.
TopoDS_Shape propeller() {
  TopoDS_Shape all = cylinder(0, 0, -10, gp::DZ(), 10, 20);
  for (int i = 0; i < 3; ++i) {
    TopoDS_Shape blade = box(5, -6, -1, 55, 12, 2);
    blade = moved(blade, [](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp::DX()), 0.5); });
    blade = moved(blade, [&](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp::DZ()), 2 * M_PI / 3 * i); });
    all = fuse(all, blade);
  }
  for (int i = 0; i < 4; ++i)
    all = cut(all, cylinder(7 * std::cos(M_PI / 2 * i), 7 * std::sin(M_PI / 2 * i), -10, gp::DZ(), 1, 6));
  return all;
}

/// One of free form, through the plate.
/// `half_width`: of the curve's middle poles; 30 makes a corner of 112 degrees, 15 one of 57.
TopoDS_Shape plate_with_cam_hole(double half_width) {
  TColgp_Array1OfPnt poles(1, 5);
  const double x[] = {130, 150, 185, 150, 130}, y[] = {100, 100 - half_width, 100, 100 + half_width, 100};
  for (int i = 0; i < 5; ++i) poles(i + 1) = gp_Pnt(x[i], y[i], -5);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge());
  const TopoDS_Shape face = BRepBuilderAPI_MakeFace(wire.Wire()).Face();
  return cut(box(0, 0, 0, 300, 200, 10), BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, 20)).Shape());
}

TopoDS_Shape two_blocks() { return compound_of({box(0, 0, 0, 100, 100, 20), box(40, 40, 20, 20, 20, 20)}); }

TopoDS_Shape plate_with_slots() {
  TopoDS_Shape all = box(0, 0, 0, 300, 200, 10);
  for (int i = 0; i < 2; ++i)
    all = cut(all, fuse(box(120, 80 + 30 * i, -1, 40, 6, 12), cylinder(120, 83 + 30 * i, -1, gp::DZ(), 3, 12)));
  return all;
}

const std::map<std::string, std::function<TopoDS_Shape()>>& parts() {
  static const std::map<std::string, std::function<TopoDS_Shape()>> kParts{
      {"hollow_box", [] { return with_voids(box(0, 0, 0, 100, 80, 60), box(10, 10, 10, 80, 60, 40)); }},
      {"box_with_small_void", [] { return with_voids(box(0, 0, 0, 100, 100, 100), box(40, 40, 40, 20, 20, 20)); }},
      {"casting", [] { return with_voids(rounded(box(0, 0, 0, 100, 80, 60), 4), ball(50, 40, 30, 8)); }},
      {"casting_with_boss",
       [] {
         return with_voids(fuse(box(0, 0, 0, 100, 80, 60), cylinder(50, 40, 60, gp::DZ(), 15, 10)),
                           ball(50, 40, 30, 6));
       }},
      {"pressure_vessel", [] { return with_voids(capsule(50, 200), capsule(46, 200)); }},
      {"thick_vessel", [] { return with_voids(capsule(50, 200), capsule(20, 60)); }},
      {"hollow_ball", [] { return with_voids(ball(0, 0, 0, 50), ball(0, 0, 0, 20)); }},
      {"vessel_with_float",
       [] {
         return compound_of({with_voids(box(0, 0, 0, 100, 100, 100), box(5, 5, 5, 90, 90, 90)), ball(50, 50, 50, 10)});
       }},
      {"dowel_block", [] { return cut(box(0, 0, 0, 300, 200, 100), cylinder(150, 100, 90, gp::DZ(), 3, 20)); }},
      {"countersink",
       [] {
         return cut(box(0, 0, 0, 300, 200, 100),
                    BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(150, 100, 92), gp::DZ()), 0, 9, 9).Shape());
       }},
      {"ball_end_hole",
       [] {
         return cut(box(0, 0, 0, 300, 200, 100), fuse(cylinder(150, 100, 80, gp::DZ(), 5, 30), ball(150, 100, 80, 5)));
       }},
      {"pocket", [] { return cut(box(0, 0, 0, 300, 200, 100), rounded(box(130, 85, 80, 40, 30, 40), 4)); }},
      {"knob",
       [] {
         const TopoDS_Shape half = BRepAlgoAPI_Common(ball(0, 0, 0, 50), box(-50, -50, 0, 100, 100, 50)).Shape();
         return cut(half, cylinder(0, 0, 0, gp::DZ(), 4, 12));
       }},
      {"flange",
       [] {
         TopoDS_Shape all = cut(cylinder(0, 0, 0, gp::DZ(), 80, 15), cylinder(0, 0, 0, gp::DZ(), 30, 15));
         for (int i = 0; i < 8; ++i)
           all = cut(all, cylinder(60 * std::cos(M_PI / 4 * i), 60 * std::sin(M_PI / 4 * i), 0, gp::DZ(), 5, 15));
         return all;
       }},
      {"valve_block",
       [] {
         TopoDS_Shape all = cut(box(0, 0, 0, 120, 80, 60), cylinder(0, 40, 30, gp::DX(), 8, 90));
         all = cut(all, cylinder(60, 0, 30, gp::DY(), 6, 60));
         return cut(all, cylinder(30, 40, 30, gp::DZ(), 5, 30));
       }},
      {"propeller", propeller},
      {"engraving", engraving},
      {"ring", [] { return cut(BRepPrimAPI_MakeTorus(60, 20).Shape(), cylinder(60, 0, 10, gp::DZ(), 3, 20)); }},
      {"parts_in_a_case",
       [] {
         return compound_of({with_voids(box(0, 0, 0, 100, 80, 60), box(2, 2, 2, 96, 76, 56)),
                             box(20, 20, 10, 15, 15, 5), cylinder(60, 40, 10, gp::DZ(), 6, 20)});
       }},
      {"plate_with_cam_hole", [] { return plate_with_cam_hole(30); }},
      {"plate_with_tear_hole", [] { return plate_with_cam_hole(10.8); }},
      {"plate_with_slots", plate_with_slots},
      {"two_blocks", two_blocks}};
  return kParts;
}

void write(const TopoDS_Shape& shape, const std::string& path) {
  bool is_done = false;
  if (path.ends_with(".brep")) {
    is_done = BRepTools::Write(shape, path.c_str());
  } else if (path.ends_with(".igs")) {
    IGESControl_Writer writer("MM", 0);
    is_done = writer.AddShape(shape) && (writer.ComputeModel(), writer.Write(path.c_str()));
  } else {
    STEPControl_Writer writer;
    is_done =
        writer.Transfer(shape, STEPControl_AsIs) == IFSelect_RetDone && writer.Write(path.c_str()) == IFSelect_RetDone;
  }
  if (!is_done) throw std::runtime_error("cannot write " + path);
}

TopoDS_Shape make(const std::vector<std::string>& a) {
  if (a.size() == 3 && a[0] == "part") {
    const auto part = parts().find(a[1]);
    if (part == parts().end()) throw std::runtime_error("no such part: " + a[1]);
    return part->second();
  }
  if (a.size() != 5)
    throw std::runtime_error("usage: body_in_air BODY KIND SIZE VARIANT OUT, or part NAME OUT, or parts");
  const bool is_half = a[3].starts_with("half") || a[3] == "innerhalf" || a[3] == "open";
  const TopoDS_Shape body = read_body(a[0], is_half ? "y=0" : "");
  const Place place = place_of(body, std::atof(a[2].c_str()));
  return is_half ? half_in(a[1], body, place, a[3]) : in_air(a[1], body, place, a[3]);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments == std::vector<std::string>{"parts"}) {
      for (const auto& [name, factory] : parts()) std::puts(name.c_str());
      return 0;
    }
    write(make(arguments), arguments.empty() ? "" : arguments.back());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "body_in_air: %s\n", e.what());
    return 1;
  } catch (const Standard_Failure& e) {
    std::fprintf(stderr, "body_in_air: OpenCASCADE failed: %s\n", e.GetMessageString());
    return 1;
  }
}
