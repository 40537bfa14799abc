// What is said of faces that are missing or were turned.
#pragma once

#include <span>
#include <string>

#include "base/ids.h"
#include "mesh/merge.h"

namespace st {

/// 1-based, the first of them by number: "3, 17, 20 and 5 more".
std::string list_faces(std::span<const FaceId> faces);

/// Warns of faces and parts that were turned, and of parts that cannot be oriented.
void warn_of_changes(const OrientationReport& report);

}  // namespace st
