// Noses on ridges, where rows of stretched triangles can begin.
#pragma once

#include <span>

#include "features/lifting_surface.h"

namespace st {

/// Whether two noses that follow each other are no line: one is another body's, perhaps.
bool jumps(const ChordStation& a, const ChordStation& b);

/// Puts back two or more noses that were moved between two that were not, where their line is clearly longer for that:
/// what bends more beside a nose for a stretch of the span is not its ridge. Noses that were moved further than they
/// are apart say nothing of a line.
/// `before`: [n] as they were. Local.
void put_back_detours(std::span<const ChordStation> before, std::span<ChordStation> after);

/// Noses beside which the surface is much more curved, as where a profile was cut obliquely or along the face of a
/// pylon, are moved to where it is most so, across the flattest direction and on their face. What is no further apart
/// than that belongs to one nose: rows cannot begin at two lines that cross. Noses alone may be left out. Those that
/// facets put clearly off the surface are put onto it. Others stay, to the bit. Local.
void put_on_ridges(const Model& model, LiftingSurface& wing);

}  // namespace st
