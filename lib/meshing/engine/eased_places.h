// Which rounds of easing stay, place by place.
#pragma once

#include <span>
#include <vector>

#include "meshing/engine/stretch_flaws.h"
#include "meshing/face/refinements.h"

namespace st {

/// A mesh that was tried.
struct EasingRound {
  std::vector<Refinement> refinements;  ///< it was made for
  std::vector<StretchFlaw> flaws;       ///< in it
};

/// Refinements that reach each other are of one place. Each place has those of the round that has the least flaws
/// within their reach, the worst kind first; of equal ones those of the first. `rounds`: the first one before all. Its
/// refinements stay. Local, O(n log n) and n times those of the first.
std::vector<Refinement> best_of_places(std::span<const EasingRound> rounds);

}  // namespace st
