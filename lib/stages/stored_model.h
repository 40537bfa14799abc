// The CAD model of a geometry artifact.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "geometry/model/joined_tables.h"
#include "geometry/model/model.h"
#include "geometry/model/parted_composites.h"
#include "io/hdf5/artifact.h"

namespace st {

/// Takes tables and shape out of `geometry`; the rest of it stays. `path`: where it was read from. Throws Error(kInput)
/// naming the file when they cannot be read or do not fit each other.
inline Model stored_model(GeometryArtifact& geometry, const std::string& path) {
  try {
    if (!geometry.facets.empty()) return {std::move(geometry.tables), std::move(geometry.facets)};
    if (!geometry.composites.empty())
      return {std::move(geometry.cad), std::move(geometry.brep), std::move(geometry.composites)};
    return {std::move(geometry.tables), std::move(geometry.brep)};
  } catch (const Error& e) {
    throw Error(e.code(), path + ": " + e.what());
  }
}

/// Tables are those of the CAD, whatever is joined. Returns whether any face was.
inline bool part_joined_faces(GeometryArtifact& geometry) {
  if (geometry.composites.empty()) return false;
  geometry.tables = std::move(geometry.cad);
  geometry.cad = {};
  geometry.composites = {};
  return true;
}

/// Likewise the faces of composites that are marked ([n_composites]) alone.
inline void part_joined_faces(GeometryArtifact& geometry, const std::vector<std::uint8_t>& is_apart) {
  if (std::ranges::count(is_apart, 1) == 0) return;
  Composites kept = without(geometry.composites, is_apart, geometry.cad);
  if (kept.empty()) {
    part_joined_faces(geometry);
    return;
  }
  geometry.tables = join_tables(geometry.cad, kept).tables;
  geometry.composites = std::move(kept);
}

/// Likewise where `mesh` was made of the faces of the CAD: such a mesh has no `cad_face` beside its faces, or
/// triangles on faces that are joined to others.
inline void part_as_meshed(const MeshArtifact& mesh, GeometryArtifact& geometry) {
  std::vector<std::uint8_t> is_apart(static_cast<std::size_t>(geometry.composites.size()),
                                     mesh.triangle_cad_face.empty());
  mark_apart(geometry.composites, mesh.mesh.triangle_face, is_apart);
  part_joined_faces(geometry, is_apart);
}

/// As stored_model(), as the CAD has it. Error(kInput) for a model of facets.
inline Model stored_cad(GeometryArtifact& geometry, const std::string& path) {
  if (!geometry.facets.empty())
    throw Error(ExitCode::kInput,
                path + ": has facets, and this needs a CAD model: give one that st-import made of one");
  part_joined_faces(geometry);
  return stored_model(geometry, path);
}

}  // namespace st
