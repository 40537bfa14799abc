#include "meshing/engine/tiled_faces.h"

#include <algorithm>
#include <iterator>

#include "base/error.h"
#include "base/share.h"

namespace st {
namespace {

constexpr double kWorthCutting = 1.5;  // tiles

}  // namespace

std::vector<BoundaryPlace> boundary_places(const FaceBoundary& boundary, const BoundaryNumbering& numbering) {
  std::vector<BoundaryPlace> places;
  for (const FaceNode& n : boundary.nodes) {
    const BoundaryNumbering::Entity own = numbering.entity(n.id);
    if (own.dim == EntityDim::kVertex)
      places.push_back({});
    else
      places.push_back({own.index, std::min(own.index, numbering.edges.n_nodes(own.entity) - 1 - own.index)});
  }
  return places;
}

TileCut TiledFaces::cut_face_of(FaceId f) const {
  const CurrentWork at_face("face", f + 1, limit_);
  try {
    const auto surface = model_.surface(f);
    const FaceBoundary boundary = make_face_boundary(model_, *surface, f, numbering_);
    return cut_face(*surface, boundary, boundary_places(boundary, numbering_), field_of(f).get(), tile_triangles_);
  } catch (const Error&) {  // the face as a whole will say what is wrong
    return {};
  }
}

void TiledFaces::choose(const std::vector<FaceId>& faces, const std::vector<double>& expected, double tile_triangles) {
  tile_triangles_ = tile_triangles;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(chosen_),
               [&](FaceId f) { return expected[f] > kWorthCutting * tile_triangles; });
  chosen_cuts_.resize(chosen_.size());
}

Bytes TiledFaces::cut(std::int32_t i) const { return packed(cut_face_of(chosen_[i])); }

void TiledFaces::share_cuts(const Executor& executor) {
  share(executor, chosen_cuts_);
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    if (chosen_cuts_[i].tiles.empty()) continue;
    const auto n = static_cast<std::int32_t>(chosen_cuts_[i].tiles.size());
    for (std::int32_t t = 0; t < n; ++t) tiles_.push_back({chosen_[i], t});
    meshes_[chosen_[i]].resize(chosen_cuts_[i].tiles.size());
    cuts_.emplace(chosen_[i], std::move(chosen_cuts_[i]));
  }
}

Bytes TiledFaces::compute(std::int32_t tile) const {
  const auto [f, index] = tiles_[tile];
  const CurrentWork at_face("face", f + 1, limit_);
  const TileCut& cut = cuts_.at(f);
  FaceMesh mesh;
  try {
    const auto surface = model_.surface(f);
    const FaceBoundary whole = make_face_boundary(model_, *surface, f, numbering_);
    mesh = mesh_face(*surface, tile_boundary(whole, cut, cut.tiles[index]), field_of(f).get(), options_);
  } catch (const Error&) {
    mesh.cause = FailureCause::kError;
  }
  return packed(mesh);
}

void TiledFaces::take(std::int32_t tile, const Bytes& bytes) {
  unpack(bytes, meshes_[tiles_[tile].face][tiles_[tile].index]);
}

FaceMesh TiledFaces::join(const Surface& surface, FaceId f, const FaceBoundary& boundary) {
  std::vector<FaceMesh> meshes = std::move(meshes_.at(f));
  return join_tiles(surface, boundary, cuts_.at(f), field_of(f).get(), options_, std::move(meshes));
}

}  // namespace st
