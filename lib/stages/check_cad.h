// st-check with a geometry: faces, areas, volume and nodes against the CAD. Internal to the check stage.
#pragma once

#include <span>
#include <vector>

#include "mesh/own_triangles.h"
#include "stages/check_report.h"

namespace st {

/// Tolerance that the groups of a face give it, 0: none. `of_face`: as face_tolerances() has it.
double group_tolerance(const std::vector<double>& of_face, FaceId f);

/// Middle of the first triangle of each face. [n_faces]
std::vector<Vec3> face_places(const SurfaceMesh& mesh, std::size_t n_faces);

/// Moments of the triangles of one face in one piece, about the face's place, and what strips may change there.
struct FaceMoments {
  FaceId face = kNone;
  double area = 0;
  Vec3 first, squares, products;  ///< products: y z, z x, x y
  double strip_volume = 0;        ///< what closed strips may change of the volume
};
/// Of a share, in order. `place`: face_places() of the whole mesh.
std::vector<FaceMoments> measure_faces(const SurfaceMesh& mesh, const OwnTriangles& own, std::span<const Vec3> place,
                                       const ModelTables& tables);

/// What check_against_cad() knows of the mesh.
struct FacesOfMesh {
  const SurfaceMesh& labels;                  ///< labels and merged features of it count
  std::span<const std::int64_t> n_triangles;  ///< by face; fewer than the CAD has: none
  std::span<const Vec3> place;                ///< face_places()
  std::span<const FaceMoments> moments;       ///< of all shares
};

/// Adds the checks and what they compare to `f`, whose cad->chords, measure and topology are there. `sewing`: tolerance
/// that the user let st-import sew by, model unit; `area_tolerance`: of a face's area.
void check_against_cad(const FacesOfMesh& mesh, const ModelTables& tables, double sewing, double area_tolerance,
                       Findings& f);

}  // namespace st
