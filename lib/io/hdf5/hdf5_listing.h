// What an artifact says of itself and which parts it has, without their values. Internal to io.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/hdf5/hdf5_handles.h"

namespace st {

/// Where a dataset lies in its file: in one piece, as in memory.
struct DatasetPlace {
  std::int64_t offset = -1;  ///< bytes; -1: nowhere, as it is empty
  std::size_t width = 0;     ///< bytes of an element
};

/// A complete file of ours. Its values can be read from their places without HDF5.
struct Hdf5Listing {
  std::string path;
  std::uint64_t file_bytes = 0;
  ArtifactHeader header;
  std::vector<DatasetInfo> datasets;           ///< by name
  std::map<std::string, DatasetPlace> places;  ///< of all datasets
  std::map<AttributeKey, AttributeValue> attributes;

  /// nullptr: there is no such dataset.
  const DatasetInfo* find(const std::string& name) const;
  /// Throws Error(kInput) that names the file, what is wrong with it, and the tool that makes it again.
  [[noreturn]] void damaged(const std::string& what) const;
};

/// Lists a file that is complete and ours, and whose parts fit the content hash. `on_header` sees the header before the
/// parts are looked at, and may throw. Throws Error(kInput).
std::shared_ptr<const Hdf5Listing> list_artifact(const std::string& path,
                                                 const std::function<void(const Hdf5Listing&)>& on_header);
/// The header alone.
ArtifactHeader header_of_artifact(const std::string& path);
/// "st-import" for "geometry": the tool to run again.
std::string tool_of_schema(const std::string& schema);
/// Where an open dataset lies.
DatasetPlace place_of(hid_t dataset, hid_t type);
/// Keeps what the file of this path, just written, lists, if listings are kept. `file_bytes` is found here.
void keep_listing(Hdf5Listing listing);
/// The listing that is kept of this file as it is now; nullptr: there is none.
std::shared_ptr<const Hdf5Listing> kept_listing(const std::string& path);

}  // namespace st
