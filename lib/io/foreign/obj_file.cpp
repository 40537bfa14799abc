// Wavefront's OBJ: points, polygons, names of groups, objects and materials.
#include <algorithm>
#include <unordered_map>

#include "base/limits.h"
#include "base/text.h"
#include "io/file/byte_cursor.h"
#include "io/foreign/polygon_split.h"
#include "io/foreign/triangulation_file.h"

namespace st {
namespace {

constexpr char kExport[] = "; export the mesh again";
constexpr std::string_view kWords[] = {"v", "vn", "vt", "f", "g", "o", "s", "l", "p", "mtllib", "usemtl"};

/// A name and the numbers of those in the file, in the order in which they first have a polygon.
class Names {
 public:
  void set(std::string_view name) { current_ = std::string(name); }
  std::int64_t number() {
    const auto [at, is_new] = number_.emplace(current_, static_cast<std::int64_t>(names_.size()));
    if (is_new) names_.push_back(current_);
    return at->second;
  }
  const std::vector<std::string>& all() const { return names_; }

 private:
  std::string current_;
  std::unordered_map<std::string, std::int64_t> number_;
  std::vector<std::string> names_;
};

class ObjReader {
 public:
  ObjReader(const std::string& path, const std::string& bytes) : in_(path, bytes) {}

  TriangulationFile read() {
    while (!in_.is_at_end()) {
      const std::string_view word = in_.word();
      if (word == "v") {
        const double x = in_.real(), y = in_.real(), z = in_.real();
        file_.node_xyz.push_back({x, y, z});
      } else if (word == "f") {
        read_polygon(in_.line());
        continue;
      } else if (word == "g" || word == "o") {
        groups_.set(trimmed(in_.line()));
        continue;
      } else if (word == "usemtl") {
        materials_.set(trimmed(in_.line()));
        continue;
      }
      in_.line();
    }
    const bool by_group = groups_.all().size() > 1 || materials_.all().size() < 2;
    const Names& names = by_group ? groups_ : materials_;
    if (names.all().size() > 1) {
      file_.surface = std::move(by_group ? group_ : material_);
      file_.surface_name = names.all();
    }
    return std::move(file_);
  }

 private:
  /// "1/2/3 4//5 6 ...": the first number is the point's, from 1, or from the end where it is negative.
  void read_polygon(std::string_view line) {
    polygon_.clear();
    ByteCursor words(in_.path(), line);
    for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
      word = word.substr(0, word.find('/'));
      std::int64_t number = 0;
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || stop != word.data() + word.size())
        in_.fail("not a number of a point in polygon " + ByteCursor::quoted(line) + kExport);
      const auto n_nodes = static_cast<std::int64_t>(file_.node_xyz.size());
      number = number < 0 ? n_nodes + number : number - 1;
      if (number < 0 || number >= n_nodes)
        in_.fail("a polygon names a point that does not stand before it: " + ByteCursor::quoted(line) + kExport);
      polygon_.push_back(number);
    }
    if (polygon_.size() < 3) in_.fail("a polygon of fewer than three points: " + ByteCursor::quoted(line) + kExport);
    split_polygon(file_.node_xyz, polygon_, file_.triangles);
    if (file_.triangles.size() > kMaxTriangles) in_.fail("has more triangles than can be handled");
    group_.resize(file_.triangles.size(), groups_.number());
    material_.resize(file_.triangles.size(), materials_.number());
  }

  ByteCursor in_;
  TriangulationFile file_;
  Names groups_, materials_;
  std::vector<std::int64_t> group_, material_, polygon_;
};

}  // namespace

/// Most lines begin with its words: some programs add lines of their own.
bool is_obj(std::string_view head) {
  bool has_point = false;
  int n_known = 0, n_others = 0;
  while (!head.empty()) {
    const std::size_t end = head.find('\n');
    if (end == std::string_view::npos && has_point) break;  // the last line may be cut
    const std::string line = trimmed(head.substr(0, end));
    head.remove_prefix(end == std::string_view::npos ? head.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    const std::string word = line.substr(0, line.find_first_of(" \t"));
    ++(std::find(std::begin(kWords), std::end(kWords), word) == std::end(kWords) ? n_others : n_known);
    has_point = has_point || word == "v";
  }
  return has_point && n_known > n_others;
}

TriangulationFile parse_obj(const std::string& path, const std::string& bytes) { return ObjReader(path, bytes).read(); }

}  // namespace st
