// How many entities 32-bit ids can number, and how to refuse what would pass it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "base/error.h"

namespace st {

/// Nodes, cells and CAD entities: their ids are 32-bit.
inline constexpr std::uint64_t kMaxIds = std::numeric_limits<std::int32_t>::max();
/// Triangles of a mesh: their sides are numbered, too, three to a triangle.
inline constexpr std::uint64_t kMaxTriangles = kMaxIds / 3;

/// Throws Error(kUsage) when `count` passes `limit`. `what`: in the plural, with its place ("triangles of the mesh").
inline void require_countable(std::uint64_t count, const char* what, std::uint64_t limit = kMaxIds) {
  if (count > limit)
    throw Error(ExitCode::kUsage, std::to_string(count) + " " + what + ": at most " + std::to_string(limit) +
                                      " can be numbered; use larger lengths, or divide the model into parts");
}

/// `count` as an id, or the number of ids. Throws as require_countable.
inline std::int32_t checked_id(std::uint64_t count, const char* what, std::uint64_t limit = kMaxIds) {
  require_countable(count, what, limit);
  return static_cast<std::int32_t>(count);
}

}  // namespace st
