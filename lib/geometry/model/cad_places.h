// Where on the CAD a place on a composite is, from their charts alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"
#include "geometry/model/composites.h"

namespace st {

/// A place on a face of the CAD.
struct CadPlace {
  FaceId face = kNone;
  Vec2 uv;
};

class CadPlaces {
 public:
  /// `composites` outlive it. `n_faces`: of the CAD.
  CadPlaces(const Composites& composites, FaceId n_faces);

  /// Of places (u,v) on a face: the member at each, and (u,v) there. Cost: the chart's facets once, then some triangles
  /// for each place.
  std::vector<CadPlace> on(FaceId face, std::span<const Vec2> uv) const;

 private:
  const Composites& composites_;
  std::vector<std::int32_t> composite_;  // [n_faces] at its lowest face, else kNone
};

/// Middles of triangles, from the (u,v) of their corners.
std::vector<Vec2> middles(std::span<const Vec2> corner_uv);

/// Whether charts and members can be read without the CAD; the rest of them may be missing.
bool has_sound_charts(const Composites& composites, FaceId n_faces);

}  // namespace st
