// Lengths along directions in which edges may be longer, for every cell of a prolonged octree.
#pragma once

#include <span>
#include <vector>

#include "sizing/prolong.h"
#include "sizing/sample_seeds.h"

namespace st {

/// A second length and its direction per site: the leaves, then the second parts of split leaves. Empty: none.
struct StretchedCells {
  std::vector<CellLength> along;       ///< [n_sites] length along `direction`, no less than the site's own length
  std::vector<SmallNormal> direction;  ///< [n_sites] unknown: the same length in all directions
};

/// Prolongs what samples allow along their directions; a stored length that none of them names allows no stretch. Each
/// site takes the direction of the one that its
/// length goes back to; the length along it is the largest that all of them allow in this direction and that grows by
/// at most the slope from cell to cell, also where directions differ: a metric whose growth is limited in every
/// direction (Alauzet 2010), with the directions fixed beforehand so that the result is unique. `stored_length`:
/// [n_sites] as seeded. `lengths`: of prolong().
StretchedCells prolong_stretch(const Neighbours& neighbours, std::span<const LengthSample> samples,
                               std::span<const float> stored_length, const ProlongedLengths& lengths,
                               const ProlongOptions& options, double max_aspect, const Blanking* blanking);

}  // namespace st
