// Facets on their way to faces: one numbering of nodes, lines between faces as marks on sides.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "geometry/shape/chart_topology.h"

namespace st {

/// Of the largest coordinate: what four roundings to 24 bits move a point by.
inline constexpr double kSinglePrecision = 2.4e-7;

/// Cosine between the normals of facets that turn by more than 120 degrees, as at a sharp trailing edge.
inline constexpr double kKnife = -0.5;

/// Area of a facet times two, along its normal.
inline Vec3 area_normal(const std::vector<Vec3>& x, const Corners& c) {
  return cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]);
}

/// Facets as a file has them.
struct FacetInput {
  std::vector<Vec3> x;                 ///< model unit
  std::vector<Corners> corners;        ///< nodes
  std::vector<std::int32_t> part;      ///< [n_triangles] row of part_name
  std::vector<std::string> part_name;  ///< UTF-8, of a solid in the file; or empty

  /// Drops triangles but those t for which stays(t).
  template <class Stays>
  void keep(const Stays& stays) {
    std::size_t n = 0;
    for (std::size_t t = 0; t < corners.size(); ++t) {
      if (!stays(t)) continue;
      corners[n] = corners[t];
      part[n++] = part[t];
    }
    corners.resize(n);
    part.resize(n);
  }
};

/// The sum of what passes did, until one does nothing; at most `most` of them.
template <class Pass>
std::size_t sum_of_passes(int most, const Pass& pass) {
  std::size_t sum = 0, n = 1;
  for (int i = 0; i < most && n > 0; ++i) sum += n = pass();
  return sum;
}

/// Facets with smooth regions or charts as faces. Triangles may be divided; the surface stays.
struct FacetMesh {
  std::vector<Vec3> x;
  std::vector<Vec3> normal;                          ///< unit; one for each node and smooth fan of triangles around it
  std::vector<Corners> corners;                      ///< nodes
  std::vector<Corners> corner_normal;                ///< rows of `normal`
  std::vector<std::array<std::uint8_t, 3>> is_line;  ///< side k, from corner k to the next one, bounds a face
  std::vector<std::int32_t> part, face;              ///< [n_triangles]
  std::vector<std::array<Vec2, 3>> uv;               ///< [n_triangles] of the corners, where a face is a chart

  std::int32_t n_triangles() const { return static_cast<std::int32_t>(corners.size()); }
};

/// Triangles that hang together across sides which are no lines, with nodes of their own: one on both sides of a line
/// is two.
struct FacetPatch {
  std::vector<std::int32_t> triangles;     ///< of the mesh, ascending
  std::vector<Corners> corners;            ///< [triangles] own nodes
  std::vector<Corners> neighbours;         ///< [triangles] own triangles, as find_neighbours() has them
  std::vector<Vec3> x;                     ///< [own nodes]
  std::vector<std::int32_t> node, normal;  ///< [own nodes] of the mesh
};

/// Finds patches of one mesh, again and again.
class PatchFinder {
 public:
  explicit PatchFinder(const FacetMesh& mesh) : mesh_(mesh) {}

  /// Of some triangles, by their lowest triangle. Cost: that of these triangles, however large the mesh is.
  std::vector<FacetPatch> find(std::vector<std::int32_t> triangles);

 private:
  const FacetMesh& mesh_;
  std::vector<std::int32_t> number_;  // [nodes] kNone between calls
};

/// A new node on a side.
struct CutNode {
  std::int32_t node;
  double share;  ///< of the way from the lower node to the higher one
};

/// By the side's nodes, the lower one first.
using CutNodes = std::map<std::pair<std::int32_t, std::int32_t>, CutNode>;

/// Divides patches of one mesh, again and again.
class PatchDivider {
 public:
  explicit PatchDivider(FacetMesh& mesh);

  /// Along a plane: sides that cross it get a node, in all triangles that have them, and sides between both halves
  /// become lines. `height`: of each own node above the plane, exactly 0 where it counts as on it. New triangles are at
  /// the end of the mesh and have the face of the one they are part of. Cost: that of the patch, however large the mesh
  /// is.
  void divide(const FacetPatch& patch, const std::vector<double>& height);
  /// Along sides of its triangles: those between two groups become lines. `group`: [triangles of the patch].
  void part(const FacetPatch& patch, const std::vector<std::int32_t>& group);

 private:
  void add_lines(std::int32_t triangle);
  std::vector<std::int32_t> find_divided(const FacetPatch& patch, const std::vector<double>& height,
                                         const CutNodes& nodes) const;

  FacetMesh& mesh_;
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> beside_;  // triangles that have or had a line, by nodes
};

/// Drops the other triangles; nodes stay. `is_kept`: [n_triangles].
void keep_triangles(FacetMesh& mesh, const std::vector<std::uint8_t>& is_kept);

/// Area of triangle t times two, along its normal.
inline Vec3 area_normal(const FacetMesh& mesh, std::int32_t t) { return area_normal(mesh.x, mesh.corners[t]); }

}  // namespace st
