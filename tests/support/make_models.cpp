// Writes the small CAD models of the tests: make_models DIR
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Application.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <gp_Elips.hxx>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "broken/broken_shapes.h"
#include "broken/damaged_shapes.h"
#include "broken/kinked_shapes.h"
#include "broken/narrow_shapes.h"
#include "support/moved_wings.h"
#include "support/shapes.h"

namespace {

namespace fs = std::filesystem;

void require(bool ok, const fs::path& path) {
  if (!ok) throw std::runtime_error("cannot write " + path.string());
}

void write_brep(const fs::path& path, const TopoDS_Shape& shape) {
  require(BRepTools::Write(shape, path.c_str()), path);
}

/// `unit` as OpenCASCADE spells it ("MM", "INCH", "M"); the shape's numbers are millimetres.
void write_step(const fs::path& path, const TopoDS_Shape& shape, const char* unit) {
  STEPControl_Controller::Init();
  require(Interface_Static::SetCVal("write.step.unit", unit), path);
  STEPControl_Writer writer;
  require(
      writer.Transfer(shape, STEPControl_AsIs) == IFSelect_RetDone && writer.Write(path.c_str()) == IFSelect_RetDone,
      path);
  Interface_Static::SetCVal("write.step.unit", "MM");
}

void write_iges(const fs::path& path, const TopoDS_Shape& shape) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", 0);  // 0: loose faces, as most IGES files have them
  require(writer.AddShape(shape) && writer.Write(path.c_str()), path);
}

TopoDS_Shape box(double x, double y, double z) { return BRepPrimAPI_MakeBox(x, y, z).Shape(); }

TopoDS_Shape block_with_hole() {
  const gp_Ax2 axis(gp_Pnt(30, 20, -5), gp_Dir(0, 0, 1));
  return BRepAlgoAPI_Cut(box(60, 40, 20), BRepPrimAPI_MakeCylinder(axis, 8, 30).Shape()).Shape();
}

/// One planar face with a round hole: an open model.
TopoDS_Shape plate_with_hole() {
  const TopoDS_Shape disc = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(30, 20, -5), gp_Dir(0, 0, 1)), 8, 10).Shape();
  const TopoDS_Shape plate = BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), 0, 60, 0, 40).Shape();
  return BRepAlgoAPI_Cut(plate, disc).Shape();
}

TopoDS_Shape two_boxes_apart() {
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, box(10, 10, 10));
  gp_Trsf shift;
  shift.SetTranslation(gp_Vec(30, 0, 0));
  builder.Add(both, BRepBuilderAPI_Transform(box(10, 10, 10), shift, true).Shape());
  return both;
}

/// A body, and a thin rod that asks for lengths far below the body's on one side of its wall.
TopoDS_Shape with_rod(const TopoDS_Shape& body, gp_Pnt from, gp_Dir along, double length) {
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, body);
  builder.Add(both, BRepPrimAPI_MakeCylinder(gp_Ax2(from, along), 0.3, length).Shape());
  return both;
}

/// A thin nacelle: a tube with a rod inside, near its wall.
TopoDS_Shape tube_with_rod() {
  const TopoDS_Shape outer = BRepPrimAPI_MakeCylinder(10, 40).Shape(),
                     inner = BRepPrimAPI_MakeCylinder(9.6, 40).Shape();
  return with_rod(BRepAlgoAPI_Cut(outer, inner).Shape(), gp_Pnt(8.9, 0, 17), gp_Dir(0, 0, 1), 6);
}

/// A tube of wall 0.03 and radius 1, 2 long, that lies across the axes.
TopoDS_Shape turned_tube() {
  const gp_Ax2 axis(gp_Pnt(0, 0, -1), gp_Dir(0, 0, 1));
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 0.4, 0.2)), 0.6);
  const TopoDS_Shape tube =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(axis, 1, 2).Shape(), BRepPrimAPI_MakeCylinder(axis, 0.97, 2).Shape())
          .Shape();
  return BRepBuilderAPI_Transform(tube, turn).Shape();
}

/// A block with a slot 0.6 wide along an arc of radius 15, open at both ends, that ends 4 above the ground.
TopoDS_Shape curved_slot() {
  const gp_Ax2 axis(gp_Pnt(20, -5, 4), gp_Dir(0, 0, 1));
  const TopoDS_Shape ring = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(axis, 15.3, 20).Shape(),
                                            BRepPrimAPI_MakeCylinder(axis, 14.7, 20).Shape())
                                .Shape();
  return BRepAlgoAPI_Cut(box(40, 20, 10), ring).Shape();
}

/// The half of an ellipsoid of revolution above its base: radii of curvature from 10/3 at the tip (a pole) to 90 along
/// the wall at its foot, and a sharp circular edge.
TopoDS_Shape dome() {
  const gp_Ax2 frame(gp_Pnt(0, 0, 0), gp_Dir(0, -1, 0), gp_Dir(0, 0, 1));  // the long axis upwards
  const gp_Pnt centre(0, 0, 0), tip(0, 0, 30), rim(10, 0, 0);
  BRepBuilderAPI_MakeEdge arc(gp_Elips(frame, 30, 10), rim, tip), axis(tip, centre), base(centre, rim);
  BRepBuilderAPI_MakeWire profile(arc, axis, base);
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(profile.Wire()).Face(), gp_Ax1(centre, gp_Dir(0, 0, 1))).Shape();
}

