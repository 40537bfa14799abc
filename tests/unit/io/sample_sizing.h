// A small raster, and sizings made of it.
#pragma once

#include <vector>

#include "io/hdf5/sizing_artifact.h"
#include "sizing/stretched_cones.h"
#include "unit/io/sample_artifacts.h"

namespace st {

inline RasterArtifact sample_raster() {
  RasterArtifact raster;
  raster.header = sample_header();
  raster.header.schema = "raster";
  raster.numbers = {0.01, 0.1, 0.2, 10, 2, 1.7};
  std::vector<RasterBox> boxes;
  for (int i = 0; i < 40; ++i)
    boxes.push_back({{0.02 * i, 0.5, 0.3},
                     0.01F * static_cast<float>(1 + i % 5),
                     0.01F * static_cast<float>(1 + i % 5),
                     pack_cause(CauseKind::kEdge, i)});
  raster.octree = build_octree({{0, 0, 0}, {1, 1, 1}}, boxes);
  raster.samples = sorted_samples(boxes);
  raster.model.faces.append_face(
      std::vector<CellArea>{{1, 0.5F, {1, 2, 3}, {0, 0, 1}}, {7, 0.25F, {4, 5, 6}, {1, 0, 0}}});
  raster.model.faces.append_face({});
  raster.model.edge_name = {"TE", ""};
  raster.model.labels.face_name = {"wing", "tip"};
  return raster;
}

inline SizingArtifact sample_sizing() {
  RasterArtifact raster = sample_raster();
  SizingArtifact sizing;
  sizing.header = raster.header;
  sizing.header.schema = "sizing";
  sizing.numbers = raster.numbers;
  sizing.slope = 0.2;
  sizing.scale = 1.5;
  const std::vector<float> slope(raster.samples.size(), 0.2F);
  const Neighbours neighbours(raster.octree.shape.view());
  sizing.cones = spread_cones(neighbours, raster.samples, slope, raster.numbers.far_length, nullptr);
  sizing.face_weight = {12.5, 0};
  sizing.model = raster.model;
  sizing.source_name = {"wake"};
  sizing.shape = raster.octree.shape;
  sizing.lengths = lengths_at_centers(sizing.field_data(nullptr), sizing.cones.at_center);
  sizing.sources.slope = 0.2;
  return sizing;
}

/// Each sample of so many is stretched.
inline SizingArtifact sizing_of_stretched_cones(std::size_t every = 3) {
  RasterArtifact raster = sample_raster();
  for (std::size_t i = 0; i < raster.samples.size(); i += every)
    raster.samples[i].stretch = {SmallNormal(Vec3{0, 1, 0}), 6 * raster.samples[i].length};
  SizingArtifact sizing = sample_sizing();
  sizing.numbers.max_aspect = 8;
  const std::vector<float> slope(raster.samples.size(), 0.2F);
  const Neighbours neighbours(raster.octree.shape.view());
  SampleSites sites;
  sizing.cones = spread_cones(neighbours, raster.samples, slope, sizing.numbers.far_length, nullptr, &sites);
  add_stretch(neighbours.octree(), raster.samples, slope, sites, sizing.cones);
  sizing.lengths = lengths_at_centers(sizing.field_data(nullptr), sizing.cones.at_center);
  return sizing;
}

}  // namespace st
