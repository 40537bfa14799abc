#include "io/toml/source_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "base/length.h"
#include "base/nearest_name.h"
#include "base/similarity.h"
#include "base/text.h"
#include "io/file/text_file.h"
#include "io/toml/toml_entry.h"
#include "sizing/source_types.h"

namespace st {
namespace {

std::string read_text(const std::string& path) {
  std::string text = read_text_file(path);
  if (text.empty()) throw Error(ExitCode::kInput, path + ": empty file; write it again");
  return text;
}

/// Words of a text file by lines, with the line number for messages.
class LineReader {
 public:
  explicit LineReader(const std::string& path) : path_(path), text_(read_text(path)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::kInput, path_ + ":" + std::to_string(line_) + ": " + what + "; check the file");
  }
  bool next_line(std::string& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at_ = end + 1;
    ++line_;
    return true;
  }
  std::string line(const char* what) {
    std::string text;
    if (!next_line(text)) fail(std::string("ends before ") + what);
    return text;
  }
  /// The numbers of one line, at least `least`; Fortran exponents (1.0D-3) and empty lines before are accepted.
  std::vector<double> numbers(const char* what, std::size_t least) {
    std::string text;
    do text = line(what);
    while (text.find_first_not_of(" \t") == std::string::npos);
    std::vector<double> values;
    std::replace(text.begin(), text.end(), 'D', 'E');
    std::replace(text.begin(), text.end(), 'd', 'e');
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      double value = 0;
      const char* first = word.data() + (word[0] == '+');
      const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) break;
      values.push_back(value);
    }
    if (values.size() < least) fail(std::string(what) + ": " + std::to_string(least) + " numbers expected");
    return values;
  }
  std::int64_t count(double value, const char* what) const {
    if (!(value >= 0 && value <= 1e9) || value != std::floor(value)) fail(std::string(what) + ": not a count");
    return static_cast<std::int64_t>(value);
  }
  std::int64_t node_number(double value) const {
    if (!(std::abs(value) <= 1e15) || value != std::floor(value)) fail("not the number of a node");
    return static_cast<std::int64_t>(value);
  }

 private:
  std::string path_, text_;
  std::size_t at_ = 0;
  int line_ = 0;
};

/// Gives the node that is added next to the mesh its number in the file.
void number_node(const LineReader& file, double number, const BackgroundMesh& mesh,
                 std::map<std::int64_t, std::int32_t>& index) {
  const std::int64_t id = file.node_number(number);
  if (!index.emplace(id, static_cast<std::int32_t>(mesh.node_xyz.size())).second)
    file.fail("has two nodes of the number " + std::to_string(id));
}

std::array<std::int32_t, 4> tet_of(const LineReader& file, const std::map<std::int64_t, std::int32_t>& index,
                                   const double* ids) {
  std::array<std::int32_t, 4> tet{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto it = index.find(file.node_number(ids[k]));
    if (it == index.end()) file.fail("tetrahedron names a node that does not exist");
    tet[k] = it->second;
  }
  return tet;
}

// --- FLITE .bac ---

/// nullopt: the directions are not orthogonal.
std::optional<SymmetricTensor> orthogonal_metric(const std::array<Vec3, 3>& direction,
                                                 const std::array<double, 3>& spacing) {
  constexpr double kOrthogonal = 1e-3;  // cosine: files have few digits
  SymmetricTensor sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 d = normalized(direction[k]);
    if (!(std::abs(dot(d, normalized(direction[(k + 1) % 3]))) < kOrthogonal) || !(norm2(d) > 0)) return std::nullopt;
    const double w = 1 / (spacing[k] * spacing[k]);
    const SymmetricTensor own{d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.y * d.z, d.x * d.z};
    for (std::size_t i = 0; i < own.size(); ++i) sum[i] += w * own[i];
  }
  return sum;
}

