// What the page of st-report knows of each CAD face: what the pointer shows, and what a click takes.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "geometry/model/model.h"
#include "io/hdf5/artifact.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Triangles by group, and within a group by face; else in their order.
std::vector<TriangleId> by_group_and_face(const SurfaceMesh& mesh);

/// Faces in that order, those without triangles left out: [[number from 1, triangles, name, part, area], ...]. The part
/// is an index into the labels' paths, -1: none. Areas are those of `tables`, 0 without any. Local, linear.
nlohmann::ordered_json faces_to_pick(const SurfaceMesh& mesh, std::span<const TriangleId> order,
                                     const ModelTables* tables);

/// Faces that have no mesh, or one that was closed from their edges: number, name, cause, remedy, place.
nlohmann::ordered_json unmeshed_faces(std::span<const FaceFailure> failures, const FaceLabels& labels);

/// Where faces are joined: `cad_faces` and `cad_edges`, of each one the numbers in the CAD, which groups files have.
/// Else empty.
nlohmann::ordered_json cad_numbers(const GeometryArtifact& geometry);

}  // namespace st