void name(const TDF_Label& label, const char* text) {
  TDataStd_Name::Set(label, TCollection_ExtendedString(text, true));
}

/// A wing element along y: a round nose of this radius at x, and straight sides to a blunt trailing edge.
TopoDS_Shape wing_element(double x, double radius, double chord, double y, double span) {
  constexpr double kHalfEdge = 0.25;
  const gp_Pnt top(x + radius, y, radius), nose(x, y, 0), bottom(x + radius, y, -radius),
      upper(x + chord, y, kHalfEdge), lower(x + chord, y, -kHalfEdge);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(top, nose, bottom).Value()).Edge(),
                               BRepBuilderAPI_MakeEdge(bottom, lower).Edge(),
                               BRepBuilderAPI_MakeEdge(lower, upper).Edge(),
                               BRepBuilderAPI_MakeEdge(upper, top).Edge());
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, span, 0)).Shape();
}

/// Parts of their own, by name.
void write_parts(const std::vector<std::pair<const char*, TopoDS_Shape>>& parts, const fs::path& path) {
  STEPCAFControl_Controller::Init();
  Handle(TDocStd_Document) document;
  const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
  application->NewDocument("MDTV-XCAF", document);
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  for (const auto& [part, shape] : parts) name(shapes->AddShape(shape, false), part);
  STEPCAFControl_Writer writer;
  writer.SetNameMode(true);
  require(writer.Transfer(document, STEPControl_AsIs) && writer.Write(path.c_str()) == IFSelect_RetDone, path);
  application->Close(document);
}

/// As conceptual-design tools export it: a wing passes through a body, a pylon through both.
void write_concept(const fs::path& path) {
  write_parts({{"body", BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-10, 0, 0), gp::DX()), 2, 20).Shape()},
               {"wing", BRepPrimAPI_MakeBox(gp_Pnt(-2, -15, -0.25), 4, 30, 0.5).Shape()},
               {"pylon", BRepPrimAPI_MakeBox(gp_Pnt(-0.5, -0.2, -0.5), 1, 0.4, 4).Shape()}},
              path);
}

/// Two parts of those names: a wing of chord 60, and behind it a flap whose nose is round about the line x = 63.5, z =
/// 0.
void write_wing_with_flap(const fs::path& path) {
  write_parts({{"wing", wing_element(0, 4, 60, 0, 100)}, {"flap", wing_element(62, 1.5, 18, 10, 80)}}, path);
}

/// An assembly: a named block, and two instances of a pin of which one face has a name and a colour.
void write_assembly(const fs::path& path) {
  STEPCAFControl_Controller::Init();
  Handle(TDocStd_Document) document;
  const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
  application->NewDocument("MDTV-XCAF", document);
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TopoDS_Shape block = box(60, 40, 20), pin = BRepPrimAPI_MakeCylinder(4, 15).Shape();
  const TDF_Label assembly = shapes->NewShape(), block_label = shapes->AddShape(block, false),
                  pin_label = shapes->AddShape(pin, false);
  name(assembly, "assembly");
  name(block_label, "block");
  name(pin_label, "pin");
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(pin, TopAbs_FACE, faces);
  const TDF_Label face_label = shapes->AddSubShape(pin_label, faces(1));
  name(face_label, "pin_mantle");
  colors->SetColor(face_label, Quantity_Color(1, 0, 0, Quantity_TOC_RGB), XCAFDoc_ColorSurf);
  shapes->AddComponent(assembly, block_label, TopLoc_Location());
  for (const double x : {100.0, 150.0}) {
    gp_Trsf place;
    place.SetTranslation(gp_Vec(x, 0, 0));
    shapes->AddComponent(assembly, pin_label, TopLoc_Location(place));
  }
  shapes->UpdateAssemblies();
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  STEPCAFControl_Writer writer;
  writer.SetNameMode(true);
  writer.SetColorMode(true);
  require(writer.Transfer(document, STEPControl_AsIs) && writer.Write(path.c_str()) == IFSelect_RetDone, path);
  application->Close(document);
}

/// A cube of 10 in one of 100 around it, each of six faces that share no edge, the last one 0.5 % of the size away.
/// Two bodies apart, in no shells: one of them a single face.
TopoDS_Shape loose_box_and_sphere() {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  TopTools_IndexedMapOfShape faces;
  for (const TopoDS_Shape& body : {box(30, 20, 10), BRepPrimAPI_MakeSphere(gp_Pnt(60, 0, 0), 10).Shape()})
    TopExp::MapShapes(body, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) builder.Add(all, BRepBuilderAPI_Copy(faces(i)).Shape());
  return all;
}

