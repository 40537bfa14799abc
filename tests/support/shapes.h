// Small B-Reps for the unit tests, made by OpenCASCADE and read back through import_model(). No OpenCASCADE type is
// visible.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/model.h"

namespace st::test {

/// Shapes of one or more faces, by name. make_shape() knows them all; an unknown name throws std::runtime_error.
/// - Solids: box sphere cylinder cone torus drilled_cylinder (hole across the seam) mirrored_cylinder two_boxes
///   thin_cylinder thin_pipe (radius 10, wall 0.05) spindle_torus (crosses itself on its axis) drilled_block
///   stepped_box (a step of 0.02 across the top) thin_plate (0.02 thick) wedge_strip (a blunt edge 0.02 to 1 wide)
///   framed_plate (a square window 0.1 from an edge)
///   plate_of_2_with_touching_hole (15 x 10 x 1, cut at x = 0, where the hole of radius 2 touches)
///   sharp_wing blunt_wing (NACA 0012, chord 10, span 30, edge 0.0252 wide) wing_in_box (the box without the wing)
///   swept_wing far_swept_wing (blunt and sharp, by 50 and 66 degrees)
///   swept_wing_in_box (forward by 39 degrees; its tip is in the box but for the rear half of the chord)
///   wing_with_pod (3.5 long and 1 wide, half of it below the wing) half_sharp_wing half_blunt_wing (cut at y = 0)
///   wing_on_body (its root in a box of 16 x 4 x 8 that ends at z = 4)
///   thin_wing (3.5 % thick) tapering_wing (chord 60 to 6) double_wedge (a wing whose profile is a rhombus)
///   lens (12.5 wide, 2 thick, its rim sharp)
///   pie (40 degrees of a cylinder about z) passage (40 degrees about x between two curved sides)
///   banded_pie (a band of 0.002 about a part of a cylinder, its upper side in two edges)
///   layered_bar (three bands of 0.1 beside each other on two sides, the uppermost in halves)
///   fan (the sharp wing revolved by 90 degrees about its nose) wing_skin (without tips, inside out)
///   thin_pin_in_block (radius 0.05, no gap) rod_and_shallow_prism
/// - Faces: square disc annulus thin_crescent (two circles 0.002 apart at x = 10) strip sharp_triangle (5.7 degrees)
/// spiked_plate (a corner of 5.7 degrees)
/// tip_of_2 (10 long, ruled from its chord to arcs 2 and 1 high: poles)
///   l_face plate_with_hole cone_side sphere_octant
/// - Sheets: wave rational_wave high_degree_wave bezier rational_bezier stretched kinked crumpled (folded in itself)
///   folded_sheet (a wave, offset by more than its radii) folded_sheet_and_pipe (a thin pipe in its box)
/// - Tubes: periodic_tube closed_tube rational_torus thin_tube tube_window (a window across the period)
/// - Others: revolution extrusion offset loose_box (six faces that share nothing) wire (no face)
///   t_junction (an edge of three faces) crossed_loop (two faces, the loop of one crosses itself)
///   baffled_box (a cube of 10 with a sheet of 4 x 4 standing on the middle of its floor, outside)
std::vector<std::string> all_shapes();

void write_brep(const std::string& shape, const std::string& path);
void write_binary_brep(const std::string& shape, const std::string& path);
/// `unit` as OpenCASCADE spells it: "MM", "INCH", "M". The shape's numbers are millimetres.
void write_step(const std::string& shape, const std::string& path, const std::string& unit);
/// Its faces, which share no edges; millimetres.
void write_iges(const std::string& shape, const std::string& path);
/// loose_box as STEP: each face a part of its own, named after the side it is ("x_min" ... "z_max").
void write_named_loose_box(const std::string& path);
/// A box with names on its faces ("wing", "symmetry", "Far Field"), a red one, a layer; and two instances of a part
/// "pin" at x = 100 and 150.
void write_named_assembly(const std::string& path);

/// The shape through a BREP file and import_model().
ImportResult import_shape(const std::string& shape);
Model make_model(const std::string& shape);
/// Cubes of 1 that stand apart: any number of faces.
Model make_row_of_cubes(int n);
/// A floor of `n` plane strips beside each other, each 30 long and 0.01 wide, between two walls 1 high.
Model make_channel(int n);

/// The same B-Rep evaluated by OpenCASCADE itself, without caches.
class Oracle {
 public:
  explicit Oracle(const std::vector<std::byte>& brep);
  ~Oracle();
  CurvePoint curve(EdgeId e, double t) const;
  SurfacePoint2 surface(FaceId f, Vec2 uv) const;
  double edge_length(EdgeId e) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace st::test
