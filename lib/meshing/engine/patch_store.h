// Patches of faces, each on the rank that made it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "mesh/patch_blocks.h"
#include "mesh/patch_section.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Where the patch of a face is: its sections by number; the last one has all boundary nodes. None: no triangles.
using FacePlace = std::vector<PatchPlace>;

/// Sections of one face, whose rows follow each other.
FacePlace place_of(std::vector<PatchPlace> sections);
inline FacePlace place_of(const PatchPlace& whole) { return whole.is_there() ? FacePlace{whole} : FacePlace(); }
std::int64_t n_triangles_of(const FacePlace& place);

/// The patches of this rank. All functions but bring() are local and may be called by several threads.
class PatchStore {
 public:
  /// `executor` outlives the object.
  explicit PatchStore(const Executor& executor) : executor_(executor) {}

  /// Keeps a section whose boundary has its nodes on these edges; one without triangles is dropped.
  PatchPlace put(FacePatch&& section, std::int32_t number, std::int64_t version, const EdgeMesh& edges,
                 std::span<const Vec3> vertex_xyz);
  bool is_own(const PatchPlace& place) const { return place.rank == executor_.rank(); }
  /// Precondition: it is kept here.
  std::shared_ptr<const FacePatch> get(const PatchPlace& place) const;
  /// Likewise, of its triangles.
  std::shared_ptr<const PatchBlocks> blocks(const PatchPlace& place) const;
  /// Takes what is not kept any more: section `number` of the patch that is there.
  FacePatch take(const FacePlace& place, std::size_t number);
  /// Drops all others. `live`: of other ranks, too.
  void keep_only(const std::vector<PatchPlace>& live);

  /// Collective. Copies of these patches, which are there, on rank 0, which alone knows what it wants; nothing on other
  /// ranks.
  std::vector<FacePatch> bring(std::vector<FacePlace> wanted) const;

 private:
  using Key = std::tuple<FaceId, std::int64_t, std::int32_t>;  // face, version, section
  static Key key(const PatchPlace& p) { return {p.face, p.version, p.section}; }

  const Executor& executor_;
  mutable std::mutex mutex_;
  std::map<Key, std::pair<std::shared_ptr<FacePatch>, std::shared_ptr<const PatchBlocks>>> patches_;
};

}  // namespace st
