// How many triangles a sizing will give, before anything is meshed.
#pragma once

#include <span>
#include <string>

#include "base/limits.h"
#include "geometry/model/model.h"

namespace st {

/// About this many triangles: equilateral ones of the local length. `face_weight`: see SizingArtifact.
double expected_triangles(std::span<const double> face_weight);

/// Throws Error(kUsage) when `faces` (empty: all) would have more triangles than a mesh can number or than fit
/// 80 % of the memory: with the expected number, the face that asks for most, and what to do. Weights that are not one
/// per face say nothing. `sizing`: its file, for the message.
void require_countable_mesh(const ModelTables& tables, std::span<const double> face_weight,
                            std::span<const FaceId> faces, const std::string& sizing);

/// The same with another limit, for tests.
void require_countable_mesh(const ModelTables& tables, std::span<const double> face_weight,
                            std::span<const FaceId> faces, const std::string& sizing, double limit);

}  // namespace st
