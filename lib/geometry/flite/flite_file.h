// FLITE geometry files (.dat, and the .fli dialect): composite Ferguson curves and surfaces, and the regions cut out of
// them, as text. docs/flite.md describes the format.
#pragma once

#include <string>
#include <vector>

#include "base/vec.h"

namespace st {

/// A support curve: points, one unit of parameter from each to the next.
struct FliteCurve {
  int id = 0, line = 0;      ///< number in the file; line of its record, 0 for a file to be written
  std::vector<Vec3> points;  ///< at least 2
};

/// A support surface: a grid of points.
struct FliteSurface {
  int id = 0, line = 0;
  int n_first = 0, n_second = 0;  ///< at least 2, as the file counts them
  std::vector<Vec3> points;       ///< [n_first * n_second], as they come
};

/// A piece of boundary: a whole support curve.
struct FliteSegment {
  int id = 0, line = 0;
  int curve = 0;  ///< index into curves
};

/// A face: the part of a support surface inside its segments, which come in any order and direction.
struct FliteRegion {
  int id = 0, line = 0;
  int surface = 0;            ///< index into surfaces
  std::vector<int> segments;  ///< indices into segments; a seam comes twice
};

struct FliteFile {
  std::vector<FliteCurve> curves;
  std::vector<FliteSurface> surfaces;
  std::vector<FliteSegment> segments;
  std::vector<FliteRegion> regions;
};

/// Whether the first bytes of a file are those of a FLITE geometry: a title, two counts, a label, a curve's record.
/// `head` may end anywhere after the label.
bool is_flite(const std::string& head);

/// Reads a whole file. Throws Error(kInput) with the line where it is cut off, damaged, or refers to what is not there.
FliteFile read_flite(const std::string& path);

/// The text of a file in the Swansea dialect, 16 significant digits.
std::string flite_text(const FliteFile& file);

}  // namespace st
