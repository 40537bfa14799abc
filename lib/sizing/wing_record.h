// What was asked for on lifting surfaces, as artifacts keep it for judging meshes.
#pragma once

#include <vector>

#include "base/ids.h"
#include "base/similarity.h"

namespace st {

/// A lifting surface.
struct WingRecord {
  /// A place on a trailing edge, and the nose before it.
  struct Station {
    Vec3 nose, trailing;  ///< model unit; `nose` means nothing where the surface has none; the same: a nose alone
    double chord = 0;     ///< model unit
    double asked = 0;     ///< length at both, model unit; 0: rules say what they get

    /// Before a slot, a flap or a notch: the trailing edge is another part's, or none.
    bool is_nose_alone() const { return distance(nose, trailing) <= 0; }
  };
  std::vector<Station> stations;     ///< edge by edge, along each
  std::vector<EdgeId> edges;         ///< trailing ones, or along such inside faces; of a nose alone the leading one
  std::vector<FaceId> faces, bases;  ///< ascending; bases are no part of `faces`
  double span = 0;                   ///< model unit
  double covered = 1;                ///< share of the edges' length with noses
  double base_cells = 0;  ///< lengths across its bases, down to a quarter of `asked`; half as many where a plane of
                          ///< symmetry cuts them in two; 0: sharp, or rules say it
  bool has_noses = true;
};

/// The same wing elsewhere.
WingRecord moved(const Similarity& frame, WingRecord wing);

}  // namespace st
