// The options of stages that a tool of their own and st-run have in common, each declared once.
#pragma once

#include "common/option_set.h"
#include "stages/check_stage.h"
#include "stages/import_stage.h"
#include "stages/merge_stage.h"
#include "stages/mesh_stage.h"
#include "stages/prolong_stage.h"
#include "stages/raster_stage.h"

namespace st {

/// Without inputs and outputs, and without what makes sense for a tool alone.
void declare(OptionSet& set, ImportStageOptions& o);
void declare(OptionSet& set, RasterStageOptions& o);
void declare(OptionSet& set, ProlongStageOptions& o);
void declare(OptionSet& set, MeshStageOptions& o);
void declare(OptionSet& set, MergeStageOptions& o);
void declare(OptionSet& set, CheckStageOptions& o);

/// After parsing: what depends on who has set an option.
void note_what_is_set(const OptionSet& set, RasterStageOptions& o);

}  // namespace st
