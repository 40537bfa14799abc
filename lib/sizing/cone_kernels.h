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
inline constexpr float kClearly = 0.99F;
inline constexpr float kClearlyNearby = 0.997F;  // where a sample is near: the mesh's nodes are

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

struct ConeKernels {
  /// Whether a cone is near a cell: from afar lengths change evenly over it.
  bool (*is_near)(const float* cell, const float* cone);
  /// The sides of a cell by which straight ways from a cone leave it: bit 2 * axis for the lower one, then the upper.
  std::int32_t (*sides_ahead)(const float* cell, const float* cone, bool& is_near);
  /// Of a cone at the probes of a cell.
  void (*lengths)(const float* cell, const float* cone, float* lengths);
  /// Likewise; whether they are clearly below `best` at any probe, by the share
  /// for cones that are near or not, which `is_near` tells.
  bool (*offer)(const float* cell, const float* cone, const float* best, float* lengths, bool& is_near);
  /// Puts lengths where they are below `best`, and their sample where it wins. Returns the least of them.
  float (*take)(const float* lengths, std::int32_t sample, float* best, std::int32_t* winner);
  /// Whether a cone wins over known ones and over the largest length where the cell is close to it.
  bool (*wins_nearby)(const float* cell, const float* cone, float largest, const KnownCones& known);
};

const ConeKernels& cone_kernels();

namespace detail {
const ConeKernels& cone_kernels_anywhere();
const ConeKernels& cone_kernels_avx2();  ///< Precondition: the processor has AVX2.
}  // namespace detail

}  // namespace st
