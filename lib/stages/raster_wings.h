// Lifting surfaces in st-raster: what they ask for, and what users are told of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "features/strip.h"
#include "features/unlisted_wings.h"
#include "sizing/model_limits.h"
#include "stages/raster_stage.h"
#include "stages/undercuts.h"
#include "stages/wing_report.h"

namespace st {

/// What detection found; on rank 0.
struct RasterWings {
  std::vector<WingEdge> edges;
  std::vector<UnusedTrailing> unused;
  Aircraft aircraft;
  std::vector<RasterBox> boxes;     ///< what they ask for, besides curvature
  std::vector<WingRecord> records;  ///< likewise, for the artifact
};

/// What the user asks for.
struct AskedLimits {
  const SamplingLimits& wall;
  const std::vector<SizeRule>& rules;
};

/// On rank 0, which knows lifting surfaces: samples them, and sets the limits of all else.
ModelLimits find_limits(const RasterStageOptions& o, const Model& model, const FaceRoles& roles,
                        std::span<const Strip> strips, const AskedLimits& asked, RasterWings& wings);

/// The least lengths that rules give, and --lmin where it is given (`everywhere`).
GivenFloors find_floors(const std::vector<SizeRule>& rules, bool everywhere, const ModelTables& t,
                        std::span<const WingEdge> wing_edges, const ModelLimits& limits);

/// [n_edges] 1: a rule says that it is no trailing edge.
std::vector<std::uint8_t> edges_without_wing(const ModelTables& t, std::span<const DeclaredEdge> declared);

/// One line for each lifting surface, or one that there is none.
void report_wings(const RasterStageOptions& o, const RasterWings& wings, const std::string& unit);

/// Who asks for lengths at trailing edges is told of those without; with -v they are all listed.
void report_unused(const RasterStageOptions& o, const Model& model, const FaceRoles& roles, const RasterWings& wings);

}  // namespace st
