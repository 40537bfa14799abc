// B-Reps with faces that have kinks inside, and such that only seem to.
#pragma once

#include <string>
#include <vector>

namespace st::test {

/// Names of all, for write_kinked().
/// - Prisms of height 2 over a rectangle of 4 by 3 whose sides but one are one edge: kink_prism (degree 1), kink_cubic
///   (degree 3, triple knots), kink_twice (two instances of the first, the second one turned and moved).
/// - kink_tube: over a square of side 4 whose outline is one periodic edge that begins in the middle of a side.
/// - kink_turned: two cones in one face, turned of an edge (radii 1, 3, 1, height 4), with two discs.
/// - One spline z = (|x| + |y|) / 2 over the square of side 4: kink_ridge, kink_hole (a round hole of radius 1 through
///   both kinks), kink_trimmed (a trimmed surface), kink_notch (two thirds of it: an edge of the loop lies on a kink).
/// - Not to be divided: no_kink_flat (a prism over a polyline that turns by 15 degrees), no_kink_plate (the
///   rectangle alone, kinks in its outline), no_kink_smooth (a ridge
///   without a slope: knots of full multiplicity in a plane), no_kink_side (of the ridge a part beside the kinks).
std::vector<std::string> kinked_shapes();

/// Writes one as BREP. Throws std::runtime_error for an unknown name.
void write_kinked(const std::string& name, const std::string& path);

}  // namespace st::test
