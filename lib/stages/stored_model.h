// The CAD model of a geometry artifact.
#pragma once

#include <string>
#include <utility>

#include "base/error.h"
#include "geometry/model/model.h"
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

/// Likewise, where facets do not do: Error(kInput) for a model of them.
inline Model stored_cad(GeometryArtifact& geometry, const std::string& path) {
  if (!geometry.facets.empty())
    throw Error(ExitCode::kInput,
                path + ": has facets, and this needs a CAD model: give one that st-import made of one");
  if (!geometry.composites.empty())
    throw Error(ExitCode::kInput,
                path + ": has composite faces, and this needs those of the CAD: import it without --composite");
  return stored_model(geometry, path);
}

}  // namespace st
