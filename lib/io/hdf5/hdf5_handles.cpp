#include "io/hdf5/hdf5_handles.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "base/error.h"
#include "base/hash.h"

namespace st {

bool is_provenance(const std::string& dataset) { return dataset.ends_with("/previous_id"); }

const char* element_type_name(ElementType type) {
  constexpr const char* kNames[] = {"float64", "float32", "int32", "int64", "uint8", "uint64", "string"};
  return kNames[static_cast<int>(type)];
}

hid_t native_type(ElementType type) {
  switch (type) {
    case ElementType::kFloat64:
      return H5T_NATIVE_DOUBLE;
    case ElementType::kFloat32:
      return H5T_NATIVE_FLOAT;
    case ElementType::kInt32:
      return H5T_NATIVE_INT32;
    case ElementType::kInt64:
      return H5T_NATIVE_INT64;
    case ElementType::kUint8:
      return H5T_NATIVE_UINT8;
    case ElementType::kUint64:
      return H5T_NATIVE_UINT64;
    case ElementType::kString:
      break;
  }
  throw Error(ExitCode::kInternal, "no HDF5 type for strings here");
}

std::string up_to_nul(const char* text, std::size_t max_length) { return std::string(text, strnlen(text, max_length)); }

std::string checksum_of(const std::vector<std::string>& values) {
  Hasher hasher;
  for (const std::string& value : values) hasher.add(std::string_view(value));
  return hasher.hex();
}

bool is_provenance(const AttributeKey& key) {
  static const std::set<std::string> names = {"content_hash", "geometry_hash", "tool",
                                              "tool_version", "options",       "inputs"};
  return key.first == kRoot && names.contains(key.second);
}

std::string content_hash(const std::vector<DatasetInfo>& datasets_by_name,
                         const std::map<AttributeKey, AttributeValue>& attributes) {
  Hasher hasher;
  for (const DatasetInfo& d : datasets_by_name) {
    if (is_provenance(d.name)) continue;
    hasher.add(std::string_view(d.name));
    hasher.add(std::string_view(element_type_name(d.type)));
    hasher.add(std::span<const std::uint64_t>(d.shape));
    hasher.add(std::string_view(d.checksum));
  }
  for (const auto& [key, value] : attributes) {
    if (is_provenance(key)) continue;
    hasher.add(std::string_view(key.first));
    hasher.add(std::string_view(key.second));
    hasher.add(&value.kind, 1);
    hasher.add(std::string_view(value.bytes));
  }
  return hasher.hex();
}

}  // namespace st
