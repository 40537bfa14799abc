// Narrow faces as bases of trailing edges: rings, bases in pieces, and bases of several strips beside each other.
#pragma once

#include <span>
#include <vector>

#include "features/strip.h"

namespace st {

/// All of `strips`, each with the row that it belongs to; strips that go on smoothly across a long edge are one, named
/// after the first face, where they are narrow together; and the rings. Ascending by face. Local. Cost: a few
/// evaluations for each long edge between two strips.
std::vector<Strip> find_base_strips(const Model& model, std::span<const Strip> strips);

}  // namespace st
