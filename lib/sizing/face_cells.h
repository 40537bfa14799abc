// How much of each face lies in which cell: what weights and triangle counts are computed from, for any lengths.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry/shape/loop_polygons.h"
#include "geometry/shape/surface.h"
#include "sizing/octree_field.h"

namespace st {

/// Area of a face in a cell, and the plane in which it lies there, roughly.
struct CellArea {
  std::int32_t leaf = 0;
  float area = 0;               ///< model unit squared
  float center[3] = {0, 0, 0};  ///< centre of the area, model unit, from the origin of places
  float normal[3] = {0, 0, 0};  ///< unit normal, either sign; zero: unknown
};

/// Of a FaceCells entry, without leaf and area.
struct CellPlane {
  float center[3] = {0, 0, 0};
  float normal[3] = {0, 0, 0};
};

/// CSR by face: cells that hold part of the face, ascending, and the area in them.
struct FaceCells {
  std::vector<std::int64_t> offsets{0};  ///< [n_faces+1]
  std::vector<std::int32_t> leaf;        ///< [offsets.back()]
  std::vector<float> area;               ///< model unit squared, > 0
  std::vector<CellPlane> plane;          ///< [offsets.back()]
  Vec3 origin;                           ///< from which the centres of the planes count; see origin_of_places()

  std::int32_t n_faces() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
  void append_face(std::span<const CellArea> cells);
};

/// The cells in which a trimmed surface lies: it is halved in (u,v) until each patch is no larger than the cell at its
/// centre. Areas are scaled to sum up to `face_area` (model unit squared; 0: unknown, not scaled). Ascending by leaf.
/// Centres count from `origin`.
std::vector<CellArea> locate_face(const Surface& surface, const LoopPolygons& loops, const OctreeView& octree,
                                  double face_area, Vec3 origin = {});

/// Where lengths change, advancing fronts make more triangles than 1/h^2. Measured on ten models of the corpus, scaled
/// by 0.5 to 4 with their slopes: within 4 % on most, 10 % on all where edges are longer than the lengths.
inline constexpr double kTrianglesPerGradient = 0.3, kTrianglesPerGradient2 = 0.7;

/// How much meshing a face is, as a function of a scale of all lengths. g: tangential gradient of h.
struct FaceWeight {
  double uniform = 0;  ///< integral of 1/h^2
  double graded = 0;   ///< integral of |g|/h^2
  double steep = 0;    ///< integral of g^2/h^2

  void add(const FaceWeight& other, double times = 1) {
    uniform += times * other.uniform;
    graded += times * other.graded;
    steep += times * other.steep;
  }
  /// Number of triangles, times sqrt(3)/4, when all lengths, and so the gradients, are multiplied by `scale`.
  double at(double scale) const {
    return (uniform / scale + kTrianglesPerGradient * graded) / scale + kTrianglesPerGradient2 * steep;
  }
};

/// Part of a face in one cell of the raster whose length has one cause.
struct SizedPart {
  FaceId face = 0;
  std::int32_t cause = kNone;  ///< see pack_cause
  double area = 0;             ///< model unit squared
  double least = 0;            ///< smallest length in it
  FaceWeight weight;
  Vec3 place = {};  ///< where it is the smallest

  /// The one length that gives as many triangles, but for those of the gradient.
  double length() const;
};

/// Per face. `raster`: the octree that `faces` refers to; `field` may live on a finer one: the area in a cell is spread
/// over its plane, the finer the more the cell was refined there. `visit` gets the parts that the weights are the sum
/// of, in the order of `faces`.
std::vector<FaceWeight> face_weights(const FaceCells& faces, const OctreeView& raster, const OctreeField& field,
                                     const std::function<void(const SizedPart&)>& visit = {});

}  // namespace st
