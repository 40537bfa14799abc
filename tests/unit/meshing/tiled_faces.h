// Faces meshed tile by tile.
#pragma once

#include <utility>
#include <vector>

#include "meshing/face/seam_mesh.h"
#include "unit/meshing/faces.h"

namespace st::test {

inline TileCut cut(const FaceCase& face, const SizeField& field, double tile_triangles) {
  const BoundaryNumbering numbering(MeshTopology(face.model.tables()), face.edges);
  return cut_face(*face.surface, {}, face.boundary, boundary_places(face.boundary, numbering), field, tile_triangles);
}

inline std::vector<FaceMesh> mesh_tiles(const FaceCase& face, const TileCut& cut, const SizeField& field) {
  std::vector<FaceMesh> meshes;
  for (const Tile& tile : cut.tiles)
    meshes.push_back(mesh_face(*face.surface, tile_boundary(face.boundary, cut, tile), field, {}));
  return meshes;
}

/// The sections of a face, without their bands, and its seams.
struct Sections {
  std::vector<Piece> sections;
  Piece seams;
};

inline Sections mesh_sections(const FaceCase& face, const TileCut& cut, const SizeField& field,
                              std::vector<FaceMesh> meshes, const FaceMeshOptions& options = {}) {
  const TileGroups groups(cut);
  const SurfaceMaker none;
  const SeamMaker maker{*face.surface, none, face.boundary, cut, groups, field, options};
  std::vector<SplitPiece> split;
  const auto take_bands = [&](const std::array<std::int32_t, 2>& members) {
    std::vector<Piece> bands;
    for (std::int32_t i = members[0]; i < members[1]; ++i) bands.push_back(std::exchange(split[i].band, Piece()));
    return bands;
  };
  for (std::int32_t t = 0; t < groups.n_tiles(); ++t)
    split.push_back(split_tile(face.boundary, cut, t, std::move(meshes[t])));
  for (std::int32_t g = 0; g < groups.n_groups(); ++g)
    split.push_back(
        split_group(face.boundary, cut, groups.n_tiles() + g, maker.of_group(g, take_bands(groups.members(g)))));
  Sections all;
  all.seams = maker.of_face(take_bands(groups.members_of_face()));
  for (SplitPiece& s : split) all.sections.push_back(std::move(s.rest));
  return all;
}

inline FaceMesh join(const FaceCase& face, Sections all) {
  return join_sections(static_cast<std::int32_t>(face.boundary.nodes.size()), std::move(all.sections),
                       std::move(all.seams));
}

}  // namespace st::test
