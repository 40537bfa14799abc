// A copy of a shape without locations, that can be changed part by part, or is an image of it.
#pragma once

#include <TopTools_DataMapOfShapeShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Trsf.hxx>

namespace st::occt {

/// Copies shapes so that each place has vertices, edges and faces of its own, where OpenCASCADE has one of them at
/// several places (instances, both ends of a prism). What was shared at one place still is; surfaces and curves without
/// a location are those of the original. Points, parameters, tolerances and flags stay; triangulations are left out.
class PlacedCopy {
 public:
  PlacedCopy() = default;
  /// Moved or mirrored, all parameters stay. Mirrored faces are turned over: their normals are the images of those
  /// before.
  explicit PlacedCopy(const gp_Trsf& motion) : motion_(motion) {}
  /// A vertex or an edge that lies in a mirror's plane is its own image: both share it.
  void keep(const TopoDS_Shape& shape);
  /// The copy of a shape, or of a part of one that was copied; oriented as it is.
  TopoDS_Shape of(const TopoDS_Shape& shape);
  bool has(const TopoDS_Shape& shape) const { return copies_.IsBound(shape); }

 private:
  TopoDS_Shape make(const TopoDS_Shape& shape);
  TopoDS_Shape make_edge(const TopoDS_Edge& edge);
  TopoDS_Shape make_face(const TopoDS_Face& face);
  void add_children(const TopoDS_Shape& from, TopoDS_Shape& to);
  bool is_moved() const { return motion_.Form() != gp_Identity; }

  gp_Trsf motion_;
  TopTools_DataMapOfShapeShape copies_;  ///< of shapes at their places, oriented forward
};

}  // namespace st::occt
