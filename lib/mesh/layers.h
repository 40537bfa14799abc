// Can layers of prisms grow from the walls of a mesh? Asked of the surface, before a volume mesher tries.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/checks.h"
#include "mesh/surface_mesh.h"

namespace st {

/// What layers do at the triangles of a group.
enum class LayerRole : std::uint8_t {
  kWall,   ///< they grow from these
  kPlane,  ///< they end on these and run along them: symmetry planes
  kNone    ///< neither: far field
};

struct LayerOptions {
  double height = 0;       ///< of all layers together, model unit, > 0
  bool is_inside = false;  ///< the flow is where normals of triangles do not point to
};

struct LayersReport {
  std::int64_t n_nodes = 0;  ///< of walls
  double widest = 0;         ///< largest angle between a node's direction and the normal of a triangle there, radians
  Vec3 widest_at = {};
  Defects blind;  ///< nodes without a direction that all their triangles see
  Defects fans;   ///< edges around which the flow reaches by more than 300 degrees: one direction makes layers twice as
                  ///< high there, fans of several do not
  double fan_length = 0;
  Defects wedges;  ///< edges where walls meet at less than 60 degrees: layers of both sides collide
  double wedge_length = 0;
  Defects tight;      ///< nodes with another wall in their direction nearer than two heights
  double room = 1;    ///< least distance to it over two heights, at most 1
  double median = 0;  ///< mean side of the walls' triangles, the median, model unit
};

/// The direction of a node has the smallest largest angle to the normals of its triangles on walls; where planes meet
/// there, it runs along them. `roles`: [n_groups]. Local, n log n; the same at any number of threads.
LayersReport check_layers(const SurfaceMesh& mesh, std::span<const LayerRole> roles, const LayerOptions& options);

/// Axis of the smallest cone around `directions` (unit, at least one): unit. Meaningless where they lie in no half
/// space. Expected time linear.
Vec3 smallest_cone(std::span<const Vec3> directions);

/// Thickness of a turbulent boundary layer on a flat plate at the end of `length`: 0.37 length / Re^0.2 (Schlichting,
/// Boundary-Layer Theory, from the velocity's 1/7 power law).
double boundary_layer_thickness(double reynolds, double length);

}  // namespace st
