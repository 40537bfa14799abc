// The appended section of .vtu files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace st {

/// Collects arrays for the appended section of a .vtu and knows their offsets.
class VtuArrays {
 public:
  /// The DataArray element for the values, which are copied.
  template <class T>
  std::string add(const std::string& name, const char* type, const std::vector<T>& values, int components = 1) {
    const std::string header = "        <DataArray type=\"" + std::string(type) + "\" Name=\"" + name +
                               "\" NumberOfComponents=\"" + std::to_string(components) +
                               "\" format=\"appended\" offset=\"" + std::to_string(bytes_.size()) + "\"/>\n";
    const std::uint64_t n = values.size() * sizeof(T);
    append(&n, sizeof n);
    append(values.data(), n);
    return header;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t n) {
    if (n) bytes_.append(static_cast<const char*>(data), n);
  }
  std::string bytes_;
};

}  // namespace st
