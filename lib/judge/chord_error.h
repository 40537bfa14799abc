// How far a mesh of chords may differ from the CAD it was made on.
#pragma once

#include <vector>

#include "geometry/model/model.h"
#include "judge/surface_deviation.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Of the requested length: a node farther from its surface belongs to another one.
inline constexpr double kOffSurface = 0.25;

/// Sides up to this many requested lengths are what the sizes ask for; longer ones explain no more than sides of this
/// length would.
inline constexpr double kLongestSide = 1.5;

/// What chords explain, per CAD face, model unit.
struct ChordError {
  std::vector<double> area;        ///< [n_faces] largest difference of area that chords of the requested length explain
  std::vector<double> found_area;  ///< [n_faces] likewise the chords that the mesh has
  std::vector<double> volume;      ///< [n_faces] largest volume between the surface and chords of the requested length
  std::vector<double> moved_volume;  ///< [n_faces] volume between the triangles and those of the surface's points at
                                     ///< their corners: that of nodes off the surface
  std::vector<double> flat;          ///< [n_faces] area of these triangles of the surface's points
  std::vector<double> size;          ///< [n_faces] requested length, mean over the area; 0 without triangles
  std::vector<double> distance;  ///< [n_faces] largest distance found between the side of a triangle and the surface
  std::vector<double> node_distance;  ///< [n_faces] largest distance between a node and the surface at its corner's
                                      ///< (u,v)
  std::vector<Vec3> node_place;       ///< [n_faces] where that is
  std::vector<double> off_surface;    ///< [n_faces] largest part of such a distance beyond kOffSurface of the node's
                                      ///< requested length; 0: none
  std::vector<Vec3> off_place;        ///< [n_faces] where that is
  std::vector<double> stray;          ///< [n_faces] largest distance between a node and the surface, found from there
  std::vector<Vec3> stray_place;      ///< [n_faces] where that is
};

/// Along edges: the segments between trimming curve and chord. Inside: triangles against their parts with corners on
/// the surface, extrapolated; from the (u,v) of the corners alone, so that a misplaced node explains nothing.
/// Precondition: `mesh` was made on `model`. Local; some four surface evaluations per triangle.
/// Each triangle is added to `deviation` as well, unless null: surfaces are made once for both.
ChordError estimate_chord_error(const Model& model, const SurfaceMesh& mesh, DeviationSum* deviation = nullptr);

}  // namespace st