void read_bac_nodes(LineReader& file, std::int64_t n_nodes, std::int64_t n_tets, BackgroundMesh& mesh) {
  std::map<std::int64_t, std::int32_t> index;
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    const std::vector<double> at = file.numbers("a background node", 4);
    number_node(file, at[0], mesh, index);
    LocalSize size;
    std::array<Vec3, 3> direction;
    std::array<double, 3> spacing{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double> v = file.numbers("a direction and its spacing", 4);
      if (!(v[3] > 0)) file.fail("spacing must be positive");
      size.length = axis ? std::min(size.length, v[3]) : v[3];
      if (v[3] > size.along) size.along = v[3], size.direction = {v[0], v[1], v[2]};
      direction[axis] = {v[0], v[1], v[2]};
      spacing[axis] = v[3];
    }
    mesh.node_xyz.push_back({at[1], at[2], at[3]});
    mesh.node_size.push_back(uniaxial(size));
    mesh.node_metric.push_back(orthogonal_metric(direction, spacing).value_or(metric_of(mesh.node_size.back())));
  }
  for (std::int64_t i = 0; i < n_tets; ++i)
    mesh.tets.push_back(tet_of(file, index, file.numbers("a tetrahedron", 5).data() + 1));
}

void read_bac_sources(LineReader& file, SourceKind kind, std::int64_t n, std::vector<SourceSpec>& sources) {
  file.line("the label of the sources");
  for (std::int64_t i = 0; i < n; ++i) {
    SourceSpec source;
    source.kind = kind;
    source.name = trimmed(file.line("the name of a source"));
    for (int k = 0; k < n_spacings(kind); ++k) {
      const std::vector<double> v = file.numbers("a point of a source, its spacing and two radii", 6);
      if (!(v[3] > 0) || v[4] < 0) file.fail("spacing must be positive, and radii not negative");
      source.point[k] = {v[0], v[1], v[2]};
      source.spacing[k] = {v[3], v[4], v[5]};
    }
    sources.push_back(source);
  }
}

SourceFile read_bac(const std::string& path) {
  LineReader file(path);
  file.line("the title");
  const std::vector<double> n = file.numbers("the numbers of nodes, tetrahedra and sources", 5);
  SourceFile result;
  const SourceKind kinds[] = {SourceKind::kPoint, SourceKind::kLine, SourceKind::kTriangle};
  std::int64_t n_left = 0;
  for (int k = 0; k < 3; ++k) n_left += file.count(n[2 + k], "sources");
  read_bac_nodes(file, file.count(n[0], "nodes"), file.count(n[1], "tetrahedra"), result.background);
  for (int k = 0; k < 3 && n_left > 0; ++k) {
    const std::int64_t count = file.count(n[2 + k], "sources");
    read_bac_sources(file, kinds[k], count, result.sources);
    n_left -= count;
  }
  return result;
}

// --- TOML ---

/// One [[source]] table; every access names file and line on failure.
class SourceTable {
 public:
  SourceTable(const std::string& path, const toml::table& table, const ModelScale& scale)
      : path_(path), table_(table), scale_(scale) {}

