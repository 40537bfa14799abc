// Why a face cannot be meshed, and what the user can do about it.
#pragma once

#include <cstdint>

namespace st {

enum class FailureCause : std::uint8_t {
  kNone,            ///< meshed
  kError,           ///< an error was thrown on the way: no usable trimming curves, for example
  kShortLoops,      ///< fewer than three boundary nodes
  kCrossingLoops,   ///< boundary segments cross or touch in (u,v)
  kTooManyNodes,    ///< the front went on beyond what the face's area explains
  kOutsideLoops,    ///< a triangle reaches a corner of the box around the loops
  kNarrowPart,      ///< a triangle names a node twice, or an inner edge is not used by two triangles
  kUnusedBoundary,  ///< a boundary segment is not used as often as the loops use it
};

/// For messages and artifacts: "its loops cross or touch in (u,v)". Empty for kNone.
const char* text_of(FailureCause cause);

/// What the user can do.
const char* remedy_of(FailureCause cause);

}  // namespace st
