// Numbers of faces and edges as a groups file takes them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace st {

/// "1-7, 9" of ascending numbers; with `quote` ranges are in quotes: "\"1-7\", 9".
std::string id_ranges(std::span<const std::int32_t> ids, char quote = 0);

}  // namespace st
