// Sizes of lifting surfaces, from their own chord: trailing edge, nose, base, and the cells in between.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/length.h"
#include "features/lifting_surface.h"
#include "features/strip.h"
#include "sizing/line_stretch.h"
#include "sizing/octree.h"
#include "sizing/wing_record.h"

namespace st {

/// Least lengths that somebody asked for, model unit; 0: none.
struct GivenFloors {
  std::vector<double> face, edge;  ///< [n_faces], [n_edges]; empty: none at all

  double of(std::int32_t cause) const {
    const std::vector<double>& all = cause_kind(cause) == CauseKind::kEdge ? edge : face;
    return all.empty() ? 0 : all[static_cast<std::size_t>(cause_id(cause))];
  }
};

/// What is asked for.
struct WingSizes {
  LengthSpec edge_size;       ///< along trailing edges and noses; chord and span are local
  int base_cells = 2;         ///< lengths across the base of a blunt trailing edge, down to a quarter of edge_size
  LengthReference reference;  ///< of lengths that are not the wing's
  std::optional<LengthSpec> least;                    ///< nothing is finer; nullopt: no floor
  double cell_per_length = 2;                         ///< edge of a raster box over its length
  StretchLimits stretch = {};                         ///< along edge, nose and base
  GivenFloors given = {};                             ///< by rules: likewise nothing is finer there
  std::optional<LengthSpec> end_size = std::nullopt;  ///< along the rims of tip and root; nullopt: not asked for
  bool is_material_ahead = false;                     ///< normals of faces point into the material
};

/// What is asked for along a trailing edge where its chord is `chord`, model unit. Throws Error(kUsage).
double length_along(const LiftingSurface& wing, const WingSizes& sizes, const ChordEdge& edge, double chord);
/// What `n_cells` across a base of this width are, down to a quarter of the length along it; model unit. Here, so that
/// who measures meshes needs no more of this.
inline double length_across(double n_cells, double width, double along) {
  constexpr double kFinestBase = 0.25;  // of the length along it
  return std::clamp(width / n_cells, kFinestBase * along, along);
}

/// A length that the floor makes larger.
struct RaisedLength {
  double asked = 0, floor = 0;  ///< model unit
};

/// `most` becomes `own` where that is raised, and by the larger factor.
void note_raised(const RaisedLength& own, std::optional<RaisedLength>& most);

/// Appends boxes along the trailing edges and the noses of a lifting surface, and across its bases, one length apart.
/// Likewise along the rims of tip and root where `end_size` is set. Edges and bases in `is_left_out` ([n_edges] 1: a
/// rule says what they get) are passed over; with one of the leading edges all noses are. Where `given` raises lengths,
/// the place where it does so most. Local. Throws Error(kUsage).
std::optional<RaisedLength> raster_wing(const Model& model, const LiftingSurface& wing, const WingSizes& sizes,
                                        std::span<const Strip> strips, std::span<const std::uint8_t> is_left_out,
                                        std::vector<RasterBox>& boxes);

/// Where `least` makes lengths along edges and noses of a lifting surface larger than `edge_size`, the station where
/// it does so most; nullopt: nowhere. Local. Throws Error(kUsage).
std::optional<RaisedLength> most_raised(const LiftingSurface& wing, const WingSizes& sizes);

/// Measured stations; of a surface without noses all. `is_left_out`, `strips`: as raster_wing() takes them.
WingRecord record_wing(const LiftingSurface& wing, const WingSizes& sizes, std::span<const std::uint8_t> is_left_out,
                       std::span<const Strip> strips = {});

/// A local chord as the sampling of faces uses it.
struct ChordLine {
  Vec3 nose, trailing;    ///< model unit
  double chord = 0;       ///< model unit
  std::int32_t wing = 0;  ///< index of the lifting surface
};

/// The largest length on one face of a lifting surface: a share of the local chord. One object serves one thread.
class ChordLimit {
 public:
  /// Of the lines of `wing`; without any there is no limit.
  ChordLimit(std::span<const ChordLine> lines, std::int32_t wing, int chord_cells);
  struct Answer {
    double length = std::numeric_limits<double>::infinity();  ///< model unit
    Vec3 direction;                                           ///< unit, along the chord; zero without lines
  };
  /// Of the nearest line, the first of equally near ones.
  Answer answer(Vec3 x) const;
  double at(Vec3 x) const { return answer(x).length; }
  /// The smallest of all places, model unit.
  double least() const { return least_; }

 private:
  /// With the ball around it.
  struct Line {
    Vec3 center;
    double radius, place;  // place: of the centre, along the axis
    std::size_t rank;      // as they were given
    ChordLine line;
  };
  std::vector<Line> lines_;  // in the order of their places
  Vec3 axis_;                // unit, along which the lines follow each other most
  double largest_radius_ = 0;
  int chord_cells_;
  double least_ = std::numeric_limits<double>::infinity();
  mutable std::size_t last_ = 0;  // the line that was nearest last
};

}  // namespace st
