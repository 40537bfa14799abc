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

/// How the lengths of a cone along the directions of a cell differ from its lengths.
struct LongerWay {
  float longer = 0;                   ///< by this, where `directions` is null
  const float* directions = nullptr;  ///< [3][kProbes] unit vectors; else by what an ellipse has along them
  const float* unit = nullptr;        ///< [3] along the ellipse
  float squeeze = 0;                  ///< 1 - (length / length along)^2
  float length = 0;                   ///< of the cone
};

/// Shares of the lengths along that are known.
struct AlongShares {
  float clearly, nearly;
};
struct AlongOffer {
  bool is_clearly, is_nearly;
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
  /// Lowers `best` to lengths along where it is above. `lengths`: of a cone at the probes.
  void (*lower_along)(const float* lengths, const LongerWay& way, float* best);
  /// How a cone's lengths along at the probes of a cell are below `best`, at any.
  AlongOffer (*offer_along)(const float* cell, const float* cone, const LongerWay& way, const AlongShares& share,
                            const float* best);
  /// Lowers `best`, and puts the sample where it wins, if these lengths are below a share of it at any probe.
  void (*take_along)(const float* cell, const float* cone, const LongerWay& way, std::int32_t sample, float share,
                     float* best, std::int32_t* winner);
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
};

const ConeKernels& cone_kernels();

namespace detail {
const ConeKernels& cone_kernels_anywhere();
const ConeKernels& cone_kernels_avx2();  ///< Precondition: the processor has AVX2.
}  // namespace detail

}  // namespace st
