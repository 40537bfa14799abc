// B-spline surfaces that are converted once, whoever asks for them.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <cstddef>
#include <memory>
#include <vector>

#include "geometry/shape/bspline.h"

namespace st::occt {

/// What a surface is converted from.
struct SplineInput {
  int u_degree = 0, v_degree = 0;
  double u_period = 0, v_period = 0;   ///< 0: none
  std::vector<double> u_flat, v_flat;  ///< knots, see KnotSpans
  std::vector<Pole> poles;             ///< [n_u][n_v]
  bool is_rational = false;

  int n_v() const { return static_cast<int>(v_flat.size()) - v_degree - 1; }
};

/// While one lives, surface_of() keeps what it converts, as the import asks for each surface again and again. Nothing
/// is kept of what changed since, nor beyond some megabytes. One at a time; surface_of() is for any thread.
class KeptSurfaces {
 public:
  KeptSurfaces();
  ~KeptSurfaces();
  KeptSurfaces(const KeptSurfaces&) = delete;
};

std::unique_ptr<BsplineSurface> surface_of(SplineInput input, const Box2& bounds);
/// `original`: where `input` comes from.
std::unique_ptr<BsplineSurface> surface_of(const Handle(Geom_BSplineSurface) & original, SplineInput input,
                                           const Box2& bounds);

}  // namespace st::occt
