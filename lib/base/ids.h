// Index types. All in-memory ids are 0-based; artifacts and messages show 1-based ids of CAD entities.
#pragma once

#include <cstdint>

namespace st {

using NodeId = std::int32_t;
using TriangleId = std::int32_t;
using VertexId = std::int32_t;
using EdgeId = std::int32_t;
using FaceId = std::int32_t;
using LoopId = std::int32_t;
using CoedgeId = std::int32_t;

/// What an entity of the CAD model is, and so what a node lies on.
enum class EntityDim : std::uint8_t { kVertex = 0, kEdge = 1, kFace = 2 };

/// The one sentinel: "no entity".
inline constexpr std::int32_t kNone = -1;

}  // namespace st
