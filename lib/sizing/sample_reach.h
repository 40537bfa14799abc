// What a sample of the raster speaks for: not its place alone, but the piece of a face or an edge around it.
#pragma once

#include "base/vec.h"

namespace st {

/// A flat rectangle around the place of a sample: place +- u +- v. Zero: the place alone; v zero: a line.
struct SampleReach {
  float u[3] = {0, 0, 0};  ///< half of one side, model unit
  float v[3] = {0, 0, 0};  ///< half of the other, at right angles to u

  bool operator==(const SampleReach&) const = default;
};

/// The least rectangle that holds the parallelogram +- a +- b and has a side along the longer of these, model unit.
SampleReach reach_of(Vec3 a, Vec3 b = {});

}  // namespace st
