// How far a mesh of chords may differ from the CAD it was made on.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "geometry/model/model.h"
#include "judge/surface_deviation.h"
#include "mesh/own_triangles.h"
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

/// What shares of a mesh add to a ChordError inside faces.
struct ChordParts {
  /// What some triangles of one face add.
  struct Part {
    FaceId face = kNone;
    double area = 0, found_area = 0, volume = 0, moved_volume = 0, flat = 0, size = 0;  ///< size: times the flat area
    double distance = 0, node_distance = 0, off_surface = 0, stray = 0;
    Vec3 node_place, off_place, stray_place;
  };
  std::vector<Part> parts;        ///< by piece and face
  std::vector<double> face_size;  ///< [n_faces] largest requested length of the face's nodes

  /// Those of the next share.
  void add(const ChordParts& next);
  static auto fields(auto& p) { return std::tie(p.parts, p.face_size); }
};
ChordParts estimate_chord_error(const Model& model, const SurfaceMesh& mesh, const OwnTriangles& own,
                                DeviationSum* deviation);
/// Of all parts, and along edges. `mesh`: its nodes on edges and vertices, at least, and its merged features.
ChordError report_chords(const Model& model, const SurfaceMesh& mesh, const ChordParts& parts);

}  // namespace st
