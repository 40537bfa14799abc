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
  const SurfaceMaker none;
  Sections all;
  std::vector<Piece> bands;
  for (std::size_t t = 0; t < meshes.size(); ++t) {
    SplitPiece split = split_tile(face.boundary, cut, static_cast<std::int32_t>(t), std::move(meshes[t]));
    all.sections.push_back(std::move(split.rest));
    bands.push_back(std::move(split.band));
  }
  all.seams = SeamMaker{*face.surface, none, face.boundary, cut, field, options}.run(std::move(bands));
  return all;
}

inline FaceMesh join(const FaceCase& face, Sections all) {
  return join_sections(static_cast<std::int32_t>(face.boundary.nodes.size()), std::move(all.sections),
                       std::move(all.seams));
}

}  // namespace st::test
