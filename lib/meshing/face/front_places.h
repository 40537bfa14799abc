// Where the advancing front would have its next node. Internal to lib/meshing.
#pragma once

#include <algorithm>
#include <cmath>

#include "meshing/face/face_work.h"

namespace st {

inline constexpr double kGrowth = 1.4;         // size of a new node over its base side
inline constexpr double kTurningFloor = 0.25;  // of the requested length: turning shortens sides no further

/// `kStretched`: see FaceWork. All nodes are evaluated.
template <bool kStretched>
class FrontPlaces {
 public:
  /// `work` outlives the object.
  explicit FrontPlaces(FaceWork& work)
      : w_(work), cos_turning_(std::cos(work.max_turning)), cos_too_far_(std::cos(1.25 * work.max_turning)) {}

  /// The ideal point of side a-b, brought to the surface, and the length `r` of its sides there; false when Newton
  /// leaves for elsewhere.
  bool of_side(const MeshNode& a, const MeshNode& b, double& r, MeshNode& p);
  /// The point from `a` along `d` (an edge of unit length in a's metric), none of it along the unit vector `aside`, as
  /// far as the sizes at both say. `length`: the first guess, then what was reached.
  bool of_row(const MeshNode& a, Vec3 d, Vec3 aside, double& length, MeshNode& p);

  /// Whether the normals of a triangle's nodes differ by more than sides may turn.
  bool turns_too_far(const MeshNode& a, const MeshNode& b, const MeshNode& c) const {
    if (a.is_pole || b.is_pole || c.is_pole) return false;
    return std::min({dot(a.normal, b.normal), dot(b.normal, c.normal), dot(c.normal, a.normal)}) < cos_too_far_;
  }
  static double edge_in_space(const MeshNode& a, const MeshNode& b) {
    return std::sqrt(mean_length2<kStretched>(b.x - a.x, a, b));
  }

 private:
  void limit_turning(const MeshNode& a, const MeshNode& b, MeshNode& p, double& r) const;

  FaceWork& w_;
  double cos_turning_, cos_too_far_;
};

}  // namespace st
