// VTK's XML UnstructuredGrid: ascii, base64 and appended arrays, plain or compressed by zlib.
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <type_traits>

#include "io/file/byte_cursor.h"
#include "io/foreign/cell_file.h"
#include "io/foreign/triangulation_file.h"

namespace st {
namespace {

/// Value of an attribute of an XML tag; empty: none.
std::string attribute(std::string_view tag, const std::string& key) {
  for (std::size_t at = tag.find(key + "=\""); at != std::string_view::npos; at = tag.find(key + "=\"", at + 1)) {
    if (at > 0 && !ByteCursor::is_blank(tag[at - 1])) continue;
    const std::size_t begin = at + key.size() + 2, end = tag.find('"', begin);
    return std::string(tag.substr(begin, end == std::string_view::npos ? end : end - begin));
  }
  return "";
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Up to `n_wanted` bytes of one or several base64 streams, one behind the other.
std::string decode_base64(std::string_view text, std::size_t n_wanted) {
  std::string bytes;
  int n_digits = 0, n_padding = 0;
  std::uint32_t group = 0;
  for (const char c : text) {
    if (bytes.size() >= n_wanted) break;
    if (ByteCursor::is_blank(c)) continue;
    const int digit = c == '=' ? 0 : base64_digit(c);
    if (digit < 0) break;
    n_padding += c == '=';
    group = group << 6 | static_cast<std::uint32_t>(digit);
    if (++n_digits < 4) continue;
    for (int k = 0; k < 3 - n_padding; ++k) bytes.push_back(static_cast<char>(group >> (16 - 8 * k) & 255));
    n_digits = n_padding = 0, group = 0;
  }
  return bytes;
}

class VtuParser {
 public:
  VtuParser(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  TriangulationFile run() {
    TriangulationFile result = read_nodes();
    read_cells(result);
    if (const auto size = find("PointData", "size")) result.node_size = values<double>(*size, n_nodes_);
    return result;
  }

  CellFile cells(const std::string& array) {
    TriangulationFile nodes = read_nodes();
    CellFile result;
    result.node_xyz = std::move(nodes.node_xyz);
    result.type = values<std::int64_t>(require("Cells", "types"), n_cells_);
    result.offset = values<std::int64_t>(require("Cells", "offsets"), n_cells_);
    result.offset.insert(result.offset.begin(), 0);
    result.node = all_values<std::int64_t>(require("Cells", "connectivity"));
    for (std::size_t c = 0; c < n_cells_; ++c)
      if (result.offset[c + 1] < result.offset[c] ||
          static_cast<std::size_t>(result.offset[c + 1]) > result.node.size())
        fail("cell " + std::to_string(c) + " has offsets that do not fit");
    const auto of_cells = array.empty() || find("PointData", array) ? std::nullopt : find("CellData", array);
    (of_cells ? result.cell_value : result.value) = all_values<double>(of_cells ? *of_cells : size_array(array));
    if (const auto group = find("CellData", kGroups)) result.group = values<std::int32_t>(*group, n_cells_);
    add_group_names(result);
    return result;
  }

  std::vector<double> point_array(const std::string& name) {
    read_head();
    const auto array = find("PointData", name);
    if (!array) fail("array '" + name + "' is not among the point data" + arrays_there(names({"PointData"})));
    return all_values<double>(*array);
  }

 private:
  struct Array {
    std::string_view tag, body;  ///< body: up to the next tag
  };

  [[noreturn]] void fail(const std::string& what) const { throw Error(ExitCode::kInput, path_ + ": " + what); }

  void read_head() {
    const std::size_t at = bytes_.find("<VTKFile");
    const std::size_t end = at == std::string::npos ? at : bytes_.find('>', at);
    if (end == std::string::npos) fail("an XML file, but none of VTK's; give a .vtu file");
    head_ = bytes_.substr(at, end - at);
    if (attribute(head_, "type") != "UnstructuredGrid")
      fail("holds VTK's " + attribute(head_, "type") + "; an UnstructuredGrid (.vtu) is expected");
    header_bytes_ = attribute(head_, "header_type") == "UInt64" ? 8 : 4;
    compressor_ = attribute(head_, "compressor");
    const std::size_t appended = bytes_.find("<AppendedData", end);
    xml_ = bytes_.substr(0, appended);
    if (appended == std::string::npos) {
      if (bytes_.find("</VTKFile", end) == std::string::npos)
        fail("cut off: </VTKFile> is missing; write the file again");
      return;
    }
    const std::size_t open = bytes_.find('>', appended),
                      start = open == std::string::npos ? open : bytes_.find('_', open);
    if (start == std::string::npos) fail("cut off: its appended data are missing; write the file again");
    appended_is_base64_ = attribute(bytes_.substr(appended, open - appended), "encoding") == "base64";
    appended_ = bytes_.substr(start + 1);
  }

  std::string_view find_piece() const {
    const std::size_t at = xml_.find("<Piece");
    if (at == std::string_view::npos) fail("cut off: there is no piece of a mesh in it");
    if (xml_.find("<Piece", at + 1) != std::string_view::npos)
      fail("has several pieces; merge them (ParaView: Merge Blocks) and write one");
    return xml_.substr(at, xml_.find('>', at) - at);
  }

  std::size_t count_of(std::string_view piece, const char* name) const {
    std::uint64_t n = 0;
    const std::string text = attribute(piece, name);
    if (std::from_chars(text.data(), text.data() + text.size(), n).ec != std::errc() || n > 2000000000)
      fail(std::string(name) + " '" + text + "' is no number of them");
    return n;
  }

  /// Calls `use(array)` for the arrays of a section until it returns true.
  template <class Use>
  void walk(const std::string& section, const Use& use) const {
    std::size_t at = xml_.find("<" + section);
    while (at != std::string_view::npos && at + 1 + section.size() < xml_.size() &&
           !ByteCursor::is_blank(xml_[at + 1 + section.size()]) && xml_[at + 1 + section.size()] != '>' &&
           xml_[at + 1 + section.size()] != '/')
      at = xml_.find("<" + section, at + 1);
    if (at == std::string_view::npos) return;
    const std::size_t end = std::min(xml_.find("</" + section, at), xml_.size());
    while ((at = xml_.find("<DataArray", at)) < end) {
      const std::size_t close = xml_.find('>', at);
      if (close >= end) return;
      if (use(Array{xml_.substr(at, close - at), xml_.substr(close + 1, xml_.find('<', close) - close - 1)})) return;
      at = close;
    }
  }

  /// The array of a section; without a name its first.
  std::optional<Array> find(const std::string& section, const std::string& name) const {
    std::optional<Array> found;
    walk(section, [&](const Array& array) {
      if (name.empty() || attribute(array.tag, "Name") == name) found = array;
      return found.has_value();
    });
    return found;
  }
  std::vector<std::string> names(std::initializer_list<const char*> sections) const {
    std::vector<std::string> all;
    for (const char* section : sections)
      walk(section, [&](const Array& array) {
        all.push_back(attribute(array.tag, "Name"));
        return false;
      });
    return all;
  }
  Array require(const std::string& section, const std::string& name) const {
    const auto array = find(section, name);
    if (!array) fail("cut off: there is no array " + (name.empty() ? section : "'" + name + "' in " + section));
    return *array;
  }

  /// Exactly `n` values of an array, converted.
  template <class Value>
  std::vector<Value> values(const Array& array, std::size_t n) const {
    std::vector<Value> result = all_values<Value>(array);
    if (result.size() != n)
      fail("cut off: array '" + attribute(array.tag, "Name") + "' has " + std::to_string(result.size()) +
           " values instead of " + std::to_string(n));
    return result;
  }

  template <class Value>
  std::vector<Value> all_values(const Array& array) const {
    const std::string format = attribute(array.tag, "format"), type = attribute(array.tag, "type"),
                      name = attribute(array.tag, "Name");
    std::vector<Value> result;
    if (format == "ascii") {
      ByteCursor in(path_, array.body);
      in.is_binary = true;
      while (!in.is_at_end()) result.push_back(converted<Value>(in.real(), name));
    } else if (type == "Float64") {
      result = convert<Value, double>(binary(array, format), name);
    } else if (type == "Float32") {
      result = convert<Value, float>(binary(array, format), name);
    } else if (type == "Int64" || type == "UInt64") {
      result = convert<Value, std::int64_t>(binary(array, format), name);
    } else if (type == "Int32" || type == "UInt32") {
      result = convert<Value, std::int32_t>(binary(array, format), name);
    } else if (type == "UInt8" || type == "Int8") {
      result = convert<Value, std::uint8_t>(binary(array, format), name);
    } else {
      fail("array '" + name + "' has the type '" + type + "', which is not read");
    }
    return result;
  }

  /// A value of the array `name`, which may have to be an integer.
  template <class Value, class Stored>
  Value converted(Stored value, const std::string& name) const {
    if constexpr (std::is_integral_v<Value> && std::is_floating_point_v<Stored>)
      if (!(std::abs(value) < 9e15) || value != std::trunc(value))
        fail("damaged: array '" + name + "' has the value " + std::to_string(value) + ", which is no integer");
    return static_cast<Value>(value);
  }

  template <class Value, class Stored>
  std::vector<Value> convert(const std::string& bytes, const std::string& name) const {
    std::vector<Value> result(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < result.size(); ++i) {
      Stored v;
      std::memcpy(&v, bytes.data() + i * sizeof v, sizeof v);
      result[i] = converted<Value>(v, name);
    }
    return result;
  }

  /// The bytes of an array that is not ascii.
  std::string binary(const Array& array, const std::string& format) const {
    if (attribute(head_, "byte_order") == "BigEndian")
      fail("written on a machine of another byte order; write it as ascii");
    if (!compressor_.empty() && compressor_ != "vtkZLibDataCompressor")
      fail("compressed by " + compressor_ + "; compress by zlib or not at all");
    std::string_view text = array.body;
    bool is_base64 = true;
    if (format == "appended") {
      const std::uint64_t offset = std::strtoull(attribute(array.tag, "offset").c_str(), nullptr, 10);
      if (offset > appended_.size()) fail("cut off: array '" + attribute(array.tag, "Name") + "' is missing");
      text = appended_.substr(offset);
      is_base64 = appended_is_base64_;
    } else if (format != "binary") {
      fail("array '" + attribute(array.tag, "Name") + "' is written as '" + format + "', which is not read");
    }
    const auto first_bytes = [&](std::size_t n) {
      std::string head = is_base64 ? decode_base64(text, n) : std::string(text.substr(0, n));
      if (head.size() < n)
        fail("cut off: array '" + attribute(array.tag, "Name") + "' is not complete; write the file again");
      return head;
    };
    const auto number = [&](const std::string& bytes, std::size_t i) {
      std::uint64_t n = 0;
      std::memcpy(&n, bytes.data() + i * header_bytes_, header_bytes_);
      return n;
    };
    const std::uint64_t n = number(first_bytes(header_bytes_), 0);
    if (n > bytes_.size())
      fail("cut off: array '" + attribute(array.tag, "Name") + "' is not complete; write the file again");
    if (compressor_.empty()) {
      std::string values = first_bytes(header_bytes_ + n);
      values.erase(0, header_bytes_);
      return values;
    }
    const std::string head = first_bytes((3 + n) * header_bytes_);  // blocks, bytes of each, of the last, compressed
                                                                    // bytes of each
    std::uint64_t total = head.size();
    for (std::uint64_t b = 0; b < n; ++b) {
      if (number(head, 3 + b) > bytes_.size())
        fail("damaged: array '" + attribute(array.tag, "Name") + "'; write the file again");
      total += number(head, 3 + b);
    }
    return inflate(first_bytes(total), n, number(head, 1), number(head, 2), number, head.size());
  }

  template <class Number>
  std::string inflate(const std::string& bytes, std::uint64_t n_blocks, std::uint64_t size, std::uint64_t last,
                      const Number& number, std::size_t at) const {
    constexpr std::uint64_t kBestRatio = 1100;  // zlib compresses no better
    std::string result;
    for (std::uint64_t b = 0; b < n_blocks; ++b) {
      const std::uint64_t n_in = number(bytes, 3 + b), n_out = b + 1 == n_blocks && last > 0 ? last : size;
      std::string block(n_out <= kBestRatio * (n_in + 1) ? n_out : 0, '\0');
      uLongf n = block.size();
      if (uncompress(reinterpret_cast<Bytef*>(block.data()), &n, reinterpret_cast<const Bytef*>(bytes.data() + at),
                     n_in) != Z_OK ||
          n != n_out)
        fail("damaged: compressed data cannot be expanded; write the file again");
      result += block;
      at += n_in;
    }
    return result;
  }

  /// Finds the piece; its nodes alone.
  TriangulationFile read_nodes() {
    read_head();
    const std::string_view piece = find_piece();
    n_nodes_ = count_of(piece, "NumberOfPoints");
    n_cells_ = count_of(piece, "NumberOfCells");
    TriangulationFile result;
    const std::vector<double> xyz = values<double>(require("Points", ""), 3 * n_nodes_);
    for (std::size_t i = 0; i < n_nodes_; ++i) result.node_xyz.push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
    return result;
  }

  /// As st-export writes them: an array in the field data for each.
  void add_group_names(CellFile& result) const {
    const std::string before = std::string("Name=\"") + kGroups + ":";
    for (std::size_t at = xml_.find(before); at != std::string_view::npos; at = xml_.find(before, at)) {
      at += before.size();
      const std::string name(xml_.substr(at, xml_.find('"', at) - at));
      if (const auto array = find("FieldData", std::string(kGroups) + ":" + name))
        result.group_name.emplace_back(name, values<std::int32_t>(*array, 1)[0]);
    }
  }
  /// The array of lengths or metrics: of this name, or one of the usual.
  Array size_array(const std::string& name) const {
    std::optional<Array> array;
    for (const char* usual : kUsualSizes)
      if (!array) array = find("PointData", name.empty() ? usual : name);
    if (!array) fail(missing_sizes(name, names({"PointData", "CellData"})));
    return *array;
  }

  void read_cells(TriangulationFile& result) const {
    constexpr int kTriangle = 5, kQuadrangle = 9, kPixel = 8, kPolygon = 7, kStrip = 6, kCurved = 22;
    const std::vector<std::int64_t> offsets = values<std::int64_t>(require("Cells", "offsets"), n_cells_);
    const std::vector<std::int64_t> types = values<std::int64_t>(require("Cells", "types"), n_cells_);
    const std::size_t n_corners =
        n_cells_ ? static_cast<std::size_t>(std::clamp<std::int64_t>(offsets.back(), 0, 2000000000)) : 0;
    const std::vector<std::int64_t> nodes = values<std::int64_t>(require("Cells", "connectivity"), n_corners);
    std::vector<std::int64_t> face;
    if (const auto array = find("CellData", "face")) face = values<std::int64_t>(*array, n_cells_);
    for (std::size_t c = 0; c < n_cells_; ++c) {
      const std::int64_t begin = c ? offsets[c - 1] : 0, end = offsets[c];
      for (const int type : {kQuadrangle, kPixel, kPolygon, kStrip, kCurved})
        if (types[c] == type)
          fail("cell " + std::to_string(c) + " is no triangle; triangulate the mesh (ParaView: Triangulate)");
      if (types[c] != kTriangle) continue;
      if (begin < 0 || end != begin + 3 || static_cast<std::size_t>(end) > nodes.size())
        fail("cell " + std::to_string(c) + " has offsets that do not fit");
      result.triangles.push_back({nodes[begin], nodes[begin + 1], nodes[begin + 2]});
      if (!face.empty()) result.surface.push_back(face[c]);
    }
  }

  const std::string& path_;
  const std::string_view bytes_;
  std::string_view head_, xml_, appended_;
  std::string compressor_;
  std::size_t header_bytes_ = 4, n_nodes_ = 0, n_cells_ = 0;
  bool appended_is_base64_ = false;
};

}  // namespace

TriangulationFile parse_vtu(const std::string& path, const std::string& bytes) { return VtuParser(path, bytes).run(); }

CellFile parse_vtu_cells(const std::string& path, std::string_view bytes, const std::string& array) {
  return VtuParser(path, bytes).cells(array);
}

std::vector<double> parse_vtu_point_array(const std::string& path, const std::string& bytes, const std::string& name) {
  return VtuParser(path, bytes).point_array(name);
}

}  // namespace st
