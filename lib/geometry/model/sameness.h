// When measures of the CAD count as the same, or as exact enough.
#pragma once

namespace st {

/// Of the model's diagonal: places no further apart are one. CAD kernels write 1e-7 of a part, single precision 6e-8.
inline constexpr double kSamePlace = 1e-6;
/// Of the model's diagonal: a curve that is off its edge or surface by less is left as it is.
inline constexpr double kHarmless = kSamePlace;
/// Relative, of areas of faces: ten times the error of their integrals.
inline constexpr double kSameArea = 1e-4;
/// Relative, of areas inside loops that are sampled, and of faces before and after a repair of their loops.
inline constexpr double kAboutSameArea = 1e-3;

}  // namespace st
