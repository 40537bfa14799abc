// Places of a moved mesh that could not keep their triangles.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Marked triangles that hang together by nodes.
struct RemeshedPlace {
  std::int32_t group = kNone;  ///< main group of most of them
  std::int64_t n_triangles = 0;
  Vec3 xyz;  ///< middle of the triangle that is nearest to the middle of all of them, model unit
};

/// By number of triangles, the most first. `marked`: [n_triangles]. Linear.
std::vector<RemeshedPlace> find_remeshed_places(const SurfaceMesh& mesh, std::span<const char> marked);

/// "group wing: 12 triangles at (1 2 3); ..." of at most ten.
std::string places_text(const SurfaceMesh& mesh, const std::vector<RemeshedPlace>& places);

/// [{"group", "triangles", "at": [x, y, z]}]
nlohmann::json places_json(const SurfaceMesh& mesh, const std::vector<RemeshedPlace>& places);

}  // namespace st
