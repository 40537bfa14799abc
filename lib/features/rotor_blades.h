// Blades around a hub: images of one another by turns about one axis.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/lifting_surface.h"
#include "geometry/model/model.h"

namespace st {

/// Gives blades that are images of one another by turns about one axis the stations, edges and faces of the one that is
/// measured on most of its way by cuts along its span, and appends those that are no lifting surface yet. The axis is
/// that of two of `wings`. What the user declares stays as it is, and edges in `is_excluded` ([n_edges]) become no
/// blade's trailing edges. Trailing edges that are used now leave `unused`. Local. Cost: five points on edges as long
/// as those of the blades.
void liken_blades(const Model& model, std::span<const std::uint8_t> is_excluded, std::vector<LiftingSurface>& wings,
                  std::vector<UnusedTrailing>& unused);

}  // namespace st
