// Gives the same shape in another way: vary_model IN OUT.brep VARIANT
//
//   same       as it is: what the others are compared with
//   moved      by 300 diagonals
//   turned     by 45 degrees about z
//   tumbled    by 40 degrees about a skew axis
//   scaled     to a thousandth
//   mirrored   across a plane of x
//   reordered  solids, shells and faces in the opposite order
//   loose      faces that share no edges
//   reversed   faces of no shell that share their edges, every second one turned over
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

TopoDS_Shape read_model(const std::string& path) {
  const auto ends_with = [&](const std::string& end) { return path.size() > end.size() && path.ends_with(end); };
  if (ends_with(".brep")) {
    TopoDS_Shape shape;
    BRep_Builder builder;
    if (!BRepTools::Read(shape, path.c_str(), builder)) throw std::runtime_error("cannot read " + path);
    return shape;
  }
  STEPControl_Reader step;
  IGESControl_Reader iges;
  XSControl_Reader& reader = ends_with(".igs") || ends_with(".iges") ? static_cast<XSControl_Reader&>(iges) : step;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot read " + path);
  reader.TransferRoots();
  return reader.OneShape();
}

TopoDS_Shape transformed(const TopoDS_Shape& shape, const gp_Trsf& trsf) {
  return BRepBuilderAPI_Transform(shape, trsf, Standard_True).Shape();
}

double diagonal(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  return std::sqrt(box.SquareExtent());
}

TopoDS_Shape moved(const TopoDS_Shape& shape) {
  gp_Trsf t;
  t.SetTranslation(gp_Vec(gp_Dir(3, -2, 1)) * 300 * diagonal(shape));
  return transformed(shape, t);
}

TopoDS_Shape turned(const TopoDS_Shape& shape, const gp_Dir& axis, double angle_deg) {
  gp_Trsf t;
  t.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), axis), angle_deg * M_PI / 180);
  return transformed(shape, t);
}

TopoDS_Shape scaled(const TopoDS_Shape& shape) {
  gp_Trsf t;
  t.SetScale(gp_Pnt(0, 0, 0), 0.001);
  return transformed(shape, t);
}

TopoDS_Shape mirrored(const TopoDS_Shape& shape) {
  gp_Trsf t;
  t.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0)));
  return transformed(shape, t);
}

/// Parts of compounds, solids and shells in the opposite order.
TopoDS_Shape reordered(const TopoDS_Shape& shape) {
  if (shape.ShapeType() > TopAbs_SHELL) return shape;
  std::vector<TopoDS_Shape> parts;
  for (TopoDS_Iterator i(shape); i.More(); i.Next()) parts.push_back(i.Value());
  TopoDS_Shape result = shape.EmptyCopied();
  result.Location(TopLoc_Location());
  BRep_Builder builder;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) builder.Add(result, reordered(*part));
  result.Closed(shape.Closed());
  return result;
}

/// All faces, each changed by `change(face, number)`.
TopoDS_Shape faces_of(const TopoDS_Shape& shape, const std::function<TopoDS_Shape(const TopoDS_Shape&, int)>& change) {
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  int n = 0;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) builder.Add(compound, change(e.Current(), n++));
  return compound;
}

TopoDS_Shape loose(const TopoDS_Shape& shape) {
  return faces_of(shape, [](const TopoDS_Shape& face, int) { return BRepBuilderAPI_Copy(face).Shape(); });
}

TopoDS_Shape reversed(const TopoDS_Shape& shape) {
  return faces_of(shape, [](const TopoDS_Shape& face, int n) { return n % 2 ? face.Reversed() : face; });
}

const std::map<std::string, std::function<TopoDS_Shape(const TopoDS_Shape&)>> kVariants = {
    {"same", [](const TopoDS_Shape& s) { return s; }},
    {"moved", moved},
    {"turned", [](const TopoDS_Shape& s) { return turned(s, gp_Dir(0, 0, 1), 45); }},
    {"tumbled", [](const TopoDS_Shape& s) { return turned(s, gp_Dir(1, 2, 3), 40); }},
    {"scaled", scaled},
    {"mirrored", mirrored},
    {"reordered", reordered},
    {"loose", loose},
    {"reversed", reversed}};

}  // namespace

int main(int argc, char** argv) {
  const auto variant = argc == 4 ? kVariants.find(argv[3]) : kVariants.end();
  if (variant == kVariants.end()) {
    std::fputs("usage: vary_model IN OUT.brep VARIANT\n", stderr);
    return 2;
  }
  try {
    const TopoDS_Shape shape = variant->second(read_model(argv[1]));
    if (!BRepTools::Write(shape, argv[2])) throw std::runtime_error(std::string("cannot write ") + argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "vary_model: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
