// Gmsh's MSH 2.2 and 4.1, text and binary: surfaces, and meshes with values at their nodes.
#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "io/file/byte_cursor.h"
#include "io/foreign/cell_file.h"
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

/// VTK's type of the straight cell with the same corners; 0: points, lines and what else has no such cell.
std::int64_t vtk_type_of(int type) {
  static constexpr int types[] = {0, 0,  5,  9,  10, 12, 13, 14, 0, 5, 9, 10, 12, 13, 14, 0,
                                  9, 12, 13, 14, 5,  5,  5,  5,  5, 5, 0, 0,  0,  10, 10, 10};
  return type > 0 && type < static_cast<int>(std::size(types)) ? types[type] : 0;
}

/// The sections that all readers need. What becomes of elements and values is for them to say.
class MshParser {
 public:
  MshParser(const std::string& path, std::string_view bytes) : in_(path, bytes) {}
  MshParser(const MshParser&) = delete;
  MshParser& operator=(const MshParser&) = delete;

 protected:
  virtual ~MshParser() = default;
  /// Fails for types that cannot be read.
  virtual void require_readable(int) {}
  virtual bool keeps(int type) const = 0;
  /// An element by its number, the surface or volume that it is of, and its nodes by their numbers in the file.
  virtual void add(int type, std::int64_t number, std::int64_t entity, std::span<const std::int64_t> nodes) = 0;
  /// `section`: "$NodeData", "$ElementData" or "$ElementNodeData".
  virtual void read_view(const std::string& /*section*/) {}

  void read() {
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
      else if (section == "$NodeData" || section == "$ElementData" || section == "$ElementNodeData")
        read_view(section);
      skip_to_end_of(section);
    }
    if (tags_.empty()) in_.fail("cut off: there is no $Nodes section");
    if (!has_elements_) in_.fail("cut off: there is no $Elements section");
    sort_numbers();
  }

  /// Place in node_xyz_ of a number in the file, from read() on. Nearly all are without gaps.
  std::int64_t place_of(std::int64_t number, const char* what) const {
    const std::int64_t last = static_cast<std::int64_t>(place_.size()) - 1;
    auto at = place_.begin() + std::clamp<std::int64_t>(number - place_.front().first, 0, last);
    if (at->first != number) at = std::lower_bound(place_.begin(), place_.end(), std::pair(number, std::int64_t{0}));
    if (at == place_.end() || at->first != number)
      in_.fail(std::string(what) + " names node " + std::to_string(number) + ", which does not exist");
    return at->second;
  }

  std::int32_t int_value() { return is_binary_ ? in_.value<std::int32_t>() : static_cast<std::int32_t>(in_.integer()); }
  double real_value() { return is_binary_ ? in_.value<double>() : in_.real(); }
  std::int64_t count_line() {
    const std::int64_t n = in_.integer();
    in_.line();
    return n;
  }
  bool is_binary() const { return is_binary_; }

  ByteCursor in_;
  std::vector<Vec3> node_xyz_;

 private:
  void read_format() {
    in_.word();
    version_ = in_.real();
    const bool is_2 = version_ >= 2 && version_ <= 2.2;  // of one form, but for partitions, which nobody asks for
    if (!is_2 && version_ != 4.1)
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

  std::int64_t size_value() {
    return is_binary_ ? static_cast<std::int64_t>(in_.value<std::uint64_t>()) : in_.integer();
  }
  Vec3 point() {
    const double x = real_value(), y = real_value(), z = real_value();
    return {x, y, z};
  }

  void read_nodes_2() {
    const std::size_t n = in_.count(count_line(), is_binary_ ? 28 : 8, "nodes");
    for (std::size_t i = 0; i < n; ++i) {
      tags_.push_back(int_value());
      node_xyz_.push_back(point());
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
        node_xyz_.push_back(point());
        for (int k = 0; is_parametric && k < dim; ++k) real_value();
      }
    }
  }

  int require_known(int type) {
    require_readable(type);
    const int n = n_nodes_of(type);
    if (n == 0) in_.fail("has elements of the unknown type " + std::to_string(type) + "; write triangles only");
    return n;
  }

  /// Nodes of one element; kept where the reader wants it.
  template <class Read>
  void read_element_nodes(int type, int n, std::int64_t number, std::int64_t entity, const Read& read) {
    element_.clear();
    for (int k = 0; k < n; ++k) element_.push_back(read());
    if (keeps(type)) add(type, number, entity, element_);
  }

  void read_elements_2() {
    has_elements_ = true;
    const std::size_t n = in_.count(count_line(), 4, "elements");
    const auto node = [&]() -> std::int64_t { return int_value(); };
    for (std::size_t i = 0; i < n;) {
      std::int64_t number = is_binary_ ? 0 : int_value();
      const int type = int_value();
      const std::size_t n_alike = is_binary_ ? in_.count(int_value(), 4, "elements") : 1;
      if (n_alike == 0 || n_alike > n - i) in_.fail("a block of elements has another number of them than announced");
      const int n_tags = int_value(), n_nodes = require_known(type);
      if (n_tags < 0 || n_tags > 1000) in_.fail("an element has " + std::to_string(n_tags) + " tags");
      for (std::size_t k = 0; k < n_alike; ++k, ++i) {
        if (is_binary_) number = int_value();
        std::int64_t surface = 0;
        for (int tag = 0; tag < n_tags; ++tag) {
          const std::int32_t value = int_value();
          if (tag == 1) surface = value;
        }
        read_element_nodes(type, n_nodes, number, surface, node);
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
        const std::int64_t number = size_value();
        read_element_nodes(type, n_nodes, number, entity, [&] { return size_value(); });
      }
    }
  }

  void sort_numbers() {
    for (std::size_t i = 0; i < tags_.size(); ++i) place_.push_back({tags_[i], static_cast<std::int64_t>(i)});
    std::sort(place_.begin(), place_.end());
    for (std::size_t i = 1; i < place_.size(); ++i)
      if (place_[i].first == place_[i - 1].first)
        in_.fail("has two nodes of the number " + std::to_string(place_[i].first));
  }

  double version_ = 0;
  bool is_binary_ = false, has_elements_ = false;
  std::vector<std::int64_t> tags_, element_;
  std::vector<std::pair<std::int64_t, std::int64_t>> place_;  // [n_nodes] number in the file, place; ascending
};

