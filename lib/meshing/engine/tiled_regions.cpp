#include "meshing/engine/tiled_regions.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/error.h"

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
    return cut_face(*surface, boundary, regions_.places(boundary), field_of(f).get(), tile_triangles_);
  } catch (const Error&) {  // the region as a whole will say what is wrong
    return {};
  }
}

void TiledRegions::choose(const std::vector<std::int32_t>& regions, const std::vector<double>& expected,
                          double tile_triangles) {
  tile_triangles_ = tile_triangles;
  std::copy_if(regions.begin(), regions.end(), std::back_inserter(chosen_),
               [&](std::int32_t r) { return expected[r] > kWorthCutting * tile_triangles; });
  chosen_cuts_.resize(chosen_.size());
}

Bytes TiledRegions::cut(std::int32_t i) const { return packed(cut_of(chosen_[i])); }

void TiledRegions::share_cuts(const Executor& executor) {
  share(executor, chosen_cuts_);
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    if (chosen_cuts_[i].tiles.empty()) continue;
    const auto n = static_cast<std::int32_t>(chosen_cuts_[i].tiles.size());
    for (std::int32_t t = 0; t < n; ++t) tiles_.push_back({chosen_[i], t});
    meshes_[chosen_[i]].resize(chosen_cuts_[i].tiles.size());
    cuts_.emplace(chosen_[i], std::move(chosen_cuts_[i]));
  }
  rank_of_.assign(tiles_.size(), 0);
}

std::vector<std::int32_t> TiledRegions::cut_regions() const {
  std::vector<std::int32_t> regions;
  for (const auto& [region, cut] : cuts_) regions.push_back(region);
  return regions;
}

Bytes TiledRegions::compute(std::int32_t tile, int rank) {
  const auto [region, index] = tiles_[tile];
  const FaceId f = regions_.face(region);
  const CurrentWork at_face("face", f + 1, limit_);
  const TileCut& cut = cuts_.at(region);
  FaceMesh mesh;
  try {
    const auto surface = model_.surface(f);
    const FaceBoundary whole = regions_.boundary(region, *surface);
    mesh = mesh_face(*surface, tile_boundary(whole, cut, cut.tiles[index]), field_of(f).get(), options_);
  } catch (const Error&) {
    mesh.cause = FailureCause::kError;
  }
  mesh.inner.shrink_to_fit();
  mesh.corners.shrink_to_fit();
  meshes_.at(region)[index] = std::move(mesh);
  return packed(static_cast<std::int32_t>(rank));
}

Bytes TiledRegions::restore(std::int32_t tile, const Bytes& bytes) {
  unpack(bytes, meshes_.at(tiles_[tile].region)[tiles_[tile].index]);
  return packed(std::int32_t{0});
}

void TiledRegions::take_place(std::int32_t tile, const Bytes& bytes) { unpack(bytes, rank_of_[tile]); }

Bytes TiledRegions::answer(const Bytes& request) {
  Tile tile{};
  unpack(request, tile);
  return packed(std::exchange(meshes_.at(tile.region)[tile.index], {}));
}

FaceMesh TiledRegions::join(const Surface& surface, std::int32_t region, const FaceBoundary& boundary,
                            const Executor& executor) {
  std::vector<FaceMesh> meshes = std::move(meshes_.at(region));
  std::vector<Request> requests;
  std::vector<std::int32_t> missing;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    if (tiles_[i].region != region) continue;
    if (rank_of_[i] == executor.rank()) {
      executor.has_own(PackedSize::of(meshes[tiles_[i].index]));
      continue;
    }
    requests.push_back({rank_of_[i], packed(tiles_[i])});
    missing.push_back(tiles_[i].index);
  }
  constexpr std::size_t kAtOnce = 8;  // tiles that are on their way
  for (std::size_t first = 0; first < requests.size(); first += kAtOnce) {
    const std::size_t end = std::min(first + kAtOnce, requests.size());
    std::vector<Bytes> answers = executor.ask(
        {requests.begin() + static_cast<std::ptrdiff_t>(first), requests.begin() + static_cast<std::ptrdiff_t>(end)});
    for (std::size_t i = 0; i < answers.size(); ++i) {
      unpack(answers[i], meshes[missing[first + i]]);
      answers[i] = {};
    }
  }
  const FaceId f = regions_.face(region);
  const auto make_surface = [&] { return model_.surface(f); };
  return join_tiles(surface, make_surface, boundary, cuts_.at(region), field_of(f).get(), options_, std::move(meshes));
}

}  // namespace st
