// Bytes as letters.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace st {

/// RFC 4648's base64, padded by "=". Linear.
std::string base64(std::span<const std::byte> bytes);

}  // namespace st
