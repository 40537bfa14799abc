/// Faces with group names, sewn to closed solids. The name of a face hangs on its surface, which booleans and sewing
/// keep.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>
#include <map>
#include <string>
#include <vector>

namespace aircraft {

/// Group names of surfaces, by identity.
class NameTable {
 public:
  void set(const TopoDS_Face& face, const std::string& name);
  /// Name of the group the face was cut from. @throws std::runtime_error for a face whose surface nobody named.
  const std::string& of(const TopoDS_Face& face) const;

 private:
  std::map<const Standard_Transient*, std::string> names_;  // only looked up, never iterated
  std::vector<Handle(Geom_Surface)> alive_;                 // keeps the addresses unique
};

/// Collects the patches of one part.
class Patchwork {
 public:
  explicit Patchwork(NameTable& names) : names_(names) {}

  /// Adds the whole surface as one face.
  void add(const Handle(Geom_Surface) & surface, const std::string& name);

  /// Adds the plane face bounded by curves that join end to end in any order.
  void add_planar(const std::vector<Handle(Geom_Curve)>& boundary, const std::string& name);

  /// The closed solid. @throws std::runtime_error naming `what` when the patches leave a gap.
  TopoDS_Solid solid(const std::string& what) const;

  /// The patches joined at their common edges, with the edges that are free.
  TopoDS_Shape open_shell() const;

 private:
  NameTable& names_;
  std::vector<TopoDS_Face> faces_;
};

/// Straight line between two points as a curve with ends.
Handle(Geom_Curve) line(const gp_Pnt& a, const gp_Pnt& b);

}  // namespace aircraft
