// Bytes in memory as a stream.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <streambuf>

namespace st::occt {

/// Reads a byte array as a stream without copying it. The array must outlive it.
std::unique_ptr<std::streambuf> byte_stream(std::span<const std::byte> bytes);

}  // namespace st::occt
