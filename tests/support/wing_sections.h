#pragma once

// Profiles, and bodies made of them, for wing_models: x along the flow, y to the side, z up.
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <functional>
#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>
#include <gp_Trsf.hxx>
#include <gp_Vec.hxx>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace st::wing_models {

enum class Tail { kSharp, kBlunt, kRound };

/// Lengths over the chord.
struct Foil {
  double thickness = 0.12, base = 0, camber = 0;
  Tail tail = Tail::kSharp;
  int base_pieces = 1;            // across
  std::vector<double> cuts = {};  // where the outline is cut: way along the chord, negative on the lower side
};
inline const Foil kBlunt{.base = 0.004, .tail = Tail::kBlunt};

/// Takes a place along the chord, in [0, 1], and across it.
using Frame = std::function<gp_Pnt(double, double)>;

struct Section {
  Foil foil;
  Frame frame;
};

/// Chord along x and z across, or turned by `angle` about the x axis: 90 degrees for what stands upright; `twist` about
/// the middle of the chord.
Frame straight(gp_Pnt nose, double chord, double angle_deg = 0, double twist_deg = 0);
/// Chord along a line in a plane across z, of which `middle` gives the place at a share; `scale`: of lengths across.
Frame along_line(const std::function<gp_Pnt(double)>& middle, double scale);

/// The outline's point at a share of the chord; `side`: 1 upper, -1 lower.
gp_Pnt at(const Section& section, double x, double side);

/// From the tail over the upper side around the nose to the tail.
TopoDS_Wire outline(const Section& section);
TopoDS_Edge line(gp_Pnt a, gp_Pnt b);
TopoDS_Shape loft(const std::vector<Section>& sections, bool is_ruled = true);
/// Of one foil.
TopoDS_Shape loft(const Foil& foil, const std::vector<Frame>& frames, bool is_ruled = true);

TopoDS_Shape box(double x, double y, double z, double dx, double dy, double dz);
TopoDS_Shape cylinder(gp_Pnt at, gp_Dir along, double r, double h);
TopoDS_Shape ball(gp_Pnt at, double r);
TopoDS_Shape cut(const TopoDS_Shape& a, const TopoDS_Shape& b);
TopoDS_Shape fuse(const TopoDS_Shape& a, const TopoDS_Shape& b);
TopoDS_Shape common(const TopoDS_Shape& a, const TopoDS_Shape& b);
TopoDS_Shape fuse_all(const std::vector<TopoDS_Shape>& shapes);
TopoDS_Shape moved(const TopoDS_Shape& shape, const std::function<void(gp_Trsf&)>& set);
TopoDS_Shape shifted(const TopoDS_Shape& shape, gp_Vec way);
/// About an axis through the origin, in radians.
TopoDS_Shape turned(const TopoDS_Shape& shape, gp_Dir axis, double angle);

/// About the x axis.
TopoDS_Shape ring(const Foil& foil, double radius, double chord, double angle = 2 * M_PI);
/// Closed, in the plane of x and z.
TopoDS_Face polygon(const std::vector<gp_Pnt>& points);
/// Extruded along y.
TopoDS_Shape prism(const std::vector<gp_Pnt>& points, double length);
/// Between outlines of straight lines: its faces are splines.
TopoDS_Shape polygon_loft(const std::vector<std::vector<gp_Pnt>>& outlines);
/// A body of revolution about the x axis through points (x, radius), smooth, from one tip to another or to a flat end.
TopoDS_Shape fuselage(const std::vector<std::pair<double, double>>& radii);

using Maker = std::function<TopoDS_Shape()>;
using Makers = std::map<std::string, Maker>;

}  // namespace st::wing_models
