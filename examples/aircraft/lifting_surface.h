/// Wings and tails: panels lofted through aerofoil sections with a blunt trailing edge. Lengths in metres, angles in
/// rad.
#pragma once

#include <gp_Pnt.hxx>
#include <string>
#include <vector>

#include "patchwork.h"

namespace aircraft {

/// One aerofoil in space.
struct Section {
  gp_Pnt leading_edge;           ///< position of its nose
  double chord = 1;              ///< along x before twist
  double thickness = 0.1;        ///< of the chord
  double camber = 0;             ///< of the chord
  double twist = 0;              ///< about the leading edge, nose up
  double roll = 0;               ///< about the x axis: turns the thickness direction from +z towards -y
  double trailing_edge = 0.005;  ///< thickness of the blunt trailing edge, of the chord
};

enum class Half { kBoth, kUpperOnly };

/// Sections from root to tip and the span parameters of the patch boundaries.
struct Panel {
  std::vector<Section> sections;
  std::vector<double> parameters;   ///< of the sections, increasing
  std::vector<double> span_splits;  ///< first and last included
  Half half = Half::kBoth;  ///< kUpperOnly: cut at the plane through the leading edges and the middle of the trailing
                            ///< edge
};

/// Closed boundaries of the first and the last section; for half panels also the one in the symmetry plane.
struct PanelRims {
  std::vector<Handle(Geom_Curve)> first, last, symmetry;
};

/// Point of the outline at p in [0, 1]: upper trailing edge (0), upper side, leading edge (0.5), lower side, lower
/// trailing edge (1).
gp_Pnt profile_point(const Section& section, double p);

/// Point of the lower side at a fraction of the chord.
gp_Pnt lower_point(const Section& section, double chord_fraction);

/// Parameters at which outlines are interpolated.
std::vector<double> profile_parameters();

/// Outline parameters that divide both sides at the given fractions of the chord (increasing), with 0, the leading edge
/// and 1.
std::vector<double> profile_splits(const std::vector<double>& chord_fractions);

/// Adds the patches NAME_upper, NAME_lower (for half panels: NAME) and NAME_te of a panel.
PanelRims add_panel(Patchwork& patches, const Panel& panel, const std::vector<double>& chord_fractions,
                    const std::string& name);

}  // namespace aircraft
