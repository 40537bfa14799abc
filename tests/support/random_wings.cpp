#include "random_wings.h"

#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <random>

namespace st::wing_models {
namespace {

/// Numbers of the standard's engine, which are the same everywhere; those of its distributions are not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double least, double most) { return least + (most - least) * (engine_() / 4294967296.0); }

 private:
  std::mt19937 engine_;
};

double radians(double degrees) { return degrees * M_PI / 180; }

TopoDS_Shape wing_of(Random& random, bool is_blunt, bool is_upright) {
  const double span = random.between(0.6, 6), sweep = radians(random.between(-45, 60));
  const double dihedral_deg = is_upright ? random.between(50, 90) : random.between(-20, 45);
  const Foil foil{.thickness = random.between(0.06, 0.18),
                  .base = is_blunt ? 0.005 : 0,
                  .camber = random.between(0, 0.04),
                  .tail = is_blunt ? Tail::kBlunt : Tail::kSharp};
  const gp_Pnt tip(span * std::tan(sweep), span * std::cos(radians(dihedral_deg)),
                   span * std::sin(radians(dihedral_deg)));
  const double angle_deg = is_upright ? dihedral_deg : 0;
  return loft(foil, {straight(gp_Pnt(), 1, angle_deg), straight(tip, 1, angle_deg, random.between(-6, 6))});
}

}  // namespace

TopoDS_Shape random_wing(unsigned number) {
  Random random(1000 + number);
  const unsigned kind = number % 5;  // 0 alone, 1 on a body, 2 upright, 3 in a V, 4 turned
  TopoDS_Shape wing = wing_of(random, number % 2 == 1, kind == 2);
  if (kind == 1) {
    const double length = random.between(3, 8), radius = random.between(0.15, 0.3),
                 nose = random.between(-0.7, -0.3) * length;
    wing = fuse(
        fuselage({{nose, 0}, {nose + 0.15 * length, radius}, {nose + 0.6 * length, radius}, {nose + length, 0}}), wing);
  }
  if (kind == 3) wing = fuse(wing, moved(wing, [](gp_Trsf& t) { t.SetMirror(gp_Ax2(gp_Pnt(), gp::DY())); }));
  if (kind == 4) wing = turned(wing, gp_Dir(random.between(-1, 1), random.between(-1, 1), 1), random.between(0.2, 3));
  return wing;
}

}  // namespace st::wing_models
