#include "meshing/engine/tiled_regions.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "base/threads.h"

namespace st {
namespace {

constexpr double kWorthCutting = 1.5;  // tiles

}  // namespace

TileCut TiledRegions::cut_of(std::int32_t region) const {
  const FaceId f = regions_.face(region);
  const CurrentWork at_face("face", f + 1, limit_);
  try {
    const auto surface = model_.surface(f);
    const FaceBoundary boundary = regions_.boundary(region, *surface);
    const SurfaceMaker make_surface = [&] { return model_.surface(f); };
    return cut_face(*surface, make_surface, boundary, regions_.places(boundary), field_of(f).get(), tile_triangles_);
  } catch (const Error&) {  // the region as a whole will say what is wrong
    return {};
  }
}

void TiledRegions::choose(const std::vector<std::int32_t>& regions, const std::vector<double>& expected,
                          double tile_triangles) {
  tile_triangles_ = tile_triangles;
  std::copy_if(regions.begin(), regions.end(), std::back_inserter(chosen_),
               [&](std::int32_t r) { return expected[r] > kWorthCutting * tile_triangles; });
  drop_stretched();
  chosen_cuts_.resize(chosen_.size());
}

/// Of those chosen: faces that stay whole in any case need not wait until others are cut.
void TiledRegions::drop_stretched() {
  if (!field_.is_stretched()) return;
  std::vector<char> is_stretched(chosen_.size(), 0);
  parallel_for(chosen_.size(), 1, [&](std::size_t i, std::size_t) {
    const FaceId f = regions_.face(chosen_[i]);
    try {
      const auto surface = model_.surface(f);
      is_stretched[i] = has_long_edges(*surface, regions_.boundary(chosen_[i], *surface), field_of(f).get());
    } catch (const Error&) {  // cut_of() will see
    }
  });
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i < chosen_.size(); ++i)
    if (!is_stretched[i]) kept.push_back(chosen_[i]);
  chosen_ = std::move(kept);
}

Bytes TiledRegions::cut(std::int32_t i) const { return packed(cut_of(chosen_[i])); }

void TiledRegions::share_cuts(const Executor& executor) {
  share(executor, chosen_cuts_);
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    if (chosen_cuts_[i].tiles.empty()) continue;
    const std::int32_t region = chosen_[i];
    TileGroups groups(chosen_cuts_[i]);
    const std::int32_t n_tiles = groups.n_tiles();
    std::vector<SplitPiece> meshes(static_cast<std::size_t>(n_tiles + groups.n_groups()));
    regions_cut_.emplace(region, RegionCut{std::move(chosen_cuts_[i]), std::move(groups), std::move(meshes),
                                           static_cast<std::int32_t>(sections_.size())});
    for (std::int32_t t = 0; t < n_tiles; ++t) sections_.push_back({region, t});
  }
  n_tiles_ = static_cast<std::int32_t>(sections_.size());
  for (auto& [region, parts] : regions_cut_) {
    parts.first_group = static_cast<std::int32_t>(sections_.size());
    for (std::int32_t g = 0; g < parts.groups.n_groups(); ++g)
      sections_.push_back({region, parts.groups.n_tiles() + g});
  }
  rank_of_.assign(sections_.size(), 0);
}

std::vector<std::int32_t> TiledRegions::cut_regions() const {
  std::vector<std::int32_t> regions;
  for (const auto& [region, parts] : regions_cut_) regions.push_back(region);
  return regions;
}

Bytes TiledRegions::compute(std::int32_t tile, int rank) {
  const auto [region, index] = sections_[tile];
  const FaceId f = regions_.face(region);
  const CurrentWork at_face("face", f + 1, limit_);
  const TileCut& cut = regions_cut_.at(region).cut;
  SplitPiece& split = mesh_of(sections_[tile]);
  try {
    const auto surface = model_.surface(f);
    const FaceBoundary whole = regions_.boundary(region, *surface);
    FaceMesh mesh = mesh_face(*surface, tile_boundary(whole, cut, cut.tiles[index]), field_of(f).get(), options_);
    split = split_tile(whole, cut, index, std::move(mesh));
  } catch (const Error&) {
    split.band.mesh.cause = FailureCause::kError;
  }
  return packed(static_cast<std::int32_t>(rank));
}

Bytes TiledRegions::restore(std::int32_t section, const Bytes& bytes) {
  unpack(bytes, mesh_of(sections_[section]));
  return packed(std::int32_t{0});
}

