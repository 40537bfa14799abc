// Rows of the datasets of one file, without those before and after them. Internal to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/hdf5_file.h"

namespace st {

/// Where a dataset lies.
struct RowPlace {
  std::string name;
  std::int64_t offset = 0;  ///< in the file, bytes
  std::size_t n_rows = 0;
};

class RowReader {
 public:
  /// `reader` outlives it. Throws Error(kInput).
  RowReader(const std::string& path, const Hdf5Reader& reader);
  ~RowReader();
  RowReader(const RowReader&) = delete;
  RowReader& operator=(const RowReader&) = delete;

  std::size_t n_rows(const std::string& name) const { return reader_.info(name).shape.at(0); }

  /// Its place, when its rows are of this type; one thread at a time. Throws Error(kInput).
  template <class T>
  RowPlace find(const std::string& name) const {
    return find(name, Element<T>::type, Element<T>::count);
  }
  /// From any thread. Checksums stay unverified. Throws Error(kInput) where the dataset has not so many rows.
  template <class T>
  std::vector<T> read(const RowPlace& place, std::size_t first, std::size_t n) const {
    std::vector<T> values(n);
    read(place, first, n, std::as_writable_bytes(std::span(values)));
    return values;
  }
  template <class T>
  std::vector<T> read(const std::string& name, std::size_t first, std::size_t n) const {
    return read<T>(find<T>(name), first, n);
  }
  /// Compares all checksums of these datasets with their values, on all threads; a few MB are in memory.
  void verify(const std::vector<std::string>& names) const;

 private:
  RowPlace find(const std::string& name, ElementType type, std::size_t columns) const;
  void read(const RowPlace& place, std::size_t first, std::size_t n, std::span<std::byte> to) const;
  void read_bytes(const std::string& name, std::int64_t begin, std::span<std::byte> to) const;

  const Hdf5Reader& reader_;
  int fd_;
};

}  // namespace st
