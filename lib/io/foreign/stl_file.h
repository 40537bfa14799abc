// Reading STL.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/surface_mesh.h"

namespace st {

/// Bytes of a binary STL file by the number of triangles that its head announces; 0 without such a number.
std::uint64_t whole_stl_size(std::string_view head);

/// Whether a file of this size is binary STL. Bytes behind the triangles, as a transfer adds them, do no harm unless
/// they may be triangles, too: then none tells whether the number is right.
bool is_binary_stl(std::string_view head, std::uint64_t file_size);

/// The triangles of an STL file, binary or ASCII (told apart by content). Several solids are the faces and
/// name them; else each connected part is a face without a name.
/// Equal points become one node, numbered in the order of the file; triangles that then name a node twice are left out.
/// Throws Error(kInput) for anything else.
SurfaceMesh read_stl(const std::string& path);

}  // namespace st
