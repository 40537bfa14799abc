// What a mesh has at noses and trailing edges of lifting surfaces, against what was asked for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"
#include "sizing/wing_record.h"

namespace st {

/// Mean lengths of segments at a place; 0: there are none.
struct LengthsAt {
  double normal = 0;  ///< of those that run more across the span than along it
  double along = 0;   ///< of the others
};

/// At one station; lengths in model unit.
struct WingStationMeasure {
  double share = 0;  ///< of the span, from the end of the larger chord
  Vec3 place = {};   ///< on the trailing edge
  double chord = 0, asked = 0;
  LengthsAt nose = {}, trailing = {};  ///< likewise, of triangles on the skin
  double chord_cells = 0;              ///< lengths along the chord, mean of the sides that are there
  double base_cells = 0;               ///< across the base; 0: sharp, or not asked for
  double asked_base_cells = 0;
  double growth = 0;   ///< of lengths, from one to the next, from the nose on over 2 per cent of the chord
  double turning = 0;  ///< largest angle between neighbours of one face within 2 per cent of the chord around the nose,
                       ///< radians
};

/// Where the mesh is much coarser than what was asked for.
struct WingMiss {
  std::size_t wing = 0;
  double share = 0;  ///< of the span
  Vec3 place = {};
  const char* what = "";      ///< "nose", "trailing edge", "base"
  double has = 0, asked = 0;  ///< lengths over the chord; cells across a base
};

/// One lifting surface.
struct WingMeasure {
  double span = 0, covered = 0;  ///< see WingRecord
  EdgeId first_edge = kNone;
  bool has_noses = true;
  double held = 1;  ///< share of the stations' span where lengths across noses and trailing edges are at most 1.3 times
                    ///< those asked for; stations of rules count as held
  std::optional<WingMiss> worst = std::nullopt;    ///< of all stations; nullopt: nothing is asked for
  std::int64_t n_triangles = 0;                    ///< on its faces
  std::vector<WingStationMeasure> stations = {};   ///< nearest to 10, 30, 50, 70 and 90 per cent of the span, each once
  std::string group = {};                          ///< that most of its triangles are in; empty: none that has a name
  std::optional<double> deviation = std::nullopt;  ///< largest distance of a triangle's midpoint from the CAD over the
                                                   ///< chord
};

/// Of each. A surface without noses has no faces of its own: all triangles count there. Segments count within three of
/// their lengths around a place. Local; linear in triangles for each of the five stations.
std::vector<WingMeasure> measure_wings(const SurfaceMesh& mesh, std::span<const WingRecord> wings);

/// Of the chord: where growth and turning are measured, from the nose on.
inline constexpr double kNoseReach = 0.02;

/// A nose or trailing edge that is coarser than 1.3 times what was asked for, and three of these lengths.
struct UnheldPlace {
  Vec3 xyz;
  double radius;  ///< model unit
};

/// Of wings that are held on less than 99 % of their span, all stations that `mesh` has triangles at. It takes places,
/// corners and faces alone. Local.
std::vector<UnheldPlace> find_unheld(const SurfaceMesh& mesh, std::span<const WingRecord> wings);

}  // namespace st
