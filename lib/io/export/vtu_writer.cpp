#include "io/export/vtu_writer.h"

#include <map>
#include <span>

#include "base/base64.h"

namespace st {

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
  out.text(base64(std::as_bytes(std::span(bytes))));
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
