// Contents that contradict each other are refused when an artifact is read: no reader behind trusts an index blindly.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/finite.h"
#include "base/ids.h"
#include "base/threads.h"
#include "base/vec.h"
#include "io/hdf5/hdf5_file.h"

namespace st {

constexpr std::size_t kCheckedAtOnce = 16'384;  // rows of a piece

/// Older versions lack what this build needs: throws Error(kInput) that says which tool is to run again.
inline void require_version(const Hdf5Reader& file, int version, const std::string& tool) {
  const ArtifactHeader& header = file.header();
  if (header.schema_version < version)
    throw Error(ExitCode::kInput, file.path() + ": " + header.schema + " schema version " +
                                      std::to_string(header.schema_version) + " of an older " + tool + "; run " + tool +
                                      " again");
}

/// Offsets start at 0, never decrease and end at n_items. Throws Error(kInput) naming the dataset.
template <class Offset>
void require_offsets(const Hdf5Reader& reader, const std::string& name, std::span<const Offset> offsets,
                     std::size_t n_items) {
  if (offsets.empty() || offsets.front() != 0 || static_cast<std::size_t>(offsets.back()) != n_items)
    reader.fail(name, "does not fit the array it points into");
  parallel_for(offsets.size() - 1, kCheckedAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 1; i <= end; ++i)
      if (offsets[i] < offsets[i - 1]) reader.fail(name, "decreases at row " + std::to_string(i));
  });
}
template <class Offset>
void require_offsets(const Hdf5Reader& reader, const std::string& name, const std::vector<Offset>& offsets,
                     std::size_t n_items) {
  require_offsets(reader, name, std::span<const Offset>(offsets), n_items);
}

/// Every row is as `is_good` wants it. Throws Error(kInput) naming the dataset and its first bad row.
template <class T, class IsGood>
void require_rows_to_be(const Hdf5Reader& reader, const std::string& name, std::span<const T> rows, const char* what,
                        const IsGood& is_good) {
  parallel_for(rows.size(), kCheckedAtOnce, [&](std::size_t begin, std::size_t end) {
    bool is_all_good = true;
    for (std::size_t i = begin; i < end; ++i) is_all_good &= is_good(rows[i]);
    for (std::size_t i = begin; !is_all_good && i < end; ++i)
      if (!is_good(rows[i])) reader.fail(name, "row " + std::to_string(i) + " is not " + what);
  });
}

/// Numbers and places are finite.
template <class T>
void require_finite(const Hdf5Reader& reader, const std::string& name, const std::vector<T>& rows) {
  require_rows_to_be(reader, name, std::span<const T>(rows), "finite", [](const T& row) { return is_finite(row); });
}
/// Lengths, areas, tolerances: finite and >= 0.
template <class T>
void require_lengths(const Hdf5Reader& reader, const std::string& name, const std::vector<T>& rows) {
  require_rows_to_be(reader, name, std::span<const T>(rows), "a finite number of at least 0",
                     [](T x) { return is_finite(x) & (x >= 0); });
}

/// Pairs of a least and a largest parameter: finite, and not the wrong way round.
inline void require_ranges(const Hdf5Reader& reader, const std::string& name, const std::vector<double>& ends) {
  require_finite(reader, name, ends);
  for (std::size_t i = 1; i < ends.size(); i += 2)
    if (ends[i] < ends[i - 1]) reader.fail(name, "value " + std::to_string(i) + " is less than the one before it");
}

/// Ids are in [lowest, n). Throws Error(kInput) naming the dataset.
inline void require_ids(const Hdf5Reader& reader, const std::string& name, std::span<const std::int32_t> ids,
                        std::size_t n, std::int32_t lowest = 0) {
  parallel_for(ids.size(), kCheckedAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (ids[i] < lowest || (ids[i] >= 0 && static_cast<std::size_t>(ids[i]) >= n))
        reader.fail(
            name, "row " + std::to_string(i) + " names entity " + std::to_string(ids[i]) + " of " + std::to_string(n));
  });
}

}  // namespace st
