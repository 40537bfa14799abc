#include "meshing/engine/tiled_faces.h"

#include <algorithm>

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

TileCut TiledFaces::cut_one(FaceId f, double tile_triangles) const {
  const CurrentWork at_face("face", f + 1, limit_);
  try {
    const auto surface = model_.surface(f);
    const FaceBoundary boundary = make_face_boundary(model_, *surface, f, numbering_);
    return cut_face(*surface, boundary, boundary_places(boundary, numbering_), field_of(f).get(), tile_triangles);
  } catch (const Error&) {  // the face as a whole will say what is wrong
    return {};
  }
}

void TiledFaces::cut(const std::vector<FaceId>& faces, const std::vector<double>& expected, double tile_triangles,
                     const Executor& executor) {
  std::vector<FaceId> heavy;
  std::vector<double> work;
  for (const FaceId f : faces) {
    if (expected[f] <= kWorthCutting * tile_triangles) continue;
    heavy.push_back(f);
    work.push_back(expected[f]);
  }
  if (heavy.empty()) return;
  std::vector<TileCut> cuts(heavy.size());
  executor.run_named_tasks(
      {heaviest_first(work),
       [&](std::int32_t task) {
         return TaskLabel{"cut", heavy[task]};
       },
       ""},
      [&](std::int32_t task) { return packed(cut_one(heavy[task], tile_triangles)); },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, cuts[task]); });
  share(executor, cuts);
  for (std::size_t i = 0; i < heavy.size(); ++i) {
    if (cuts[i].tiles.empty()) continue;
    const auto n = static_cast<std::int32_t>(cuts[i].tiles.size());
    for (std::int32_t t = 0; t < n; ++t) tiles_.push_back({heavy[i], t});
    meshes_[heavy[i]].resize(cuts[i].tiles.size());
    cuts_.emplace(heavy[i], std::move(cuts[i]));
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
