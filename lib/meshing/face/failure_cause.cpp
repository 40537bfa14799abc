#include "meshing/face/failure_cause.h"

namespace st {

const char* text_of(FailureCause cause) {
  switch (cause) {
    case FailureCause::kNone:
      return "";
    case FailureCause::kError:
      return "its surface or its boundary cannot be evaluated";
    case FailureCause::kShortLoops:
      return "its loops have fewer than three nodes";
    case FailureCause::kCrossingLoops:
      return "its loops cross or touch in (u,v)";
    case FailureCause::kTooManyNodes:
      return "the sizes need far more nodes than the face's area explains";
    case FailureCause::kOutsideLoops:
      return "a triangle reaches outside its loops";
    case FailureCause::kNarrowPart:
      return "too few nodes around a narrow part";
    case FailureCause::kUnusedBoundary:
      return "a boundary segment is not used as often as the loops use it";
  }
  return "";
}

const char* remedy_of(FailureCause cause) {
  switch (cause) {
    case FailureCause::kCrossingLoops:
      return "repair its boundary in the CAD system where it crosses itself, or use smaller sizes there";
    case FailureCause::kShortLoops:
    case FailureCause::kNarrowPart:
      return "use smaller sizes there (st-raster), or remove the feature in the CAD system";
    case FailureCause::kTooManyNodes:
      return "its surface is degenerate: export it again from the CAD system, or use larger sizes there";
    default:
      return "repair the face in the CAD system, or use smaller sizes there";
  }
}

}  // namespace st
