// Content hashes: 128 bits of XXH3, as 32 hexadecimal digits.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace st {

/// Accumulates bytes in order; equal byte sequences give equal digests on every machine of equal endianness.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  void add(const void* data, std::size_t n_bytes);
  void add(std::string_view text);
  template <class T>
  void add(std::span<const T> values) {
    add(values.data(), values.size_bytes());
  }
  /// 32 lower-case hexadecimal digits of everything added so far.
  std::string hex() const;

 private:
  void* state_;
};

/// Digest of one block.
std::string hash_hex(const void* data, std::size_t n_bytes);

}  // namespace st