  [[noreturn]] void fail(const std::string& what, const toml::node* node = nullptr) const {
    throw Error(ExitCode::kUsage, toml_place(path_, (node ? *node : table_).source()) + ": " + what);
  }
  bool has(const char* key) const { return table_.contains(key); }
  std::string text(const char* key) const {
    const toml::node* node = table_.get(key);
    if (!node) return "";
    if (const auto* s = node->as_string()) return s->get();
    fail(std::string(key) + ": text expected", node);
  }
  /// false where it is not given.
  bool flag(const char* key) const {
    const toml::node* node = table_.get(key);
    if (node && !node->is_boolean()) fail(std::string(key) + ": takes true or false", node);
    return node && node->as_boolean()->get();
  }
  Vec3 vector(const char* key) const {
    const toml::node* node = table_.get(key);
    if (!node) fail(std::string("source needs ") + key + " = [x, y, z]");
    return vector(key, *node);
  }
  std::vector<Vec3> vectors(const char* key, std::size_t n) const {
    const toml::node* node = table_.get(key);
    const toml::array* list = node ? node->as_array() : nullptr;
    if (!list || list->size() != n)
      fail(std::string("source needs ") + key + " = [[x, y, z], ...] of " + std::to_string(n) + " points", node);
    std::vector<Vec3> points;
    for (const toml::node& p : *list) points.push_back(vector(key, p));
    return points;
  }
  double length(const char* key) const { return length(key, *table_.get(key)); }
  double number(const char* key, double least, double most) const {
    const toml::node& node = *table_.get(key);
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= least && *value <= most))
      fail(fmt::format("{}: a number from {:g} to {:g} expected", key, least, most), &node);
    return *value;
  }
  /// One value for all points, or one for each.
  std::vector<double> lengths(const char* key, std::size_t n, double fallback, bool may_be_zero) const {
    const toml::node* node = table_.get(key);
    if (!node) return std::vector<double>(n, fallback);
    const toml::array* list = node->as_array();
    if (!list) return std::vector<double>(n, length(key, *node, may_be_zero));
    if (list->size() != n)
      fail(std::string(key) + ": one value, or one for each of the " + std::to_string(n) + " points", node);
    std::vector<double> values;
    for (const toml::node& v : *list) values.push_back(length(key, v, may_be_zero));
    return values;
  }
  void require_known(const std::vector<std::string>& keys) const {
    for (const auto& [key, node] : table_)
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
        const std::string name(key.str());
        std::string known;
        for (const std::string& k : std::set(keys.begin(), keys.end())) known += (known.empty() ? "" : ", ") + k;
        fail("unknown key '" + name + "' of a source" + did_you_mean(name, keys) + "; the keys are " + known, &node);
      }
  }

 private:
  Vec3 vector(const char* key, const toml::node& node) const {
    const toml::array* list = node.as_array();
    double v[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = list && list->size() == 3 ? (*list)[k].value<double>() : std::nullopt;
      if (!value || !std::isfinite(*value)) fail(std::string(key) + ": [x, y, z] expected", &node);
      if (std::abs(*value) > kLargestCoordinate)
        fail(fmt::format("{}: {:g} is beyond {:g}, the largest coordinate", key, *value, kLargestCoordinate), &node);
      v[k] = *value;
    }
    return {v[0], v[1], v[2]};
  }
  double length(const char* key, const toml::node& node, bool may_be_zero = false) const {
    const auto* s = node.as_string();
    const auto number = node.is_number() ? node.value<double>() : std::nullopt;
    if (!s && !number) fail(std::string(key) + ": a length expected, such as 0.2 or \"5mm\"", &node);
    if (number && (!(*number > 0 || (may_be_zero && *number == 0)) || !std::isfinite(*number)))
      fail(std::string(key) + ": must be positive", &node);
    try {
      const LengthSpec spec = s ? parse_length(s->get(), key) : LengthSpec{LengthSpec::Kind::kModelUnit, *number, {}};
      return resolve_length(spec, {scale_.diagonal, scale_.unit_in_m}, key);
    } catch (const Error& e) {
      fail(e.what(), &node);
    }
  }

  const std::string& path_;
  const toml::table& table_;
  const ModelScale& scale_;
};

void read_shape(const SourceTable& table, const SourceType& type, SourceSpec& source) {
  for (const auto& [key, sets] : type.keys) switch (sets) {
      case SourceKey::kFirstPoint:
        source.point[0] = table.vector(key);
        break;
      case SourceKey::kSecondPoint:
        source.point[1] = table.vector(key);
        break;
      case SourceKey::kPoints: {
        const std::vector<Vec3> points = table.vectors(key, static_cast<std::size_t>(type.n_spacings));
        std::copy(points.begin(), points.end(), source.point.begin());
        break;
      }
      case SourceKey::kDirection:
        source.half_axis[0] = table.vector(key);
        break;
      case SourceKey::kExtent:
        if (!table.has(key)) table.fail(fmt::format("source needs {}, the radius of the volume", key));
        source.extent = table.length(key);
        break;
    }
  if (!type.complete) return;
  if (const std::string wrong = type.complete(source); !wrong.empty()) table.fail(wrong);
}

