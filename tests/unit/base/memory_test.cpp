// memory_limit(): never more than the machine has, and what a limit of the process leaves. Memory that goes back.
#include "base/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace st {
namespace {

TEST(MemoryLimit, is_no_more_than_the_machine_has) {
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  EXPECT_GT(memory_limit(), 1e6);
  EXPECT_LE(memory_limit(), machine);
}

TEST(MemoryLimit, is_that_of_the_process_where_it_has_one) {
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &old), 0);
  rlimit small = old;
  small.rlim_cur = 3 << 28;
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &small), 0);
  const double limit = memory_limit();
  setrlimit(RLIMIT_DATA, &old);
  EXPECT_LE(limit, 3 << 28);
}

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

TEST(FreedMemory, goes_back_to_the_system_from_between_what_is_used) {
  constexpr std::size_t kPieces = 2000, kBytes = 20'000;
  std::vector<std::unique_ptr<char[]>> pieces(kPieces);
  for (auto& piece : pieces) piece.reset(new char[kBytes]), std::memset(piece.get(), 1, kBytes);
  for (std::size_t i = 0; i < kPieces; ++i)
    if (i % 10 != 0) pieces[i].reset();
  const double kept = resident_bytes();
  return_freed_memory();
  EXPECT_LT(resident_bytes(), kept - 0.5 * kPieces * kBytes);
}

TEST(KeptToEnd, is_not_taken_apart) {
  bool is_gone = false;
  keep_to_end(std::shared_ptr<const void>(&is_gone, [](bool* gone) { *gone = true; }));
  EXPECT_FALSE(is_gone);
  EXPECT_FALSE(ends_with_memory());
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/// The line of flags of the mapping that holds an address.
std::string flags_of_mapping(const void* address) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream file("/proc/self/smaps");
  bool is_in = false;
  for (std::string line; std::getline(file, line);) {
    std::uintptr_t begin = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2) is_in = begin <= wanted && wanted < end;
    if (is_in && line.starts_with("VmFlags:")) return line + " ";
  }
  return {};
}

TEST(FreedMemory, and_the_rest_of_the_heap_lie_in_large_pages) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage") || memory_limit() < 8e9)
    GTEST_SKIP() << "SKIPPED: this machine has no large pages on request, or less than 8 GB of memory";
  prepare_heap();
  const double before = resident_bytes();
  const std::vector<char> array(std::size_t{8} << 20, 7);
  const std::string flags = flags_of_mapping(array.data() + array.size() / 2);
  EXPECT_NE(flags.find(" hg "), std::string::npos) << flags;
  EXPECT_LT(resident_bytes(), before + (16 << 20)) << "the reserve is memory in use";
}

#endif

TEST(LargePages, leave_what_is_in_an_array) {
  std::vector<char> array(std::size_t{5} << 20, 7);
  prefer_large_pages(array.data(), array.size());
  EXPECT_EQ(std::count(array.begin(), array.end(), 7), std::ssize(array));
  char small[10] = "nine char";
  prefer_large_pages(small, sizeof small);  // no page lies in it
  EXPECT_STREQ(small, "nine char");
  prefer_large_pages(nullptr, 0);
}

}  // namespace
}  // namespace st
