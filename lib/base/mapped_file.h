// Which file lies at an address: a file that is cut while it is mapped ends in a signal, which can say its name.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace st {

/// A read-only mapping of `length` bytes of the open file `fd` from `offset`, a multiple of the page size; null with
/// errno when that fails. `path`: for mapped_file_at().
std::shared_ptr<const void> map_file(int fd, std::size_t offset, std::size_t length, const std::string& path);

/// Name of the mapped file at this address, cut to 4095 bytes; nullptr: none of map_file's first 64 lies there.
/// Async-signal-safe.
const char* mapped_file_at(const void* address) noexcept;

}  // namespace st
