#include "patchwork.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeSegment.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <stdexcept>

namespace aircraft {
namespace {

constexpr double kPoleTolerance = 1e-7;    // m: a boundary shorter than this is a pole
constexpr double kSewingTolerance = 1e-6;  // m: patches of a part share exact iso-curves, so this is generous

}  // namespace

void NameTable::set(const TopoDS_Face& face, const std::string& name) {
  alive_.push_back(BRep_Tool::Surface(face));
  names_[alive_.back().get()] = name;
}

const std::string& NameTable::of(const TopoDS_Face& face) const {
  const auto found = names_.find(BRep_Tool::Surface(face).get());
  if (found == names_.end()) throw std::runtime_error("a face lost its group name");
  return found->second;
}

void Patchwork::add(const Handle(Geom_Surface) & surface, const std::string& name) {
  faces_.push_back(BRepBuilderAPI_MakeFace(surface, kPoleTolerance).Face());
  names_.set(faces_.back(), name);
}

void Patchwork::add_planar(const std::vector<Handle(Geom_Curve)>& boundary, const std::string& name) {
  TopTools_ListOfShape edges;
  for (const auto& curve : boundary) edges.Append(BRepBuilderAPI_MakeEdge(curve).Edge());
  BRepBuilderAPI_MakeWire wire;
  wire.Add(edges);
  if (!wire.IsDone()) throw std::runtime_error("boundary of a plane face of '" + name + "' does not join");
  BRepBuilderAPI_MakeFace face(wire.Wire(), /*OnlyPlane=*/true);
  if (!face.IsDone()) throw std::runtime_error("boundary of a face of '" + name + "' is not plane");
  faces_.push_back(face.Face());
  names_.set(faces_.back(), name);
}

TopoDS_Solid Patchwork::solid(const std::string& what) const {
  BRepBuilderAPI_Sewing sewing(kSewingTolerance);
  for (const TopoDS_Face& face : faces_) sewing.Add(face);
  sewing.Perform();
  if (sewing.NbFreeEdges() != 0)
    throw std::runtime_error(what + ": " + std::to_string(sewing.NbFreeEdges()) + " free edges after sewing");
  TopExp_Explorer shells(sewing.SewedShape(), TopAbs_SHELL);
  if (!shells.More()) throw std::runtime_error(what + ": no shell after sewing");
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shells.Current())).Solid();
  if (shells.Next(); shells.More()) throw std::runtime_error(what + ": more than one shell after sewing");
  if (!BRepLib::OrientClosedSolid(solid)) throw std::runtime_error(what + ": the shell is not closed");
  return solid;
}

TopoDS_Shape Patchwork::open_shell() const {
  BRepBuilderAPI_Sewing sewing(kSewingTolerance);
  for (const TopoDS_Face& face : faces_) sewing.Add(face);
  sewing.Perform();
  return sewing.SewedShape();
}

Handle(Geom_Curve) line(const gp_Pnt& a, const gp_Pnt& b) { return Handle(Geom_Curve)(GC_MakeSegment(a, b).Value()); }

}  // namespace aircraft
