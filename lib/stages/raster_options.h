// What the options of st-raster ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/length.h"
#include "geometry/model/model.h"
#include "io/toml/size_rule_file.h"
#include "sizing/model_limits.h"
#include "stages/raster_stage.h"

namespace st {

/// Of the reference diagonal: the largest length where none is asked for.
inline constexpr double kDefaultMaxLength = 0.025;

/// A length of --lmin, --lmax or --chord that refers to wings is a rule for all walls; the others resolve_limits()
/// takes.
std::optional<LengthSpec> wing_length(const std::string& text, const std::string& option);

/// Rules of --lmin, --lmax, --chord, --trailing-edges and --leading-edges. Throws Error(kUsage).
std::vector<SizeRule> option_rules(const RasterStageOptions& o);

/// Rules of options, then those of the file, which win. What can be known before anything is sampled is refused now:
/// lengths with a unit in a model without one, names that nothing has, a smallest length above the largest.
std::vector<SizeRule> all_rules(const RasterStageOptions& o, const SizeRuleFile& sizes, const ModelTables& t);

/// nullopt: "none".
std::optional<LengthSpec> edge_size(const RasterStageOptions& o);
/// nullopt: not given.
std::optional<LengthSpec> end_size(const RasterStageOptions& o);

/// Of walls for which no rule says otherwise. `diagonal`: what per cents refer to. Throws Error(kUsage, kGeometry).
SamplingLimits resolve_limits(const RasterStageOptions& o, const ModelTables& t, double diagonal);

/// Options of lifting surfaces that were set, by a preset perhaps: "--edge-size, --base-cells"; empty: none.
std::string wing_options(const RasterStageOptions& o);
bool asks_for_wings(const RasterStageOptions& o);

}  // namespace st
