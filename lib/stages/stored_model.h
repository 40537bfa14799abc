// The CAD model of a geometry artifact.
#pragma once

#include <string>
#include <utility>

#include "base/error.h"
#include "geometry/model/model.h"
#include "io/hdf5/artifact.h"

namespace st {

/// Takes tables and B-Rep out of `geometry`; the rest of it stays. `path`: where it was read from. Throws Error(kInput)
/// naming the file when they cannot be read or do not fit each other.
inline Model stored_model(GeometryArtifact& geometry, const std::string& path) {
  try {
    return Model(std::move(geometry.tables), std::move(geometry.brep));
  } catch (const Error& e) {
    throw Error(e.code(), path + ": " + e.what());
  }
}

}  // namespace st
