// What a cone tells in a cell, in the widest vectors that the processor has: the innermost loops of spreading cones. No
// operation is fused or reordered, so all processors give the same bits. Internal to sizing.
#pragma once

#include <cstdint>

namespace st {

// A cell is four floats here: its centre, from the lower corner of the root, and half its edge. A cone is those of
// `Cone`, in order.
inline constexpr int kConeNumbers = 13;
inline constexpr int kProbes = 16;  // of a cell: its corners, the centres of its faces, its own centre (twice)

// Of the length known at a place: less is no gain.
inline constexpr float kClearlyOnFace = 0.999F;  // where cells touch

/// Likewise, for cones that are near and for others.
struct ConeShares {
  float nearby, far;
};

/// A cone, and what edges along a direction may be longer by.
struct AlongCone {
  const float* cone;       ///< [kConeNumbers]
  const float* direction;  ///< [3] a unit vector, or zero
  float along;             ///< length along it; the same in all directions unless it is above the cone's
};

/// A cell, or a part of one, and the smallest lengths along that are known at its probes.
struct AlongSite {
  float cell[4];
  float unit[3];                 ///< the direction of all probes, if it is one
  std::int32_t turns;            ///< else which of the directions [][3][kProbes] are theirs; below 0: none
  float best[kProbes];           ///< below all where nothing is stretched
  std::int32_t winner[kProbes];  ///< the sample of `best`; below 0: a cone of the site
};

/// Shares of the lengths along that are known.
struct AlongShares {
  float clearly, nearly;
};
/// Whether a cone's lengths along are below these shares at any probe; what is clearly below is nearly so, too.
enum AlongGain : std::int32_t { kNoGain, kNearlyGains, kClearlyGains };

/// The cones of a site, and `more` that tell lengths along there; those of the shortest lengths first in both.
struct AlongCones {
  const float* cones;              ///< [][kConeNumbers]
  const float* stretches;          ///< [][4] of each the direction and the length along
  const std::int32_t *own, *more;  ///< which
  std::int32_t n_own, n_more;
  double largest;      ///< length, model unit
  double most_aspect;  ///< length along over length across
};
struct LeastAlong {
  float length;         ///< as `least` of the own ones
  float along;          ///< in the direction of the cone that tells it
  std::int32_t winner;  ///< that cone; -1: it has no direction
};

/// Of a chain of samples.
struct SampleLink {
  std::int32_t sample, next;  ///< kNone: the end
};

/// Cones to be asked, one after the other.
struct KnownCones {
  const float* cone;        ///< [n_samples][kConeNumbers]
  std::int32_t first;       ///< the sample that is asked first; kNone: none
  std::int32_t without;     ///< that is not asked
  const std::int32_t* own;  ///< [n_own] samples
  std::int32_t n_own;
  const SampleLink* links;  ///< more of them
  std::int32_t link;        ///< where the chain begins; kNone: nowhere
};

/// The common face of two cells.
struct ConeFace {
  float c[3];         ///< its centre, from the lower corner of the root
  float half;         ///< half its edge
  std::int32_t axis;  ///< across it
};
inline constexpr std::int32_t kFacePlaces = 8;  // of a set, where cones are compared
inline constexpr std::int32_t kFaceSets = 3;

/// A cone of a cell beside a face.
struct FaceCone {
  std::int32_t sample;
  std::int32_t of;         ///< 1: of the first cell, 2: of the second, 3: of both
  std::int32_t added = 0;  ///< 1: it was added to the first, 2: to the second
};

struct ConeKernels {
  /// Whether a cone is near a cell: from afar lengths change evenly over it.
  bool (*is_near)(const float* cell, const float* cone);
  /// The sides of a cell by which straight ways from a cone leave it: bit 2 * axis for the lower one, then the upper.
  std::int32_t (*sides_ahead)(const float* cell, const float* cone, bool& is_near);
  /// Of a cone at the probes of a cell.
  void (*lengths)(const float* cell, const float* cone, float* lengths);
  /// Likewise; whether they are clearly below `best` at any probe, by the share
  /// for cones that are near or not, which `is_near` tells.
  bool (*offer)(const float* cell, const float* cone, const float* best, const ConeShares& share, float* lengths,
                bool& is_near);
  /// Puts lengths where they are below `best`, and their sample where it wins. Returns the least of them.
  float (*take)(const float* lengths, std::int32_t sample, float* best, std::int32_t* winner);
  /// Lowers what a site knows to lengths along where it is above. `lengths`: of the cone at the probes; `turns`: see
  /// AlongSite.
  void (*lower_along)(const float* lengths, const AlongCone& cone, const float* turns, AlongSite& site);
  /// What a cone's lengths along gain in each of `n` sites, `which` of `sites`.
  void (*offer_along)(const AlongCone& cone, const AlongSite* sites, const float* turns, const std::int32_t* which,
                      std::int32_t n, const AlongShares& shares, AlongGain* gains);
  /// Lowers what a site knows, and puts the sample where it wins, if its lengths are below a share at any probe.
  void (*take_along)(const AlongCone& cone, std::int32_t sample, const float* turns, float share, AlongSite& site);
  /// Whether a cone wins over known ones and over the largest length where the cell is close to it.
  bool (*wins_nearby)(const float* cell, const float* cone, float share, float largest, const KnownCones& known);
  /// Likewise at a set of places of a face.
  bool (*wins_on_face)(const ConeFace& face, std::int32_t set, const float* cone, float largest,
                       const KnownCones& known);
  /// Adds cones of each cell to the other until both tell nearly the same at a set of places. Bit 0 of `ways`: to the
  /// second cell, bit 1: to the first. `lengths` [n * kFacePlaces] is scratch. Returns how many it added.
  std::int32_t (*settle_face)(const ConeFace& face, std::int32_t set, const float* cones, float largest,
                              std::int32_t ways, FaceCone* on_face, std::int32_t n, float* lengths);
  /// The smallest of `largest` and of what the cones `own` [n], those of the shortest lengths first, tell at a place.
  /// `place`: the numbers of a SplitPlace. `winner` (may be null) becomes the place in `own` of the first that tells
  /// it; kNone: none tells less than `largest`.
  float (*least)(const float* cones, const std::int32_t* own, std::int32_t n, const float* place, float largest,
                 std::int32_t* winner);
  /// The smallest length at a place, and the smallest that all the cones ask for along its direction.
  LeastAlong (*least_along)(const AlongCones& of, const float* place);
};

const ConeKernels& cone_kernels();

namespace detail {
const ConeKernels& cone_kernels_anywhere();
const ConeKernels& cone_kernels_avx2();  ///< Precondition: the processor has AVX2.
}  // namespace detail

}  // namespace st
