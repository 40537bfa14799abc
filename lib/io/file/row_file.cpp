#include "io/file/row_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace st {

RowFile::RowFile(const std::string& name, std::string label) : label_(std::move(label)) {
  errno = 0;
  file_ = open(name.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  if (file_ < 0) fail("the file");
}

RowFile::~RowFile() {
  if (file_ >= 0) ::close(file_);
}

void RowFile::fail(const std::string& what) const {
  const std::string cause = errno ? std::string(" (") + std::strerror(errno) + ")" : "";
  throw Error(ExitCode::kOutput,
              label_ + ": cannot write " + what + cause + "; free some space or choose another directory");
}

void RowFile::write(std::uint64_t offset, std::span<const std::byte> bytes, const std::string& what) const {
  while (!bytes.empty()) {
    errno = 0;
    const ssize_t n = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(what);
    offset += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void RowFile::close() {
  errno = 0;
  if (::close(std::exchange(file_, -1)) != 0) fail("the file");
}

}  // namespace st
