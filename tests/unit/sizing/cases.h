// Octrees that several tests of the layer use.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sizing/cones.h"
#include "sizing/neighbours.h"
#include "sizing/octree.h"

namespace st::test {

inline const Box3 kUnitBox{{0, 0, 0}, {1, 1, 1}};

/// Otherwise two cells touch at an edge or a corner.
inline bool is_across_face(const CellStep& step) { return step.length2 == 4 || step.length2 == 11; }

/// Random raster boxes on a sphere in the unit box, lengths 0.001 .. 0.04: finer towards its top.
inline std::vector<RasterBox> sphere_boxes(int n, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<RasterBox> boxes;
  while (static_cast<int>(boxes.size()) < n) {
    const Vec3 d{uniform(random), uniform(random), uniform(random)};
    if (norm(d) < 0.1 || norm(d) > 1) continue;
    const Vec3 x = Vec3{0.5, 0.5, 0.5} + 0.4 * normalized(d);
    const float length = static_cast<float>(0.001 + 0.05 * distance(x, {0.5, 0.5, 0.9}));
    boxes.push_back({x, length, length, pack_cause(CauseKind::kFace, static_cast<std::int32_t>(boxes.size() % 7))});
  }
  return boxes;
}

/// Boxes of one length that cover the side x = 0 of the unit box: the prolonged field is length + slope * x.
inline std::vector<RasterBox> wall_boxes(float length) {
  std::vector<RasterBox> boxes;
  for (double y = 0; y <= 1; y += length)
    for (double z = 0; z <= 1; z += length) boxes.push_back({{0, y, z}, length, length, 0});
  return boxes;
}

/// Of a stretched cone of `length` what it asks for along `unit`, a unit vector, where all its lengths grew by `rise`.
inline float length_in(const ConeStretch& s, const float (&unit)[3], float length, float rise) {
  if (!(s.along > length)) return length + rise;
  const float part = unit[0] * s.direction[0] + unit[1] * s.direction[1] + unit[2] * s.direction[2];
  const float across = length + rise, ratio = across / (s.along + rise);
  return across / std::sqrt(1 - std::min(1.0F, part * part) * (1 - ratio * ratio));
}

}  // namespace st::test
