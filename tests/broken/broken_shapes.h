// Small B-Reps with one defect each, as BREP files. No OpenCASCADE type is visible.
#pragma once

#include <string>

namespace st::test {

/// Writes the shape `name` to `path`; an unknown name throws std::runtime_error.
///   doubled_face     the six loose faces of a box 60 x 40 x 20, one of them twice
///   sheet_on_solid   that box as a solid, and before it in the file two of its faces as sheets
///   gappy_box        the six loose faces of that box with gaps up to 0.09
///   touching_boxes   two solids side by side that share a place, not a face
///   touching_boxes_and_sheet   those, and a triangle far away in no solid
///   offset_boxes     boxes 10 x 10 x 10 and 10 x 4 x 5; a side of the second, 4 x 5, lies inside one of the first
///   pin_in_plate     a plate 40 x 40 x 10 with a bore of radius 5, and a pin of that radius, 30 long, in it
///   boxes_along_edge two boxes of 10 that touch along an edge
///   box_twice        a box of 10, two solids at one place
///   pinched_block    a block 30 x 20 x 10, one edge of a hole in it lies on its side
///   looped_sheet     a sheet of free form, 10 high, that passes through itself along the z axis
///   open_loop        that sheet, cut off before it comes to itself
///   swallow_tail     the two halves of that sheet, with a common edge at x = -1
///   folded_flap      a rectangle of 10 x 2, and a trapezoid on one of its long sides that is folded back onto it
///   folded_sliver    the same, 10 x 4 and a trapezoid of an eighth of its area
///   crossing_boxes   a box of 10, and another one whose corner is in the middle of the first
///   wing_in_body     a body (cylinder, radius 2, length 20), a wing (box 4 x 30 x 0.5) through it, a pylon (box 1 x
///   0.4
///                    x 4) through both
///   box_in_box       a box of 10 inside a box of 60, two solids
///   pod_in_KIND_SIZE the flow around a pod of free form, 6 x 2 x 1.2, in a box, sphere, cylinder or c (half cylinder
///   and
///                    box) of 5, 50 or 1000 times its length; with _half only z > 0, with a plane of symmetry
///   capsule_in_KIND_SIZE, cone_in_KIND_SIZE   such a half domain around half a body of analytic faces, 6 long and 2
///   wide spot             a cube of 40 with a conical hole of 90 degrees, 4 deep blind_hole       a cube of 40 with a
///   hole of radius 4, 10 deep housing          a cube of 40 with a cavity of 30 inside moulded_block    a block 40 x
///   40 x 10 with the pocket of half a pod far_circle       a cylinder of radius 10 and height 20; the space curve of
///   its upper circle is 30 above both faces stacked_boxes    a box 60 x 40 x 20 and a box 10 high on one of its sides
///   of 60 x 40, which both solids have in common parted_corner    a plane square of 10, two sides of which end 0.5
///   short of their corner at (10, 10, 0) inside_out       a box 60 x 40 x 20 as a solid whose normals point inward
///   loose_shell      the shell of that box, inward, no solid
///   lone_sphere      the face of a sphere of radius 10, in no shell
///   nested_shells    shells of boxes of 60, 40 and 20 around one centre, no solid
///   off_pcurve       a wavy sheet, one trimming curve of which leaves its edge by about 0.5
///   lost_fillet      a pin of radius 2 whose rounded end (a surface of revolution, radius 1.2) has its circles half a
///   turn away in (u,v), vertices
///                    of tolerance 1
///   edges_elsewhere  the side of a cylinder of radius 2 whose edges are 20 away from it
///   off_meridian     an eighth of a sphere of radius 10 across the seam, both sides of which leave their meridian by
///   0.3 on the way to
///                    the pole
///   bow_tie          a plane face whose loop crosses itself in (5, 5, 0)
///   hourglass        two plane triangles tip to tip, one face whose loop passes the tip twice
///   sliver           a plane face of 100 x 0.001
///   flat             a plane face without area: three sides on one line
///   short_edge       a plane face with an edge of 0.0001
///   bare_sphere      a spherical face without loops
///   ring             the face of a torus of radii 10 and 2 whose loop is one circle around the tube, there and back
///   speeds           two rectangles whose common side both run at different speeds
void write_broken(const std::string& name, const std::string& path);

}  // namespace st::test