class TriangleParser final : public MshParser {
 public:
  using MshParser::MshParser;

  TriangulationFile run() {
    read();
    for (auto& t : result_.triangles)
      for (std::int64_t& n : t) n = place_of(n, "a triangle");
    result_.node_xyz = std::move(node_xyz_);
    return std::move(result_);
  }

 private:
  void require_readable(int type) override {
    if (is_other_surface_element(type)) in_.fail("has quadrangles or curved triangles; write triangles of first order");
  }
  bool keeps(int type) const override { return type == kTriangle; }
  void add(int, std::int64_t, std::int64_t entity, std::span<const std::int64_t> nodes) override {
    result_.triangles.push_back({nodes[0], nodes[1], nodes[2]});
    result_.surface.push_back(entity);
  }

  TriangulationFile result_;
};

/// Cells and one of the views at their nodes.
class ViewParser final : public MshParser {
 public:
  ViewParser(const std::string& path, std::string_view bytes, const std::string& view)
      : MshParser(path, bytes), view_(view) {}

  CellFile run() {
    file_.offset = {0};
    read();
    if (n_components_ == 0) in_.fail(missing_view());
    for (std::int64_t& n : file_.node) n = place_of(n, "an element");
    file_.value.assign(n_components_ * node_xyz_.size(), std::numeric_limits<double>::quiet_NaN());
    section_ == "$NodeData" ? place_values() : average_elements();
    file_.node_xyz = std::move(node_xyz_);
    return std::move(file_);
  }

 private:
  bool keeps(int type) const override { return vtk_type_of(type) != 0; }
  /// The corners stand first.
  void add(int type, std::int64_t number, std::int64_t, std::span<const std::int64_t> nodes) override {
    number_.push_back(number);
    file_.type.push_back(vtk_type_of(type));
    const int n = n_corners_of(file_.type.back());
    file_.node.insert(file_.node.end(), nodes.begin(), nodes.begin() + n);
    file_.offset.push_back(static_cast<std::int64_t>(file_.node.size()));
  }

