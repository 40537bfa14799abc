#include "io/export/vtu_writer.h"

#include <algorithm>
#include <map>

namespace st {
namespace {

/// Bytes in base64, padded.
std::string base64(const unsigned char* data, std::size_t n) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((n + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t i = 0; i < n; i += 3, out += 4) {
    const std::size_t left = std::min<std::size_t>(3, n - i);
    const std::uint32_t bits = data[i] << 16 | (left > 1 ? data[i + 1] << 8 : 0) | (left > 2 ? data[i + 2] : 0);
    for (std::size_t k = 0; k <= left; ++k) out[k] = digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

void begin_vtu(Output& out) {
  out.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n");
}

void write_vtu_bytes(Output& out, const char* type, const std::string& name, int n_components, std::size_t n_tuples,
                     const void* values, std::size_t n_bytes) {
  const std::uint64_t announced = n_bytes;
  std::string bytes(sizeof announced, '\0');
  std::memcpy(bytes.data(), &announced, sizeof announced);
  bytes.append(static_cast<const char*>(values), n_bytes);
  out.text(std::string("<DataArray type=\"") + type + "\" Name=\"" + xml_escaped(name) +
           (n_components > 1 ? "\" NumberOfComponents=\"" + std::to_string(n_components) : "") +
           "\" NumberOfTuples=\"" + std::to_string(n_tuples) + "\" format=\"binary\">");
  out.text(base64(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  out.text("</DataArray>\n");
}

void write_vtu_names(Output& out, const std::string& what, const std::vector<std::string>& names) {
  std::map<std::string, std::vector<std::int32_t>> numbers;
  std::vector<std::string> order;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    const std::string name = clean_name(names[i], false);
    std::vector<std::int32_t>& of_name = numbers[name];
    if (of_name.empty()) order.push_back(name);
    of_name.push_back(static_cast<std::int32_t>(i) + 1);
  }
  for (const std::string& name : order) write_vtu_array(out, what + ":" + name, numbers[name]);
}

}  // namespace st
