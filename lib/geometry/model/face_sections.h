// What the module lib/geometry/reader/face_sections.cpp exports: it takes OpenCASCADE's boolean operations along, which
// st-check needs for few models.
#pragma once

#include <TopoDS_Face.hxx>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Appends where two faces meet besides their common edges and vertices, within the larger of their tolerances and
/// `tolerance`; nothing where OpenCASCADE cannot say.
using SectionFunction = void (*)(const TopoDS_Face& a, const TopoDS_Face& b, double tolerance,
                                 std::vector<FaceContact>& found);
constexpr char kSectionFunction[] = "st_find_face_sections";

}  // namespace st
