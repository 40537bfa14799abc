// HDF5 ids that close themselves, and what the writer and the reader of artifacts have in common. Internal to io.
#pragma once

#include <hdf5.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/hdf5_open.h"

namespace st {

inline constexpr const char* kChecksum = "xxh3";  ///< attribute of each dataset
inline constexpr const char* kRoot = "/st";       ///< the group that tells what an artifact is

/// Closes an HDF5 id at the end of its scope.
template <herr_t (*Close)(hid_t)>
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id) : id_(id) {}  // NOLINT: made to be assigned from the C API
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  operator hid_t() const { return id_; }
  bool is_valid() const { return id_ >= 0; }
  /// Closes now; false when that failed.
  bool reset() { return id_ < 0 || Close(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
};
using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Attribute = Handle<H5Aclose>;
using Properties = Handle<H5Pclose>;

/// Not for strings.
hid_t native_type(ElementType type);
std::string up_to_nul(const char* text, std::size_t max_length);
std::string checksum_of(const std::vector<std::string>& values);

/// The value of an attribute, as hashed: a kind and the bytes.
struct AttributeValue {
  char kind = 's';  // s string, i integers, d double
  std::string bytes;
};
using AttributeKey = std::pair<std::string, std::string>;  // group, name

/// Whether the attribute says where the artifact comes from, not what it says of the model.
bool is_provenance(const AttributeKey& key);

/// Hash of everything that the artifact says of the model: datasets and attributes by name, provenance apart.
std::string content_hash(const std::vector<DatasetInfo>& datasets_by_name,
                         const std::map<AttributeKey, AttributeValue>& attributes);

}  // namespace st
