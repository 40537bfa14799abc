#include "meshing/engine/patch_store.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "base/assert.h"
#include "base/share.h"

namespace st {

PatchPlace PatchStore::put(FacePatch&& patch, std::int64_t version, const EdgeMesh& edges,
                           std::span<const Vec3> vertex_xyz) {
  PatchPlace place;
  if (patch.triangles.empty()) return place;
  const auto count = [](const auto& rows) { return static_cast<std::int32_t>(rows.size()); };
  auto stored = std::make_shared<StoredPatch>();
  stored->blocks = PatchBlocks(edges, vertex_xyz, patch);
  stored->patch = std::move(patch);
  const FacePatch& p = stored->patch;
  place = {executor_.rank(),    version, p.n_boundary, count(p.inner_xyz), count(p.triangles), count(p.uv_corner),
           stored->blocks.box()};
  const FaceId face = p.face;
  const std::lock_guard lock(mutex_);
  patches_[{face, version}] = std::move(stored);
  return place;
}

std::shared_ptr<const StoredPatch> PatchStore::get(FaceId face, std::int64_t version) const {
  const std::lock_guard lock(mutex_);
  return patches_.at({face, version});
}

FacePatch PatchStore::take(FaceId face, std::int64_t version) {
  const std::lock_guard lock(mutex_);
  auto node = patches_.extract({face, version});
  ST_ASSERT(!node.empty());
  return std::move(node.mapped()->patch);
}

void PatchStore::keep_only(const std::vector<PlacedPatch>& live) {
  std::set<Key> keys;
  for (const auto& [face, place] : live) keys.insert({face, place.version});
  const std::lock_guard lock(mutex_);
  std::erase_if(patches_, [&](const auto& stored) { return !keys.contains(stored.first); });
}

std::vector<FacePatch> PatchStore::bring(std::vector<PlacedPatch> wanted) const {
  share(executor_, wanted);
  std::vector<FacePatch> patches(executor_.is_root() ? wanted.size() : 0);
  NamedTasks tasks;
  std::vector<std::int32_t> remote;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto& [face, place] = wanted[i];
    if (place.rank == 0) {
      if (executor_.is_root()) patches[i] = get(face, place.version)->patch;
      continue;
    }
    tasks.home.push_back(place.rank);
    remote.push_back(static_cast<std::int32_t>(i));
  }
  if (remote.empty()) return patches;
  tasks.order.resize(remote.size());
  std::iota(tasks.order.begin(), tasks.order.end(), 0);
  tasks.label = [&](std::int32_t task) { return TaskLabel{"bring", wanted[remote[task]].face}; };
  executor_.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        const auto& [face, place] = wanted[remote[task]];
        return packed(get(face, place.version)->patch);
      },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, patches[remote[task]]); });
  return patches;
}

}  // namespace st
