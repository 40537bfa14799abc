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

/// Consecutive ids, to loop over.
class IdRange {
 public:
  class Iterator {
   public:
    constexpr explicit Iterator(std::int32_t id) : id_(id) {}
    constexpr std::int32_t operator*() const { return id_; }
    constexpr Iterator& operator++() {
      ++id_;
      return *this;
    }
    constexpr bool operator!=(Iterator other) const { return id_ != other.id_; }

   private:
    std::int32_t id_;
  };

  /// [first, last): `last` is not in it.
  constexpr IdRange(std::int32_t first, std::int32_t last) : first_(first), last_(last) {}
  constexpr Iterator begin() const { return Iterator(first_); }
  constexpr Iterator end() const { return Iterator(last_); }
  constexpr std::int32_t first() const { return first_; }
  constexpr std::int32_t size() const { return last_ - first_; }
  constexpr bool empty() const { return first_ == last_; }

 private:
  std::int32_t first_, last_;
};

/// The one sentinel: "no entity".
inline constexpr std::int32_t kNone = -1;

}  // namespace st
