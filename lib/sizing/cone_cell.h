// Where in one cell a cone tells the length: at probes, and where the cell is closest to it. Internal to sizing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "sizing/cones.h"

namespace st {

// Of the length known at a place: less is no gain.
inline constexpr float kClearly = 0.99F;
inline constexpr float kClearlyNearby = 0.997F;  // where a sample is near: the mesh's nodes are

using Int4 [[gnu::vector_size(16)]] = std::int32_t;  // of a comparison: -1 where it holds

inline bool is_any(Int4 v) {
  std::uint64_t half[2];
  std::memcpy(half, &v, sizeof half);
  return (half[0] | half[1]) != 0;
}

inline Float4 four(float v) { return v - Float4{}; }
inline Float4 min_of(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max_of(Float4 a, Float4 b) { return a > b ? a : b; }
inline float least_of(Float4 v) { return std::min({v[0], v[1], v[2], v[3]}); }

inline Float4 root_of(Float4 v) {
  Float4 root{};
  for (int i = 0; i < 4; ++i) root[i] = std::sqrt(v[i]);
  return root;
}

/// A cone with each of its numbers four times, to be asked at four places at once.
class WideCone {
 public:
  explicit WideCone(const Cone& cone) : length_(four(cone.length)), slope_(four(cone.slope)) {
    for (; n_sides_ < 2 && cone.half[n_sides_] > 0; ++n_sides_) {
      most_[n_sides_] = four(cone.half[n_sides_]);
      for (int k = 0; k < 3; ++k) side_[n_sides_][k] = four(cone.side[n_sides_][k]);
    }
  }
  /// Distances of places that lie so far from the middle of its rectangle.
  Float4 distance(Float4 x, Float4 y, Float4 z) const {
    for (int e = 0; e < n_sides_; ++e) {
      const Float4(&unit)[3] = side_[e];
      const Float4 along = max_of(min_of(x * unit[0] + y * unit[1] + z * unit[2], most_[e]), -most_[e]);
      x -= along * unit[0];
      y -= along * unit[1];
      z -= along * unit[2];
    }
    return root_of(x * x + y * y + z * z);
  }
  Float4 length_at(Float4 distance) const { return length_ + slope_ * distance; }

 private:
  Float4 length_, slope_, side_[2][3], most_[2];
  int n_sides_ = 0;
};

/// Four places, from the lower corner of the root.
struct FourPlaces {
  Float4 x[3];

  Float4 distance(const Cone& cone, const WideCone& wide) const {
    return wide.distance(x[0] - cone.x[0], x[1] - cone.x[1], x[2] - cone.x[2]);
  }
  Float4 length(const Cone& cone) const {
    const WideCone wide(cone);
    return wide.length_at(distance(cone, wide));
  }
};

// Where the lengths in a cell are compared: its corners, the centres of its faces, its own centre (twice).
inline constexpr int kGroups = 4;  // of four probes
inline constexpr Float4 kProbe[kGroups][3] = {{{-1, 1, -1, 1}, {-1, -1, 1, 1}, {-1, -1, -1, -1}},
                                              {{-1, 1, -1, 1}, {-1, -1, 1, 1}, {1, 1, 1, 1}},
                                              {{-1, 1, 0, 0}, {0, 0, -1, 1}, {0, 0, 0, 0}},
                                              {{0, 0, 0, 0}, {0, 0, 0, 0}, {-1, 1, 0, 0}}};
using Lengths = std::array<Float4, kGroups>;

inline float at_center(const Lengths& lengths) { return lengths[kGroups - 1][3]; }

/// Whether lengths are below a share of others at any probe.
inline bool is_below(const Lengths& lengths, float share, const Lengths& others) {
  Int4 is_below{};
  for (int g = 0; g < kGroups; ++g) is_below |= lengths[g] < share * others[g];
  return is_any(is_below);
}

/// The cube of a cell, from the lower corner of the root.
struct ConeCell {
  float c[3];
  float half;

  ConeCell() = default;
  ConeCell(const OctreeView& octree, std::int32_t leaf)
      : half(static_cast<float>(0.5 * octree.cell_edge(octree.leaf_levels[leaf]))) {
    const Vec3 center = octree.leaf_center(leaf) - octree.lo;
    c[0] = static_cast<float>(center.x);
    c[1] = static_cast<float>(center.y);
    c[2] = static_cast<float>(center.z);
  }

  /// Of a cone at the probes.
  Lengths lengths(const Cone& cone) const {
    Lengths result;
    const WideCone wide(cone);
    const Float4 x = four(c[0] - cone.x[0]), y = four(c[1] - cone.x[1]), z = four(c[2] - cone.x[2]), h = four(half);
    for (int g = 0; g < kGroups; ++g)
      result[g] = wide.length_at(wide.distance(x + h * kProbe[g][0], y + h * kProbe[g][1], z + h * kProbe[g][2]));
    return result;
  }

  float length_at_center(const Cone& cone) const {
    float way[3];
    return cone.length + cone.slope * way_to_center(cone, way);
  }

  /// Whether a cone of length `at_center` there is near: from afar lengths change evenly over a cell.
  bool is_near(const Cone& cone, float at_center) const {
    constexpr float kNearby = 3.75F;  // half edges from the centre: one edge from the closest point
    return at_center <= cone.length + cone.slope * kNearby * half;
  }

  /// Whether a cone wins where the cell is close to it. `visit_known` calls its argument for other cones of the cell,
  /// until it is true.
  template <class VisitKnown>
  bool wins_nearby(const Cone& cone, float largest, const VisitKnown& visit_known) const {
    constexpr float kWide = 0.25F;  // of half the edge: wider rectangles are looked at in more places
    if (!(cone.half[0] > kWide * half)) return wins_at(closest(cone), cone, largest, visit_known);
    constexpr float kInside = 0.8F;  // of the sides: further out its neighbours count
    const float a = kInside * cone.half[0], b = kInside * cone.half[1];
    float towards[2];  // of the rectangle the place closest to the cell's centre
    for (int e = 0; e < 2; ++e) {
      const float(&unit)[3] = cone.side[e];
      float along = 0;
      for (int k = 0; k < 3; ++k) along += (c[k] - cone.x[k]) * unit[k];
      towards[e] = std::clamp(along, -kInside * cone.half[e], kInside * cone.half[e]);
    }
    return wins_at(closest(cone, Float4{0, a, -a, towards[0]}, Float4{0, 0, 0, towards[1]}), cone, largest,
                   visit_known) ||
           wins_at(closest(cone, Float4{a, a, -a, -a}, Float4{b, -b, b, -b}), cone, largest, visit_known);
  }

 private:
  /// From the closest point of a cone's rectangle; and how far.
  float way_to_center(const Cone& cone, float (&way)[3]) const {
    for (int k = 0; k < 3; ++k) way[k] = c[k] - cone.x[k];
    for (int e = 0; e < 2 && cone.half[e] > 0; ++e) {
      const float(&unit)[3] = cone.side[e];
      const float all = way[0] * unit[0] + way[1] * unit[1] + way[2] * unit[2],
                  along = std::clamp(all, -cone.half[e], cone.half[e]);
      for (int k = 0; k < 3; ++k) way[k] -= along * unit[k];
    }
    return std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
  }

  /// The places of the cell closest to those `a` and `b` along the sides of a cone's rectangle.
  FourPlaces closest(const Cone& cone, Float4 a, Float4 b) const {
    FourPlaces places;
    for (int k = 0; k < 3; ++k) {
      const Float4 lo = four(c[k] - half), hi = four(c[k] + half);
      places.x[k] = max_of(lo, min_of(hi, cone.x[k] + a * cone.side[0][k] + b * cone.side[1][k]));
    }
    return places;
  }
  /// From the place closest to the middle of a cone's rectangle towards the centre.
  FourPlaces closest(const Cone& cone) const {
    constexpr Float4 kTowards{0, 0.25F, 0.5F, 0.75F};
    FourPlaces places;
    for (int k = 0; k < 3; ++k) {
      const float from = std::clamp(cone.x[k], c[k] - half, c[k] + half);
      places.x[k] = from + kTowards * (c[k] - from);
    }
    return places;
  }

  template <class VisitKnown>
  bool wins_at(const FourPlaces& places, const Cone& cone, float largest, const VisitKnown& visit_known) const {
    const WideCone wide(cone);
    const Float4 distance = places.distance(cone, wide), limit = (1 / kClearlyNearby) * wide.length_at(distance);
    Int4 wins = (distance < 2 * half) & (limit < largest);
    if (!is_any(wins)) return false;
    visit_known([&](const Cone& other) {
      wins &= places.length(other) >= limit;
      return !is_any(wins);
    });
    return is_any(wins);
  }
};

}  // namespace st
