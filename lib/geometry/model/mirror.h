// Which entities of a model are images of others in a plane.
#pragma once

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"

namespace st {

/// A plane across an axis, and for each entity its image there: itself where it lies in the plane. Images have the
/// parameters of what they are images of; their loops run through the same (u,v).
struct Mirror {
  int axis = 0;      ///< 0, 1, 2: x, y, z
  double value = 0;  ///< model unit
  std::vector<VertexId> vertex;
  std::vector<EdgeId> edge;
  std::vector<FaceId> face;                 ///< empty: the model has no such plane
  std::vector<std::uint8_t> face_is_image;  ///< [n_faces] 1: meshed as the image of its partner

  bool empty() const { return face.empty(); }
  /// The image of the image is the point itself where `value` is 0.
  Vec3 image_of(Vec3 x) const {
    double& c = coordinate(x);
    c = value == 0 ? -c : 2 * value - c;
    return x;
  }
  Vec3 image_of_direction(Vec3 d) const {
    double& c = coordinate(d);
    c = -c;
    return d;
  }
  /// The nearest point of the plane.
  Vec3 in_plane(Vec3 x) const {
    coordinate(x) = value;
    return x;
  }

 private:
  double& coordinate(Vec3& x) const { return axis == 0 ? x.x : axis == 1 ? x.y : x.z; }
};

}  // namespace st
