#include "base/hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdint>
#include <cstdio>
#include <new>

namespace st {
namespace {
std::string to_hex(XXH128_hash_t h) {
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(h.high64),
                static_cast<unsigned long long>(h.low64));
  return text;
}
}  // namespace

Hasher::Hasher() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(static_cast<XXH3_state_t*>(state_));
}
Hasher::~Hasher() { XXH3_freeState(static_cast<XXH3_state_t*>(state_)); }

void Hasher::add(const void* data, std::size_t n_bytes) {
  if (n_bytes) XXH3_128bits_update(static_cast<XXH3_state_t*>(state_), data, n_bytes);
}

void Hasher::add(std::string_view text) {
  const std::uint64_t n = text.size();
  add(&n, sizeof n);
  add(text.data(), text.size());
}

std::string Hasher::hex() const { return to_hex(XXH3_128bits_digest(static_cast<XXH3_state_t*>(state_))); }

std::string hash_hex(const void* data, std::size_t n_bytes) { return to_hex(XXH3_128bits(data, n_bytes)); }

}  // namespace st
