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

/// Appends all pieces to `all`, one after the other. Returns where each begins.
template <class T>
std::vector<std::size_t> append_pieces(const std::vector<std::vector<T>>& pieces, std::vector<T>& all) {
  std::vector<std::size_t> start;
  std::size_t n = all.size();
  for (const std::vector<T>& piece : pieces) {
    start.push_back(n);
    n += piece.size();
  }
  parallel_reserve(all, n);
  for (const std::vector<T>& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  return start;
}

}  // namespace st
