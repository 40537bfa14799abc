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
    const std::size_t n_tiles = chosen_cuts_[i].tiles.size();
    regions_cut_.emplace(region, RegionCut{std::move(chosen_cuts_[i]), std::vector<SplitPiece>(n_tiles), n_sections()});
    for (std::size_t t = 0; t < n_tiles; ++t) sections_.push_back({region, static_cast<std::int32_t>(t)});
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

/// Of all sections of the region, whoever has them: they are gone there.
std::vector<Piece> TiledRegions::gather(std::int32_t region, bool wants_bands, const Executor& executor) {
  std::vector<Piece> parts;
  std::vector<Request> requests;
  std::vector<std::size_t> missing;
  for (std::int32_t index = 0; index < n_sections_of(region); ++index) {
    parts.emplace_back();
    if (const int rank = rank_of(regions_cut_.at(region).first + index); rank != executor.rank()) {
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

Bytes TiledRegions::answer(const Bytes& request) {
  SectionRequest asked{};
  unpack(request, asked);
  return packed(take_part(asked.section, asked.wants_band));
}

Piece TiledRegions::seams(const Surface& surface, std::int32_t region, const FaceBoundary& boundary,
                          const Executor& executor) {
  const FaceId f = regions_.face(region);
  const SurfaceMaker make_surface = [&] { return model_.surface(f); };
  const FaceField field = field_of(f);
  return SeamMaker{surface, make_surface, boundary, regions_cut_.at(region).cut, field.get(), options_}.run(
      gather(region, true, executor));
}

FaceMesh TiledRegions::join(std::int32_t region, const FaceBoundary& boundary, Piece seams, const Executor& executor) {
  if (seams.mesh.cause != FailureCause::kNone) return std::move(seams.mesh);
  return join_sections(static_cast<std::int32_t>(boundary.nodes.size()), gather(region, false, executor),
                       std::move(seams));
}

}  // namespace st
