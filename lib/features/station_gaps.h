// Stations of a lifting surface where planes cut no profile: what is there instead.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/lifting_surface.h"
#include "features/profile.h"

namespace st {

/// What gaps are closed with. Keeps references.
struct GapSearch {
  const Model& model;
  const ProfileCutter& cutter;
  double reach;                          ///< how far from a place a cut may begin, model unit
  std::span<const std::uint8_t> is_own;  ///< [n_faces] faces that no concave edge parts from the surface
};

/// Of one trailing edge, whose stations ascend and some of which are measured. Measures others where the nose's surface
/// goes on between two measured ones, or beside them, and the model has that place. Says of the rest which have no nose
/// of their own (`is_hidden`): the cut ends in another body, or is too thick for a lifting surface. `axis`: to which
/// the cuts are square; nullptr: to the edge. Local.
void close_gaps(const GapSearch& search, const Vec3* axis, ChordEdge& edge);

/// Whether an edge runs along the chord at a place: that of the nearest station that is measured, of other edges where
/// there are any, as those of the edge itself may be oblique cuts. `tangent`: unit.
bool is_along_chord(const LiftingSurface& surface, EdgeId edge, Vec3 x, Vec3 tangent);

/// Where an edge without a profile runs along the chord of the nearest station that is measured, as around a tip, it
/// has no nose of its own.
void hide_tip(const Model& model, const LiftingSurface& surface, ChordEdge& edge);

/// A stretch of a trailing edge before which no nose is seen though there is one.
struct UncoveredStretch {
  EdgeId edge = kNone;
  double length = 0;  ///< model unit
};

/// What LiftingSurface::covered() lacks, by edge and along it. Local.
std::vector<UncoveredStretch> uncovered_stretches(const LiftingSurface& surface);

}  // namespace st