  void place_values() {
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      const auto to = static_cast<std::size_t>(place_of(tags_[i], "$NodeData")) * n_components_;
      std::copy_n(values_.data() + first_[i], n_components_, file_.value.data() + to);
    }
  }

  /// Nodes get the mean of what the cells around them have there, volumes alone where there are some.
  void average_elements() {
    const bool has_volume = std::any_of(file_.type.begin(), file_.type.end(), is_volume);
    std::vector<std::pair<std::int64_t, std::size_t>> cell_of;
    for (std::size_t c = 0; c < number_.size(); ++c)
      if (is_volume(file_.type[c]) == has_volume) cell_of.emplace_back(number_[c], c);
    std::sort(cell_of.begin(), cell_of.end());
    std::vector<double> n_values(node_xyz_.size(), 0);
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      const auto at = std::lower_bound(cell_of.begin(), cell_of.end(), std::pair(tags_[i], std::size_t{0}));
      if (at == cell_of.end() || at->first != tags_[i]) continue;
      const auto begin = file_.offset[at->second], n_corners = file_.offset[at->second + 1] - begin;
      const std::size_t n = (i + 1 < tags_.size() ? first_[i + 1] : values_.size()) - first_[i];
      const bool is_alike = section_ == "$ElementData";
      if (!is_alike && n < static_cast<std::size_t>(n_corners) * n_components_)
        in_.fail("element " + std::to_string(tags_[i]) + " has too few values");
      for (std::int64_t k = 0; k < n_corners; ++k)
        add_to_mean(static_cast<std::size_t>(file_.node[begin + k]),
                    values_.data() + first_[i] + (is_alike ? 0 : static_cast<std::size_t>(k) * n_components_),
                    n_values);
    }
  }
  void add_to_mean(std::size_t node, const double* v, std::vector<double>& n_values) {
    const double n = n_values[node] += 1;
    double* const mean = file_.value.data() + node * n_components_;
    for (std::size_t k = 0; k < n_components_; ++k) mean[k] = n > 1 ? mean[k] + (v[k] - mean[k]) / n : v[k];
  }

  /// Names, times, then step, number of components, number of entries: a count, then as many lines.
  void read_view(const std::string& section) override {
    std::string name;
    for (std::int64_t i = 0, n = count_line(); i < n; ++i) {
      std::string text(in_.line());
      std::erase_if(text, [](char c) { return c == '"' || c == '\r'; });
      if (i == 0) name = text;
    }
    for (std::int64_t i = 0, n = count_line(); i < n; ++i) in_.line();
    std::array<std::int64_t, 3> numbers{};
    for (std::int64_t i = 0, n = count_line(); i < n; ++i) {
      const std::int64_t value = count_line();
      if (i < 3) numbers[static_cast<std::size_t>(i)] = value;
    }
    names_ += (names_.empty() ? "'" : ", '") + name + "'";
    if (n_components_ > 0 || (!view_.empty() && name != view_)) return;
    if (numbers[1] != 1 && numbers[1] != 9)
      in_.fail(section + " '" + name + "' has " + std::to_string(numbers[1]) +
               " components; a length per node, or the nine components of a metric are expected");
    section_ = section;
    n_components_ = static_cast<std::size_t>(numbers[1]);
    const std::size_t n = in_.count(numbers[2], is_binary() ? 4 + 8 * n_components_ : 2 + 2 * n_components_, "values");
    for (std::size_t i = 0; i < n; ++i) {
      tags_.push_back(int_value());
      first_.push_back(values_.size());
      const std::int64_t n_each = section == "$ElementNodeData" ? int_value() : 1;
      const std::size_t n_values = in_.count(n_each, 2 * n_components_, "values of an element") * n_components_;
      for (std::size_t k = 0; k < n_values; ++k) values_.push_back(real_value());
    }
  }

  std::string missing_view() const {
    if (names_.empty()) return "has no $NodeData; write a view of lengths or metrics at nodes";
    return "has no $NodeData '" + view_ + "'; there are " + names_;
  }

  const std::string& view_;
  std::string names_;  // of all views, for messages
  std::size_t n_components_ = 0;
  std::string section_;               // of the view that is taken
  std::vector<std::int64_t> tags_;    // numbers of its nodes or elements
  std::vector<std::size_t> first_;    // [tags] into values_
  std::vector<double> values_;        // n_components for a node or an element, or for each node of an element
  std::vector<std::int64_t> number_;  // [n_cells]
  CellFile file_;
};

}  // namespace

TriangulationFile parse_msh(const std::string& path, const std::string& bytes) {
  return TriangleParser(path, bytes).run();
}

CellFile parse_msh_cells(const std::string& path, std::string_view bytes, const std::string& view) {
  return ViewParser(path, bytes, view).run();
}

}  // namespace st
