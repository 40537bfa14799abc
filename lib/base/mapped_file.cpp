#include "base/mapped_file.h"

#include <sys/mman.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>

namespace st {
namespace {

// A fixed table: a signal handler may touch neither the heap nor a lock.
constexpr std::size_t kSlots = 64, kNameLength = 4096;
struct Slot {
  std::atomic<bool> is_taken{false};
  std::atomic<std::uintptr_t> begin{0}, end{0};  // end 0: not yet filled
  char name[kNameLength];
};
std::array<Slot, kSlots> g_slots;

Slot* remember(const void* base, std::size_t length, const std::string& path) {
  for (Slot& slot : g_slots) {
    if (slot.is_taken.exchange(true)) continue;
    std::strncpy(slot.name, path.c_str(), kNameLength - 1);
    slot.begin = reinterpret_cast<std::uintptr_t>(base);
    slot.end = slot.begin + length;
    return &slot;
  }
  return nullptr;
}

void forget(Slot* slot) {
  if (!slot) return;
  slot->end = 0;
  slot->is_taken = false;
}

}  // namespace

std::shared_ptr<const void> map_file(int fd, std::size_t offset, std::size_t length, const std::string& path) {
  void* base = mmap(nullptr, length, PROT_READ, MAP_SHARED, fd, static_cast<off_t>(offset));
  if (base == MAP_FAILED) return nullptr;
  Slot* slot = remember(base, length, path);
  return {base, [base, length, slot](const void*) {
            munmap(base, length);
            forget(slot);
          }};
}

const char* mapped_file_at(const void* address) noexcept {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (const Slot& slot : g_slots)
    if (at < slot.end && at >= slot.begin) return slot.name;
  return nullptr;
}

}  // namespace st
