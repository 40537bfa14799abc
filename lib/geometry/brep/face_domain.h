// A face as the import measures it: its surface and its loops in (u,v).
#pragma once

#include <Geom2d_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <memory>
#include <vector>

#include "geometry/brep/occt_evaluators.h"

namespace st::occt {

/// One use of an edge by a loop, with its trimming curve.
struct CoedgeUv {
  TopoDS_Edge edge;               ///< oriented as the loop uses it
  Handle(Geom2d_Curve) curve;     ///< null when the edge has none
  double t_start = 0, t_end = 0;  ///< in the loop's direction: t_start > t_end for a reversed edge
  bool is_line = false;
  std::vector<Vec2> polygon;  ///< sampled from t_start on, without the end; empty without a curve
};

struct LoopUv {
  std::vector<CoedgeUv> coedges;
  double area = 0;         ///< of the sampled polygon, signed, in (u,v)
  bool is_turned = false;  ///< it runs the wrong way: a hole as the outer loop does
  std::vector<Vec2> polygon() const;
};

/// Surface and loops; the loop of the largest signed area, the outer one, comes first. Edges inside the face are left
/// out.
struct FaceDomain {
  Box2 bounds;
  std::unique_ptr<Surface> surface;
  int n_u = 12, n_v = 12;                ///< samples across the bounds that show the surface's bumps
  std::vector<double> u_knots, v_knots;  ///< inside the bounds, ascending: between them the surface is smooth
  std::vector<LoopUv> loops;
};

/// `face` oriented forward.
FaceDomain make_domain(const TopoDS_Face& face);

/// Box of samples of the space curve, enlarged by what lies between samples.
Box3 sampled_box(const Curve& curve);

/// Box of samples inside the trimmed surface, enlarged by what lies between samples; empty for a plane and for a face
/// that no sample meets: their edges bound them.
Box3 sampled_box(const FaceDomain& domain);

}  // namespace st::occt
