#include "meshing/engine/patch_store.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "base/assert.h"
#include "base/share.h"

namespace st {

FacePlace place_of(std::vector<PatchPlace> sections) {
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const PatchPlace& before = sections[i - 1];
    sections[i].inner_begin = before.inner_begin + before.n_inner;
    sections[i].triangle_begin = before.triangle_begin + before.n_triangles;
    sections[i].own_uv_begin = before.own_uv_begin + before.n_own_uv;
  }
  return sections;
}

std::int64_t n_triangles_of(const FacePlace& place) {
  return place.empty() ? 0 : place.back().triangle_begin + place.back().n_triangles;
}

PatchPlace PatchStore::put(FacePatch&& section, std::int32_t number, std::int64_t version, const EdgeMesh& edges,
                           std::span<const Vec3> vertex_xyz) {
  PatchPlace place;
  place.face = section.face;
  place.section = number;
  if (section.triangles.empty()) return place;
  auto stored = std::make_shared<FacePatch>(std::move(section));
  const FacePatch& p = *stored;
  auto blocks = std::make_shared<const PatchBlocks>(edges, vertex_xyz, p);
  place.rank = executor_.rank();
  place.version = version;
  place.n_boundary = p.n_boundary;
  place.n_inner = p.n_own();
  place.n_triangles = static_cast<std::int32_t>(p.triangles.size());
  place.n_own_uv = static_cast<std::int32_t>(p.uv_corner.size());
  place.box = blocks->box();
  const std::lock_guard lock(mutex_);
  patches_[key(place)] = {std::move(stored), std::move(blocks)};
  return place;
}

std::shared_ptr<const FacePatch> PatchStore::get(const PatchPlace& place) const {
  const std::lock_guard lock(mutex_);
  return patches_.at(key(place)).first;
}

std::shared_ptr<const PatchBlocks> PatchStore::blocks(const PatchPlace& place) const {
  const std::lock_guard lock(mutex_);
  return patches_.at(key(place)).second;
}

FacePatch PatchStore::take(const FacePlace& place, std::size_t number) {
  std::unique_lock lock(mutex_);
  auto node = patches_.extract(key(place[number]));
  lock.unlock();
  ST_ASSERT(!node.empty());
  return rows_of(std::move(*node.mapped().first), place, number);
}

void PatchStore::keep_only(const std::vector<PatchPlace>& live) {
  std::set<Key> keys;
  for (const PatchPlace& place : live) keys.insert(key(place));
  const std::lock_guard lock(mutex_);
  std::erase_if(patches_, [&](const auto& stored) { return !keys.contains(stored.first); });
}

std::vector<FacePatch> PatchStore::bring(std::vector<FacePlace> wanted) const {
  share(executor_, wanted);
  struct Section {
    std::size_t face, number;
  };
  std::vector<Section> sections;
  NamedTasks tasks;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t s = 0; s < wanted[i].size(); ++s) {
      if (!wanted[i][s].is_there()) continue;
      sections.push_back({i, s});
      tasks.home.push_back(wanted[i][s].rank);
    }
  if (sections.empty()) return {};
  tasks.order.resize(sections.size());
  std::iota(tasks.order.begin(), tasks.order.end(), 0);
  tasks.label = [&](std::int32_t task) { return TaskLabel{"bring", wanted[sections[task].face].back().face}; };
  std::vector<std::vector<FacePatch>> rows(wanted.size());  // of sections by number
  for (std::size_t i = 0; i < wanted.size(); ++i) rows[i].resize(wanted[i].size());
  executor_.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        const auto [face, number] = sections[task];
        FacePatch copy = *get(wanted[face][number]);
        return packed(rows_of(std::move(copy), wanted[face], number));
      },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, rows[sections[task].face][sections[task].number]); });
  std::vector<FacePatch> patches;
  for (std::size_t i = 0; executor_.is_root() && i < wanted.size(); ++i)
    patches.push_back(join_rows(std::move(rows[i])));
  return patches;
}

}  // namespace st
