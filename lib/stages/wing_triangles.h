// The triangles of a lifting surface that its measures look at, of a mesh that is not in memory. Internal to the check
// stage.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/mesh_file.h"
#include "sizing/wing_record.h"
#include "stages/wing_measure.h"

namespace st {

/// Where measure_wings() looks at triangles of one surface: around noses and trailing edges, and along the profiles of
/// the stations that it lists.
class WingReach {
 public:
  explicit WingReach(const WingRecord& wing);
  /// First all triangles of the surface come, in any division: the nearest of each place tells how far to look there.
  void look_at(const SurfaceMesh& mesh);
  /// Then those to be kept, of the same triangles. Ascending.
  std::vector<TriangleId> within(const SurfaceMesh& mesh) const;

 private:
  struct Ball {
    Vec3 center;
    double radius;
  };
  struct Place {
    Vec3 xyz;
    double nearest;  // distance of the nearest triangle's middle
    double side;     // and its longest side
    Ball reach() const { return {xyz, nearest + kSides * side}; }
  };
  struct Plane {
    Vec3 point, normal;
  };
  static constexpr double kSides = 12;  // of the nearest triangle: four times as far as measures go around it

  std::vector<Place> places_;
  std::vector<Ball> noses_;
  std::vector<Plane> profiles_;
};

/// As measure_wings() of a mesh in memory, which has all triangles. Local; goes through the triangles of the surface
/// twice.
std::vector<WingMeasure> measure_wings(const MeshFile& mesh, std::span<const WingRecord> wings);

}  // namespace st
