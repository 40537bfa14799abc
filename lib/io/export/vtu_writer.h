// Arrays of VTK's XML files, their values in them in base64: the one form that VTK, ParaView and meshio all read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/export/export_formats.h"

namespace st {

template <class T>
struct VtkType;
template <>
struct VtkType<double> {
  static constexpr const char* name = "Float64";
};
template <>
struct VtkType<float> {
  static constexpr const char* name = "Float32";
};
template <>
struct VtkType<std::int32_t> {
  static constexpr const char* name = "Int32";
};
template <>
struct VtkType<std::int64_t> {
  static constexpr const char* name = "Int64";
};
template <>
struct VtkType<std::uint8_t> {
  static constexpr const char* name = "UInt8";
};

/// Text as the value of an XML attribute.
std::string xml_escaped(const std::string& text);

/// The head of an unstructured grid, up to its first child.
void begin_vtu(Output& out);
/// A DataArray of `n_bytes` in values.
void write_vtu_bytes(Output& out, const char* type, const std::string& name, int n_components, std::size_t n_tuples,
                     const void* values, std::size_t n_bytes);
/// A DataArray; (n) for one component, as meshio makes (n, 1) of an announced one.
template <class T>
void write_vtu_array(Output& out, const std::string& name, const std::vector<T>& values, int n_components = 1) {
  write_vtu_bytes(out, VtkType<T>::name, name, n_components, values.size() / static_cast<std::size_t>(n_components),
                  values.data(), values.size() * sizeof(T));
}

/// Names as field data: an array "what:NAME" for each different name, with the numbers, from 1, of all that have it.
/// Strings would be read by VTK alone.
void write_vtu_names(Output& out, const std::string& what, const std::vector<std::string>& names);

}  // namespace st
