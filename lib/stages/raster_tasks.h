// The samples of a model, task by task on all ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/executor.h"
#include "features/strip.h"
#include "sizing/cell_limit.h"
#include "sizing/face_cells.h"
#include "sizing/gap_sizes.h"
#include "sizing/loop_tracer.h"
#include "sizing/model_limits.h"

namespace st {

/// Loops of the faces that this rank sampled: they are asked for twice.
using FaceLoops = std::vector<std::optional<LoopPolygons>>;

/// What is sampled. All references outlive the object.
struct SampledModel {
  const Model& model;
  const ModelLimits& limits;
  std::span<const Strip> strips;
  double seconds;    ///< for each face
  FaceLoops& loops;  ///< [n_faces] those that this rank traces stay here
};

/// Boxes stay on the rank that made them, the rest is gathered on rank 0, by task.
struct Samples {
  std::vector<RasterBox> own_boxes;  // in any order
  std::vector<std::uint64_t> n_boxes;
  std::vector<std::string> failures;  // empty where there is none
  std::vector<std::vector<GapPatch>> patches;
};

/// Collective. Edges, then faces. Throws TooManyCells beyond `max_samples`.
Samples sample_model(const SampledModel& sampled, std::uint64_t max_samples, const Executor& comm);

/// No curve and no face may make more. Throws TooManyCells where the faces need more in any case.
void limit_samples(const ModelTables& tables, std::uint64_t max_samples, ModelLimits& limits);

/// Collective. Boxes of gaps stay on the rank that made them, as the others do; returns their number on rank 0. Throws
/// TooManyCells beyond `max_samples`.
std::size_t sample_gaps(const Model& model, Samples& samples, double cell_per_length, std::uint64_t max_samples,
                        const Executor& comm);

struct SampleCounts {
  std::size_t n_boxes = 0, n_failures = 0, n_gap_boxes = 0;
  DepthLimit depth;
};

/// Counts, and warns of what could not be sampled.
SampleCounts report_samples(const Samples& samples);

/// Collective. Where in the octree each face lies, symmetry planes included; complete on rank 0. A face that takes
/// longer than it may is in no cell, warned of and counted in `n_failures`. `meanwhile`: what rank 0 alone can do; it
/// does that first, while the others take faces.
FaceCells locate_faces(const SampledModel& sampled, const OctreeShape& shape, const std::function<void()>& meanwhile,
                       const Executor& comm, std::size_t& n_failures);

}  // namespace st
