#include "meshing/engine/patch_store.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "base/assert.h"
#include "base/share.h"

namespace st {

FacePlace::FacePlace(std::vector<PatchPlace> all) : sections(std::move(all)) {
  SectionBegin next;
  for (PatchPlace& p : sections) {
    p.begin = next;
    next = {next.inner + p.n_inner, next.triangle + p.n_triangles, next.own_uv + p.n_own_uv};
  }
}

std::int64_t FacePlace::n_triangles() const {
  return sections.empty() ? 0 : sections.back().begin.triangle + sections.back().n_triangles;
}

std::vector<SectionBegin> FacePlace::begins() const {
  std::vector<SectionBegin> all;
  for (const PatchPlace& p : sections) all.push_back(p.begin);
  return all;
}

PatchPlace PatchStore::put(PatchSection&& section, std::int32_t number, std::int64_t version, const EdgeMesh& edges,
                           std::span<const Vec3> vertex_xyz) {
  PatchPlace place;
  place.section = number;
  if (section.patch.triangles.empty()) return place;
  auto stored = std::make_shared<StoredPatch>();
  stored->blocks = PatchBlocks(edges, vertex_xyz, section.patch);
  stored->section = std::move(section);
  const FacePatch& p = stored->section.patch;
  place.rank = executor_.rank();
  place.version = version;
  place.n_boundary = p.n_boundary;
  place.n_inner = stored->section.n_own();
  place.n_triangles = static_cast<std::int32_t>(p.triangles.size());
  place.n_own_uv = static_cast<std::int32_t>(p.uv_corner.size());
  place.box = stored->blocks.box();
  const FaceId face = p.face;
  const std::lock_guard lock(mutex_);
  patches_[{face, version, number}] = std::move(stored);
  return place;
}

std::shared_ptr<const StoredPatch> PatchStore::get(FaceId face, const PatchPlace& place) const {
  const std::lock_guard lock(mutex_);
  return patches_.at({face, place.version, place.section});
}

SectionRows PatchStore::take(FaceId face, const FacePlace& place, std::size_t number,
                             std::span<const SectionBegin> begins) {
  std::unique_lock lock(mutex_);
  const PatchPlace& own = place.sections[number];
  auto node = patches_.extract({face, own.version, own.section});
  lock.unlock();
  ST_ASSERT(!node.empty());
  return rows_of(std::move(node.mapped()->section), begins, number, place.sections.back().n_boundary);
}

void PatchStore::keep_only(const std::vector<PlacedPatch>& live) {
  std::set<Key> keys;
  for (const auto& [face, place] : live) keys.insert({face, place.version, place.section});
  const std::lock_guard lock(mutex_);
  std::erase_if(patches_, [&](const auto& stored) { return !keys.contains(stored.first); });
}

std::vector<FacePatch> PatchStore::bring(std::vector<PlacedFace> wanted) const {
  share(executor_, wanted);
  struct Section {
    std::size_t face, number;
  };
  std::vector<Section> sections;
  NamedTasks tasks;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t s = 0; s < wanted[i].place.sections.size(); ++s) {
      if (!wanted[i].place.sections[s].is_there()) continue;
      sections.push_back({i, s});
      tasks.home.push_back(wanted[i].place.sections[s].rank);
    }
  if (sections.empty()) return std::vector<FacePatch>(executor_.is_root() ? wanted.size() : 0);
  tasks.order.resize(sections.size());
  std::iota(tasks.order.begin(), tasks.order.end(), 0);
  tasks.label = [&](std::int32_t task) { return TaskLabel{"bring", wanted[sections[task].face].face}; };
  std::vector<std::vector<SectionRows>> rows(wanted.size());  // of sections by number
  std::vector<std::vector<SectionBegin>> begins;
  for (const PlacedFace& w : wanted) begins.push_back(w.place.begins());
  for (std::size_t i = 0; i < wanted.size(); ++i) rows[i].resize(wanted[i].place.sections.size());
  executor_.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        const auto& [face, place] = wanted[sections[task].face];
        const std::size_t number = sections[task].number;
        PatchSection copy = get(face, place.sections[number])->section;
        return packed(rows_of(std::move(copy), begins[sections[task].face], number, place.sections.back().n_boundary));
      },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, rows[sections[task].face][sections[task].number]); });
  std::vector<FacePatch> patches;
  for (std::size_t i = 0; executor_.is_root() && i < wanted.size(); ++i) {
    patches.push_back(join_rows(std::move(rows[i])));
    patches.back().face = wanted[i].face;
  }
  return patches;
}

}  // namespace st
