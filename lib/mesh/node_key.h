// What a node has in all patches, and in all sections of a patch.
#pragma once

#include <cstdint>

#include "mesh/surface_mesh.h"

namespace st {

/// Of a node inside a face, by the section that owns it and its number there; then of those on vertices and edges,
/// ascending by (dimension, entity, index).
enum class NodeKey : std::int64_t {};

namespace detail {

inline constexpr int kKeyShift = 31;
inline constexpr std::int64_t kKeyOnEdge = std::int64_t{1} << (2 * kKeyShift);

}  // namespace detail

inline NodeKey inner_key(InnerNode n) {
  return NodeKey{-1 - (std::int64_t{n.section} << detail::kKeyShift | n.number)};
}

inline NodeKey boundary_key(EntityDim dim, std::int32_t entity, std::int32_t index) {
  return NodeKey{(dim != EntityDim::kVertex ? detail::kKeyOnEdge : 0) | std::int64_t{entity} << detail::kKeyShift |
                 index};
}
inline NodeKey boundary_key(const FacePatch& p, std::int32_t i) {
  return boundary_key(static_cast<EntityDim>(p.boundary_dim[i]), p.boundary_entity[i], p.boundary_index[i]);
}
/// Whether `b` follows `a` inside an edge.
inline bool is_next(NodeKey a, NodeKey b) {
  const auto of_a = static_cast<std::int64_t>(a);
  return of_a >= detail::kKeyOnEdge && static_cast<std::int64_t>(b) == of_a + 1;
}

}  // namespace st
