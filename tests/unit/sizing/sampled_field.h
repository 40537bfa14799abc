// A size field of the samples of some boxes, with all that it is made of.
#pragma once

#include <memory>
#include <vector>

#include "sizing/octree_field.h"
#include "unit/sizing/cases.h"

namespace st::test {

struct SampledField {
  RasterOctree raster;
  std::vector<LengthSample> samples;
  Blanking blanking;  ///< empty: nothing is
  ConeTable cones;
  ProlongedLengths lengths;
  OctreeFieldData data;
};

/// Data of a field in the unit box; `blank` fills `blanking`, or is null.
template <class Blank>
std::shared_ptr<SampledField> sample_field(const std::vector<RasterBox>& boxes, double slope, double largest,
                                           const Blank& blank) {
  const auto f = std::make_shared<SampledField>();
  f->raster = build_octree(kUnitBox, boxes);
  f->samples = sorted_samples(boxes);
  const Neighbours neighbours(f->raster.shape.view());
  blank(neighbours, f->blanking);
  const std::vector<float> slopes(f->samples.size(), static_cast<float>(slope));
  f->cones = spread_cones(neighbours, f->samples, slopes, largest, f->blanking.colour.empty() ? nullptr : &f->blanking);
  f->data = {f->raster.shape.view(), {}, {}, slope, 1, f->blanking.split_leaf, f->blanking.split};
  f->data.set_cones(f->cones, largest);
  f->lengths = lengths_at_centers(f->data, f->cones.at_center);
  f->data.cells = f->lengths.cells;
  f->data.cause = f->lengths.cause;
  f->data.second_cells = f->lengths.second_cells;
  f->data.second_cause = f->lengths.second_cause;
  return f;
}

inline std::shared_ptr<SampledField> sample_field(const std::vector<RasterBox>& boxes, double slope, double largest) {
  return sample_field(boxes, slope, largest, [](const Neighbours&, Blanking&) {});
}

}  // namespace st::test
