// Gmsh's MSH 2.2 and 4.1, text and binary.
#include <algorithm>
#include <map>

#include "io/file/byte_cursor.h"
#include "io/foreign/triangulation_file.h"

namespace st {
namespace {

constexpr int kTriangle = 2;

/// Nodes of an element by type; 0: not known.
int n_nodes_of(int type) {
  static constexpr int n[] = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                              8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
  return type > 0 && type < static_cast<int>(std::size(n)) ? n[type] : 0;
}

/// Quadrangles and triangles with nodes on their sides.
bool is_other_surface_element(int type) {
  static constexpr int types[] = {3, 9, 10, 16, 20, 21, 22, 23, 24, 25};
  return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

class MshParser {
 public:
  MshParser(const std::string& path, const std::string& bytes) : in_(path, bytes) {}

  TriangulationFile run() {
    read_format();
    while (!in_.is_at_end()) {
      const std::string section(in_.word());
      if (section.empty() || section[0] != '$') in_.fail(ByteCursor::quoted(section) + " is no section");
      if (!is_binary_) in_.is_at_end();  // the rest of the line is blank
      if (is_binary_) in_.line();
      if (section == "$Nodes")
        version_ < 4 ? read_nodes_2() : read_nodes_4();
      else if (section == "$Elements")
        version_ < 4 ? read_elements_2() : read_elements_4();
      skip_to_end_of(section);
    }
    if (tags_.empty()) in_.fail("cut off: there is no $Nodes section");
    if (!has_elements_) in_.fail("cut off: there is no $Elements section");
    number_nodes();
    return std::move(result_);
  }

 private:
  void read_format() {
    in_.word();
    version_ = in_.real();
    if (version_ != 2.2 && version_ != 4.1)
      in_.fail("only MSH 2.2 and 4.1 are read (gmsh -format msh41); this is " + std::to_string(version_).substr(0, 3));
    is_binary_ = in_.integer() == 1;
    if (in_.integer() != 8) in_.fail("only 8 bytes per number are read");
    in_.line();
    if (is_binary_ && in_.value<std::int32_t>() != 1)
      in_.fail("written on a machine of another byte order; write it as text");
    in_.is_binary = is_binary_;
    skip_to_end_of("$MeshFormat");
  }

  void skip_to_end_of(const std::string& section) {
    std::string end("$End");
    end.append(section, 1);
    const std::size_t at = in_.bytes().find(end, in_.position());
    if (at == std::string_view::npos) in_.fail("cut off: " + end + " is missing");
    in_.seek(at + end.size());
  }

  std::int32_t int_value() { return is_binary_ ? in_.value<std::int32_t>() : static_cast<std::int32_t>(in_.integer()); }
  std::int64_t size_value() {
    return is_binary_ ? static_cast<std::int64_t>(in_.value<std::uint64_t>()) : in_.integer();
  }
  double real_value() { return is_binary_ ? in_.value<double>() : in_.real(); }
  Vec3 point() {
    const double x = real_value(), y = real_value(), z = real_value();
    return {x, y, z};
  }

  std::int64_t count_line() {
    const std::int64_t n = in_.integer();
    in_.line();
    return n;
  }

  void read_nodes_2() {
    const std::size_t n = in_.count(count_line(), is_binary_ ? 28 : 8, "nodes");
    for (std::size_t i = 0; i < n; ++i) {
      tags_.push_back(int_value());
      result_.node_xyz.push_back(point());
    }
  }

  void read_nodes_4() {
    const std::size_t n_blocks = in_.count(size_value(), 4, "blocks");
    for (int i = 0; i < 3; ++i) size_value();
    for (std::size_t b = 0; b < n_blocks; ++b) {
      const int dim = int_value();
      int_value();
      const bool is_parametric = int_value() != 0;
      const std::size_t n = in_.count(size_value(), is_binary_ ? 32 : 8, "nodes");
      for (std::size_t i = 0; i < n; ++i) tags_.push_back(size_value());
      for (std::size_t i = 0; i < n; ++i) {
        result_.node_xyz.push_back(point());
        for (int k = 0; is_parametric && k < dim; ++k) real_value();
      }
    }
  }

  int require_known(int type) {
    if (is_other_surface_element(type)) in_.fail("has quadrangles or curved triangles; write triangles of first order");
    const int n = n_nodes_of(type);
    if (n == 0) in_.fail("has elements of the unknown type " + std::to_string(type) + "; write triangles only");
    return n;
  }

  /// Nodes of one element; kept when it is a triangle.
  template <class Read>
  void read_element_nodes(int type, int n, std::int64_t surface, const Read& read) {
    std::array<std::int64_t, 3> t{};
    for (int k = 0; k < n; ++k) {
      const std::int64_t node = read();
      if (type == kTriangle) t[k] = node;
    }
    if (type != kTriangle) return;
    result_.triangles.push_back(t);
    result_.surface.push_back(surface);
  }

  void read_elements_2() {
    has_elements_ = true;
    const std::size_t n = in_.count(count_line(), 4, "elements");
    const auto node = [&]() -> std::int64_t { return int_value(); };
    for (std::size_t i = 0; i < n;) {
      if (!is_binary_) int_value();  // number
      const int type = int_value();
      const std::size_t n_alike = is_binary_ ? in_.count(int_value(), 4, "elements") : 1;
      if (n_alike == 0 || n_alike > n - i) in_.fail("a block of elements has another number of them than announced");
      const int n_tags = int_value(), n_nodes = require_known(type);
      if (n_tags < 0 || n_tags > 1000) in_.fail("an element has " + std::to_string(n_tags) + " tags");
      for (std::size_t k = 0; k < n_alike; ++k, ++i) {
        if (is_binary_) int_value();
        std::int64_t surface = 0;
        for (int tag = 0; tag < n_tags; ++tag) {
          const std::int32_t value = int_value();
          if (tag == 1) surface = value;
        }
        read_element_nodes(type, n_nodes, surface, node);
      }
    }
  }

  void read_elements_4() {
    has_elements_ = true;
    const std::size_t n_blocks = in_.count(size_value(), 4, "blocks");
    for (int i = 0; i < 3; ++i) size_value();
    for (std::size_t b = 0; b < n_blocks; ++b) {
      int_value();
      const std::int32_t entity = int_value();
      const int type = int_value(), n_nodes = require_known(type);
      const std::size_t n = in_.count(size_value(), is_binary_ ? 8 * (1 + n_nodes) : 2, "elements");
      for (std::size_t i = 0; i < n; ++i) {
        size_value();
        read_element_nodes(type, n_nodes, entity, [&] { return size_value(); });
      }
    }
  }

  /// From the file's own numbers to places in the arrays.
  void number_nodes() {
    std::vector<std::pair<std::int64_t, std::int64_t>> place;
    for (std::size_t i = 0; i < tags_.size(); ++i) place.push_back({tags_[i], static_cast<std::int64_t>(i)});
    std::sort(place.begin(), place.end());
    for (std::size_t i = 1; i < place.size(); ++i)
      if (place[i].first == place[i - 1].first)
        in_.fail("has two nodes of the number " + std::to_string(place[i].first));
    const std::int64_t first = place.front().first;
    for (auto& t : result_.triangles)
      for (std::int64_t& n : t) {
        const std::int64_t tag = n;
        auto at = place.begin() + std::clamp<std::int64_t>(tag - first, 0, static_cast<std::int64_t>(place.size()) - 1);
        if (at->first != tag) at = std::lower_bound(place.begin(), place.end(), std::pair(tag, std::int64_t{0}));
        if (at == place.end() || at->first != tag)
          in_.fail("a triangle names node " + std::to_string(tag) + ", which does not exist");
        n = at->second;
      }
  }

  ByteCursor in_;
  double version_ = 0;
  bool is_binary_ = false, has_elements_ = false;
  std::vector<std::int64_t> tags_;
  TriangulationFile result_;
};

}  // namespace

TriangulationFile parse_msh(const std::string& path, const std::string& bytes) { return MshParser(path, bytes).run(); }

}  // namespace st
