// Composites of the inputs of st-edit, in its result.
#pragma once

#include <span>
#include <vector>

#include "base/similarity.h"
#include "geometry/model/composites.h"
#include "geometry/model/model.h"
#include "stages/edit_trace.h"

namespace st {

/// What of an input is needed: the CAD's tables, and which faces are joined.
struct JoinedInput {
  ModelTables cad;
  Composites composites;
};

/// Composites whose faces are all in `result` and moved alike and are not mirrored; their charts move with them,
/// and (u,v) grow where they are scaled. `motion`: [n_faces] of the result. `n_left`: how many are not carried, whose
/// faces are apart.
Composites carry_composites(std::span<const JoinedInput> inputs, const EditTrace& trace, const Model& result,
                            std::span<const Similarity> motion, int& n_left);

}  // namespace st
