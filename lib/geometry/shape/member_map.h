// How a triangle of a chart lies in the (u,v) of the face it stands for.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/ids.h"
#include "base/vec.h"

namespace st {

/// The affine map that takes three places to three others. Precondition: the first three span a triangle.
struct AffineMap {
  Vec2 from, to;          ///< of the first place
  Vec2 along_u, along_v;  ///< derivatives

  AffineMap() = default;
  AffineMap(const std::array<Vec2, 3>& places, const std::array<Vec2, 3>& images);
  Vec2 operator()(Vec2 p) const { return to + (p - from).x * along_u + (p - from).y * along_v; }
};

/// A triangle with a corner at a pole, where a line of (u,v) is one point.
struct PoleCorner {
  std::int32_t corner = 0;
  bool is_along_v = false;  ///< the line runs along v, else along u

  /// As artifacts have it: 0 to 5; kNone stands for no pole.
  std::int32_t code() const { return corner + (is_along_v ? 3 : 0); }
  static PoleCorner of_code(std::int32_t code) { return {code % 3, code >= 3}; }
};

inline constexpr std::int32_t kNPoleCorners = 6;  ///< codes
/// Whether all are kNone or PoleCorner::code().
bool are_pole_codes(std::span<const std::int32_t> codes);

/// From a triangle of the chart to (u,v) and back: affine, but straight lines from a corner at a pole are meridians.
class MemberMap {
 public:
  /// `pole`: PoleCorner::code(), or kNone. Precondition: both triangles have an area, and of one with a pole the other
  /// two corners differ along the line of the pole and are away from it.
  MemberMap(const std::array<Vec2, 3>& chart, const std::array<Vec2, 3>& uv, std::int32_t pole);

  struct Image {
    Vec2 uv, along_u, along_v;  ///< of the member; derivatives by the chart's (u,v)
  };
  /// Within a millionth of a triangle's height from the pole as on the way there: its derivatives have no bound.
  Image operator()(Vec2 chart) const;
  /// The place in the chart.
  Vec2 chart(Vec2 uv) const;

 private:
  std::int32_t pole_;
  AffineMap forth_, back_;  // with a pole: between the chart and (share of the way from a to b times s, s)
  Vec2 a_, b_, pole_uv_;    // (along the line of the pole, away from it)
};

}  // namespace st
