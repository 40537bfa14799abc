// What systems of equations in (u,v) are made of: derivatives of a surface, along each other and along a direction.
#pragma once

#include "base/eigen.h"
#include "geometry/shape/surface.h"

namespace st {

/// The first fundamental form: products of du and dv.
inline Eigen::Matrix2d first_form(Vec3 du, Vec3 dv) { return symmetric(norm2(du), dot(du, dv), norm2(dv)); }

/// Second derivatives along `direction`; with the unit normal the second fundamental form.
inline Eigen::Matrix2d second_form(const SurfacePoint2& p, Vec3 direction) {
  return symmetric(dot(p.duu, direction), dot(p.duv, direction), dot(p.dvv, direction));
}

inline Eigen::Vector2d along_tangents(Vec3 du, Vec3 dv, Vec3 d) { return {dot(du, d), dot(dv, d)}; }

}  // namespace st
