// How good a triangle is while its face is meshed.
#pragma once

#include <algorithm>
#include <cmath>

#include "meshing/face/stretch.h"

namespace st {

/// 4 sqrt(3) A / sum l^2 in the mean metric of the corners: what st-check judges.
inline double metric_quality(const MeshNode& a, const MeshNode& b, const MeshNode& c) {
  const Vec3 ab = b.x - a.x, ac = c.x - a.x, bc = c.x - b.x;
  const double sum = length2(ab, a, b, c) + length2(ac, a, b, c) + length2(bc, a, b, c);
  return sum > 0 ? 3.4641016151377544 * norm(cross(ab, ac)) * std::sqrt(area_share2(a, b, c)) / sum : 0;
}

/// Compiled twice, as FaceWork::edge_length2() is.
template <bool kStretched>
class TriangleShape {
 public:
  /// The side from one node to another; the square of its length where no sizes are stretched.
  struct Side {
    Vec3 way;
    double length2 = 0;
    Side(const MeshNode& from, const MeshNode& to) : way(to.x - from.x) {
      if constexpr (!kStretched) length2 = norm2(way);
    }
  };

  /// 4 sqrt(3) A / sum l^2 in space, less where the normal is far off the surface's, negative where it is turned
  /// against it.
  static double quality(const MeshNode& a, const MeshNode& b, const MeshNode& c) {
    return quality(a, b, c, Side(a, b), Side(a, c));
  }
  static double quality(const MeshNode& a, const MeshNode& b, const MeshNode& c, const Side& to_b, const Side& to_c) {
    const Vec3 ab = to_b.way, ac = to_c.way, bc = c.x - b.x;
    const Vec3 n = cross(ab, ac);
    double sum = to_b.length2 + to_c.length2;
    if constexpr (kStretched) sum = mean_length2<true>(ab, a, b, c) + mean_length2<true>(ac, a, b, c);
    sum += mean_length2<kStretched>(bc, a, b, c);
    if (!(sum > 0)) return 0;
    double area = norm(n), q = 3.4641016151377544 * area / sum;
    if constexpr (kStretched) q *= std::sqrt(area_share2(a, b, c)) * angle_share(norm2(ab), norm2(ac), norm2(bc));
    const double least = std::min({dot(n, a.normal), dot(n, b.normal), dot(n, c.normal)});
    if (least >= kSteepCosine * area) return q;
    const Vec3 mean = a.normal + b.normal + c.normal;
    const double cosine = dot(n, mean) / std::max(area * norm(mean), 1e-300);
    if (least >= 0) return q * std::clamp(cosine / kSteepCosine, 0.0, 1.0);
    return cosine > 0.2 ? 0.5 * q : -1 + q;
  }

 private:
  static constexpr double kSteepCosine = 0.5;     // between a triangle's normal and the surface's: less costs quality
  static constexpr double kObtuse = -0.5;         // cosine: larger angles of stretched triangles cost quality
  static constexpr double kWorstAngleLoss = 0.8;  // at 180 degrees

  /// 1, less for a triangle whose largest angle in space is obtuse: what the metric does not see. Squares of its sides.
  static double angle_share(double a2, double b2, double c2) {
    const double longest = std::max({a2, b2, c2}), others = a2 + b2 + c2 - longest;
    if (others >= longest) return 1;  // no angle is obtuse
    const double product = longest == a2 ? b2 * c2 : longest == b2 ? a2 * c2 : a2 * b2;
    const double cosine = 0.5 * (others - longest) / std::sqrt(std::max(product, 1e-300));
    return 1 - kWorstAngleLoss * std::clamp((kObtuse - cosine) / (1 + kObtuse), 0.0, 1.0);
  }
};

}  // namespace st
