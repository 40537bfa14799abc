// How many triangles a sizing will give, before anything is meshed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/limits.h"
#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "sizing/size_field.h"

namespace st {

/// About this many triangles: equilateral ones of the local length. `face_weight`: see SizingArtifact.
double expected_triangles(std::span<const double> face_weight);

/// Triangles of a tile of a heavy face, of a mesh of so many: small enough that 64 threads find work on a small mesh.
double usual_tile(double n_triangles);

/// Above this number st-prolong says before anything is meshed which faces ask for most.
inline constexpr double kManyTriangles = 5e6;

/// The faces that ask for most triangles, five at most, with their shares: "31 % on face 12 "fillet", 4 % on face 3".
/// `face_name`: one per face, or empty.
std::string heaviest_faces(std::span<const double> face_weight, std::span<const std::string> face_name);

/// Warns when more than `many` triangles are expected; throws Error(kUsage) when it is more than `limit`. Both say
/// which faces ask for most, and the options that bound it. `sizing`: its file, for the message.
void report_expected_triangles(std::span<const double> face_weight, std::span<const std::string> face_name,
                               std::optional<int> limit, const std::string& sizing, double many = kManyTriangles);

/// Weights of faces as in SizingArtifact, from a mesh of them and the sizes that a new one will have. Cost: at most
/// some 40,000 queries of the field.
std::vector<double> face_weights_on(const SurfaceMesh& mesh, const SizeField& field, FaceId n_faces);

/// No more than a mesh can number, and than fit 80 % of so many bytes.
double most_triangles_in(double memory);

/// Throws Error(kUsage) when `faces` (empty: all) would have more triangles than `limit`: with the expected number, the
/// face that asks for most, and what to do. Weights that are not one per face say nothing. `sizing`: its file, for the
/// message.
void require_countable_mesh(const ModelTables& tables, std::span<const double> face_weight,
                            std::span<const FaceId> faces, const std::string& sizing, double limit);

}  // namespace st
