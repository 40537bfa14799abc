#include "base/memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <utility>
#include <vector>

namespace st {
namespace {

/// The number in a file; `otherwise` when there is none ("max").
double number_in(const char* path, double otherwise) {
  std::ifstream file(path);
  double value = 0;
  return file >> value && value > 0 ? value : otherwise;
}

/// What the heap reserves at once and asks large pages for, bytes: one kind of page per range of the heap, so what it
/// grows by later has small ones. Below what is kept when freed, or it would be given back at once.
constexpr std::size_t kHeapOfLargePages = std::size_t{3} << 28;

/// Least memory that a process may use for such a reserve, in reserves: it counts in limits of address space.
constexpr double kLeastReserves = 8;

std::atomic<bool> g_ends_with_memory = false;

}  // namespace

void prepare_heap() {
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 1 << 26);
  if (memory_limit() < kLeastReserves * kHeapOfLargePages) return;
  void* const range = std::malloc(kHeapOfLargePages);  // no page of it is touched
  if (!range) return;
  prefer_large_pages(range, kHeapOfLargePages);
  std::free(range);
#endif
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void end_with_memory() { g_ends_with_memory = true; }
bool ends_with_memory() { return g_ends_with_memory; }

void keep_to_end(std::shared_ptr<const void> thing) {
  static std::mutex mutex;
  static auto& kept = *new std::vector<std::shared_ptr<const void>>();  // never destroyed
  const std::lock_guard lock(mutex);
  kept.push_back(std::move(thing));
}

void prefer_large_pages([[maybe_unused]] void* array, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
  const std::size_t skipped = (page - reinterpret_cast<std::uintptr_t>(array) % page) % page;
  if (bytes >= skipped + page)
    madvise(static_cast<std::byte*>(array) + skipped, (bytes - skipped) / page * page, MADV_HUGEPAGE);
#endif
}

double memory_limit() {
  double limit = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  for (const char* group : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
    limit = std::min(limit, number_in(group, limit));
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit r{};
    if (getrlimit(resource, &r) == 0 && r.rlim_cur != RLIM_INFINITY)
      limit = std::min(limit, static_cast<double>(r.rlim_cur));
  }
  return limit;
}

}  // namespace st
