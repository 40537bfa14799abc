#include "io/hdf5/row_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>

#include "base/hash.h"
#include "base/threads.h"

namespace st {

RowReader::RowReader(const std::string& path, const Hdf5Reader& reader)
    : reader_(reader), fd_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (fd_ < 0) reader_.fail("/st", "cannot be read");
}

RowReader::~RowReader() { close(fd_); }

RowPlace RowReader::find(const std::string& name, ElementType type, std::size_t columns) const {
  const DatasetInfo& info = reader_.info(name);
  const std::size_t stored = info.shape.size() == 2 ? info.shape[1] : 1;
  if (info.type != type || stored != columns) reader_.fail(name, "has not the rows that its triangles need");
  return {name, reader_.file_offset(name), info.shape[0]};
}

void RowReader::read(const RowPlace& place, std::size_t first, std::size_t n, std::span<std::byte> to) const {
  if (first > place.n_rows || n > place.n_rows - first)
    reader_.fail(place.name, "has not the rows that its triangles need");
  if (n > 0) read_bytes(place.name, place.offset + static_cast<std::int64_t>(first * (to.size() / n)), to);
}

void RowReader::read_bytes(const std::string& name, std::int64_t begin, std::span<std::byte> to) const {
  while (!to.empty()) {
    const ssize_t got = pread(fd_, to.data(), to.size(), static_cast<off_t>(begin));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) reader_.fail(name, "cannot be read");
    to = to.subspan(static_cast<std::size_t>(got));
    begin += got;
  }
}

void RowReader::verify(const std::vector<std::string>& names) const {
  static constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::vector<std::function<void()>> jobs;
  for (const std::string& name : names) {
    const DatasetInfo& info = reader_.info(name);
    std::size_t n_bytes = element_size(info.type);
    for (const std::uint64_t extent : info.shape) n_bytes *= extent;
    jobs.emplace_back([this, &info, n_bytes, offset = reader_.file_offset(name)] {
      Hasher hasher;
      std::vector<std::byte> piece(std::min(kPiece, n_bytes));
      for (std::size_t done = 0; done < n_bytes; done += piece.size()) {
        const auto some = std::span(piece).first(std::min(piece.size(), n_bytes - done));
        read_bytes(info.name, offset + static_cast<std::int64_t>(done), some);
        hasher.add(some.data(), some.size());
      }
      if (hasher.hex() != info.checksum) reader_.fail(info.name, "does not fit its checksum");
    });
  }
  run_jobs(jobs);
}

}  // namespace st
