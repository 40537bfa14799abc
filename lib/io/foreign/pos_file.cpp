// Parsed views of Gmsh (.pos): cells with their corners and values, written out one by one.
#include <algorithm>
#include <charconv>
#include <numeric>
#include <string_view>
#include <tuple>

#include "base/error.h"
#include "io/foreign/cell_file.h"

namespace st {
namespace {

constexpr std::int64_t kVertex = 1;  ///< VTK's type of what has no corners for n_corners_of()

/// VTK's type, by the second letter of a cell; kVertex for points and lines, which are passed over.
std::int64_t type_of(char letter) {
  switch (letter) {
    case 'T':
      return 5;
    case 'Q':
      return 9;
    case 'S':
      return 10;
    case 'H':
      return 12;
    case 'I':
      return 13;
    case 'Y':
      return 14;
    default:
      return kVertex;
  }
}

class PosReader {
 public:
  PosReader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  CellFile read() {
    if (word() != "View") fail("no parsed view of Gmsh: it does not begin with 'View'");
    at_ = text_.find('{', at_);
    if (at_ == std::string_view::npos) fail("the view has no '{'");
    ++at_;
    file_.offset = {0};
    for (skip_space(); at_ < text_.size() && text_[at_] != '}'; skip_space()) read_entry();
    if (at_ >= text_.size()) fail("the view has no end");
    if (file_.type.empty()) fail("the view has no cells with a length or a metric (ST, SQ, SS, SH, SI, SY, TT, ...)");
    unite_nodes();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const std::string_view before = text_.substr(0, std::min(at_, text_.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    throw Error(ExitCode::kInput, path_ + ":" + std::to_string(line) + ": " + what);
  }

  void skip_space() {
    for (; at_ < text_.size(); ++at_) {
      if (text_.substr(at_, 2) == "//")
        at_ = std::min(text_.find('\n', at_), text_.size() - 1);
      else if (text_.substr(at_, 2) == "/*")
        at_ = std::min(text_.find("*/", at_), text_.size() - 2) + 1;
      else if (std::string_view(" \t\r\n;").find(text_[at_]) == std::string_view::npos)
        return;
    }
  }
  std::string_view word() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// The numbers between two brackets.
  void read_list(char open, char close, std::vector<double>& numbers) {
    numbers.clear();
    skip_space();
    if (at_ >= text_.size() || text_[at_] != open) fail(std::string("'") + open + "' expected");
    for (++at_;; ++at_) {
      skip_space();
      if (at_ < text_.size() && text_[at_] == close && numbers.empty()) break;
      double value = 0;
      at_ += at_ < text_.size() && text_[at_] == '+';
      const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
      if (error != std::errc()) fail("a number expected");
      numbers.push_back(value);
      at_ = static_cast<std::size_t>(end - text_.data());
      skip_space();
      if (at_ >= text_.size() || (text_[at_] != ',' && text_[at_] != close)) fail("',' between numbers expected");
      if (text_[at_] == close) break;
    }
    ++at_;
  }

  /// A cell and its values, or what is passed over: points, lines, texts, time values.
  void read_entry() {
    const std::string_view name = word();
    if (name.empty()) fail("the name of a cell expected, such as SS");
    const bool is_cell = name.size() == 2 && std::string_view("SVT").find(name[0]) != std::string_view::npos;
    const std::int64_t type = is_cell ? type_of(name[1]) : kVertex;
    const auto n_corners = static_cast<std::size_t>(n_corners_of(type));
    if (n_corners == 0) return pass_over(name);
    if (name[0] == 'V') fail("vectors are no lengths: scalars (S) or metrics (T) are read");
    read_list('(', ')', place_);
    read_list('{', '}', value_);
    const std::size_t n_components = name[0] == 'S' ? 1 : 9;
    if (n_components_ == 0) n_components_ = n_components;
    if (n_components != n_components_) fail("lengths and metrics in one view");
    if (place_.size() != 3 * n_corners) fail("a cell has the wrong number of coordinates");
    if (value_.size() < n_components * n_corners) fail("a cell has too few values");
    for (std::size_t c = 0; c < n_corners; ++c) {
      file_.node.push_back(static_cast<std::int64_t>(file_.node_xyz.size()));
      file_.node_xyz.push_back({place_[3 * c], place_[3 * c + 1], place_[3 * c + 2]});
    }
    const auto end = value_.begin() + static_cast<std::ptrdiff_t>(n_components * n_corners);  // of the first step
    file_.value.insert(file_.value.end(), value_.begin(), end);
    file_.type.push_back(type);
    file_.offset.push_back(static_cast<std::int64_t>(file_.node.size()));
  }

  void pass_over(std::string_view name) {
    if (name.size() == 3 && name[2] == '2') fail("curved cells are not read");
    const std::size_t end = text_.find(';', at_);
    if (end == std::string_view::npos) fail("';' expected");
    at_ = end;
  }

  /// Corners at one place become one node; the value that stands first counts.
  void unite_nodes() {
    const std::vector<Vec3> all = std::move(file_.node_xyz);
    const std::vector<double> values = std::move(file_.value);
    std::vector<std::int64_t> order(all.size()), number(all.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::int64_t i) {
      const Vec3 x = all[static_cast<std::size_t>(i)];
      return std::tuple(x.x, x.y, x.z, i);
    };
    std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_same = i > 0 && all[order[i]] == all[order[i - 1]];
      number[order[i]] = is_same ? number[order[i - 1]] : order[i];
    }
    file_.node_xyz.clear();
    file_.value.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto first = static_cast<std::size_t>(number[i]);
      if (first < i) {
        number[i] = number[first];
        continue;
      }
      number[i] = static_cast<std::int64_t>(file_.node_xyz.size());
      file_.node_xyz.push_back(all[i]);
      for (std::size_t k = 0; k < n_components_; ++k) file_.value.push_back(values[i * n_components_ + k]);
    }
    for (std::int64_t& node : file_.node) node = number[node];
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0, n_components_ = 0;
  CellFile file_;
  std::vector<double> place_, value_;
};

}  // namespace

CellFile parse_pos_cells(const std::string& path, std::string_view text) { return PosReader(path, text).read(); }

}  // namespace st
