// Contents that contradict each other are refused when an artifact is read: no reader behind trusts an index blindly.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/ids.h"
#include "io/hdf5/hdf5_file.h"

namespace st {

/// Offsets start at 0, never decrease and end at n_items. Throws Error(kInput) naming the dataset.
template <class Offset>
void require_offsets(const Hdf5Reader& reader, const std::string& name, std::span<const Offset> offsets,
                     std::size_t n_items) {
  if (offsets.empty() || offsets.front() != 0 || static_cast<std::size_t>(offsets.back()) != n_items)
    reader.fail(name, "does not fit the array it points into");
  for (std::size_t i = 1; i < offsets.size(); ++i)
    if (offsets[i] < offsets[i - 1]) reader.fail(name, "decreases at row " + std::to_string(i));
}
template <class Offset>
void require_offsets(const Hdf5Reader& reader, const std::string& name, const std::vector<Offset>& offsets,
                     std::size_t n_items) {
  require_offsets(reader, name, std::span<const Offset>(offsets), n_items);
}

/// Ids are in [lowest, n). Throws Error(kInput) naming the dataset.
inline void require_ids(const Hdf5Reader& reader, const std::string& name, std::span<const std::int32_t> ids,
                        std::size_t n, std::int32_t lowest = 0) {
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (ids[i] < lowest || (ids[i] >= 0 && static_cast<std::size_t>(ids[i]) >= n))
      reader.fail(name,
                  "row " + std::to_string(i) + " names entity " + std::to_string(ids[i]) + " of " + std::to_string(n));
}

}  // namespace st
