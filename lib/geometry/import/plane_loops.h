// Faces between closed loops of edges in a plane, and the shells that faces make.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pln.hxx>
#include <optional>
#include <string>
#include <vector>

namespace st::occt {

using Faces = std::vector<TopoDS_Face>;

/// Edges that one of these faces uses once, poles left out.
std::vector<TopoDS_Edge> free_edges(const Faces& faces);

/// "(1, 2, 3), (4, 5, 6) ...": the middles of the first edges.
std::string places(const std::vector<TopoDS_Edge>& edges);

/// A closed wire in the plane, with the face that it bounds alone.
struct PlaneLoop {
  TopoDS_Wire wire;
  TopoDS_Face face;
  double area = 0;
  int depth = 0;
  int container = -1;
};

double area_of(const TopoDS_Shape& shape);
/// Positive where the faces point outward.
double volume_of(const TopoDS_Shape& shape);

/// The edges end to end, as far as they have vertices in common. A wire passes no vertex twice where all can be closed.
std::vector<TopoDS_Wire> simple_wires(const std::vector<TopoDS_Edge>& edges);

/// None for a wire that is not closed, or of which no face can be made. Precondition: it lies in the plane.
std::optional<PlaneLoop> loop_in_plane(const TopoDS_Wire& wire, const gp_Pln& plane);

/// Empty where an edge is in no closed loop.
std::vector<PlaneLoop> closed_loops(const std::vector<TopoDS_Edge>& edges, const gp_Pln& plane);

/// Every second region between nested loops: the outermost loop is the border of what is kept.
Faces faces_between(std::vector<PlaneLoop>& loops, const gp_Pln& plane);

/// A place on a wire.
gp_Pnt point_of(const TopoDS_Wire& wire);
bool is_in(const gp_Pnt& p, const TopoDS_Face& face);

/// Shells of faces that share edges, in the order of their first faces, each oriented alike.
std::vector<TopoDS_Shape> shells_of(const Faces& faces);

}  // namespace st::occt