/// The faces of a box, its top moved up by the gap.
void add_loose_faces(const TopoDS_Shape& box, double top_gap, TopoDS_Compound& all) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(box, TopAbs_FACE, faces);
  for (int i = 1; i <= 6; ++i) {
    gp_Trsf gap;
    gap.SetTranslation(gp_Vec(0, 0, i == 6 ? top_gap : 0));
    BRep_Builder().Add(all, BRepBuilderAPI_Transform(BRepBuilderAPI_Copy(faces(i)).Shape(), gap, true).Shape());
  }
}

TopoDS_Shape gappy_boxes() {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (const double size : {10.0, 100.0}) {
    gp_Trsf middle;
    middle.SetTranslation(gp_Vec(-0.5 * size, -0.5 * size, -0.5 * size));
    add_loose_faces(BRepBuilderAPI_Transform(box(size, size, size), middle, true).Shape(), 0.005 * size, all);
  }
  return all;
}

/// A cube of 1, of loose faces; the top is 0.02 above the sides.
TopoDS_Shape gappy_cube() {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  add_loose_faces(box(1, 1, 1), 0.02, all);
  return all;
}

void write_all(const fs::path& dir) {
  fs::create_directories(dir);
  const gp_Ax2 z(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  write_step(dir / "box.step", box(60, 40, 20), "MM");
  write_step(dir / "box_inch.step", box(60, 40, 20), "INCH");
  write_iges(dir / "box.igs", box(60, 40, 20));
  write_brep(dir / "box.brep", box(60, 40, 20));
  write_brep(dir / "sphere.brep", BRepPrimAPI_MakeSphere(10).Shape());
  write_brep(dir / "cylinder.brep", BRepPrimAPI_MakeCylinder(10, 30).Shape());
  write_brep(dir / "cone.brep", BRepPrimAPI_MakeCone(z, 10, 0, 20).Shape());
  write_brep(dir / "torus.brep", BRepPrimAPI_MakeTorus(20, 6).Shape());
  write_brep(dir / "plate_with_hole.brep", plate_with_hole());
  write_step(dir / "block_with_hole.step", block_with_hole(), "MM");
  write_brep(dir / "thin_plate.brep", box(100, 60, 0.2));
  write_brep(dir / "tube_with_rod.brep", tube_with_rod());
  write_brep(dir / "turned_tube.brep", turned_tube());
  write_brep(dir / "plate_with_rod.brep", with_rod(box(100, 60, 0.2), gp_Pnt(47, 30, 1.2), gp_Dir(1, 0, 0), 6));
  write_step(dir / "two_boxes.step", two_boxes_apart(), "MM");
  write_assembly(dir / "assembly.step");
  write_wing_with_flap(dir / "wing_with_flap.step");
  write_concept(dir / "concept.step");
  write_parts({{"plate", box(10, 10, 4)}, {"block", BRepPrimAPI_MakeBox(gp_Pnt(3, 3, 4), 4, 4, 3).Shape()}},
              dir / "stacked.step");
  for (const char* shape : {"crossed_loop", "fan", "thin_pipe", "vertex_back", "vertex_ahead", "vertex_aside",
                            "vertex_inside", "vertex_outside", "wing_of_8"})
    st::test::write_brep(shape, dir / (std::string(shape) + ".brep"));
  for (const char* shape : {"parted_corner", "hourglass", "touching_boxes", "box_twice", "wing_in_body",
                            "pod_in_c_50_half", "capsule_in_sphere_50", "far_circle", "folded_flap", "folded_sliver"})
    st::test::write_broken(shape, dir / (std::string(shape) + ".brep"));
  for (const char* shape : {"rod_hole", "rod_hole_p1", "rod_hole_closed", "rod_hole_nearly_closed", "rod_hole_no_seam",
                            "rod_hole_no_seam_p1", "stray_hole", "box_stray_hole", "box_stray_tube", "no_curve_ring",
                            "no_curve_lost", "twisted_band", "bumped_seam", "folded_offset"})
    st::test::write_damaged(shape, dir / (std::string(shape) + ".brep"));
  for (const std::string& shape : st::test::kinked_shapes()) st::test::write_kinked(shape, dir / (shape + ".brep"));
  for (const std::string& shape : st::test::narrow_shapes()) st::test::write_narrow(shape, dir / (shape + ".brep"));
  for (const int twist : {0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20})
    write_brep(dir / ("twisted_wing_" + std::to_string(twist) + ".brep"), st::test::twisted_wing(twist));
  for (const int flap : {0, 20})
    write_brep(dir / ("flapped_wing_" + std::to_string(flap) + ".brep"), st::test::flapped_wing(flap));
  for (const int flap : {5, 25})
    write_brep(dir / ("part_flapped_wing_" + std::to_string(flap) + ".brep"), st::test::part_flapped_wing(flap));
  write_brep(dir / "curved_slot.brep", curved_slot());
  write_brep(dir / "dome.brep", dome());
  write_brep(dir / "gappy_boxes.brep", gappy_boxes());
  write_brep(dir / "gappy_cube.brep", gappy_cube());
  write_brep(dir / "loose_box_and_sphere.brep", loose_box_and_sphere());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_models DIR\n");
    return 2;
  }
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    write_all(argv[1]);
  } catch (const Standard_Failure& e) {
    std::fprintf(stderr, "make_models: error: %s\n", e.GetMessageString());
    return 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_models: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
