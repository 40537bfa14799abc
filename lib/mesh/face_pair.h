// Two faces that have one mesh: a periodic pair.
#pragma once

#include "base/ids.h"
#include "base/similarity.h"

namespace st {

/// The mesh of `b` is the image of that of `a`.
struct FacePair {
  FaceId a = kNone, b = kNone;
  Similarity motion;  ///< from a to b; neither scales nor mirrors

  bool operator==(const FacePair&) const = default;
};

}  // namespace st
