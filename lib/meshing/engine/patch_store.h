// Patches of faces, each on the rank that made it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "mesh/patch_blocks.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Where the patch of a face is, and how large.
struct PatchPlace {
  std::int32_t rank = kNone;  ///< kNone: the face has no triangles
  std::int64_t version = 0;   ///< a face may have several patches at a time, of different rounds
  std::int32_t n_boundary = 0, n_inner = 0, n_triangles = 0, n_own_uv = 0;
  Box3 box;  ///< of the triangles

  bool is_there() const { return rank != kNone; }
};

struct PlacedPatch {
  FaceId face = kNone;
  PatchPlace place;
};

struct StoredPatch {
  FacePatch patch;
  PatchBlocks blocks;
};

/// The patches of this rank. All functions but bring() are local and may be called by several threads.
class PatchStore {
 public:
  /// `executor` outlives the object.
  explicit PatchStore(const Executor& executor) : executor_(executor) {}

  /// Keeps a patch whose boundary has its nodes on these edges; one without triangles is dropped.
  PatchPlace put(FacePatch&& patch, std::int64_t version, const EdgeMesh& edges, std::span<const Vec3> vertex_xyz);
  bool is_own(const PatchPlace& place) const { return place.rank == executor_.rank(); }
  /// Precondition: it is kept here.
  std::shared_ptr<const StoredPatch> get(FaceId face, std::int64_t version) const;
  /// Likewise, and it is not kept any more.
  FacePatch take(FaceId face, std::int64_t version);
  /// Drops all others. `live`: by face; of other ranks, too.
  void keep_only(const std::vector<PlacedPatch>& live);

  /// Collective. Copies of these patches on rank 0, which alone knows what it wants; nothing on other ranks.
  std::vector<FacePatch> bring(std::vector<PlacedPatch> wanted) const;

 private:
  using Key = std::pair<FaceId, std::int64_t>;

  const Executor& executor_;
  mutable std::mutex mutex_;
  std::map<Key, std::shared_ptr<StoredPatch>> patches_;
};

}  // namespace st
