// Room in a vector whose memory all threads touch first.
#pragma once

#include <cstddef>
#include <vector>

#include "base/threads.h"

namespace st {

/// Writes zeros into each page of uninitialised memory, on all threads. The system clears a page when it is first
/// touched, which takes longer than to fill it. Local.
inline void touch_pages(void* memory, std::size_t n_bytes) {
  constexpr std::size_t kPage = 4096, kPagesPerPiece = 256;
  auto* bytes = static_cast<volatile char*>(memory);
  parallel_for((n_bytes + kPage - 1) / kPage, kPagesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t page = begin; page < end; ++page) bytes[page * kPage] = 0;
  });
}

/// v.reserve(n); what is new of it is touched on all threads, so that v.resize(n) or v.assign(n, ...) after it takes
/// little time on one.
template <class T>
void parallel_reserve(std::vector<T>& v, std::size_t n) {
  if (n <= v.capacity()) return;
  v.reserve(n);
  touch_pages(v.data() + v.size(), (n - v.size()) * sizeof(T));
}

}  // namespace st
