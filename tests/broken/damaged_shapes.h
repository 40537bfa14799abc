// Sound B-Reps from which something was taken, or in which something was moved.
#pragma once

#include <string>
#include <vector>

namespace st::test {

/// Names of all, for write_damaged().
/// - Without a space curve: no_curve_ring (the circles of a rod), no_curve_all (every edge of a rod with a hole through
///   its seam), no_curve_torus (seams alone), no_curve_box (the trimming curves are all that is there), no_curve_at_all
///   (an edge of a box has neither), no_curve_disagree (the hole's edge is straight in (u,v) on the rod),
///   no_curve_ranges (as its circles, in other parameters on each face), no_curve_pole (poles that are not marked as
///   such), no_curve_bent (a hexagonal hole in one edge), no_curve_false_pole (a straight edge marked as a pole),
///   no_curve_lost (the upper circle of a rod has neither).
/// - bumped_seam (the seam of a sphere of radius 10 leaves it, in space alone), twisted_band (by half a turn, its ends
///   are one line), folded_offset (a gutter, offset by more than its radius).
/// - A rod of radius 30 and height 100 with radial holes of radius 5 at its side, not through its seam: rod_hole (none
///   is moved), rod_hole_p1, rod_hole_m3 (periods of the hole), rod_holes_one_off (of three), rod_outer_off (all but
///   the hole), rod_hole_reversed (the solid reversed), rod_hole_spline, rod_hole_closed (the side a B-spline, periodic
///   or only closed), rod_all_beyond (a closed one, all its loops a turn too far), rod_hole_elsewhere (half a turn
///   off), rod_hole_nearly_closed (a spline, closed within tolerance, the hole a turn off), rod_hole_no_seam and
///   rod_hole_no_seam_p1 (without the seam; the hole a turn off).
/// - stray_hole: a quarter of a tube's side, with a hole in what is not there; box_stray_hole: a hole in the plane of a
///   box's top, beside it; box_stray_tube: likewise, and another face begins there.
/// - rim_hole: a disc of radius 10 with a hole of radius 0.02, between its rim and a polygon of 24 sides.
/// - A box of 60 x 40 x 20 with a hole of radius 8 through it: turned_hole, turned_outer (one loop of the top runs the
///   wrong way).
/// - A torus of radii 40 and 10 with a radial hole: torus_hole, torus_hole_off (in u and v).
std::vector<std::string> damaged_shapes();

/// Writes one as BREP. Throws std::runtime_error for an unknown name.
void write_damaged(const std::string& name, const std::string& path);

}  // namespace st::test