void TiledRegions::mesh_groups(const Executor& executor, const std::string& made_from) {
  share(executor, rank_of_);
  const std::int32_t n_groups = n_sections() - n_tiles_;
  if (n_groups == 0) return;
  std::vector<double> work;
  for (std::int32_t s = n_tiles_; s < n_sections(); ++s)
    work.push_back(static_cast<double>(regions_cut_.at(sections_[s].region).cut.nodes.size()));
  const auto label = [&](std::int32_t task) {
    const Section& s = sections_[n_tiles_ + task];
    return TaskLabel{"group", regions_.face(s.region), task};  // a face may have several regions
  };
  executor.run_named_tasks(
      {.order = heaviest_first(work),
       .label = label,
       .made_from = made_from,
       .record = [&](std::int32_t task, const Bytes&) { return record(n_tiles_ + task); },
       .restore = [&](std::int32_t task, Bytes&& bytes) { return restore(n_tiles_ + task, bytes); },
       .answer = [&](const Bytes& request) { return answer(request); }},
      [&](std::int32_t task) {
        mesh_group(n_tiles_ + task, executor);
        return packed(static_cast<std::int32_t>(executor.rank()));
      },
      [&](std::int32_t task, Bytes&& bytes) { take_place(n_tiles_ + task, bytes); });
  share(executor, rank_of_);
}

void TiledRegions::mesh_group(std::int32_t section, const Executor& executor) {
  const auto [region, index] = sections_[section];
  const FaceId f = regions_.face(region);
  const TileCut& cut = regions_cut_.at(region).cut;
  const TileGroups& groups = regions_cut_.at(region).groups;
  SplitPiece& split = mesh_of(sections_[section]);
  const std::int32_t group = index - groups.n_tiles();
  std::vector<Piece> bands = gather(region, groups.members(group), true, executor);
  const CurrentWork at_face("face", f + 1, limit_);
  try {
    const auto surface = model_.surface(f);
    const SurfaceMaker make_surface = [&] { return model_.surface(f); };
    const FaceBoundary whole = regions_.boundary(region, *surface);
    const FaceField field = field_of(f);
    const SeamMaker maker{*surface, make_surface, whole, cut, groups, field.get(), options_};
    split = split_group(whole, cut, index, maker.of_group(group, std::move(bands)));
  } catch (const Error&) {
    split.band.mesh.cause = FailureCause::kError;
  }
}

namespace {

struct SectionRequest {
  TiledRegions::Section section;
  bool wants_band;
};

}  // namespace

/// Moves the band out of the section, or what it keeps; nothing wants the band then.
Piece TiledRegions::take_part(const Section& section, bool wants_band) {
  SplitPiece& mesh = mesh_of(section);
  Piece band = std::exchange(mesh.band, {});
  if (wants_band) return band;
  return std::exchange(mesh.rest, {});
}

/// Of these sections [first, end) of the region, whoever has them: they are gone there.
std::vector<Piece> TiledRegions::gather(std::int32_t region, const std::array<std::int32_t, 2>& members,
                                        bool wants_bands, const Executor& executor) {
  std::vector<Piece> parts;
  std::vector<Request> requests;
  std::vector<std::size_t> missing;
  for (std::int32_t index = members[0]; index < members[1]; ++index) {
    parts.emplace_back();
    if (const int rank = rank_of(number_of(region, index)); rank != executor.rank()) {
      requests.push_back({rank, packed(SectionRequest{{region, index}, wants_bands})});
      missing.push_back(parts.size() - 1);
    } else {
      parts.back() = take_part({region, index}, wants_bands);
      executor.has_own(PackedSize::of(parts.back()));
    }
  }
  constexpr std::size_t kAtOnce = 16;  // that are on their way
  for (std::size_t first = 0; first < requests.size(); first += kAtOnce) {
    const std::size_t end = std::min(first + kAtOnce, requests.size());
    std::vector<Bytes> answers = executor.ask(
        {requests.begin() + static_cast<std::ptrdiff_t>(first), requests.begin() + static_cast<std::ptrdiff_t>(end)});
    for (std::size_t i = 0; i < answers.size(); ++i) {
      unpack(answers[i], parts[missing[first + i]]);
      answers[i] = {};
    }
  }
  return parts;
}

std::int32_t TiledRegions::number_of(std::int32_t region, std::int32_t index) const {
  const RegionCut& parts = regions_cut_.at(region);
  const std::int32_t n_tiles = parts.groups.n_tiles();
  return index < n_tiles ? parts.first_tile + index : parts.first_group + index - n_tiles;
}

Bytes TiledRegions::answer(const Bytes& request) {
  SectionRequest asked{};
  unpack(request, asked);
  return packed(take_part(asked.section, asked.wants_band));
}

Piece TiledRegions::seams(const Surface& surface, std::int32_t region, const FaceBoundary& boundary,
                          const Executor& executor) {
  const FaceId f = regions_.face(region);
  const SurfaceMaker make_surface = [&] { return model_.surface(f); };
  const RegionCut& parts = regions_cut_.at(region);
  const TileGroups& groups = parts.groups;
  const FaceField field = field_of(f);
  return SeamMaker{surface, make_surface, boundary, parts.cut, groups, field.get(), options_}.of_face(
      gather(region, groups.members_of_face(), true, executor));
}

FaceMesh TiledRegions::join(std::int32_t region, const FaceBoundary& boundary, Piece seams, const Executor& executor) {
  if (seams.mesh.cause != FailureCause::kNone) return std::move(seams.mesh);
  return join_sections(static_cast<std::int32_t>(boundary.nodes.size()),
                       gather(region, {0, n_sections_of(region)}, false, executor), std::move(seams));
}

}  // namespace st
