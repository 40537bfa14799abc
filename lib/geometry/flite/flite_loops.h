// The topology that a FLITE file leaves to its reader: which ends of segments are one vertex, and how segments follow
// each other in loops.
#pragma once

#include <string>
#include <vector>

#include "geometry/flite/flite_file.h"

namespace st {

struct FliteTopology {
  std::vector<Vec3> vertices;
  std::vector<double> vertex_gap;  ///< largest distance of an end of a segment from its vertex
  struct Segment {
    int start = -1, end = -1;  ///< vertices of its first and last point
    bool is_point = false;     ///< all its points are one: a pole, in no loop
  };
  std::vector<Segment> segments;  ///< [segments of the file]
  struct Coedge {
    int segment;
    bool is_reversed;  ///< from its end to its start
  };
  using Loop = std::vector<Coedge>;      ///< head to tail
  std::vector<std::vector<Loop>> loops;  ///< [regions of the file]
};

/// Ends within the precision of seven digits are one vertex; where a region's segments leave a gap, the two ends next
/// to each other, when they are closer than a twentieth of the shorter segment. Signs and order in the file count for
/// nothing. Throws Error(kInput), naming `path`, region and place, where loops do not close.
FliteTopology flite_topology(const FliteFile& file, const std::string& path);

/// Distance below which two points of a file are the same: its numbers may have seven digits only.
double flite_resolution(Vec3 p, double diagonal);

/// Box of all points of curves.
Box3 flite_box(const FliteFile& file);

}  // namespace st
