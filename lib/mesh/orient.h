// Which faces and which closed parts of a mesh are turned: what does not depend on how its triangles are kept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/merge.h"

namespace st {

/// Two faces that share manifold mesh edges.
struct FaceLink {
  FaceId a = kNone, b = kNone;  ///< a < b
  std::int32_t agreement = 0;   ///< edges along which their triangles are oriented alike, minus those where not
};

/// Faces connected by manifold edges, and what was found out about them.
struct FaceComponent {
  std::vector<FaceId> faces;  ///< ascending
  bool is_one_sided = false;
  bool is_closed = true;
  double volume = 0;  ///< signed
  Box3 box;
  std::vector<TriangleId> triangles;  ///< filled only when nesting must be decided
};

/// One link for each pair of faces, in their order; agreements are summed up.
void unite_links(std::vector<FaceLink>& links);

/// Components by flooding over the links; `is_turned[f]`: face f must turn to agree with the lowest face of its
/// component. `area` [n_faces]: faces of none are in no component. Where areas differ, the larger one keeps its
/// orientation; one-sided components are left alone.
std::vector<FaceComponent> agree(std::span<const FaceLink> links, std::span<const double> area,
                                 std::vector<std::uint8_t>& is_turned);

/// [n_faces] kNone: in none.
std::vector<std::int32_t> component_of_face(std::span<const FaceComponent> components, FaceId n_faces);

/// What a triangle adds to the signed volume about `origin`. Turned, it adds the same with the other sign.
inline double volume_of(Vec3 a, Vec3 b, Vec3 c, Vec3 origin) {
  return dot(a - origin, cross(b - origin, c - origin)) / 6;
}

/// Whether a component must be looked at with others: it is closed, and inside out unless it is a void.
inline bool is_negative(const FaceComponent& c) { return c.is_closed && !c.is_one_sided && c.volume < 0; }

/// Components to turn: negative at even depth (a body inside out), and the voids of such bodies. Of the mesh, places,
/// triangles and their faces are used.
std::vector<std::uint8_t> find_inside_out(const SurfaceMesh& mesh, std::vector<FaceComponent>& components,
                                          std::span<const std::int32_t> face_component);

/// What was changed. `is_turned` [n_faces] to agree, `is_inside_out` [n_components].
OrientationReport report_orientation(std::span<const std::uint8_t> is_turned, std::span<const FaceComponent> components,
                                     std::span<const std::uint8_t> is_inside_out);

}  // namespace st
