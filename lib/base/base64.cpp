#include "base/base64.h"

#include <algorithm>
#include <cstdint>

namespace st {

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3, out += 4) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    const auto byte = [&](std::size_t k) { return k < n ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U; };
    const std::uint32_t word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k <= n; ++k) out[k] = kLetters[word >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace st
