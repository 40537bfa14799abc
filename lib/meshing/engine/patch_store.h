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

/// Where a section of the patch of a face is, and how large; see PatchSection.
struct PatchPlace {
  FaceId face = kNone;
  std::int32_t rank = kNone;  ///< kNone: it has no triangles
  std::int32_t section = 0;   ///< of its face
  std::int64_t version = 0;   ///< a face may have several patches at a time, of different rounds
  std::int32_t n_boundary = 0, n_inner = 0, n_triangles = 0, n_own_uv = 0;  ///< n_inner: of its own
  SectionBegin begin;
  Box3 box;  ///< of the triangles

  bool is_there() const { return rank != kNone; }

  static auto fields(auto& p) {
    return std::tie(p.face, p.rank, p.section, p.version, p.n_boundary, p.n_inner, p.n_triangles, p.n_own_uv, p.begin,
                    p.box);
  }
};

/// Where the patch of a face is.
struct FacePlace {
  std::vector<PatchPlace> sections;  ///< by number; the last one has all boundary nodes. None: no triangles

  FacePlace() = default;
  explicit FacePlace(const PatchPlace& whole) {
    if (whole.is_there()) sections.push_back(whole);
  }
  /// Sections of one face, whose rows follow each other.
  explicit FacePlace(std::vector<PatchPlace> sections);

  bool is_there() const { return !sections.empty(); }
  std::int64_t n_triangles() const;
  std::vector<SectionBegin> begins() const;

  static auto fields(auto& p) { return std::tie(p.sections); }
};

struct StoredPatch {
  PatchSection section;
  PatchBlocks blocks;
};

/// The patches of this rank. All functions but bring() are local and may be called by several threads.
class PatchStore {
 public:
  /// `executor` outlives the object.
  explicit PatchStore(const Executor& executor) : executor_(executor) {}

  /// Keeps a section whose boundary has its nodes on these edges; one without triangles is dropped.
  PatchPlace put(PatchSection&& section, std::int32_t number, std::int64_t version, const EdgeMesh& edges,
                 std::span<const Vec3> vertex_xyz);
  bool is_own(const PatchPlace& place) const { return place.rank == executor_.rank(); }
  /// Precondition: it is kept here.
  std::shared_ptr<const StoredPatch> get(const PatchPlace& place) const;
  /// Takes what is not kept any more: section `number` of the patch that is there;
  /// `begins`: of all its sections.
  SectionRows take(const FacePlace& place, std::size_t number, std::span<const SectionBegin> begins);
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
  std::map<Key, std::shared_ptr<StoredPatch>> patches_;
};

}  // namespace st