void read_stretch(const SourceTable& table, bool has_axis, SourceSpec& source) {
  if (table.has("aspect")) source.aspect = table.number("aspect", 1, 100);
  if (table.has("direction"))
    source.direction = table.vector("direction");
  else if (has_axis)
    source.direction = source.point[1] - source.point[0];
  if (source.aspect > 1 && !(norm(source.direction) > 0))
    table.fail("source with an aspect needs direction = [x, y, z], not zero");
  source.direction = source.aspect > 1 ? normalized(source.direction) : Vec3{};
}

SourceSpec read_source(const SourceTable& table) {
  SourceSpec source;
  source.name = table.text("name");
  const SourceType* type = find_source_type(table.text("type"));
  if (!type) {
    std::vector<std::string> names;
    for (const SourceType& known : source_types()) names.push_back(known.name);
    table.fail("type '" + table.text("type") + "'" + did_you_mean(table.text("type"), names) + ": write " +
               source_type_names());
  }
  source.kind = type->kind;
  read_shape(table, *type, source);
  if (!table.has("length")) table.fail("source needs a length");
  const auto n = static_cast<std::size_t>(type->n_spacings);
  const auto length = table.lengths("length", n, 0, false), radius = table.lengths("radius", n, 0, true),
             doubling = table.lengths("doubling", n, 0, false);
  for (std::size_t k = 0; k < n; ++k) {
    source.spacing[k] = {length[k], radius[k], doubling[k]};
    if (table.has("doubling") && doubling[k] <= radius[k]) table.fail("doubling must be larger than radius");
  }
  read_stretch(table, type->has_axis, source);
  return source;
}

std::string name_to_delete(const SourceTable& table) {
  const std::string name = table.text("name");
  if (name.empty()) table.fail("delete: needs the name of a source");
  return name;
}

/// The keys of all types.
std::vector<std::string> known_keys() {
  std::vector<std::string> keys{"name", "type", "delete", "length", "radius", "doubling", "aspect", "direction"};
  for (const SourceType& type : source_types())
    for (const SourceType::Key& key : type.keys) keys.push_back(key.name);
  return keys;
}

SourceFile read_toml(const std::string& path, const ModelScale& scale) {
  const toml::table file = parse_toml(path, read_text(path), ExitCode::kUsage);
  SourceFile result;
  const std::vector<const toml::table*> entries = toml_list(path, file, {"source", "st-prolong", ExitCode::kUsage});
  if (entries.empty() && !file.empty())
    throw Error(ExitCode::kUsage, path + ": no table [[source]] in it; see docs/st-prolong.md");
  for (const toml::table* entry : entries) {
    const SourceTable table(path, *entry, scale);
    table.require_known(known_keys());
    if (table.flag("delete"))
      result.deleted.push_back(name_to_delete(table));
    else
      result.sources.push_back(read_source(table));
  }
  return result;
}

bool is_flite(const std::string& path) { return path.ends_with(".bac") || path.ends_with(".ba3"); }

}  // namespace

SourceFile read_source_file(const std::string& path, const ModelScale& scale) {
  return is_flite(path) ? read_bac(path) : read_toml(path, scale);
}

SourceFile read_background_file(const std::string& path) {
  if (!is_flite(path))
    throw Error(ExitCode::kInput, path +
                                      ": no background mesh; give .bac, .ba3, .sol, .solb, .msh, .pos, .vtu or "
                                      ".vtkhdf");
  SourceFile file = read_bac(path);
  if (file.background.tets.empty()) throw Error(ExitCode::kInput, path + ": has no tetrahedra; give a background mesh");
  return file;
}

}  // namespace st
